#include "himm_demo/track/track.hpp"

namespace sigmax::apps {
namespace {

/// Which accuracies nobody gave, neither the row nor a key.
void find_defaults(const Row& row, int axes, const std::vector<FilterSettings>& filters, std::set<std::string>& found) {
  using enum AnyDetection::Sensor;
  static const SensorSettings usual{};
  static const std::array<std::pair<std::string, double>, 3> keys = {{{"sigma_position_m", usual.position_m.front()},
                                                                      {"sigma_range_m", usual.radar[0]},
                                                                      {"sigma_azimuth_deg", usual.radar[1] / degree}}};
  const AnyDetection& detection = row.detection;
  for (std::size_t i = 0; i < static_cast<std::size_t>(detection.size); ++i) {
    const std::size_t k = detection.sensor == components ? (detection.places[i] < axes ? 0 : keys.size())
                          : detection.sensor == bearing  ? 2
                                                         : i + 1;
    if (k < keys.size() && std::isnan(detection.variance(static_cast<int>(i))) &&
        std::ranges::none_of(filters, [&](const FilterSettings& filter) {
          return filter.accuracy_of(row.sensor).given.contains(keys[k].first);
        }))
      found.insert(fmt::format("{} = {:.6g}", keys[k].first, keys[k].second));
  }
}

}  // namespace

void FilterOutcome::add(const Row& row, const TargetPoint& point, std::size_t size, int axes) {
  add_by_part(sums, row.roll_deg, [&](Sums& part) {
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(axes); ++axis) {
      part.sigma[axis].add_square(point.covariance[axis * (point.mean.size() + 1)]);
      if (row.truth) part.error[axis].add(point.mean[axis] - (*row.truth)[axis]);
    }
    for (std::size_t j = 0; j < part.weights.size(); ++j) part.weights[j] += point.weights[j];
    if (point.nis) part.innovations.add_nis(*point.nis, size);
  });
}

void FilterOutcome::add_innovation(const std::string& sensor, const TargetPoint& point, std::size_t size,
                                   std::vector<double>& before) {
  if (point.normalized_innovation.empty())
    sensors[sensor].add_nis(*point.nis, size);
  else
    sensors[sensor].add(point.normalized_innovation, before);
  before = point.normalized_innovation;
}

void TrackTally::goes_to(const std::vector<double>& mean, int axes) {
  Position here{};
  std::copy_n(mean.begin(), axes, here.begin());
  if (before) way_m += std::hypot(here[0] - (*before)[0], here[1] - (*before)[1], here[2] - (*before)[2]);
  before = here;
}

std::string TrackTally::reason_without_estimates() const {
  constexpr std::size_t start = 3;  // measurements
  return fmt::format("{} measurement{}; a filter starts from {} whole positions, and estimates from the next one on{}",
                     measurements, measurements == 1 ? "" : "s", start,
                     measurements > start ? ", and these do not lie so near each other" : "");
}

void TrackOutcome::count(const Row& row, const RecordingReader& recording, const std::vector<FilterSettings>& own) {
  const int axes = recording.axes(), seen = axes_seen(row.detection, axes);
  ++rows;
  if (row.measured()) ++measurements;
  if (seen > 0 && seen < axes) ++partial;
  if (row.detection.sensor == Sensor::bearing) ++bearings;
  if (!recording.simulated()) find_defaults(row, axes, own, by_default);
  if (!recording.has_sensors()) return;
  ++sensors[row.sensor];
  const auto known = [&](std::optional<double> SensorSettings::*sigma) {
    return std::ranges::any_of(
        own, [&](const FilterSettings& filter) { return (filter.accuracy_of(row.sensor).*sigma).has_value(); });
  };
  if (is_moving(row.detection, axes) && !known(&SensorSettings::velocity_mps))
    ++unused["velocity does not count, for want of sensor.NAME.sigma_velocity_mps"][row.sensor];
  if (row.detection.sensor == Sensor::doppler && !known(&SensorSettings::range_rate_mps))
    ++unused["range rate does not count, for want of sensor.NAME.sigma_range_rate_mps"][row.sensor];
}

void TrackOutcome::judge_conversion(const Row& row, int axes, const std::vector<FilterSettings>& own) {
  using enum AnyDetection::Sensor;
  if ((row.detection.sensor != polar && row.detection.sensor != doppler) || row.detection.size < axes) return;
  for (const FilterSettings& filter : own) {
    const SensorSettings& accuracy = filter.accuracy_of(row.sensor);
    if (filter.radar_measurement != RadarForm::standard || (row.detection.sensor == doppler && accuracy.range_rate_mps))
      continue;
    if (row.detection.z[0] * accuracy.radar[1] * accuracy.radar[1] / accuracy.radar[0] < most_conversion_bias) continue;
    return unsuited.add(row.line);
  }
}

