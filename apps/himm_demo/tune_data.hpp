#pragma once

#include <map>
#include <string>
#include <vector>

#include <sigmax/hybrid/any_target.hpp>

#include "himm_demo/filter_settings.hpp"
#include "himm_demo/tune.hpp"

namespace sigmax::apps {

/// One target of a recording, its rows in one frame: a position rather than a place.
struct TuneTrack {
  std::string file;
  std::vector<Fix> rows;
};

/// Whose accuracy is to be fitted: what a sensor measured where the row does not say how well.
struct TuneSensor {
  std::size_t rows = 0;
  bool position = false;
  bool radar = false;
  bool bearing = false;  ///< alone
  bool velocity = false;
  bool range_rate = false;
};

/// All recordings, read once.
struct TuneData {
  int axes = 3;
  bool has_truth = false;
  bool geodetic = false;  ///< whether positions were places
  Vector<3> radar_at = Vector<3>::Zero();
  std::vector<TuneTrack> tracks;  ///< those long enough to be followed
  std::size_t too_short = 0;      ///< tracks that are not
  std::size_t measurements = 0;
  std::map<std::string, TuneSensor, std::less<>> sensors;  ///< "" if the rows name none
  std::vector<std::string> notes;                          ///< sentences on what does not count
  double volume = 1.0;                                     ///< of the box that holds all measurements, in m² or m³
  double radar_volume = 1.0;                               ///< the same of a radar's, in its own space

  /// The fold of each measurement, from 0: by track where there are two for each fold or more, else the track's time
  /// cut into as many pieces.
  std::vector<std::vector<std::size_t>> folds(std::size_t count) const;

  /// What the rows of a track are to a filter; the tags are their numbers.
  std::vector<AnyPlot> plots(const TuneTrack& track, const FilterSettings& settings) const;
};

/// Reads all files. Throws InputError, with file and line, for what `track` refuses too, for files of different axes,
/// and where there is too little to fit.
TuneData read_tune_data(const TuneOptions& options);

}  // namespace sigmax::apps
