#include "himm_demo/track/track.hpp"

namespace sigmax::apps {

void Lean::add(double innovation) {
  constexpr std::size_t together = 32;
  some_.add(innovation);
  if (some_.count() == together) means_.add(std::exchange(some_, {}).mean());
}

double Lean::mean() const {
  constexpr std::size_t fewest = 4;
  constexpr double much = 0.3, sure = 3.0;
  if (means_.count() < fewest) return 0.0;
  const auto [mean, half_width] = means_.interval();
  return std::abs(mean) > std::max(much, sure * half_width) ? mean : 0.0;
}

namespace {

/// What may be wrong with a recording, or with the settings for it.
class Warnings {
 public:
  Warnings(const TrackOptions& options, const RecordingReader& recording, const std::vector<FilterSettings>& filters,
           const TrackOutcome& outcome, std::vector<std::string> findings)
      : options_(options),
        recording_(recording),
        filters_(filters),
        outcome_(outcome),
        warnings_(std::move(findings)) {}

  /// In sentences: causes before what they bring about.
  std::vector<std::string> all() {
    of_rows();
    causes_ = warnings_.size();
    of_outliers();
    of_lost_filters();
    of_gates();
    of_nis();
    of_common_errors();
    of_truth();
    of_sides();
    of_shares();
    of_options();
    return std::move(warnings_);
  }

 private:
  void of_rows() {
    const Validity& validity = outcome_.validity;
    const double unit = std::pow(10.0, std::floor(std::log10(validity.sigma_range_needed)) - 1.0);
    warn(validity.outside > 0,
         "{}:{}: r σ_α²/σ_r is {:.2g} at a range of {:.0f} m, where the standard conversion of radar measurements "
         "holds below {}; so it is in {} of {} measurements; set sigma_range_m above {:.6g}, so that their covariance "
         "covers the error of the conversion, or radar_measurement=polar, best with member=ukf, which converts only "
         "for the start",
         file_, validity.first_line, validity.first_value, validity.first_range, Validity::limit, validity.outside,
         validity.measurements, std::ceil(validity.sigma_range_needed / unit) * unit);
  }

  void of_outliers() {
    const bool tied = std::ranges::all_of(filters_, [](const FilterSettings& filter) {
      return filter.accuracy.velocity_mps && std::ranges::all_of(filter.models, [](const std::string& model) {
               return model == "dwna" || model == "dwpa";
             });
    });
    const bool by_slopes = recording_.polar() && std::ranges::any_of(filters_, [](const FilterSettings& filter) {
                             return filter.member == MemberType::ekf &&
                                    (filter.radar_measurement == RadarForm::polar || filter.accuracy.range_rate_mps);
                           });
    const Outliers& outliers = outcome_.outliers;
    const bool many =
        options_.recording.track_id.empty() && outliers.count >= 3 && 10 * outliers.count >= outcome_.measurements;
    warn(outliers.count > 0,
         "{}:{}: no filter expects this measurement (NIS {:.3g}); above an NIS of {} are {} of {}; look for outliers, "
         "or raise sigma_w or the sensor's sigmas{}{}{}{}",
         file_, outliers.worst_line, outliers.worst_nis, Outliers::limit, outliers.count, outcome_.measurements,
         outcome_.bearings == outcome_.measurements ? ", or lower sigma_w, where bearings are far apart in time" : "",
         by_slopes ? ", or, for a target that comes near a radar, try --set member=ukf" : "",
         tied ? "; dwna and dwpa tie a velocity to the way of the step: try --set models=[cwna,cwpa]" : "",
         many ? "; if the file holds several targets, tell them apart with --track-id COLUMN" : "");
  }

