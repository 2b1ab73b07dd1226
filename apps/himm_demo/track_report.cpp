#include "himm_demo/track_report.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "result/table.hpp"
#include "support/json.hpp"
#include "support/output.hpp"
#include "version.hpp"

namespace sigmax::apps {
namespace {

/// Makes the report part by part; text and data grow together.
class Reporter {
 public:
  Reporter(const TrackOptions& options, const RecordingReader& recording, const std::vector<FilterSettings>& filters,
           const TrackOutcome& outcome)
      : options_(options), recording_(recording), filters_(filters), outcome_(outcome) {}

  TrackReport made() {
    describe_run();
    describe_recording();
    describe_starts();
    warn();
    const std::string description = text_;
    const std::size_t part_count = recording_.has_roll() ? parts.size() : 1;
    for (std::size_t p = 0; p < part_count; ++p) tabulate(p);
    explain();
    return {text_, description, std::move(tables_), std::move(summary_), warnings_};
  }

 private:
  /// A sentence, in lines of the width asked for.
  void say(std::string_view sentence) { text_ += wrapped(sentence, options_.output.width()); }

  void say_by_sensor(std::string_view what, const std::map<std::string, std::size_t>& counts) {
    std::vector<std::string> parts;
    for (const auto& [sensor, count] : counts) parts.push_back(fmt::format("{} {}", sensor, count));
    if (!parts.empty()) say(fmt::format("{}: {}", what, fmt::join(parts, ", ")));
  }

  void describe_run() {
    summary_ = {{"version", version}, {"command", options_.output.command}, {"file", file_}};
    summary_["seed"] = options_.seed;
    if (options_.radar) {
      summary_["radar"] = {{"sigma_range_m", (*options_.radar)[0]},
                           {"sigma_azimuth_deg", (*options_.radar)[1]},
                           {"sigma_elevation_deg", (*options_.radar)[2]}};
    }
    if (options_.radar || recording_.polar() || recording_.bearings()) summary_["radar"]["at_m"] = radar_at();
    if (const auto& origin = outcome_.origin) {
      summary_["origin"] = {{"latitude_deg", origin->latitude_deg},
                            {"longitude_deg", origin->longitude_deg},
                            {"altitude_m", origin->altitude_m}};
    }
    summary_["rows"] = outcome_.rows;
    summary_["measurements"] = outcome_.measurements;
    if (outcome_.partial > 0) summary_["partial_measurements"] = outcome_.partial;
    if (outcome_.bearings > 0) summary_["bearings"] = outcome_.bearings;
    summary_["skipped"] = recording_.skipped();
    if (recording_.has_sensors()) summary_["sensors"] = outcome_.sensors;
    if (recording_.has_tracks())
      summary_["tracks"] = {{"count", outcome_.tracks}, {"never_started", outcome_.never_started}};
    summary_["settings_toml"] = as_toml(filters_);
  }

  void describe_recording() {
    const bool converted = std::none_of(filters_.begin(), filters_.end(), [](const FilterSettings& filter) {
      return filter.radar_measurement == RadarForm::polar;
    });
    say(fmt::format("{}: {} rows, {} measurements{}, {} {}{}{}", file_, outcome_.rows, outcome_.measurements,
                    parts_of_measurements(), recording_.axes(), recording_.axes() == 1 ? "axis" : "axes",
                    recording_.geodetic() ? ", geodetic to local east-north-up" : "",
                    !recording_.polar() ? ""
                    : converted         ? ", a radar's measurements converted"
                                        : ", a radar's measurements"));
    say(fmt::format("Taken for: {}", recording_.taken()));
    for (const std::string& note : recording_.notes()) say(note);
    if (recording_.has_sensors()) say_by_sensor("Rows by sensor", outcome_.sensors);
    say_by_sensor("Rows whose velocity does not count, for want of sensor.NAME.sigma_velocity_mps",
                  outcome_.velocity_unknown);
    say_by_sensor("Rows whose range rate does not count, for want of sensor.NAME.sigma_range_rate_mps",
                  outcome_.range_rate_unknown);
    if (recording_.has_tracks()) {
      const std::size_t short_ones = outcome_.never_started.size();
      say(fmt::format(
          "{} tracks by {}{}", outcome_.tracks, options_.recording.track_id,
          short_ones > 0 ? fmt::format(", {} of them too short for every filter to start", short_ones) : ""));
    }
    if (recording_.skipped() > 0)
      say(fmt::format("Skipped {} rows whose time was not after that of the row before", recording_.skipped()));
  }

