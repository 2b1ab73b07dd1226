// How rows become scans, as they stand in a file or as a simulated radar sees them.

#include "himm_demo/associate/associate.hpp"

#include "shell/text.hpp"

namespace sigmax::apps {
namespace {

constexpr std::size_t looked_at = 400;  // rows, to find out what a scan is
constexpr double whole_turn = 2.0 * std::numbers::pi;
constexpr double backwards = 10.0 * degree;  // so far may azimuths go back within a turn
constexpr std::size_t most_empty = 100;      // scans without a row, after which no track is left

/// How far a radar turned from one azimuth to the next.
double turn_between(double from, double to, double direction) {
  const double turn = direction * (to - from) + backwards;
  return turn - whole_turn * std::floor(turn / whole_turn) - backwards;
}

}  // namespace

ScanReader::ScanReader(const AssociateOptions& options, RecordingReader& recording, const FilterSettings& filter)
    : options_(options), recording_(recording), filter_(filter) {
  if (options.radar.sigma) read_truth();
}

/// The next row with its detection in the frame of all.
bool ScanReader::read(Row& row) {
  if (!recording_.next(row)) return false;
  row.sensor = recording_.has_sensors() ? row.sensor : "";
  if (!options_.radar.sigma) places_.place(row);
  AnyDetection& detection = row.detection;
  if (recording_.geodetic() && detection.sensor == Sensor::components) {
    const auto here = place_of(detection, axes_);
    if (here && !frame()) frame_.emplace(recording_.origin().value_or(*here), axes_);
    detection =
        here ? in_frame(detection, *frame(), frame()->to_local(*here), axes_) : AnyDetection::missed(detection.time);
    if (!here) ++unplaced_;
  }
  ++rows_;
  return true;
}

/// Whether so many rows wait.
bool ScanReader::fill(std::size_t rows) {
  for (Row row; waiting_.size() < rows && read(row);) waiting_.push_back(std::move(row));
  return waiting_.size() >= rows;
}

/// Finds out what a scan is: rows of equal times, or a turn.
void ScanReader::choose() {
  chosen_ = true;
  if (options_.scan_s) return;
  fill(looked_at);
  std::size_t equal = 0;
  double forwards = 0.0, back = 0.0;
  for (std::size_t i = 1; i < waiting_.size(); ++i) {
    const AnyDetection &one = waiting_[i - 1].detection, &next = waiting_[i].detection;
    if (next.time == one.time) ++equal;
    forwards += turn_between(one.z[1], next.z[1], 1.0);
    back += turn_between(one.z[1], next.z[1], -1.0);
  }
  const bool all_polar = std::ranges::all_of(waiting_, [&](const Row& row) {
    return (row.detection.sensor == Sensor::polar || row.detection.sensor == Sensor::doppler) &&
           row.sensor == waiting_[0].sensor;
  });
  if (3 * equal >= waiting_.size()) return;
  const double least = std::min(forwards, back);
  if (!all_polar || least < 2.0 * whole_turn || least > 0.4 * whole_turn * static_cast<double>(waiting_.size()))
    throw InputError(
        "{}: neither equal times nor azimuths that go round tell which rows are of one scan; say how long "
        "a scan takes, with --scan SECONDS",
        recording_.file());
  turn_ = forwards < back ? 1.0 : -1.0;
}

/// Whether a row is the first of another scan than the row before.
bool ScanReader::begins_scan(const Row& row) {
  const double time = row.detection.time, before = std::exchange(time_, time);
  if (std::isnan(before)) first_time_ = time;
  if (options_.scan_s) {
    const auto window = static_cast<std::size_t>((time - first_time_) / *options_.scan_s * (1.0 + 1e-12) + 1e-9);
    return std::exchange(number_, window) != window;
  }
  if (turn_ == 0.0) return time != before;
  if (!row.measured()) return false;
  if (!std::isnan(azimuth_)) angle_ += turn_between(azimuth_, row.detection.z[1], turn_);
  azimuth_ = row.detection.z[1];
  const auto turn = std::max(number_, static_cast<std::size_t>(std::max(0.0, angle_ / whole_turn)));
  return std::exchange(number_, turn) != turn;
}

bool ScanReader::next(Scan& scan) {
  scan.clear();
  if (options_.radar.sigma) return simulated(scan);
  if (!chosen_) choose();
  if (scans_.empty()) {
    if (!fill(1)) return false;
    if (std::isnan(time_)) begins_scan(waiting_.front());
    std::map<std::string, std::size_t> place;  // of each sensor's scan
    const std::size_t now = number_;
    for (bool first = true; fill(1) && (first || !begins_scan(waiting_.front())); first = false) {
      Row& row = waiting_.front();
      const auto [found, is_new] = place.emplace(row.sensor, scans_.size());
      if (is_new) scans_.emplace_back();
      row.detection = with_sensor_noise(filter_, row.sensor, row.detection, axes_);
      scans_[found->second].push_back(std::move(row));
      waiting_.pop_front();
    }
    for (std::size_t k = now + 1; options_.scan_s && k < std::min(number_, now + most_empty); ++k)
      scans_.push_back(
          {Row{.detection = AnyDetection::missed(first_time_ + static_cast<double>(k) * *options_.scan_s)}});
  }
  scan = std::move(scans_.front());
  scans_.pop_front();
  for (std::size_t i = 0; i < scan.size(); ++i) scan[i].detection.tag = i;
  return true;
}

/// Takes the recording for the truth: the positions of each label.
void ScanReader::read_truth() {
  first_time_ = least_elevation_ = infinity;
  greatest_elevation_ = 0.0;
  for (Row row; read(row);) {
    const auto at = position_of(row.detection, axes_);
    if (!at || axes_seen(row.detection, axes_) < axes_) continue;
    const Position from = options_.radar.place();
    const Polar exact = to_polar(Vector<3>(at->data()) - Vector<3>(from.data()));
    greatest_range_ = std::max(greatest_range_, exact.range);
    greatest_elevation_ = std::max(greatest_elevation_, exact.elevation.radians());
    least_elevation_ = std::min(least_elevation_, exact.elevation.radians());
    first_time_ = std::min(first_time_, row.detection.time);
    last_time_ = std::max(last_time_, row.detection.time);
    truth_[row.track].push_back({row.detection.time, row.line, *at});
  }
}

/// The next scan of a simulated radar: each target is where it was between its rows, and is detected with probability
/// P_D; false detections are uniform in range, azimuth and elevation.
bool ScanReader::simulated(Scan& scan) {
  const double time = first_time_ + static_cast<double>(number_++) * *options_.scan_s;
  if (!(time <= last_time_)) return false;
  const auto add = [&](Row row) {
    row.detection = with_sensor_noise(filter_, "", row.detection, axes_);
    row.detection.tag = scan.size();
    scan.push_back(std::move(row));
  };
  const auto size = static_cast<std::size_t>(axes_);
  const std::vector<double> unknown(size, nan);
  for (const auto& [label, path] : truth_) {
    const auto known = between(path, time);
    if (!known) continue;
    Row row{.line = known->line, .track = label};
    row.detection = AnyDetection::position(time, std::span(known->at).first(size), unknown);
    see_by_radar(row, known->at, axes_, options_.radar, random_, recording_.file());
    if (random_.uniform() > options_.rules.detection_probability) row.detection = AnyDetection::missed(time);
    add(std::move(row));
  }
  for (std::size_t k = random_.count(options_.clutter.value_or(0.0)); k > 0; --k) {
    const std::array z = {greatest_range_ * random_.uniform(), std::numbers::pi * (2.0 * random_.uniform() - 1.0),
                          least_elevation_ + (greatest_elevation_ - least_elevation_) * random_.uniform()};
    add({.detection = AnyDetection::polar(time, std::span(z).first(size), unknown, options_.radar.place())});
  }
  if (scan.empty()) add({.detection = AnyDetection::missed(time)});
  return true;
}

std::vector<std::string> ScanReader::notes() const {
  std::vector<std::string> notes = recording_.notes();
  for (const std::string& note : places_.notes()) notes.push_back(note);
  if (unplaced_ > 0)
    notes.push_back(fmt::format("Rows without a latitude and a longitude are not used: {}", unplaced_));
  const std::string scans = options_.scan_s ? fmt::format("{} s, as --scan says", shortest(*options_.scan_s))
                            : turn_ == 0.0
                                ? "the rows of one time"
                                : fmt::format("one turn of the radar, {:.3g} s on average, as the azimuths tell",
                                              whole_turn * (time_ - first_time_) / angle_);
  notes.push_back("A scan is " + scans);
  return notes;
}

}  // namespace sigmax::apps
