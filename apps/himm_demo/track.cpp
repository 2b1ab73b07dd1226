#include "himm_demo/track.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <sigmax/estimation/metrics.hpp>

#include "himm_demo/tracker.hpp"
#include "support/output.hpp"
#include "support/progress.hpp"
#include "support/random.hpp"
#include "support/table.hpp"
#include "version.hpp"

namespace sigmax::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr double degree = std::numbers::pi / 180.0;
constexpr std::array<const char*, 3> axis_names = {"x", "y", "z"};

/// Rows that are judged together: all, or by the aircraft's bank where the recording tells it.
struct Part {
  std::string_view name;
  bool (*holds)(std::optional<double> roll_deg);
};
constexpr std::array<Part, 3> parts = {{
    {"all", [](std::optional<double>) { return true; }},
    {"|roll| > 15°", [](std::optional<double> roll) { return roll && std::abs(*roll) > 15.0; }},
    {"|roll| < 3°", [](std::optional<double> roll) { return roll && std::abs(*roll) < 3.0; }},
}};

/// What is added up over the rows of one part.
struct Sums {
  std::array<RootMeanSquare, 3> error;
  std::array<RootMeanSquare, 3> sigma;  ///< as the filter states it
  std::vector<double> weights;
  double nis = 0.0;
  std::size_t nis_count = 0;
  std::size_t count = 0;
};
using SumsByPart = std::array<Sums, parts.size()>;

void add_error(Sums& sums, const Vector<3>& error) {
  for (std::size_t axis = 0; axis < 3; ++axis) sums.error[axis].add(error(static_cast<Eigen::Index>(axis)));
}

/// Where the standard conversion of a radar's measurements is out of its validity, r σ_α² / σ_r < 0.4.
struct Validity {
  static constexpr double limit = 0.4;

  std::size_t first_line = 0;
  double first_value = 0.0;
  double first_range = 0.0;
  std::size_t outside = 0;
  std::size_t measurements = 0;
  double sigma_range_needed = 0.0;

  void add(const Fix& fix, const Polar& seen, const std::vector<FilterSettings>& filters) {
    ++measurements;
    double worst = 0.0;
    for (const auto& filter : filters) {
      if (filter.radar_measurement != RadarForm::standard) continue;
      const Polar& sigma = filter.accuracy_of(fix.sensor).radar;
      const double value = conversion_validity(seen.range, sigma);
      worst = std::max(worst, value);
      if (value >= limit) sigma_range_needed = std::max(sigma_range_needed, value * sigma.range / limit);
    }
    if (worst < limit) return;
    if (outside++ > 0) return;
    first_line = fix.line;
    first_value = worst;
    first_range = seen.range;
  }

  std::string warning(const std::string& file) const {
    const double unit = std::pow(10.0, std::floor(std::log10(sigma_range_needed)) - 1.0);
    return fmt::format(
        "{}:{}: r σ_α²/σ_r is {:.2g} at a range of {:.0f} m, where the standard conversion of radar measurements holds "
        "below {}; so it is in {} of {} measurements; set sigma_range_m above {:.6g}, so that their covariance covers "
        "the error of the conversion, or radar_measurement=polar, which converts only for the start",
        file, first_line, first_value, first_range, limit, outside, measurements,
        std::ceil(sigma_range_needed / unit) * unit);
  }
};

/// Measurements that no filter expects: an NIS above 30 is beyond the 0.999998 quantile of χ² with three degrees of
/// freedom.
struct Outliers {
  static constexpr double limit = 30.0;

  std::size_t count = 0;
  std::size_t worst_line = 0;
  double worst_nis = 0.0;

  void add(std::size_t line, double nis) {
    if (nis <= limit) return;
    ++count;
    if (nis <= worst_nis) return;
    worst_line = line;
    worst_nis = nis;
  }

