// The times of a recording's rows.

#include "records/recording.hpp"
#include "table/timestamp.hpp"

namespace sigmax::apps {
namespace {

/// Of thousandths rather than times 0.001, which no double is.
double in_seconds(double number, double unit_s) {
  return unit_s < 1.0 ? number / std::round(1.0 / unit_s) : number * unit_s;
}

}  // namespace

std::optional<double> RecordingReader::time_of(const std::string& text, bool& of_day) const {
  of_day = options_.time_format.empty() && is_time_of_day(text);
  if (!options_.time_format.empty()) return parse_timestamp(text, options_.time_format, of_day);
  if (const auto number = parse_number(text)) return in_seconds(*number, time_unit_->unit_s);
  return parse_timestamp(text);
}

/// Takes the row's line, track, sensor and time; false if the row is to be skipped for its time.
bool RecordingReader::take_time(Row& row) {
  row.line = row_.line();
  row.track = track_ ? trimmed(row_[*track_]) : std::string_view{};
  row.sensor = sensor_ ? trimmed(row_[*sensor_]) : std::string_view{};
  if (track_ && row.track.empty() && !options_.mixed)
    throw row_.error(*track_, "what tells its track from others",
                     rows_ == 0 ? "fill the cell, or drop the line, if it holds units" : "fill the cell");
  bool of_day = false;
  std::string cell(trimmed(row_[time_]));
  auto found = time_of(cell, of_day);
  if (date_ && (of_day || (!found && !options_.time_format.empty()))) {
    cell = fmt::format("{} {}", trimmed(row_[*date_]), cell);
    found = time_of(cell, of_day);
    if (!found || of_day)
      throw row_.error(*date_, "a date as 2016-01-12, since its row has a time of day",
                       "correct the cell, or drop the column if it is none; if all are written otherwise, say how "
                       "both are, as --time-format '%d/%m/%Y %H:%M:%S'");
    times_have_dates_ = true;
  }
  if (!found && !options_.time_format.empty())
    throw row_.error(time_, "a time as --time-format says, " + in_quotes(options_.time_format),
                     "correct the cell or drop the row");
  if (!found)
    throw row_.error(time_, "a number of seconds, or a date and time as 2016-01-12T13:02:11.218Z",
                     (rows_ == 0 ? "drop the line, if it holds units; " : "") +
                         std::string("correct the cell or drop the row; if all are written otherwise, say how, as "
                                     "--time-format '%d/%m/%Y %H:%M:%S'"));
  times_are_numbers_ = options_.time_format.empty() && parse_number(row_[time_]);
  const double time = of_day ? on_its_day(row, *found) : *found;
  row.detection.time = time;
  const bool refused = refused_time(row, time);
  Last& last = last_.find(timed(row))->second;
  if (!refused) {
    last.of_day = of_day;
    if (of_day) latest_of_day_ = time;
    return true;
  }
  if (!options_.skip_bad_times)
    throw row_.error(
        time_, fmt::format("a time after that of the row before, {}", shortest(last.time)),
        sensor_ ? "sort the rows by time and drop repeated ones of one sensor, or give --on-bad-time skip"
        : time == last.time
            ? fmt::format(
                  "where several sensors measure at one time, name them in a column sensor{}; where times were "
                  "rounded, write them in full; else drop repeated rows, or give --on-bad-time skip",
                  track_ ? "" : ", and where several targets do, give the column that tells them apart by --track-id")
            : fmt::format("sort the rows by time{}, or give --on-bad-time skip",
                          track_ || options_.mixed
                              ? ""
                              : "; or where there are several targets, tell them apart by --track-id COLUMN"));
  ++skipped_;
  return false;
}

/// The time of day with the days since the first. Where it falls by more than half a day within a track, that is the
/// next day. Where it would rise by more than half a day, it is of the day before: a late row of a track, or the first
/// row of one that begins.
double RecordingReader::on_its_day(const Row& row, double time_of_day) {
  const auto last = last_.find(timed(row));
  const bool first = last == last_.end();
  if (first ? !latest_of_day_ : !last->second.of_day) return time_of_day;
  const double before = first ? *latest_of_day_ : last->second.time;
  const double midnight = midnight_before(before);
  const double time = first ? midnight + time_of_day : time_of_day_after(before, time_of_day);
  if (time >= day_s && time - before > day_s / 2.0) return time - day_s;
  if (time - midnight >= day_s) midnights_.add(row.line);
  return time;
}

/// Whether the time is not after that of the track's row before; several sensors may measure at one time.
bool RecordingReader::refused_time(const Row& row, double time) {
  const auto [found, first] = last_.try_emplace(timed(row));
  Last& last = found->second;
  if (first || time > last.time) {
    last = {time, {row.sensor}};
    return false;
  }
  if (options_.mixed) return !(time == last.time);
  const bool has_reported = std::ranges::find(last.sensors, row.sensor) != last.sensors.end();
  if (!(time == last.time) || has_reported) return true;
  last.sensors.push_back(row.sensor);
  return false;
}

}  // namespace sigmax::apps
