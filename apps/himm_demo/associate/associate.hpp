#pragma once

#include <deque>
#include <sigmax/estimation/trajectory_gospa.hpp>

#include <sigmax/hybrid/multi_target_tracker.hpp>

#include "himm_demo/filters/settings.hpp"
#include "records/recording.hpp"
#include "report/result.hpp"
#include "shell/random.hpp"

namespace sigmax::apps {

/// The kinds of association by their names in the field, in the order of the table in docs/many_targets.md.
struct NamedAssociation {
  const char* name;
  AssociationChoice choice;
};
inline constexpr std::array<NamedAssociation, 4> associations = {
    {{"jpda", {false, false}}, {"jpda_star", {false, true}}, {"gnn", {true, true}}, {"fuzzy_random", {true, false}}}};

/// The options of `himm_demo associate`.
struct AssociateOptions {
  RecordingOptions recording;  ///< whose tracks are the labels
  RadarOptions radar;
  FilterOptions filters;
  NamedAssociation association = associations[1];
  MultiTargetRules rules;         ///< whose gate is that of the settings
  std::optional<double> scan_s;   ///< how long a scan takes
  std::optional<double> clutter;  ///< false detections a scan of simulated radars, on average
  int radars = 0;                 ///< of a situation; 0: its positions are measured
  std::optional<double> cutoff;   ///< of GOSPA, in m
  std::uint64_t seed = 1;
  std::string situation;  ///< that is simulated, or empty
  std::optional<int> runs;
  int threads = 0;  ///< 0: as many as the machine has
  OutputOptions output;
};

/// Rows of one scan: what one sensor saw while it looked at every target once. Their detections are as the filter takes
/// them and have their places here as tags; their tracks are labels, which the filter does not see.
using Scan = std::vector<Row>;

/// The tracker that options and settings stand for.
MultiTargetTracker tracker_for(const AssociateOptions& options, const FilterSettings& filter, int axes,
                               const AssociationChoice& association);

/// What settings of associate are by default: a radar's measurements stay in its own space, where clutter is uniform.
FilterDefaults associate_defaults();

/// A situation that makes association hard, and what tracks need to know of its targets.
struct Situation {
  std::string name;
  std::optional<double> greatest_speed{};  ///< in m/s
  std::vector<std::string> sets{};
};
inline const std::vector<Situation> situations = {
    {"crossing"},      // two targets cross at 30°
    {"parallel"},      // two targets approach, fly 100 m apart for 60 s, and separate
    {"splitting"},     // a second target begins where the first one is, and turns away
    {"manoeuvring"},   // three targets turn at 6°/s, two of them towards each other
    {"dense", 100.0},  // twelve targets in 8 km × 8 km, with 60 false detections a scan
    // Four targets meet in a point, and one dies there, as in García-Fernández et al. (IEEE TAES 54:1883).
    {"meeting", 3.0, {"sigma_w=0.1", "models=[dwna]"}}};

/// A situation as a seed draws it.
struct Scene {
  /// Of each scan all detections in no order, then a row without a measurement for each target that was missed. Their
  /// tracks are the targets, "1", "2", …, or empty; their truth is where the target was, x and y in m.
  std::vector<Scan> scans{};
  std::vector<Trajectory> truth{};  ///< x and y in m of each target
};

/// Draws the situation of the options as they say that it is seen: positions, or the ranges and azimuths of radars that
/// take turns at the corners of the area. It depends on the seed alone, and the truth not on how it is seen.
Scene simulate(const AssociateOptions& options, std::uint64_t seed);

/// `himm_demo associate --simulate`: writes a situation, or evaluates every association on many runs.
void simulate_situation(AssociateOptions options);

/// Where a target is, or was by a line of the recording, at one time.
struct Known {
  double time;
  std::size_t line;
  Position at;
};

/// On the straight line between two places that are known, in the order of times; nothing before the first and after
/// the last.
std::optional<Known> between(const std::vector<Known>& path, double time);

/// Reads a recording scan by scan: by --scan, rows of equal times, or turns of a radar.
class ScanReader {
 public:
  /// What it is made of must live as long. Throws InputError where nothing tells what a scan is.
  ScanReader(const AssociateOptions& options, RecordingReader& recording, const FilterSettings& filter);

  /// The next scan; false at the end. Throws InputError with file, line and column.
  bool next(Scan& scan);

  /// The frame of positions on the Earth.
  const std::optional<LocalFrame>& frame() const { return places_.frame() ? places_.frame() : frame_; }

  /// Sentences on what was read, and on what a scan is.
  std::vector<std::string> notes() const;

  std::size_t rows() const { return rows_; }

 private:
  bool read(Row& row);
  void place(Row& row);
  void take(Row& row);
  void take_for_truth();
  Scan simulated(double time);

  const AssociateOptions& options_;
  RecordingReader& recording_;
  const FilterSettings& filter_;
  int axes_ = recording_.axes();
  SensorPlaces places_{filter_, recording_, options_.radar.place()};
  std::optional<LocalFrame> frame_;
  std::deque<Row> ahead_;   // read to find out what a scan is
  std::deque<Scan> scans_;  // the first `whole_` have all their rows
  double turn_ = 0.0;       // which way azimuths go: 1 or −1; 0 for equal times
  double azimuth_ = nan, angle_ = 0.0;
  std::size_t rows_ = 0, unplaced_ = 0, whole_ = 0;
  std::size_t number_ = 0;  // of the window, turn or time
  // Of a simulated radar: where everybody was, and what it may take for a target.
  std::map<std::string, std::vector<Known>> truth_;
  RandomStream random_{options_.seed, 0};
  double first_time_ = infinity, last_time_ = -infinity;
  double greatest_range_ = 0.0, least_elevation_ = infinity, greatest_elevation_ = 0.0;
};

/// Keeps where targets were and confirmed tracks are, scan by scan.
class AssociateHistory {
 public:
  explicit AssociateHistory(int axes) : axes_(axes) {}

  /// Takes a scan, whose rows with a label tell where that target was, by their truth or else by what was measured;
  /// what the tracker made of it, and all its tracks at its time.
  void add(const MultiTargetTracker& tracker, const Scan& scan, const std::vector<TrackedTarget>& tracks);

  /// How well tracks show the targets, as fields of a row: RMS GOSPA over scans (α = 2, p = 2) and its parts, in m,
  /// whose squares add up to its square; and what concerns whole tracks.
  std::vector<Field> score(double cutoff) const;

  /// Ten times the median standard deviation of a position.
  double usual_cutoff() const;

  /// How many tracks were confirmed.
  std::size_t confirmed() const { return tracks_.size(); }

  /// All detections, or those of confirmed tracks.
  std::size_t detections(bool explained = false) const;

  /// The plan, with unexplained detections, and existence over time.
  void add_to(Report& page, bool geodetic) const;

 private:
  using Point = std::vector<double>;
  /// A track since it is confirmed; where it is not, its positions are empty.
  struct Track {
    Trajectory path;
    std::vector<double> existence;
  };

  int axes_;
  std::vector<double> times_;  // of the scans
  std::map<std::size_t, Track> tracks_;
  std::map<std::size_t, std::vector<Position>> detections_;  // by the number of the track, or 0; NaN without a position
  std::map<std::string, std::vector<Known>> targets_;
  bool truth_known_ = false;
  std::vector<double> sigmas_;
};

}  // namespace sigmax::apps