  std::string warning(const std::string& file, std::size_t measurements) const {
    return fmt::format(
        "{}:{}: no filter expects this measurement (NIS {:.3g}); above an NIS of {} are {} of {}; look for outliers, "
        "or raise sigma_w or the sensor's sigmas",
        file, worst_line, worst_nis, limit, count, measurements);
  }
};

/// Writes estimates.csv.
class EstimatesFile {
 public:
  EstimatesFile(const OutputDirectory& directory, const std::vector<FilterSettings>& filters,
                const RecordingReader& recording)
      : file_(directory.file("estimates.csv")), recording_(recording) {
    for (const auto& filter : filters)
      for (const auto& motion : filter.motions) turns_ = turns_ || motion.type == MotionType::ct;
    for (const auto& filter : filters)
      for (const auto& model : filter.models)
        if (std::find(models_.begin(), models_.end(), model) == models_.end()) models_.push_back(model);
    file_.write(recording_.has_tracks() ? "time_s,track,filter" : "time_s,filter");
    file_.write(
        ",x_m,y_m,z_m,vx_mps,vy_mps,vz_mps,ax_mps2,ay_mps2,az_mps2,sigma_x_m,sigma_y_m,sigma_z_m,"
        "sigma_vx_mps,sigma_vy_mps,sigma_vz_mps,nis");
    if (turns_) file_.write(",turn_rate_deg_s");
    for (const auto& model : models_) file_.print(",weight_{}", model);
    file_.write(recording_.geodetic() ? ",most_likely,latitude_deg,longitude_deg,altitude_m\n" : ",most_likely\n");
  }

  template <int Axes>
  void add(const std::string& track, const FilterSettings& settings, const TrackPoint<Axes>& point) {
    const auto& estimate = point.estimate;
    const auto has = [&](int order, int axis) { return axis < Axes && order * Axes + axis < estimate.size(); };
    file_.write(shortest(point.time));
    if (recording_.has_tracks()) file_.print(",{}", csv_field(track));
    file_.print(",{}", csv_field(settings.name));
    for (int order = 0; order < 3; ++order)
      for (int axis = 0; axis < 3; ++axis)
        cell(has(order, axis) ? std::optional(estimate.mean(order * Axes + axis)) : std::nullopt);
    for (int order = 0; order < 2; ++order)
      for (int axis = 0; axis < 3; ++axis) {
        const int i = order * Axes + axis;
        cell(has(order, axis) ? std::optional(std::sqrt(estimate.covariance(i, i))) : std::nullopt);
      }
    cell(point.nis);
    if (turns_) cell(point.turn_rate ? std::optional(*point.turn_rate / degree) : std::nullopt);
    for (const auto& model : models_) {
      const auto own = std::find(settings.models.begin(), settings.models.end(), model);
      cell(own == settings.models.end()
               ? std::nullopt
               : std::optional(point.weights[static_cast<std::size_t>(own - settings.models.begin())]));
    }
    file_.print(",{}", settings.models[point.most_likely_mode]);
    if (recording_.geodetic()) {
      const double east = estimate.mean(0), north = estimate.mean(1);
      const LocalFrame& frame = recording_.frame();
      const Geodetic place =
          Axes == 3 ? frame.to_geodetic({east, north, estimate.mean(Axes - 1)}) : frame.to_surface(east, north);
      cell(place.latitude_deg());
      cell(place.longitude_deg());
      cell(Axes == 3 ? std::optional(place.altitude) : std::nullopt);
    }
    file_.write("\n");
  }

  AtomicFile& file() { return file_; }

 private:
  void cell(std::optional<double> value) { file_.print(",{}", value ? shortest(*value) : ""); }

  AtomicFile file_;
  const RecordingReader& recording_;
  std::vector<std::string> models_;
  bool turns_ = false;
};

/// A stream of random numbers for each track, whichever others a file holds: the 64-bit FNV-1a of its name.
std::uint64_t stream_of(std::string_view track) {
  if (track.empty()) return 0;
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (const char byte : track) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001B3U;
  return hash;
}