  /// How many of them are not positions along all axes.
  std::string parts_of_measurements() const {
    std::vector<std::string> parts;
    if (outcome_.partial > 0) parts.push_back(fmt::format("{} along some axes only", outcome_.partial));
    if (outcome_.bearings > 0) parts.push_back(fmt::format("{} bearings", outcome_.bearings));
    return parts.empty() ? "" : fmt::format(" ({})", fmt::join(parts, ", "));
  }

  void describe_starts() {
    const auto by_filter = [&](const char* key, const char* what, std::size_t FilterOutcome::*count) {
      std::vector<std::string> counts;
      for (std::size_t f = 0; f < filters_.size(); ++f)
        if (const std::size_t total = outcome_.filters[f].*count; total > 0) {
          counts.push_back(fmt::format("{} {}", filters_[f].name, total));
          summary_[key][filters_[f].name] = total;
        }
      if (!counts.empty()) say(fmt::format("{}: {}", what, fmt::join(counts, ", ")));
    };
    by_filter("rejected", "Measurements that the gate turned away", &FilterOutcome::rejected);
    if (outcome_.refused_by_all > 0)
      say(fmt::format("Turned away by every filter: {}, the first on line {}", outcome_.refused_by_all,
                      outcome_.first_refused_line));
    by_filter("restarts", "Starts after a gap, or after rejections in a row", &FilterOutcome::restarts);
    if (!options_.radar) return;
    const auto& sigma = *options_.radar;
    const auto at = radar_at();
    say(fmt::format(
        "The recording is taken as the truth and measured by a simulated radar: {} m, {}°, {}° at ({}, {}, {}) m, seed "
        "{}",
        shortest(sigma[0]), shortest(sigma[1]), shortest(sigma[2]), shortest(at[0]), shortest(at[1]), shortest(at[2]),
        options_.seed));
  }

  void warn() {
    if (outcome_.validity.broken()) warnings_.push_back(outcome_.validity.warning(file_));
    if (outcome_.outliers.any())
      warnings_.push_back(outcome_.outliers.warning(file_, outcome_.measurements, options_.recording.track_id.empty()));
    if (outcome_.refusals.any()) warnings_.push_back(outcome_.refusals.warning(file_));
    if (recording_.senseless() > 0)
      warnings_.push_back(fmt::format(
          "{}:{}: no measurement can be that great; {} such {} as missed; leave the cells empty where there is none",
          file_, recording_.first_senseless_line(), recording_.senseless(),
          recording_.senseless() == 1 ? "row counts" : "rows count"));
    if (!outcome_.refusals.any()) warn_of_low_nis();  // what the gate lets pass has a low one
    for (const auto& filter : filters_)
      for (const auto& [sensor, accuracy] : filter.sensors)
        if (!outcome_.sensors.contains(sensor))
          warnings_.push_back(fmt::format("key 'sensor.{}' of filter '{}': no row of {} is of that sensor", sensor,
                                          filter.name, file_));
    if (options_.predict_to && outcome_.predicted == 0)
      warnings_.push_back(
          fmt::format("{}: nothing was predicted: every track ends at the time of --predict-to or "
                      "later; write it as the recording writes its times",
                      file_));
    if (!warnings_.empty()) summary_["warnings"] = warnings_;
  }

  /// Where every filter finds its measurements much better than it believes.
  void warn_of_low_nis() {
    double greatest = 0.0;
    for (const auto& filter : outcome_.filters) {
      const Sums& sums = filter.sums[0];
      if (sums.nis.count() < 10) return;
      greatest = std::max(greatest, sums.nis.mean());
    }
    const int expected = recording_.bearings() && !recording_.located() ? 1 : recording_.axes();
    if (greatest >= 0.1 * expected) return;
    warnings_.push_back(fmt::format(
        "{}: the mean NIS is {:.2g} at most, where {} is expected: the measurements are far better than the sensor's "
        "sigmas say, or in another unit than was taken; headers may name one, as range_nmi, range_km, altitude_ft",
        file_, greatest, expected));
  }

