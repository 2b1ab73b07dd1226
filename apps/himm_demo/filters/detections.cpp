// How detections come to a filter: with the noise that it assumes, and from where their sensors stand.

#include "himm_demo/filters/settings.hpp"

namespace sigmax::apps {
namespace {

/// What is believed of a number of a detection, if it is taken for a measurement.
std::optional<double> sigma_of(const SensorSettings& accuracy, const AnyDetection& detection, std::size_t i, int axes) {
  if (detection.sensor == Sensor::bearing) return accuracy.radar[1];
  if (detection.sensor == Sensor::components) {
    if (detection.places[i] >= axes) return accuracy.velocity_mps;
    return accuracy.position_m[accuracy.position_m.size() == 1 ? 0 : static_cast<std::size_t>(detection.places[i])];
  }
  return i < static_cast<std::size_t>(axes) ? std::optional(accuracy.radar[i]) : accuracy.range_rate_mps;
}

/// What a radar measured, as a position.
AnyDetection converted(const AnyDetection& seen, RadarForm form) {
  const auto n = static_cast<std::size_t>(seen.size);
  Polar measured{seen.z[0], radians(seen.z[1])},
      sigma{std::sqrt(seen.variance(0)), radians(std::sqrt(seen.variance(1)))};
  if (n == 3) measured.elevation = radians(seen.z[2]), sigma.elevation = radians(std::sqrt(seen.variance(2)));
  const Gaussian<3> position = to_cartesian(measured, sigma, static_cast<Conversion>(form));
  AnyDetection detection{.time = seen.time, .tag = seen.tag, .sensor = Sensor::position, .size = seen.size};
  for (std::size_t i = 0; i < n; ++i) {
    detection.z[i] = position.mean(static_cast<Eigen::Index>(i)) + seen.origin[i];
    for (std::size_t j = 0; j < n; ++j) detection.covariance[i * n + j] = position.covariance.data()[i + 3 * j];
  }
  return detection;
}

}  // namespace

AnyDetection with_sensor_noise(const FilterSettings& settings, std::string_view sensor, const AnyDetection& detection,
                               int axes) {
  const SensorSettings& accuracy = settings.accuracy_of(sensor);
  const auto size = static_cast<std::size_t>(detection.size);
  AnyDetection taken = detection;
  std::size_t n = 0;  // what is not taken, velocities and range rates, comes last
  while (n < size && sigma_of(accuracy, detection, n, axes)) ++n;
  taken.size = static_cast<int>(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) taken.covariance[i * n + j] = detection.covariance[i * size + j];
    const double sigma = *sigma_of(accuracy, detection, i, axes);
    if (std::isnan(detection.variance(static_cast<int>(i)))) taken.covariance[i * (n + 1)] = sigma * sigma;
  }
  using enum AnyDetection::Sensor;
  if (n == 0) {
    taken.sensor = none;
  } else if (detection.sensor == doppler || detection.sensor == polar) {
    taken.sensor = taken.size > axes ? doppler : polar;
    if (taken.size == axes && settings.radar_measurement != RadarForm::polar)
      return converted(taken, settings.radar_measurement);
  } else if (detection.sensor == components && taken.size == axes && taken.places[n - 1] == axes - 1) {
    taken.sensor = position;
  }
  return taken;
}

SensorPlaces::SensorPlaces(const FilterSettings& settings, const RecordingReader& recording, const Position& otherwise)
    : settings_(settings), recording_(recording), otherwise_(otherwise) {
  if (recording.origin() && recording.seen_from_places()) frame_.emplace(*recording.origin(), recording.axes());
}

void SensorPlaces::place(Row& row) {
  AnyDetection& detection = row.detection;
  const int axes = recording_.axes();
  if (detection.sensor == Sensor::components) {
    const auto here = place_of(detection, axes);
    if (!frame_ && recording_.geodetic() && recording_.seen_from_places() && here) frame_.emplace(*here, axes);
    return;
  }
  if (!row.measured()) return;
  const SensorPlace& own = settings_.accuracy_of(row.sensor).place;
  std::optional<Position> at = row.sensor_at;
  std::optional<Geodetic> on_earth = row.sensor_place;
  if (!at && !on_earth && own.latitude_deg)
    on_earth = {*own.latitude_deg, *own.longitude_deg, own.altitude_m.value_or(0.0)};
  if (!at && !on_earth && !own.at_m.empty()) at = {own.at_m[0], own.at_m[1], own.at_m.size() == 3 ? own.at_m[2] : 0.0};
  if (on_earth) {
    if (!frame_) frame_.emplace(*on_earth, axes);
    detection = seen_from(*on_earth, detection, *frame_, axes);
  } else {
    detection.origin = at.value_or(otherwise_);
    in_metres_ = true;
    if (!at) ++unplaced_[row.sensor];
  }
  const auto refuse = [&](std::string_view what, std::string_view remedy) {
    throw InputError("{}:{}: {}; {}", recording_.file(), row.line, what, remedy);
  };
  if (frame_ && in_metres_ && !recording_.origin())
    refuse("some sensors or positions are on the Earth, by latitude and longitude, and others are not",
           "place all of them there, or say with --origin LAT,LON,ALT from where metres are counted");
  const Position& first = stood_.try_emplace(row.sensor, detection.origin).first->second;
  if (detection.sensor == Sensor::doppler && first != detection.origin)
    refuse("the sensor moves, and so its range rate is not the target's alone", "leave sigma_range_rate_mps out");
  several_ |= detection.origin != stood_.begin()->second;
}

std::vector<std::string> SensorPlaces::notes() const {
  std::vector<std::string> sentences;
  if (frame_ && !recording_.origin())
    sentences.push_back(fmt::format("Positions are counted from the first place, latitude {}°, longitude {}°",
                                    shortest(frame_->origin().latitude_deg), shortest(frame_->origin().longitude_deg)));
  const std::string unplaced = list_of(
      unplaced_, [](const auto& of) { return fmt::format("{} {}", of.first.empty() ? "rows" : of.first, of.second); });
  if (several_ && !unplaced.empty())
    sentences.push_back(fmt::format("No place is given, so the sensors stand at ({}, {}, {}) m: {}",
                                    shortest(otherwise_[0]), shortest(otherwise_[1]), shortest(otherwise_[2]),
                                    unplaced));
  return sentences;
}

}  // namespace sigmax::apps