/// One target of a recording, followed by every filter.
template <int Axes>
struct Target {
  Target(const std::vector<FilterSettings>& filters, const RandomStream& random_stream)
      : trackers(filters.begin(), filters.end()), random(random_stream), rows(filters.size()) {}

  bool all_started() const {
    return std::all_of(trackers.begin(), trackers.end(), [](const auto& tracker) { return tracker.starts() > 0; });
  }

  std::vector<Tracker<Axes>> trackers;
  RandomStream random;
  Fix now;
  Fix before;                          // a start may wait for the row after it
  std::vector<std::vector<Fix>> rows;  // of the steps of each filter that waits to be smoothed
};

/// All filters on all targets of one recording.
template <int Axes>
class TrackRun {
 public:
  TrackRun(const TrackOptions& options, RecordingReader& recording, const std::vector<FilterSettings>& filters,
           EstimatesFile* estimates)
      : options_(options), recording_(recording), filters_(filters), estimates_(estimates), sums_(filters.size()) {
    for (std::size_t f = 0; f < filters.size(); ++f)
      for (auto& part : sums_[f]) part.weights.assign(filters[f].models.size(), 0.0);
    if (options.radar_at) radar_at_ = Vector<3>(options.radar_at->data());
  }

  void run() {
    const auto total = recording_.csv().bytes_total();
    Progress progress(file(), total.value_or(1), options_.quiet || !total);
    std::uint64_t done = 0;
    for (Fix fix; recording_.next(fix);) {
      take(fix);
      progress.advance(recording_.csv().bytes_read() - done);
      done = recording_.csv().bytes_read();
    }
    progress.finish();
    for (auto& [name, target] : targets_) smooth(target);
    for (const auto& [name, target] : targets_)
      if (!target.all_started()) never_started_.push_back(name);
    if (never_started_.size() == targets_.size()) refuse_nothing();
  }

  const std::string& file() const { return recording_.csv().file(); }
  bool truth_known() const { return options_.radar || recording_.has_truth(); }
  std::size_t rows() const { return rows_; }
  std::size_t measurements() const { return measurements_; }
  std::size_t tracks() const { return targets_.size(); }
  const std::vector<std::string>& never_started() const { return never_started_; }
  /// A count of each filter's trackers, added up over the targets.
  template <class Count>
  std::size_t total(std::size_t filter, const Count& count) const {
    std::size_t sum = 0;
    for (const auto& [name, target] : targets_) sum += count(target.trackers[filter]);
    return sum;
  }
  const std::map<std::string, std::size_t>& sensors() const { return sensors_; }
  const Validity& validity() const { return validity_; }
  const Outliers& outliers() const { return outliers_; }
  const SumsByPart& raw() const { return raw_; }
  const SumsByPart& sums(std::size_t filter) const { return sums_[filter]; }

 private:
  void take(Fix fix) {
    ++rows_;
    if (fix.measured()) ++measurements_;
    if (recording_.has_sensors()) ++sensors_[fix.sensor];
    auto target = targets_.find(fix.track);
    if (target == targets_.end())
      target = targets_.try_emplace(fix.track, filters_, RandomStream(options_.seed, stream_of(fix.track))).first;
    if (options_.radar && fix.position) measure(fix, target->second.random);
    if (fix.seen) validity_.add(fix, *fix.seen, filters_);
    if (fix.truth && fix.measured())
      add_by_part(raw_, fix.roll_deg, [&](Sums& sums) {
        add_error(sums, (fix.seen ? radar_at_ + to_cartesian(*fix.seen) : *fix.position) - *fix.truth);
      });
    step(target->second, fix);
  }

