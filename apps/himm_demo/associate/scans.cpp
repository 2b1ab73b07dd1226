// How rows become scans, as they stand in a file or as a simulated radar sees them.

#include "himm_demo/associate/associate.hpp"

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

/// Which way the azimuths of a radar go round, 1 or −1; 0 where a scan is rows of equal times.
double direction_of_turns(const std::vector<Row>& rows, const std::string& file) {
  std::size_t equal = 0;
  double forwards = 0.0, back = 0.0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const AnyDetection &one = rows[i - 1].detection, &next = rows[i].detection;
    if (next.time == one.time) ++equal;
    forwards += turn_between(one.z[1], next.z[1], 1.0);
    back += turn_between(one.z[1], next.z[1], -1.0);
  }
  if (3 * equal >= rows.size()) return 0.0;
  const bool is_of_one_radar = std::ranges::all_of(rows, [&](const Row& row) {
    return (row.detection.sensor == Sensor::polar || row.detection.sensor == Sensor::doppler) &&
           row.sensor == rows[0].sensor;
  });
  const double least = std::min(forwards, back);
  if (!is_of_one_radar || least < 2.0 * whole_turn || least > 0.4 * whole_turn * static_cast<double>(rows.size()))
    throw InputError(
        "{}: neither equal times nor azimuths that go round tell which rows are of one scan; say how long "
        "a scan takes, with --scan SECONDS",
        file);
  return forwards < back ? 1.0 : -1.0;
}

}  // namespace

ScanReader::ScanReader(const AssociateOptions& options, RecordingReader& recording, const FilterSettings& filter)
    : options_(options), recording_(recording), filter_(filter) {
  if (options.radar.sigma) take_for_truth();
  std::vector<Row> first;
  for (Row row; !options.scan_s && first.size() < looked_at && read(row);) first.push_back(std::move(row));
  if (!first.empty()) turn_ = direction_of_turns(first, recording.file());
  ahead_.assign(first.begin(), first.end());
}

/// The next row with its detection in the frame of all.
bool ScanReader::read(Row& row) {
  if (!ahead_.empty()) {
    row = std::move(ahead_.front());
    ahead_.pop_front();
    return true;
  }
  if (!recording_.next(row)) return false;
  ++rows_;
  place(row);
  return true;
}

/// Brings the row's detection into the frame of all.
void ScanReader::place(Row& row) {
  row.sensor = recording_.has_sensors() ? row.sensor : "";
  if (!options_.radar.sigma) places_.place(row);
  AnyDetection& detection = row.detection;
  if (!recording_.geodetic() || detection.sensor != Sensor::components) return;
  const auto here = place_of(detection, axes_);
  if (here && !frame()) frame_.emplace(recording_.origin().value_or(*here), axes_);
  detection =
      here ? in_frame(detection, *frame(), frame()->to_local(*here), axes_) : AnyDetection::missed(detection.time);
  if (!here) ++unplaced_;
}

/// Puts a row into the scan of its sensor in its window, turn or time. Windows without a row are scans without a
/// detection.
void ScanReader::take(Row& row) {
  const double time = row.detection.time, before = std::exchange(last_time_, time);
  if (std::isinf(first_time_)) first_time_ = time;
  std::size_t now = number_;
  if (options_.scan_s) {
    now = static_cast<std::size_t>(std::min((time - first_time_) / *options_.scan_s * (1.0 + 1e-12) + 1e-9, 1e15));
  } else if (turn_ == 0.0) {
    now += time > before && !scans_.empty() ? 1U : 0U;
  } else if (row.measured()) {
    if (!std::isnan(azimuth_)) angle_ += turn_between(azimuth_, row.detection.z[1], turn_);
    azimuth_ = row.detection.z[1];
    now = std::max(number_, static_cast<std::size_t>(std::max(0.0, angle_ / whole_turn)));
  }
  if (now != number_) {
    for (std::size_t k = number_ + 1; options_.scan_s && k < std::min(now, number_ + most_empty); ++k)
      scans_.push_back({{.detection = AnyDetection::missed(first_time_ + static_cast<double>(k) * *options_.scan_s)}});
    number_ = now;
    whole_ = scans_.size();
  }
  const auto sensor = [](const Scan& scan) { return scan.front().sensor; };
  auto own = std::ranges::find(scans_.begin() + static_cast<std::ptrdiff_t>(whole_), scans_.end(), row.sensor, sensor);
  if (own == scans_.end()) own = scans_.insert(own, Scan());
  row.detection = with_sensor_noise(filter_, row.sensor, row.detection, axes_);
  row.detection.tag = own->size();
  own->push_back(std::move(row));
}

/// The positions of each label.
void ScanReader::take_for_truth() {
  for (Row row; read(row);) {
    const auto at = position_of(row.detection, axes_);
    if (!at || row.track.empty() || axes_seen(row.detection, axes_) < axes_) continue;
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

bool ScanReader::next(Scan& scan) {
  if (options_.radar.sigma) {
    const double time = first_time_ + static_cast<double>(number_++) * *options_.scan_s;
    if (time <= last_time_) scan = simulated(time);
    return time <= last_time_;
  }
  for (Row row; whole_ == 0 && read(row);) take(row);
  if (scans_.empty()) return false;
  scan = std::move(scans_.front());
  scans_.pop_front();
  whole_ -= whole_ > 0 ? 1U : 0U;
  return true;
}

/// The next scan of a simulated radar: each target is where it was between its rows, and is detected with probability
/// P_D; false detections are uniform in range, azimuth and elevation.
Scan ScanReader::simulated(double time) {
  Scan scan;
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
  return scan;
}

std::vector<std::string> ScanReader::notes() const {
  std::vector<std::string> notes = recording_.notes();
  for (const std::string& note : places_.notes()) notes.push_back(note);
  if (unplaced_ > 0)
    notes.push_back(fmt::format("Rows without a latitude and a longitude are not used: {}", unplaced_));
  const double turn_s = whole_turn * (last_time_ - first_time_) / angle_;
  notes.push_back("A scan is " +
                  (options_.scan_s ? fmt::format("{} s, as --scan says", shortest(*options_.scan_s))
                   : turn_ == 0.0
                       ? "the rows of one time"
                       : fmt::format("one turn of the radar, {:.3g} s on average, as the azimuths tell", turn_s)));
  return notes;
}

}  // namespace sigmax::apps
