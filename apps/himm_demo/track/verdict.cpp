#include <regex>
#include <sigmax/estimation/chi_square.hpp>

#include "himm_demo/track/track.hpp"

namespace sigmax::apps {
namespace {

/// What the rules judge by.
struct Evidence {
  const TrackOptions& options;
  const RecordingReader& recording;
  const std::vector<FilterSettings>& filters;
  const TrackOutcome& outcome;
  const TrackOutcome* gated;

  const std::string& file() const { return recording.file(); }

  /// The command that fits the noise to the recording, read as it was: by this one's options that tune has, too.
  std::string tune() const {
    static const std::regex others(" --(out|report|predict-to)[ =]('[^']*'|\"[^\"]*\"|[^ ]*)| --(quiet|wide)\\b");
    std::string words = std::regex_replace(options.output.command, others, "");
    words.replace(words.find(" track "), 7, " tune ");
    const bool has_settings = !options.filters.sets.empty() || !options.filters.config.empty();
    return fmt::format("fit it by {} --out best.toml, and give --config best.toml{}", words,
                       has_settings ? " instead of these settings" : "");
  }
};

/// The conversion of a radar's measurements to positions is biased.
std::string conversion(const Evidence& evidence) {
  const Counted& unsuited = evidence.outcome.unsuited;
  if (unsuited.rows == 0) return "";
  return fmt::format(
      "{}:{}: the conversion to positions is biased in {} of {} measurements (r σ_α²/σ_r ≥ {}): --set "
      "radar_measurement=polar --set member=ukf",
      evidence.file(), unsuited.first_line, unsuited.rows, evidence.outcome.measurements, most_conversion_bias);
}

/// A gate turns a fifth of a track away, and at least five rows: the filter does not follow the target.
std::string gate(const Evidence& evidence) {
  for (const auto& [track, tally] : evidence.outcome.each)
    for (std::size_t f = 0; f < evidence.filters.size(); ++f)
      if (const std::size_t rejected = tally.nis[f].rejected; rejected >= 5 && 5 * rejected > tally.measurements)
        return fmt::format(
            "{}: the gate of filter '{}' turned {} of {} measurements{} away, and it lost the target: {}",
            evidence.file(), evidence.filters[f].name, rejected, tally.measurements,
            track.empty() ? "" : fmt::format(" of track '{}'", track), evidence.tune());
  return "";
}

constexpr double least_share = 0.8;
constexpr std::size_t least_count = 20;  // innovations

/// The share of the innovations that are where 95 % should be, of the filter with the greatest.
double share_inside(const TrackOutcome& outcome) {
  double most = 0.0;
  for (const FilterOutcome& one : outcome.filters)
    most = std::max(most, one.sums[0].innovations.count() < least_count ? 1.0 : one.sums[0].innovations.share_inside());
  return most;
}

/// A gate turns a few measurements away, and most of them alone, so that no filter loses its target.
std::string outliers(const Evidence& evidence) {
  const TrackOutcome& outcome = evidence.outcome;
  const auto gates = [](const FilterSettings& filter) { return filter.gate_probability < 1.0; };
  if (outcome.outliers == 0 || std::ranges::any_of(evidence.filters, gates)) return "";
  if (!evidence.gated)
    return fmt::format("{}: {} of {} measurements have an NIS above {}: reject outliers with --set gate_probability={}",
                       evidence.file(), outcome.outliers, outcome.measurements, outlier_nis, outlier_gate);
  const TrackOutcome& gated = *evidence.gated;
  const Refused& refused = gated.refused_by_all;
  std::size_t lost = 0;  // rows, of all filters
  for (const FilterOutcome& one : gated.filters) lost += 5 * one.restarts;
  for (const FilterOutcome& one : outcome.filters) lost -= std::min(lost, 5 * one.restarts);
  if (refused.rows == 0 || 20 * refused.rows > outcome.measurements || share_inside(gated) < least_share ||
      2 * lost > refused.rows * evidence.filters.size())
    return "";
  const double km = 1e-3 * refused.metres;
  return fmt::format(
      "{}:{}: {} outlier{} in {} measurements, this one {} off: reject {} with --set gate_probability={}",
      evidence.file(), refused.worst_line, refused.rows, refused.rows == 1 ? "" : "s", outcome.measurements,
      km < 10.0 ? fmt::format("{:.4g} m", refused.metres) : fmt::format("{:.0f} km", km),
      refused.rows == 1 ? "it" : "them", outlier_gate);
}

/// Innovations are too small or too large. Where a gain is too low they last, where it is too high they alternate,
/// which tells the noise of the target from that of a sensor. Which of several sensors is wrong they do not tell.
std::string noise(const Evidence& evidence) {
  const TrackOutcome& outcome = evidence.outcome;
  const auto size = [](const InnovationTally& tally) {
    return std::sqrt(tally.median_nis() / chi_square_quantile(0.5, tally.expected_nis()));
  };
  const bool many_far = 100 * outcome.outliers > outcome.measurements && outcome.sensors.size() < 2;
  std::vector<std::string> sensors;
  const InnovationTally* worst = nullptr;  // of the first filter
  bool large = false;                      // the noise, and not the innovations
  for (const auto& [sensor, tally] : outcome.filters.front().sensors) {
    const auto of_all = [&, &name = sensor](const auto& holds) {
      return std::ranges::all_of(outcome.filters, [&](const FilterOutcome& one) {
        const auto own = one.sensors.find(name);
        return own != one.sensors.end() && own->second.count() >= least_count && holds(own->second);
      });
    };
    const bool is_large = of_all([&](const InnovationTally& one) { return size(one) < 0.3; });
    const bool is_small =
        of_all([&](const InnovationTally& one) { return one.share_inside() < (many_far ? 0.94 : least_share); });
    if ((!is_large && !is_small) || (worst && is_large != large)) continue;
    large = is_large;
    sensors.push_back("'" + sensor + "'");
    if (!worst || tally.share_inside() < worst->share_inside()) worst = &tally;
  }
  if (!worst) return "";
  if (!large && !evidence.recording.has_tracks() && size(*worst) > 20.0)
    return fmt::format(
        "{}: innovations are {:.2g} times too large: several targets or false detections are mixed, or a unit is "
        "wrong; tell targets apart with --track-id COLUMN",
        evidence.file(), size(*worst));
  const double lasts = worst->autocorrelation();
  const bool is_sensor = !(std::abs(lasts) > 0.3 && (lasts < 0.0) == large);
  const std::string whose =
      !is_sensor ? "sigma_w"
                 : fmt::format("the {} noise of {}", outcome.by_default.empty() ? "assumed" : "default",
                               sensors.front() == "''" ? "the measurements"
                                                       : fmt::format("sensor {}", fmt::join(sensors, " or ")));
  const std::string by =
      large ? fmt::format("{:.2g} times too large (median NIS {:.2g}, right is {:.2g})", 1.0 / size(*worst),
                          worst->median_nis(), chi_square_quantile(0.5, worst->expected_nis()))
      : worst->share_inside() >= least_share
          ? fmt::format("too small ({} of {} innovations have an NIS above {})", outcome.outliers, outcome.measurements,
                        outlier_nis)
          : fmt::format("too small ({:.0f} % of the innovations are where 95 % should be)",
                        100.0 * worst->share_inside());
  return fmt::format("{}: {} is {}: {}", evidence.file(), whose, by,
                     evidence.recording.has_accuracy() && is_sensor
                         ? "see the unit of the columns of standard deviations"
                         : evidence.tune());
}

/// A filter is not consistent although others are.
std::string of_one_filter(const Evidence& evidence) {
  for (std::size_t f = 0; f < evidence.filters.size(); ++f)
    if (const auto& own = evidence.outcome.filters[f].sums[0].innovations;
        own.count() >= least_count && own.share_inside() < least_share)
      return fmt::format(
          "{}: the noise of filter '{}' is too small ({:.0f} % of its innovations are where 95 % should be): {}",
          evidence.file(), evidence.filters[f].name, 100.0 * own.share_inside(), evidence.tune());
  return "";
}

/// The truth is farther from the estimates of every filter than twice what they state.
std::string truth(const Evidence& evidence) {
  const auto length = [](const std::array<RootMeanSquare, 3>& axes) {
    return std::hypot(axes[0].value(), axes[1].value(), axes[2].value());
  };
  double error = 0.0, times = infinity;
  for (const FilterOutcome& one : evidence.outcome.filters) {
    const Sums& all = one.sums[0];
    if (all.error[0].count() < std::max<std::size_t>(all.count(), 30)) return "";
    if (const double own = length(all.error) / length(all.sigma); own < times) times = own, error = length(all.error);
  }
  if (!(times > 2.0)) return "";
  return fmt::format("{}: the estimates are {:.3g} m off the truth (RMS), {:.2g} times what they state: {}",
                     evidence.file(), error, times, evidence.tune());
}

/// No rule asks another one; what brings others about stands above.
constexpr std::array rules = {conversion, gate, outliers, noise, of_one_filter, truth};

}  // namespace

std::string verdict_of(const TrackOptions& options, const RecordingReader& recording,
                       const std::vector<FilterSettings>& filters, const TrackOutcome& outcome,
                       const TrackOutcome* gated) {
  const Evidence evidence{options, recording, filters, outcome, gated};
  for (const auto rule : rules)
    if (auto words = rule(evidence); !words.empty()) return words;
  const InnovationTally& innovations = outcome.filters.front().sums[0].innovations;
  if (innovations.count() < least_count)
    return fmt::format("not judged: {} innovations, {} are needed", innovations.count(), least_count);
  return fmt::format("consistent ({:.0f} % of the innovations are where 95 % should be)",
                     100.0 * innovations.share_inside());
}

std::optional<TrackOutcome> with_gate(TrackOptions options, const RecordingOptions& what,
                                      std::vector<FilterSettings> filters, const TrackOutcome& outcome) {
  if (outcome.outliers == 0 || what.file == "-" || !std::filesystem::is_regular_file(what.file)) return std::nullopt;
  options.output.quiet = true;
  options.predict_to.reset();
  for (FilterSettings& filter : filters) {
    if (filter.gate_probability < 1.0) return std::nullopt;
    filter.gate_probability = outlier_gate;
    filter.smooth = filter.explain = false;
  }
  RecordingReader recording(what);
  return run_track(options, recording, filters, {});
}

}  // namespace sigmax::apps