  void step(Target<Axes>& target, const Fix& fix) {
    target.before = std::exchange(target.now, fix);
    for (std::size_t f = 0; f < target.trackers.size(); ++f) {
      auto& tracker = target.trackers[f];
      try {
        tracker.take(fix.time_s, reading(fix, tracker.settings()), [&](double time) {
          const Fix& row = time == target.now.time_s ? target.now : target.before;
          if (tracker.settings().smooth)
            target.rows[f].push_back(row);
          else
            record(row, f, tracker.now());
        });
      } catch (const InputError&) {
        throw;  // of the output
      } catch (const std::exception& error) {
        refuse_failure(f, fix, error);
      }
    }
    std::optional<double> least;  // of the filters' NIS
    for (const auto& tracker : target.trackers) {
      const auto nis = tracker.running() ? tracker.nis() : std::nullopt;
      if (nis && (!least || *nis < *least)) least = nis;
    }
    if (least) outliers_.add(fix.line, *least);
  }

  /// Takes the position for the truth and sees it by the simulated radar.
  void measure(Fix& fix, RandomStream& random) const {
    const auto& sigma = *options_.radar;
    Polar seen = to_polar(*fix.position - radar_at_);
    seen.azimuth += sigma[1] * degree * random.normal();
    seen.elevation += sigma[2] * degree * random.normal();
    seen.range += sigma[0] * random.normal();
    if (!(seen.range > 0.0))
      throw InputError(message({.where = fmt::format("{}:{}", file(), fix.line),
                                .what = "the simulated radar",
                                .found = fmt::format("a range of {} m", shortest(seen.range)),
                                .expected = "a positive one",
                                .remedy = "put the radar farther from the track with --radar-at=E,N,U"}));
    fix.truth = std::exchange(fix.position, std::nullopt);
    fix.seen = seen;
  }

  /// The steps of a target whose rows have all been read, as smoothing sees them.
  void smooth(Target<Axes>& target) {
    for (std::size_t f = 0; f < target.trackers.size(); ++f) {
      std::vector<TrackPoint<Axes>> points;
      try {
        points = target.trackers[f].finish();
      } catch (const std::exception& error) {
        refuse_failure(f, target.now, error);
      }
      auto row = target.rows[f].begin();
      for (const auto& point : points)
        if (!point.is_start) record(*row++, f, point);
    }
    target.rows.clear();
  }

  /// What a row measures, with the covariance that a filter believes.
  std::optional<Reading<Axes>> reading(const Fix& fix, const FilterSettings& settings) const {
    if (!fix.measured()) return std::nullopt;
    const Accuracy& accuracy = settings.accuracy_of(fix.sensor);
    if (fix.seen) return radar_reading<Axes>(*fix.seen, accuracy.radar, radar_at_, settings.radar_measurement);
    Gaussian<Axes> z{fix.position->template head<Axes>(), SquareMatrix<Axes>::Zero()};
    for (Eigen::Index axis = 0; axis < Axes; ++axis) {
      const auto& sigma = accuracy.position_m;
      z.covariance(axis, axis) = std::pow(sigma.size() == 1 ? sigma[0] : sigma[static_cast<std::size_t>(axis)], 2);
    }
    return Reading<Axes>{z, std::nullopt};
  }

  template <class Add>
  static void add_by_part(SumsByPart& sums, std::optional<double> roll, const Add& add) {
    for (std::size_t p = 0; p < parts.size(); ++p)
      if (parts[p].holds(roll)) add(sums[p]);
  }

  /// Takes down what filter f says of a row.
  void record(const Fix& fix, std::size_t f, const TrackPoint<Axes>& point) {
    if (estimates_) estimates_->add(fix.track, filters_[f], point);
    const auto& estimate = point.estimate;
    add_by_part(sums_[f], fix.roll_deg, [&](Sums& sums) {
      ++sums.count;
      for (Eigen::Index axis = 0; axis < Axes; ++axis)
        sums.sigma[static_cast<std::size_t>(axis)].add_square(estimate.covariance(axis, axis));
      if (fix.truth) {
        Vector<3> error = Vector<3>::Zero();
        error.template head<Axes>() = estimate.mean.template head<Axes>() - fix.truth->template head<Axes>();
        add_error(sums, error);
      }
      for (std::size_t j = 0; j < sums.weights.size(); ++j) sums.weights[j] += point.weights[j];
      if (point.nis) {
        sums.nis += *point.nis;
        ++sums.nis_count;
      }
    });
  }

