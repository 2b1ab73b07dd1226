#include "himm_demo/track.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <sigmax/estimation/metrics.hpp>

#include "himm_demo/recording.hpp"
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
  std::vector<double> weights;
  double nis = 0.0;
  std::size_t nis_count = 0;
  std::size_t count = 0;
};
using SumsByPart = std::array<Sums, parts.size()>;

void add_error(Sums& sums, const Vector<3>& error) {
  for (std::size_t axis = 0; axis < 3; ++axis) sums.error[axis].add(error(static_cast<Eigen::Index>(axis)));
}

/// Writes estimates.csv.
class EstimatesFile {
 public:
  EstimatesFile(const OutputDirectory& directory, const std::vector<FilterSettings>& filters, bool geodetic)
      : file_(directory.file("estimates.csv")), geodetic_(geodetic) {
    for (const auto& filter : filters)
      for (const auto& model : filter.models)
        if (std::find(models_.begin(), models_.end(), model) == models_.end()) models_.push_back(model);
    file_.write(
        "time_s,filter,x_m,y_m,z_m,vx_mps,vy_mps,vz_mps,ax_mps2,ay_mps2,az_mps2,sigma_x_m,sigma_y_m,sigma_z_m,"
        "sigma_vx_mps,sigma_vy_mps,sigma_vz_mps,nis");
    for (const auto& model : models_) file_.print(",weight_{}", model);
    file_.write(geodetic_ ? ",most_likely,latitude_deg,longitude_deg,altitude_m\n" : ",most_likely\n");
  }

  template <int Axes>
  void add(double time, const Tracker<Axes>& tracker, const RecordingReader& recording) {
    const auto& settings = tracker.settings();
    const auto estimate = tracker.estimate();
    const auto has = [&](int order, int axis) { return axis < Axes && order * Axes + axis < estimate.size(); };
    file_.print("{},{}", shortest(time), settings.name);
    for (int order = 0; order < 3; ++order)
      for (int axis = 0; axis < 3; ++axis)
        cell(has(order, axis) ? std::optional(estimate.mean(order * Axes + axis)) : std::nullopt);
    for (int order = 0; order < 2; ++order)
      for (int axis = 0; axis < 3; ++axis) {
        const int i = order * Axes + axis;
        cell(has(order, axis) ? std::optional(std::sqrt(estimate.covariance(i, i))) : std::nullopt);
      }
    cell(tracker.nis());
    for (const auto& model : models_) {
      const auto own = std::find(settings.models.begin(), settings.models.end(), model);
      cell(own == settings.models.end()
               ? std::nullopt
               : std::optional(tracker.weight(static_cast<std::size_t>(own - settings.models.begin()))));
    }
    file_.print(",{}", settings.models[tracker.most_likely_mode()]);
    if (geodetic_) {
      const Geodetic point =
          recording.frame().to_geodetic(EastNorthUp{estimate.mean(0), estimate.mean(1), estimate.mean(Axes - 1)});
      cell(point.latitude_deg());
      cell(point.longitude_deg());
      cell(point.altitude);
    }
    file_.write("\n");
  }

  void commit() { file_.commit(); }

 private:
  void cell(std::optional<double> value) { file_.print(",{}", value ? shortest(*value) : ""); }

  AtomicFile file_;
  bool geodetic_;
  std::vector<std::string> models_;
};

/// Truth of a row, kept until every filter has stepped over it.
struct Truth {
  double time;
  Vector<3> position;
  std::optional<double> roll_deg;
};

/// All filters on one recording.
template <int Axes>
class TrackRun {
 public:
  TrackRun(const TrackOptions& options, RecordingReader& recording, const std::vector<FilterSettings>& filters,
           EstimatesFile* estimates)
      : options_(options), recording_(recording), estimates_(estimates), random_(options.seed, 0) {
    for (const auto& filter : filters) {
      trackers_.emplace_back(filter);
      sums_.emplace_back();
      for (auto& part : sums_.back()) part.weights.assign(filter.models.size(), 0.0);
    }
  }