void TrackOutcome::refuse_nothing(const RecordingReader& recording, const RecordingOptions& options,
                                  bool several_places) const {
  const std::string& file = recording.file();
  if (rows == 0 && !options.select.empty())
    throw InputError("{}: no row has {}; see how the file writes the value", file, fmt::join(options.select, " and "));
  if (bearings > 0 && bearings == measurements)
    throw InputError(
        "{}: {}, or give start = \"given\" with start_mean, start_covariance_diagonal and start_time_s", file,
        several_places
            ? "the bearings are too few, or cross at too small angles, to start a track; give at least two rows of "
              "each station, or a simpler model (--set \"models=[dwna]\")"
            : "bearings from one place do not determine where a target starts; name each row's station in a column "
              "sensor, and its place as sensor.NAME.at = [E, N]");
  const std::string skipped =
      recording.skipped() == 0 ? "" : fmt::format(", and {} that were skipped for their time", recording.skipped());
  throw InputError(
      {.where = file,
       .what = each.size() > 1 ? "no track is long enough for every filter to start"
                               : "there is too little for every filter to start",
       .found = fmt::format("{} rows, {} of them measurements{}", rows, measurements, skipped),
       .expected = "more than the three measurements that start a filter (two rows if the start is given)",
       .remedy = recording.skipped() > rows ? "sort the rows by time"
                 : partial > 0 ? "a track starts from whole positions; drop a column that is always empty, or give a "
                                 "start (himm_demo keys)"
                               : "give more rows, or start = \"given\" with start_time_s"});
}

EstimatesFile::EstimatesFile(ResultFiles* files, const std::vector<FilterSettings>& filters,
                             const RecordingReader& recording, bool associated) {
  if (!files) return;
  const auto axes = static_cast<std::size_t>(recording.axes());
  std::vector<std::string> keys;
  const auto add = [&](std::string key, auto cell) {
    keys.push_back(std::move(key));
    cells_.push_back(std::move(cell));
  };
  add("time_s", [](auto& point, auto&) { return point.time; });
  if (associated || recording.has_tracks()) add("track", [this](auto&, auto&) { return track_; });
  if (associated) add("existence", [this](auto&, auto&) { return existence_; });
  add("filter", [](auto&, auto& filter) { return filter.name; });
  // What there is of the mean, and of its standard deviations, along each axis.
  constexpr std::array formats = {"{}_m", "v{}_mps", "a{}_mps2", "sigma_{}_m", "sigma_v{}_mps"};
  for (std::size_t k = 0; k < 3 * formats.size(); ++k)
    add(fmt::format(fmt::runtime(formats[k / 3]), "xyz"[k % 3]), [=](auto& point, auto&) {
      const std::size_t n = point.mean.size(), i = k / 3 % 3 * axes + k % 3;
      if (k % 3 >= axes || i >= n / axes * axes) return Cell();
      return Cell(k < 9 ? point.mean[i] : std::sqrt(point.covariance[i * (n + 1)]));
    });
  add("nis", [](auto& point, auto&) { return point.nis ? Cell(*point.nis) : Cell(); });
  const auto turns = [](const FilterSettings& filter) {
    return !std::ranges::all_of(filter.motions, &MotionChoice::linear);
  };
  if (std::ranges::any_of(filters, turns))
    add("turn_rate_deg_s", [=](auto& point, auto&) {  // which comes after the derivatives
      const std::vector<double>& mean = point.mean;
      return mean.size() % axes > 0 ? Cell(mean[mean.size() / axes * axes] / degree) : Cell();
    });
  for (const auto& model : model_names(filters))
    add("weight_" + model, [=](auto& point, auto& filter) {
      const auto& own = filter.models;
      const auto j = static_cast<std::size_t>(std::ranges::find(own, model) - own.begin());
      return j < own.size() ? Cell(point.weights[j]) : Cell();
    });
  add("most_likely", [](auto& point, auto& filter) { return filter.models[point.most_likely_mode]; });
  if (recording.on_the_earth()) {
    add("latitude_deg", [](auto& point, auto&) { return point.place.latitude_deg; });
    add("longitude_deg", [](auto& point, auto&) { return point.place.longitude_deg; });
    add("altitude_m", [=](auto& point, auto&) { return axes == 3 ? Cell(point.place.altitude_m) : Cell(); });
  }
  file_.emplace(*files, associated ? "tracks.csv" : "estimates.csv", keys);
}

}  // namespace sigmax::apps