  [[noreturn]] void refuse_failure(std::size_t f, const Fix& fix, const std::exception& error) const {
    throw InputError(message(
        {.where = fmt::format("{}:{}", file(), fix.line),
         .what = fmt::format("filter '{}' at time {} s: {}", filters_[f].name, shortest(fix.time_s), error.what()),
         .remedy = "look for an outlier here, and at the start and the settings of the filter"}));
  }

  [[noreturn]] void refuse_nothing() const {
    if (rows_ == 0 && !options_.recording.select.empty())
      throw InputError(message({.where = file(),
                                .what = fmt::format("no row has {}", fmt::join(options_.recording.select, " and ")),
                                .remedy = "see how the file writes the value"}));
    throw InputError(message({.where = file(),
                              .what = targets_.size() > 1 ? "no track is long enough for every filter to start"
                                                          : "there is too little for every filter to start",
                              .found = fmt::format("{} rows, {} of them measurements", rows_, measurements_),
                              .expected = "at least three measurements (two rows if the start is given)",
                              .remedy = "give more rows, or start = \"given\" with start_time_s"}));
  }

  const TrackOptions& options_;
  RecordingReader& recording_;
  const std::vector<FilterSettings>& filters_;
  EstimatesFile* estimates_;
  std::map<std::string, Target<Axes>, std::less<>> targets_;
  std::vector<std::string> never_started_;
  std::map<std::string, std::size_t> sensors_;
  Validity validity_;
  Outliers outliers_;
  SumsByPart raw_;
  std::vector<SumsByPart> sums_;
  Vector<3> radar_at_ = Vector<3>::Zero();
  std::size_t rows_ = 0;
  std::size_t measurements_ = 0;
};

/// What the run found, as text for people and as data, and what may be wrong.
struct TrackReport {
  std::string text;
  Json summary;
  std::vector<std::string> warnings;
};