  void run() {
    const auto total = recording_.csv().bytes_total();
    Progress progress(options_.file, total.value_or(1), options_.quiet || !total);
    std::uint64_t done = 0;
    for (Fix fix; recording_.next(fix);) {
      take(fix);
      progress.advance(recording_.csv().bytes_read() - done);
      done = recording_.csv().bytes_read();
    }
    progress.finish();
    for (const auto& tracker : trackers_)
      if (!tracker.running())
        throw InputError(message({.where = options_.file,
                                  .what = "filter '" + tracker.settings().name + "' never started",
                                  .found = fmt::format("{} rows, {} of them measurements", rows_, measurements_),
                                  .expected = "at least three measurements (two rows if the start is given)",
                                  .remedy = "give more rows, or start = \"given\" with start_time_s"}));
  }

  bool truth_known() const { return options_.radar.has_value(); }
  std::size_t rows() const { return rows_; }
  std::size_t measurements() const { return measurements_; }
  const SumsByPart& raw() const { return raw_; }
  const SumsByPart& sums(std::size_t filter) const { return sums_[filter]; }

 private:
  void take(const Fix& fix) {
    ++rows_;
    if (fix.position) ++measurements_;
    const auto seen = fix.position && truth_known() ? std::optional(radar_sees(fix)) : std::nullopt;
    if (seen)
      add_by_part(raw_, fix.roll_deg,
                  [&](Sums& sums) { add_error(sums, radar_at() + to_cartesian(*seen) - *fix.position); });
    before_ = std::exchange(now_, fix);
    for (std::size_t f = 0; f < trackers_.size(); ++f) {
      auto& tracker = trackers_[f];
      std::optional<Gaussian<Axes>> z;
      if (fix.position) z = seen ? converted(*seen, tracker.settings()) : direct(*fix.position, tracker.settings());
      try {
        tracker.take(fix.time_s, z, [&](double time) { record(f, time); });
      } catch (const std::exception& error) {
        throw InputError(fmt::format("{}:{}: filter '{}' at time {} s: {}", options_.file, fix.line,
                                     tracker.settings().name, shortest(fix.time_s), error.what()));
      }
    }
  }

  Vector<3> radar_at() const { return Eigen::Map<const Vector<3>>(options_.radar_at.data()); }

  Polar radar_sees(const Fix& fix) {
    const auto& sigma = *options_.radar;
    Polar seen = to_polar(*fix.position - radar_at());
    seen.azimuth += sigma[1] * degree * random_.normal();
    seen.elevation += sigma[2] * degree * random_.normal();
    seen.range += sigma[0] * random_.normal();
    if (!(seen.range > 0.0))
      throw InputError(message({.where = fmt::format("{}:{}", options_.file, fix.line),
                                .what = "the simulated radar",
                                .found = fmt::format("a range of {} m", shortest(seen.range)),
                                .expected = "a positive one",
                                .remedy = "put the radar farther from the track with --radar-at=E,N,U"}));
    return seen;
  }

  Gaussian<Axes> converted(const Polar& seen, const FilterSettings& settings) const {
    const Gaussian<3> position = to_cartesian(seen, settings.sigma_radar);
    const Vector<3> moved = position.mean + radar_at();
    return {moved.template head<Axes>(), position.covariance.template topLeftCorner<Axes, Axes>()};
  }

  static Gaussian<Axes> direct(const Vector<3>& position, const FilterSettings& settings) {
    Gaussian<Axes> z{position.template head<Axes>(), SquareMatrix<Axes>::Zero()};
    for (Eigen::Index axis = 0; axis < Axes; ++axis) {
      const auto& sigma = settings.sigma_position_m;
      z.covariance(axis, axis) = std::pow(sigma.size() == 1 ? sigma[0] : sigma[static_cast<std::size_t>(axis)], 2);
    }
    return z;
  }

  template <class Add>
  static void add_by_part(SumsByPart& sums, std::optional<double> roll, const Add& add) {
    for (std::size_t p = 0; p < parts.size(); ++p)
      if (parts[p].holds(roll)) add(sums[p]);
  }

  /// Takes down filter f's estimate at a time: that of this row, or of the one before where a start waited for it.
  void record(std::size_t f, double time) {
    const auto& tracker = trackers_[f];
    const Fix& fix = time == now_.time_s ? now_ : before_;
    if (estimates_) estimates_->add(time, tracker, recording_);
    const auto estimate = tracker.estimate();
    const auto nis = tracker.nis();
    add_by_part(sums_[f], fix.roll_deg, [&](Sums& sums) {
      ++sums.count;
      if (truth_known() && fix.position) {
        Vector<3> error = Vector<3>::Zero();
        error.template head<Axes>() = estimate.mean.template head<Axes>() - fix.position->template head<Axes>();
        add_error(sums, error);
      }
      for (std::size_t j = 0; j < sums.weights.size(); ++j) sums.weights[j] += tracker.weight(j);
      if (nis) {
        sums.nis += *nis;
        ++sums.nis_count;
      }
    });
  }