  void of_lost_filters() {
    const Outliers& outliers = outcome_.outliers;
    const auto loser = most_of(&FilterOutcome::lost), stray = most_of(&FilterOutcome::lost_by_far);
    const std::size_t lost_rows = loser->lost.rows;
    const bool many_lost = lost_rows >= 5 && 20 * lost_rows >= outcome_.measurements && lost_rows > outliers.count;
    const auto& [lost, first_lost] = many_lost ? loser->lost : stray->lost_by_far;
    warn(many_lost || (lost > 0 && outliers.count == 0),
         "{}:{}: filter '{}' does not expect this measurement, though another filter does; so it is with {} of {} (NIS "
         "above {}); raise its sigma_w, or see what the other one has that it lacks",
         file_, first_lost, settings_of(*(many_lost ? loser : stray)).name, lost, outcome_.measurements,
         many_lost ? Outliers::limit : Outliers::by_far);
  }

  void of_gates() {
    const Refusals& worst = outcome_.refusals;
    const FilterSettings& refusing = worst.filter ? *worst.filter : filters_.front();
    warn(worst.many > 0,
         "{}: the gate of filter '{}' turned {} of {} measurements{} away{}, where {:.2g} are expected: the filter "
         "does not follow, or there are several targets or many outliers; raise sigma_w, the sensor's sigmas or "
         "gate_probability",
         file_, refusing.name, worst.rejected, worst.measurements,
         worst.track.empty() ? "" : fmt::format(" of track '{}'", worst.track),
         worst.many > 1 ? fmt::format(" (and of {} other filters or tracks too many)", worst.many - 1) : "",
         (1.0 - refusing.gate_probability) * static_cast<double>(worst.measurements));
    const auto given_up = most_of(&FilterOutcome::given_up);
    warn(
        given_up->given_up.rows > 0 && worst.many == 0,
        "{}:{}: filter '{}' begins anew here, as its gate turned the rows just before away; such starts are {} in all: "
        "the target moves as its models do not, and estimates before are farther off than they say; raise sigma_w or "
        "gate_probability, or add a model",
        file_, given_up->given_up.first_line, settings_of(*given_up).name, given_up->given_up.rows);
  }

  void of_nis() {
    // Those of the least and of the greatest NIS; one with a fuzzy mode hides what another shows.
    const auto tally_of = [](const FilterOutcome& one) -> const InnovationTally& { return one.sums[0].innovations; };
    const auto ratio = [&](const FilterOutcome& one) {
      return tally_of(one).mean_nis() / tally_of(one).expected_nis();
    };
    if (std::ranges::any_of(outcome_.filters, [&](const auto& one) { return tally_of(one).count() < 10; })) return;
    const FilterOutcome& best = *std::ranges::min_element(outcome_.filters, {}, ratio);
    const double greatest = ratio(*std::ranges::max_element(outcome_.filters, {}, ratio));
    const double nis = tally_of(best).mean_nis(), usual = tally_of(best).expected_nis();
    const double low_nis = recording_.tells_accuracy() ? 0.2 : 0.1;
    const bool low = (greatest < low_nis || ratio(best) < low_nis / 2.0) &&
                     outcome_.refusals.many == 0;  // what the gate lets pass has a low one
    const RunningMean& predicted = best.sums[0].predicted_share;
    const double share = predicted.count() > 0 ? predicted.mean() : 0.0;
    const bool by_prediction = share > 0.5 && nis >= low_nis * usual * (1.0 - share);
    const bool alone = nis >= 0.5 * usual * (1.0 - share);
    warn(low && by_prediction,
         "{}: the mean NIS is {:.2g}, where {:.3g} is expected, and {:.0f} % of the variance of an innovation "
         "is the prediction's: {} too great for this target",
         file_, nis, usual, 100.0 * share, alone ? "sigma_w is" : "sigma_w and the sensor's sigmas are");
    warn(low && !by_prediction,
         "{}: the mean NIS is {:.2g}, where {:.3g} is expected: the measurements are far better than the "
         "sensor's sigmas say, their errors last, as those of a GNSS do, or they are in another unit than was taken; "
         "headers may name one, as range_nmi, range_km, altitude_ft",
         file_, nis, usual);
    const double alike = best.without_velocity.count() < 50 ? 0.0 : best.without_velocity.autocorrelation();
    warn(!low && greatest < 0.5 && alike > 0.5 && outcome_.refusals.many == 0,
         "{}: the mean NIS is {:.2g}, where {:.3g} is expected, and neighbouring innovations are alike (correlation "
         "{:.2f}): errors last, as those of a GNSS or of a device that averages, whose positions are late, too; or "
         "raise sigma_w, and lower the sensor's sigmas",
         file_, nis, usual, alike);
    const auto lasting = [](const FilterOutcome& one) {
      return one.with_velocity.count() < 50 ? 0.0 : one.with_velocity.autocorrelation();
    };
    constexpr double much = 0.8;  // turns within a step make 0.7
    const double lasts = lasting(*std::ranges::min_element(outcome_.filters, {}, lasting));
    warn(!low && causes_ == 0 && greatest >= 0.5 && greatest < 1.0 && alike > much,
         "{}: neighbouring innovations are much the same (correlation {:.2f}): errors of positions last, or were "
         "interpolated, and make the estimates worse than they say; raise sigma_position_m, or leave the measured rows "
         "alone",
         file_, alike);
    warn(!low && lasts > much && greatest < 1.0,
         "{}: neighbouring innovations of positions are much the same (correlation {:.2f}), beside velocities that "
         "count: errors of positions that last, as those of a GNSS do, make the estimates worse than they say; raise "
         "sigma_position_m",
         file_, lasts);
  }