template <int Axes>
void describe(TrackReport& report, const TrackOptions& options, const RecordingReader& recording,
              const std::vector<FilterSettings>& filters, const TrackRun<Axes>& run) {
  Json& summary = report.summary;
  summary = {{"version", version}, {"command", options.command}, {"file", run.file()}};
  summary["seed"] = options.seed;
  const auto at = options.radar_at.value_or(std::array{0.0, 0.0, 0.0});
  if (options.radar) {
    summary["radar"] = {{"sigma_range_m", (*options.radar)[0]},
                        {"sigma_azimuth_deg", (*options.radar)[1]},
                        {"sigma_elevation_deg", (*options.radar)[2]}};
  }
  if (options.radar || recording.polar()) summary["radar"]["at_m"] = at;
  if (recording.geodetic()) {
    const Geodetic& origin = recording.frame().origin();
    summary["origin"] = {{"latitude_deg", origin.latitude_deg()},
                         {"longitude_deg", origin.longitude_deg()},
                         {"altitude_m", origin.altitude}};
  }
  summary["rows"] = run.rows();
  summary["measurements"] = run.measurements();
  summary["skipped"] = recording.skipped();
  if (recording.has_sensors()) summary["sensors"] = run.sensors();
  if (recording.has_tracks()) summary["tracks"] = {{"count", run.tracks()}, {"never_started", run.never_started()}};
  summary["settings_toml"] = as_toml(filters);

  const bool converted = std::none_of(filters.begin(), filters.end(), [](const FilterSettings& filter) {
    return filter.radar_measurement == RadarForm::polar;
  });
  std::string& text = report.text;
  text = fmt::format("{}: {} rows, {} measurements, {} axes{}{}\n", run.file(), run.rows(), run.measurements(), Axes,
                     recording.geodetic() ? ", geodetic to local east-north-up" : "",
                     !recording.polar() ? ""
                     : converted        ? ", a radar's measurements converted"
                                        : ", a radar's measurements");
  if (recording.has_sensors()) {
    std::vector<std::string> counts;
    for (const auto& [sensor, count] : run.sensors()) counts.push_back(fmt::format("{} {}", sensor, count));
    text += fmt::format("Rows by sensor: {}\n", fmt::join(counts, ", "));
  }
  if (recording.has_tracks()) {
    text += fmt::format("{} tracks by {}", run.tracks(), options.recording.track_id);
    if (!run.never_started().empty())
      text += fmt::format(", {} of them too short for every filter to start", run.never_started().size());
    text += "\n";
  }
  if (recording.skipped() > 0)
    text += fmt::format("Skipped {} rows whose time was not after that of the row before\n", recording.skipped());
  const auto by_filter = [&](const char* key, const char* what, const auto& count) {
    std::vector<std::string> counts;
    for (std::size_t f = 0; f < filters.size(); ++f)
      if (const std::size_t total = run.total(f, count); total > 0) {
        counts.push_back(fmt::format("{} {}", filters[f].name, total));
        summary[key][filters[f].name] = total;
      }
    if (!counts.empty()) text += fmt::format("{}: {}\n", what, fmt::join(counts, ", "));
  };
  by_filter("rejected", "Measurements that the gate turned away",
            [](const Tracker<Axes>& tracker) { return tracker.rejected(); });
  by_filter("restarts", "Starts after a gap",
            [](const Tracker<Axes>& tracker) { return tracker.starts() > 0 ? tracker.starts() - 1 : 0; });
  if (options.radar)
    text += fmt::format(
        "The recording is taken as the truth and measured by a simulated radar: {} m, {}°, {}° at ({}, {}, {}) m, seed "
        "{}\n",
        shortest((*options.radar)[0]), shortest((*options.radar)[1]), shortest((*options.radar)[2]), shortest(at[0]),
        shortest(at[1]), shortest(at[2]), options.seed);

  if (run.validity().outside > 0) report.warnings.push_back(run.validity().warning(run.file()));
  if (run.outliers().count > 0) report.warnings.push_back(run.outliers().warning(run.file(), run.measurements()));
  for (const auto& filter : filters)
    for (const auto& [sensor, accuracy] : filter.sensors)
      if (!run.sensors().contains(sensor))
        report.warnings.push_back(fmt::format("key 'sensor.{}' of filter '{}': no row of {} is of that sensor", sensor,
                                              filter.name, run.file()));
  if (!report.warnings.empty()) summary["warnings"] = report.warnings;
}