  const TrackOptions& options_;
  RecordingReader& recording_;
  EstimatesFile* estimates_;
  RandomStream random_;
  std::vector<Tracker<Axes>> trackers_;
  SumsByPart raw_;
  std::vector<SumsByPart> sums_;
  Fix now_;
  Fix before_;
  std::size_t rows_ = 0;
  std::size_t measurements_ = 0;
};

template <int Axes>
void report(const TrackOptions& options, const RecordingReader& recording, const std::vector<FilterSettings>& filters,
            const TrackRun<Axes>& run, const OutputDirectory* directory) {
  Json summary = {{"version", version}, {"command", options.command}, {"file", options.file}};
  summary["seed"] = options.seed;
  if (options.radar) {
    summary["radar"] = {{"sigma_range_m", (*options.radar)[0]},
                        {"sigma_azimuth_deg", (*options.radar)[1]},
                        {"sigma_elevation_deg", (*options.radar)[2]},
                        {"at_m", options.radar_at}};
  }
  if (recording.geodetic()) {
    const Geodetic& origin = recording.frame().origin();
    summary["origin"] = {{"latitude_deg", origin.latitude_deg()},
                         {"longitude_deg", origin.longitude_deg()},
                         {"altitude_m", origin.altitude}};
  }
  summary["rows"] = run.rows();
  summary["measurements"] = run.measurements();
  summary["settings_toml"] = as_toml(filters);

  fmt::print("{}: {} rows, {} measurements, {} axes{}\n", options.file, run.rows(), run.measurements(), Axes,
             recording.geodetic() ? ", geodetic to local east-north-up" : "");
  if (options.radar)
    fmt::print(
        "The recording is taken as the truth and measured by a simulated radar: {} m, {}°, {}° at ({}, {}, {}) m, seed "
        "{}\n",
        shortest((*options.radar)[0]), shortest((*options.radar)[1]), shortest((*options.radar)[2]),
        shortest(options.radar_at[0]), shortest(options.radar_at[1]), shortest(options.radar_at[2]), options.seed);

  const std::size_t part_count = recording.has_roll() ? parts.size() : 1;
  for (std::size_t p = 0; p < part_count; ++p) {
    std::vector<TextTable::Column> columns = {{std::string(parts[p].name), Align::left}, {"rows"}};
    if (run.truth_known())
      for (int axis = 0; axis < Axes; ++axis)
        columns.push_back(
            {fmt::format("{}{}", axis == 0 ? "RMSE, m: " : "", axis_names[static_cast<std::size_t>(axis)])});
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
      if (run.truth_known())
        for (std::size_t axis = 0; axis < static_cast<std::size_t>(Axes); ++axis) {
          cells.push_back(count == 0 ? "–" : fmt::format("{:.2f}", sums.error[axis].value()));
          result["rmse_m"][axis_names[axis]] = sums.error[axis].value();
        }
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
    fmt::print("\n");
    table.print();
    summary["results"][std::string(parts[p].name)] = part;
  }
  if (directory) {
    AtomicFile file = directory->file("summary.json");
    file.write(summary.dump(2) + "\n");
    file.commit();
    fmt::print("\nWrote estimates.csv and summary.json to {}\n", options.out);
  }
}

template <int Axes>
void track_on(const TrackOptions& options, RecordingReader& recording, const std::vector<FilterSettings>& filters) {
  std::optional<OutputDirectory> directory;
  std::optional<EstimatesFile> estimates;
  if (!options.out.empty()) {
    directory.emplace(options.out);
    estimates.emplace(*directory, filters, recording.geodetic());
  }
  TrackRun<Axes> run(options, recording, filters, estimates ? &*estimates : nullptr);
  run.run();
  if (estimates) estimates->commit();
  report(options, recording, filters, run, directory ? &*directory : nullptr);
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
  RecordingReader recording(options.file, options.columns, options.origin);
  if (recording.axes() == 3) {
    track_on<3>(options, recording, filters);
  } else {
    if (options.radar) throw UsageError("--radar needs three axes, but " + options.file + " has no z_m");
    track_on<2>(options, recording, filters);
  }
}

}  // namespace sigmax::apps