  /// Of rows of one time the second is told with what was said of the first, so that their errors alone count.
  void of_common_errors() {
    const auto agrees = [](const FilterOutcome& one) {
      if (std::min(one.nis_first.count(), one.nis_again.count()) < 50) return false;
      const double first = one.nis_first.mean(), again = one.nis_again.mean();
      return again < 0.2 || (first > 1.2 && again < 0.4 * first && again < 0.7);
    };
    const auto found = std::ranges::find_if(outcome_.filters, agrees);
    if (found == outcome_.filters.end() || warnings_.size() > causes_) return;
    warn(
        true,
        "{}: rows of one time agree with each other better than their sigmas say (NIS a quantity {:.2g}, and {:.2g} of "
        "the first of each time): the sigmas are too great, or errors are in part common to all, count as new in each, "
        "and the estimates are farther off than they say; lower the sigmas, or give one row of each time",
        file_, found->nis_again.mean(), found->nis_first.mean());
  }

  void of_truth() {
    const auto times_stated = [](const FilterOutcome& one) {
      const Sums& sums = one.sums[0];
      const bool enough = sums.error[0].count() >= std::max<std::size_t>(sums.count(), 30);
      return enough ? length_of(sums.error) / length_of(sums.sigma) : 0.0;
    };
    const auto farthest = std::ranges::max_element(outcome_.filters, {}, times_stated);
    const double error = length_of(farthest->sums[0].error), measured = length_of(outcome_.raw[0].error);
    warn(times_stated(*farthest) > 2.0,
         "{}: the truth is {:.3g} m off the estimates of filter '{}' (RMS), which are told to be {:.3g} m off{}: see "
         "whether it has the same axes and times, and, if so, raise sigma_w or the sensor's sigmas",
         file_, error, settings_of(*farthest).name, length_of(farthest->sums[0].sigma),
         measured > 0.0 && measured < error ? fmt::format("; the measurements are {:.3g} m off", measured) : "");
  }

  void of_sides() {
    for (const auto& named : outcome_.filters.front().leans) {
      if (warnings_.size() > causes_) return;  // one is enough
      const std::string& sensor = named.first;
      double by = 0.0;
      for (std::size_t k = 0; k < named.second.size(); ++k) {
        const auto size = [&](const FilterOutcome& one) {
          const auto own = one.leans.find(sensor);
          return own == one.leans.end() ? 0.0 : std::abs(own->second[k].mean());
        };
        by = std::max(by, std::ranges::min(each(outcome_.filters, size)));
      }
      warn(by > 0.0,
           "{}: what {} tells is to one side of what every filter expects, by {:.2g} standard deviations on the "
           "average, so that the estimates may be farther off than they say: {}",
           file_, sensor.empty() ? "a row" : fmt::format("sensor '{}'", sensor), by,
           outcome_.sensors.size() > 1 ? "see whether the sensors' places, north, clocks and scales agree"
           : outcome_.filters.front().with_velocity.count() > 0
               ? "see whether positions and velocities have one scale, the same axes and one clock"
               : "raise sigma_w, or add a model that moves as the target does");
    }
  }

