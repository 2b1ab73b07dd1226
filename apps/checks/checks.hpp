#pragma once

#include <Eigen/Core>
#include <complex>
#include <set>
#include <sigmax/core/mean_interval.hpp>

#include "records/recording.hpp"

namespace sigmax::apps {
namespace checks {

using Vector = Eigen::Vector3d;

/// What a row says: NaN where it says nothing. Positions are in m, velocities in m/s, angles in rad.
struct Record {
  double time;
  std::size_t line;
  std::size_t sensor;  ///< its place among the names
  Vector velocity;     ///< along the axes of the track's frame
  Vector from;         ///< where its sensor stands
  Vector truth = Vector::Constant(nan), at = Vector::Constant(nan);
  double height = nan, climb = nan;                    ///< of a place on the Earth above the ellipsoid
  double range = nan, azimuth = nan, elevation = 0.0;  ///< of a radar
  double range_rate = nan;

  bool is_radar() const { return !std::isnan(range); }
};

struct Track {
  std::vector<Record> rows{};
  std::vector<double> written{};  ///< the numbers of the rows' cells, those of a row together
  std::optional<LocalFrame> frame{};
  double altitude_m = 0.0;  ///< the last one
};

/// All rows, and what their columns are.
struct Records {
  const RecordingReader& recording;
  int axes = recording.axes();
  std::vector<std::size_t> columns{};  ///< the quantities whose cells are kept
  std::vector<std::string> sensors{};
  std::map<std::size_t, Vector> radars{};  ///< the sensors that are, and where they stood first
  std::map<std::string, Track> tracks{};
};

/// Something that is wrong, on what line, if on one, and what mends it.
struct Finding {
  std::string track;
  std::size_t line;
  std::string text;
};
using Findings = std::vector<Finding>;

/// A way to read rows, how far they are off it, squared, and how many numbers were fitted to them.
struct Reading {
  std::string text;
  std::vector<double> off;
  double parameters = 0.0;
};

/// The reading that explains the rows best, if it is better than the first one by 2.5 standard errors over blocks of 25
/// rows, and by much; else null. What is off is off over so many rows.
const Reading* better(const std::vector<Reading>& readings, std::size_t rows_each = 1);

/// The usual one of some numbers; NaN of none.
double quantile_of(std::vector<double> numbers, double share);
inline double median_of(std::vector<double> numbers) { return quantile_of(std::move(numbers), 0.5); }

/// The rows of a track that tell a position, of each sensor; and its name.
template <class Use>
void for_each_path(const Records& records, const Use& use) {
  for (const auto& [name, track] : records.tracks)
    for (std::size_t sensor = 0; sensor < records.sensors.size(); ++sensor) {
      std::vector<const Record*> rows;
      for (const Record& row : track.rows)
        if (row.sensor == sensor && !std::isnan(row.at[0])) rows.push_back(&row);
      use(name, rows);
    }
}

/// Adds what it finds.
using Check = void(const Records& records, Findings& findings);
Check check_columns, check_sentinels, check_targets, check_held, check_interpolated, check_times, check_velocities,
    check_sensors;

}  // namespace checks

/// Signs that the numbers of a recording mean something else than they were taken for. It keeps what the rows say.
class RecordingChecks {
 public:
  explicit RecordingChecks(const RecordingReader& recording);

  /// The row that the reader gave last, where its sensor stands. Places on the Earth are counted in this frame, else
  /// in one that begins at the first of their track.
  void see(const Row& row, const LocalFrame* frame = nullptr);

  /// From where azimuths count, where nobody said it, and the options that say it; else nothing.
  std::optional<std::string> assumed() const;

  /// Sentences: what is wrong, where, and what mends it; causes before what else there is. Throws InputError where the
  /// truth is what was measured.
  std::vector<std::string> findings() const;

 private:
  checks::Records records_;
};

}  // namespace sigmax::apps