template <int Axes>
void tabulate(TrackReport& report, const RecordingReader& recording, const std::vector<FilterSettings>& filters,
              const TrackRun<Axes>& run) {
  const std::size_t part_count = recording.has_roll() ? parts.size() : 1;
  for (std::size_t p = 0; p < part_count; ++p) {
    std::vector<TextTable::Column> columns = {{std::string(parts[p].name), Align::left}, {"rows"}};
    const auto add_columns = [&](std::string_view label) {
      for (std::size_t axis = 0; axis < static_cast<std::size_t>(Axes); ++axis)
        columns.push_back({fmt::format("{}{}", axis == 0 ? label : "", axis_names[axis])});
    };
    if (run.truth_known()) add_columns("RMSE, m: ");
    add_columns("σ, m: ");
    columns.push_back({"mean NIS"});
    columns.push_back({"mean weights", Align::left});
    TextTable table(columns);
    Json part;
    const auto row = [&](const std::string& name, const Sums& sums, const FilterSettings* filter) {
      std::vector<std::string> cells = {name};
      Json result;
      const std::size_t count = filter ? sums.count : sums.error[0].count();
      result["rows"] = count;
      cells.push_back(std::to_string(count));
      const auto add_cells = [&](const char* key, const std::array<RootMeanSquare, 3>& values) {
        for (std::size_t axis = 0; axis < static_cast<std::size_t>(Axes); ++axis) {
          const bool known = values[axis].count() > 0;
          cells.push_back(known ? fmt::format("{:.2f}", values[axis].value()) : filter ? "–" : "");
          if (known) result[key][axis_names[axis]] = values[axis].value();
        }
      };
      if (run.truth_known()) add_cells("rmse_m", sums.error);
      add_cells("sigma_m", sums.sigma);
      std::string weights;
      if (filter) {
        if (sums.nis_count > 0) result["mean_nis"] = sums.nis / static_cast<double>(sums.nis_count);
        for (std::size_t j = 0; j < filter->models.size() && count > 0; ++j) {
          const double weight = sums.weights[j] / static_cast<double>(count);
          weights += fmt::format("{}{} {:.3f}", j ? ", " : "", filter->models[j], weight);
          result["mean_weight"][filter->models[j]] = weight;
        }
      }
      cells.push_back(
          filter && sums.nis_count > 0 ? fmt::format("{:.2f}", sums.nis / static_cast<double>(sums.nis_count)) : "");
      cells.push_back(weights);
      table.row(cells);
      part[name] = result;
    };
    if (run.truth_known()) row("measurement", run.raw()[p], nullptr);
    for (std::size_t f = 0; f < filters.size(); ++f) row(filters[f].name, run.sums(f)[p], &filters[f]);
    report.text += "\n" + table.text();
    report.summary["results"][std::string(parts[p].name)] = part;
  }
}

template <int Axes>
void track_on(const TrackOptions& options, RecordingReader& recording, const std::vector<FilterSettings>& filters) {
  std::optional<OutputDirectory> directory;
  std::optional<EstimatesFile> estimates;
  if (!options.out.empty()) {
    directory.emplace(options.out);
    estimates.emplace(*directory, filters, recording);
  }
  TrackRun<Axes> run(options, recording, filters, estimates ? &*estimates : nullptr);
  run.run();
  TrackReport report;
  describe(report, options, recording, filters, run);
  tabulate(report, recording, filters, run);
  if (directory) {
    AtomicFile summary = directory->file("summary.json");
    summary.write(report.summary.dump(2) + "\n");
    commit_all(estimates->file(), summary);
    report.text += fmt::format("\nWrote estimates.csv and summary.json to {}\n", options.out);
  }
  fmt::print("{}", report.text);
  if (!report.warnings.empty()) std::fflush(stdout);  // they come last where both streams are one
  for (const auto& warning : report.warnings) fmt::print(stderr, "himm_demo: warning: {}\n", warning);
}

void refuse_what_means_nothing(const TrackOptions& options, const RecordingReader& recording) {
  const std::string& file = recording.csv().file();
  if (options.radar_at && !options.radar && !recording.polar())
    throw UsageError("--radar-at is for --radar and for radar input, but " + file + " has no range_m");
  if (!options.radar) return;
  if (recording.polar()) throw UsageError("--radar measures positions, but " + file + " holds a radar's measurements");
  if (recording.has_truth()) throw UsageError("--radar takes positions as the truth, but " + file + " has true_x_m");
  if (recording.axes() != 3) throw UsageError("--radar needs three axes, but " + file + " has two");
}

}  // namespace

void track_and_report(const TrackOptions& options) {
  const Settings settings = Settings::read(options.config, options.sets);
  FilterDefaults defaults;
  const auto sigma = options.radar.value_or(std::array{10.0, 0.1, 0.1});
  defaults.sigma_radar = {sigma[0], sigma[1] * degree, sigma[2] * degree};
  const auto filters = read_filters(settings, defaults);
  settings.refuse_unknown();
  if (options.print_config) {
    fmt::print("{}", as_toml(filters));
    return;
  }
  RecordingReader recording(options.recording);
  refuse_what_means_nothing(options, recording);
  if (recording.axes() == 3)
    track_on<3>(options, recording, filters);
  else
    track_on<2>(options, recording, filters);
}

}  // namespace sigmax::apps