  /// The table of one part of the rows: a row for the measurement, if its error is known, and for each filter.
  void tabulate(std::size_t p) {
    const bool truth_known = options_.radar || recording_.has_truth();
    std::vector<ResultColumn> columns = {{.key = "filter", .header = std::string(parts[p].name), .align = Align::left},
                                         {.key = "rows", .header = "rows"}};
    const auto add_columns = [&](std::string_view key, const std::string& group) {
      for (std::size_t axis = 0; axis < axes(); ++axis)
        columns.push_back({.key = fmt::format("{}_{}_m", key, axis_names[axis]),
                           .header = axis_names[axis],
                           .sized = true,
                           .group = group});
    };
    if (truth_known) add_columns("rmse", "RMSE, m:");
    add_columns("sigma", "σ, m:");
    columns.push_back({.key = "mean_nis", .header = "mean", .sized = true, .group = "NIS:"});
    columns.push_back({.key = "median_nis", .header = "median", .sized = true, .group = "NIS:"});
    columns.push_back({.key = "nis_inside_95", .header = "in 95 %", .digits = 1, .scale = 100.0, .group = "NIS:"});
    columns.push_back({.header = "mean weights", .align = Align::left});
    const auto models = model_names(filters_);
    for (const auto& model : models) columns.push_back({.key = "mean_weight_" + model});
    ResultTable table(columns);
    if (truth_known) row(table, models, "measurement", outcome_.raw[p], nullptr, truth_known);
    for (std::size_t f = 0; f < filters_.size(); ++f)
      row(table, models, filters_[f].name, outcome_.filters[f].sums[p], &filters_[f], truth_known);
    text_ += "\n" + table.text(options_.output.width());
    summary_["results"][std::string(parts[p].name)] = table.json();
    tables_.push_back({fmt::format("Rows: {}", parts[p].name), std::move(table)});
  }

  void row(ResultTable& table, const std::vector<std::string>& models, const std::string& name, const Sums& sums,
           const FilterSettings* filter, bool truth_known) const {
    const std::size_t count = filter ? sums.count : sums.error[0].count();
    std::vector<Cell> cells = {Cell(name), Cell(count)};
    const auto add_cells = [&](const std::array<RootMeanSquare, 3>& values) {
      for (std::size_t axis = 0; axis < axes(); ++axis)
        cells.push_back(values[axis].count() > 0 ? Cell(values[axis].value()) : filter ? Cell("–") : Cell());
    };
    if (truth_known) add_cells(sums.error);
    add_cells(sums.sigma);
    const bool judged = filter && sums.nis.count() > 0;
    cells.push_back(judged ? Cell(sums.nis.mean()) : Cell());
    cells.push_back(judged ? Cell(sums.nis.median()) : Cell());
    cells.push_back(judged ? Cell(sums.nis.inside()) : Cell());
    std::string weights;
    std::vector<Cell> by_model(models.size());
    for (std::size_t j = 0; filter && count > 0 && j < filter->models.size(); ++j) {
      const double weight = sums.weights[j] / static_cast<double>(count);
      weights += fmt::format("{}{} {:.3f}", j ? ", " : "", filter->models[j], weight);
      by_model[static_cast<std::size_t>(std::find(models.begin(), models.end(), filter->models[j]) - models.begin())] =
          Cell(weight);
    }
    cells.emplace_back(weights);
    cells.insert(cells.end(), by_model.begin(), by_model.end());
    table.row(std::move(cells));
  }

  /// When the modes changed; all of it in the data, the first changes in the text.
  void explain() {
    constexpr std::size_t shown = 12;
    for (std::size_t f = 0; f < filters_.size(); ++f)
      for (const auto& [track, stays] : outcome_.filters[f].histories) {
        if (stays.empty()) continue;
        std::vector<std::string> told;
        Json all = Json::array();
        for (const ModeStay& stay : stays) {
          const std::string& mode = filters_[f].models[stay.mode];
          all.push_back({{"since_s", stay.since}, {"mode", mode}, {"start", stay.is_start}});
          if (told.size() < shown) told.push_back(fmt::format("{} from {} s", mode, shortest(stay.since)));
        }
        summary_["histories"][filters_[f].name][track] = all;
        text_ += "\n";
        say(fmt::format("Best history by {}{}: {}{}", filters_[f].name, track.empty() ? "" : " of " + track,
                        fmt::join(told, ", "),
                        stays.size() > shown ? fmt::format(", and {} changes more", stays.size() - shown) : ""));
      }
  }

  std::size_t axes() const { return static_cast<std::size_t>(recording_.axes()); }
  std::array<double, 3> radar_at() const { return options_.radar_at.value_or(std::array{0.0, 0.0, 0.0}); }

  const TrackOptions& options_;
  const RecordingReader& recording_;
  const std::vector<FilterSettings>& filters_;
  const TrackOutcome& outcome_;
  const std::string& file_ = recording_.csv().file();
  std::string text_;
  std::vector<ReportTable> tables_;
  Json summary_;
  std::vector<std::string> warnings_;
};

}  // namespace

TrackReport report(const TrackOptions& options, const RecordingReader& recording,
                   const std::vector<FilterSettings>& filters, const TrackOutcome& outcome) {
  return Reporter(options, recording, filters, outcome).made();
}

}  // namespace sigmax::apps
