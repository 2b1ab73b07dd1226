#include "checks/checks.hpp"

namespace sigmax::apps {

using namespace checks;

RecordingChecks::RecordingChecks(const RecordingReader& recording) : records_{recording} {
  using enum Role;
  for (const Role role : {position, place, polar, velocity, course, range_rate, truth})
    for (std::size_t q = place_of(role); q < place_of(role) + size_of(role); ++q)
      if (recording.holds(q)) records_.columns.push_back(q);
}

void RecordingChecks::see(const Row& row, const LocalFrame* frame) {
  const RecordingReader& recording = records_.recording;
  const int axes = records_.axes;
  Track& track = records_.tracks[row.track];
  for (const std::size_t q : records_.columns) track.written.push_back(recording.written(q).value_or(nan));
  auto sensor = std::ranges::find(records_.sensors, row.sensor);
  if (sensor == records_.sensors.end()) sensor = records_.sensors.insert(sensor, row.sensor);
  const AnyDetection& detection = row.detection;
  Record record{detection.time, row.line, static_cast<std::size_t>(sensor - records_.sensors.begin()),
                Vector(row.rates.data()), Vector(detection.origin.data())};
  if (row.truth) record.truth = Vector(row.truth->data());
  for (int i = 0; i < axes; ++i)
    if (const auto own = detection.sensor == Sensor::components ? component_of(detection, axes + i) : std::nullopt)
      record.velocity[i] = *own;
  record.climb = record.velocity[2];
  const bool is_seen = detection.sensor == Sensor::polar || detection.sensor == Sensor::doppler;
  const auto here = place_of(detection, axes, track.altitude_m);
  if (is_seen && axes_seen(detection, axes) == axes) {
    record.range = detection.z[0];
    record.azimuth = detection.z[1];
    if (axes == 3) record.elevation = detection.z[2];
    if (detection.sensor == Sensor::doppler) record.range_rate = detection.z[static_cast<std::size_t>(axes)];
    record.at = Vector(position_of(detection, axes)->data());
    records_.radars.try_emplace(record.sensor, record.from);
  } else if (recording.geodetic() && here) {
    track.altitude_m = here->altitude_m;
    if (!track.frame) track.frame = frame ? *frame : LocalFrame(*here, axes);
    record.at = Vector(track.frame->to_local(*here).data());
    record.height = here->altitude_m;
    const auto turn = track.frame->local_axes({record.at[0], record.at[1], record.at[2]});
    Vector turned = Vector::Zero();
    for (std::size_t i = 0; i < 3; ++i)
      if (const double own = record.velocity[static_cast<Eigen::Index>(i)]; !std::isnan(own) || i < 2)
        turned += own * Vector(turn[i].data());
    record.velocity = turned;
  } else if (!is_seen && axes_seen(detection, axes) == axes) {
    record.at = Vector(position_of(detection, axes)->data());
    record.height = axes == 3 ? record.at[2] : nan;
  }
  track.rows.push_back(record);
}

std::optional<std::string> RecordingChecks::assumed() const {
  const RecordingReader& recording = records_.recording;
  if (!(recording.polar() || recording.bearings()) || recording.azimuth_from_is_given()) return std::nullopt;
  return fmt::format(
      "{}:1: azimuths are read counter-clockwise from x (east), as nobody said from where they count; compass "
      "azimuths: --azimuth-from north, clockwise from ahead (x): --azimuth-from ahead",
      recording.file());
}

std::vector<std::string> RecordingChecks::findings() const {
  Findings found;
  // What explains the rest comes first: whoever finds something is the last.
  for (const auto check : {check_columns, check_sentinels, check_targets, check_held, check_interpolated, check_times,
                           check_velocities, check_sensors})
    if (found.empty()) check(records_, found);
  std::map<std::string, std::size_t> again;  // of one kind, in several tracks
  for (const auto& one : found) ++again[one.text.substr(0, one.text.find(':'))];
  std::vector<std::string> sentences;
  for (const auto& [track, line, text] : found) {
    const std::size_t tracks = std::exchange(again[text.substr(0, text.find(':'))], 0);
    if (tracks == 0) continue;
    const std::string others = tracks > 1 ? fmt::format(" and {} more", tracks - 1) : "";
    sentences.push_back(fmt::format("{}:{}: {}{}", records_.recording.file(), line,
                                    track.empty() ? "" : fmt::format("track '{}'{}: ", track, others), text));
  }
  return sentences;
}

}  // namespace sigmax::apps

namespace sigmax::apps::checks {

double quantile_of(std::vector<double> numbers, double share) {
  std::erase_if(numbers, [](double number) { return std::isnan(number); });
  if (numbers.empty()) return nan;
  const auto at = numbers.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(numbers.size() - 1));
  std::ranges::nth_element(numbers, at);
  return *at;
}

const Reading* better(const std::vector<Reading>& readings, std::size_t rows_each) {
  const std::size_t n = readings.front().off.size(), in_block = std::max<std::size_t>(25 / rows_each, 4);
  if (n < 25) return nullptr;
  // Rows are judged as those of a Cauchy distribution, which outliers do not move, of the scale of the best reading.
  double scale = infinity;
  for (const Reading& reading : readings) scale = std::min(scale, median_of(reading.off));
  scale = std::max(scale, 1e-6 * median_of(readings.front().off));
  if (!(scale > 0.0)) return nullptr;
  const auto loss = [&](const Reading& reading, std::size_t row) { return std::log1p(reading.off[row] / scale); };
  const Reading* best = nullptr;
  double least = infinity;
  const auto count = static_cast<double>(n);
  for (const Reading& reading : readings) {
    double sum = reading.parameters * std::log(count);
    for (std::size_t row = 0; row < n; ++row) sum += loss(reading, row);
    if (sum > least - 0.01 * count) continue;
    least = sum;
    best = &reading;
  }
  if (!(quantile_of(best->off, 0.75) < quantile_of(readings.front().off, 0.75))) return nullptr;
  constexpr double sure = 2.5, much = 0.2;
  const std::size_t blocks = std::max<std::size_t>(n / in_block, 3);
  RunningMean gains;
  for (std::size_t block = 0; block < blocks; ++block) {
    double gain = 0.0;
    const std::size_t from = block * n / blocks, to = (block + 1) * n / blocks;
    for (std::size_t row = from; row < to; ++row) gain += loss(readings.front(), row) - loss(*best, row);
    gains.add(gain / static_cast<double>(to - from));
  }
  const auto [mean, half_width] = gains.interval();  // of 1.96 standard errors
  return mean > std::max(much, sure / 1.96 * half_width) ? best : nullptr;
}

}  // namespace sigmax::apps::checks
