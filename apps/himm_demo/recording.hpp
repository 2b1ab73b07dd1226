#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <sigmax/estimation/gaussian.hpp>

#include "support/csv.hpp"
#include "support/geodesy.hpp"

namespace sigmax::apps {

/// One row of a recording in local coordinates.
struct Fix {
  std::size_t line = 0;
  double time_s = 0.0;
  std::optional<Vector<3>> position;  ///< east, north, up in m; z is 0 on two axes. Nothing if the cells are empty.
  std::optional<double> roll_deg;
};

/// Reads a headed CSV recording, Cartesian or geodetic as its columns say, row by row.
class RecordingReader {
 public:
  /// `columns` maps our names to the file's headers (NAME=HEADER). Throws InputError for a file that is neither kind,
  /// UsageError for a mapping that is none.
  RecordingReader(const std::string& file, const std::vector<std::string>& columns,
                  std::optional<std::array<double, 3>> origin);

  /// The next row; false at the end. Times must increase. Throws InputError with file, line and column.
  bool next(Fix& fix);

  bool geodetic() const { return latitude_.has_value(); }
  int axes() const { return z_ || geodetic() ? 3 : 2; }
  bool has_roll() const { return roll_.has_value(); }
  const CsvReader& csv() const { return csv_; }

  /// The frame of a geodetic recording, known after its first row.
  const LocalFrame& frame() const { return *frame_; }

 private:
  CsvReader csv_;
  CsvRow row_;
  std::size_t time_ = 0;
  std::optional<std::size_t> x_, y_, z_, latitude_, longitude_, altitude_, roll_;
  double altitude_unit_ = 1.0;  ///< in m
  std::optional<LocalFrame> frame_;
  std::optional<double> last_time_;
};

}  // namespace sigmax::apps