  void of_shares() {
    const Outliers& outliers = outcome_.outliers;
    const bool few_outliers = outliers.count > 0 && 20 * outliers.count < outcome_.measurements;
    if (causes_ > 0 || warnings_.size() > (few_outliers ? 1 : 0)) return;
    // A random mode keeps to its share, as far as chance lets it; a fuzzy one of the right settings comes to 86 %.
    const auto is_too_sure = [&](const FilterOutcome& one) {
      const InnovationTally& tally = one.sums[0].innovations;
      const double chance = std::sqrt(0.05 * 0.95 / static_cast<double>(tally.count()));
      return tally.count() >= 50 &&
             tally.share_inside() < (settings_of(one).fuzzy ? 0.8 : std::min(0.9, 0.95 - 3.0 * chance));
    };
    if (const auto found = std::ranges::find_if(outcome_.filters, is_too_sure); found != outcome_.filters.end())
      warn(true,
           "{}: {:.0f} % of the measurements are where filter '{}' expects 95 %: raise sigma_w or the sensor's "
           "sigmas; himm_demo tune fits them",
           file_, 100.0 * found->sums[0].innovations.share_inside(), settings_of(*found).name);
  }

  void of_options() {
    constexpr double year = 31556952.0;
    const double dated = 1970.0 + outcome_.last_time / year;
    warn(options_.iso_times && recording_.times_are_numbers() && (std::floor(dated) == 1970.0 || dated > 2060.0),
         "{}: by --iso-times the last row is of the year {:.0f}, as dates count from 1970 on: if times count from "
         "another "
         "day, as a spreadsheet's do from 25569 days before, take that off",
         file_, std::floor(dated));
    for (const auto& filter : filters_)
      for (const auto& [sensor, own] : filter.sensors)
        warn(!outcome_.sensors.contains(sensor), "key 'sensor.{}' of filter '{}': no row of {} is of that sensor",
             sensor, filter.name, file_);
    warn(outcome_.unpredicted > 0,
         "{}: of {} of {} tracks nothing is predicted by a filter whose restart_after_s goes by before the time of "
         "--predict-to: give a greater one, or an earlier time",
         file_, outcome_.unpredicted, outcome_.predicted);
    warn(options_.predict_to && outcome_.predicted == 0,
         "{}: nothing was predicted: every track ends at the time of --predict-to or later; write it as the recording "
         "writes its times",
         file_);
  }

  template <class... Args>
  void warn(bool holds, fmt::format_string<Args...> format, Args&&... args) {
    if (holds) warnings_.push_back(fmt::format(format, std::forward<Args>(args)...));
  }

  /// The filter that counts the most.
  std::vector<FilterOutcome>::const_iterator most_of(Counted FilterOutcome::*which) const {
    return std::ranges::max_element(outcome_.filters, {}, [=](const auto& one) { return (one.*which).rows; });
  }

  const FilterSettings& settings_of(const FilterOutcome& one) const {
    return filters_[static_cast<std::size_t>(&one - outcome_.filters.data())];
  }

  static double length_of(const std::array<RootMeanSquare, 3>& axes) {
    return std::hypot(axes[0].value(), axes[1].value(), axes[2].value());
  }

  const TrackOptions& options_;
  const RecordingReader& recording_;
  const std::vector<FilterSettings>& filters_;
  const TrackOutcome& outcome_;
  const std::string& file_ = recording_.file();
  std::vector<std::string> warnings_;
  std::size_t causes_ = 0;
};

}  // namespace

std::vector<std::string> warnings_of(const TrackOptions& options, const RecordingReader& recording,
                                     const std::vector<FilterSettings>& filters, const TrackOutcome& outcome,
                                     std::vector<std::string> findings) {
  return Warnings(options, recording, filters, outcome, std::move(findings)).all();
}

}  // namespace sigmax::apps
