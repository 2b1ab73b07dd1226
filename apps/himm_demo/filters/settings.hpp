#pragma once

#include <set>

#include <sigmax/hybrid/any_target.hpp>

#include "records/recording.hpp"
#include "shell/command_line.hpp"
#include "shell/settings.hpp"

namespace sigmax::apps {

/// Which of two accounts of the paper's experiment is followed, where print and program differ.
enum class Preset { paper_text, released };
inline constexpr std::array both_presets = {Preset::paper_text, Preset::released};
inline const char* name_of(Preset preset) { return preset == Preset::released ? "released" : "paper_text"; }

/// How a filter takes a radar's measurements: converted to positions, or in the radar's own space; there only the start
/// is from positions, by the unbiased conversion.
enum class RadarForm { standard, unbiased, debiased, polar };

/// Where a sensor stands: in m, on the Earth, or nobody says it.
struct SensorPlace {
  std::vector<double> at_m;  ///< east, north and perhaps up
  std::optional<double> latitude_deg, longitude_deg, altitude_m;

  bool operator==(const SensorPlace&) const = default;
};

/// A sensor's standard deviations, as a filter believes them, and where it stands.
struct SensorSettings {
  std::array<double, 3> radar{10.0, 0.1 * degree, 0.1 * degree};  ///< of range, azimuth and elevation, in m and rad
  std::vector<double> position_m{10.0};  ///< of measurements that are no radar's: one, or one an axis
  std::optional<double> velocity_mps;    ///< of each component; without it a velocity is not taken for a measurement
  std::optional<double> range_rate_mps;  ///< of a radar's; likewise
  SensorPlace place;                     ///< the same for all filters
  std::set<std::string> given{};         ///< the keys that were
};

/// Everything that one filter is made of: that of the library's target, and how measurements come to it.
struct FilterSettings : TargetChoice {
  FilterSettings() { motions = {{"dwna"}, {"dwpa"}}; }

  std::string name;
  double leaving_possibility = 0.5;           ///< of a mode for each other one, unless `transition` is given
  double leaving_probability = 0.05;          ///< the same, for all others together
  std::optional<double> leaving_a_manoeuvre;  ///< either of both, if that is another one
  double gate_probability = 1.0;              ///< that a right measurement passes the gate; 1 is no gate
  std::optional<double> restart_after_s;      ///< without a measurement that passes
  double restart_after_rejections = 5.0;      ///< in a row; 0 is never
  bool explain = false;                       ///< whether the best history of the mode is told with its dates
  bool smooth = false;                        ///< whether the output is of the whole recording rather than the past
  RadarForm radar_measurement = RadarForm::standard;
  SensorSettings accuracy;
  std::map<std::string, SensorSettings, std::less<>> sensors;  ///< those with an accuracy of their own

  const SensorSettings& accuracy_of(std::string_view sensor) const {
    const auto own = sensors.find(sensor);
    return own == sensors.end() ? accuracy : own->second;
  }
  /// Whether an accuracy, of whatever sensor, has this.
  bool has_sigma(std::optional<double> SensorSettings::*sigma) const {
    return (accuracy.*sigma).has_value() ||
           std::ranges::any_of(sensors, [=](const auto& own) { return (own.second.*sigma).has_value(); });
  }
};

/// From so many bearings at most a track starts: those of a ship may tell little before it turns.
inline constexpr std::size_t bearings_of_a_start = 128;

/// The library's choice that the settings stand for. Throws UsageError for motions that turn along one axis.
TargetChoice choice_of(const FilterSettings& settings, int axes);

/// What a sensor saw, as a filter takes it: a variance that is NaN is that which the filter believes; what it does not
/// take for a measurement is left out, and a radar's is converted if the settings say so.
AnyDetection with_sensor_noise(const FilterSettings& settings, std::string_view sensor, const AnyDetection& detection,
                               int axes);

/// Where the sensors of a recording stand: where its rows or the settings of a filter say, or else all at one place.
class SensorPlaces {
 public:
  /// What it is made of must live as long.
  SensorPlaces(const FilterSettings& settings, const RecordingReader& recording, const Position& otherwise);

  /// Gives a radar's measurement, or a bearing, the origin that it has in the frame of all. On the Earth its angles are
  /// from the east and the horizon where the sensor stands, and are turned into the frame. Sees positions, too. Throws
  /// InputError with file and line where the frame is not known, and for a range rate of a sensor that moves.
  void place(Row& row);

  /// That of all, where sensors stand on the Earth: about --origin, or the first place of them and of the target.
  const std::optional<LocalFrame>& frame() const { return frame_; }

  /// Whether measurements come from several places.
  bool several() const { return several_; }

  /// Whether nothing told the place of some, which stand where all others do.
  bool some_unplaced() const { return !unplaced_.empty(); }

  /// Sentences on what was placed.
  std::vector<std::string> notes() const;

 private:
  const FilterSettings& settings_;
  const RecordingReader& recording_;
  Position otherwise_;
  std::optional<LocalFrame> frame_;
  std::map<std::string, Position> stood_;        // where each sensor stood first
  std::map<std::string, std::size_t> unplaced_;  // rows of those of which nothing says where they stand
  bool in_metres_ = false;                       // whether there are sensors that are not placed on the Earth
  bool several_ = false;
};

/// What the keys have as defaults, and the filters that run by default: the library's, or those of a preset.
struct FilterDefaults {
  FilterSettings filter;
  std::vector<std::string> names = {"imm", "himm"};

  static FilterDefaults of(Preset preset);
};

/// The filters that the settings name, in order; "all" stands for every one that has a name of its own and no settings
/// that were tuned for it. Throws InputError, with the key, for what cannot be.
std::vector<FilterSettings> read_filters(const Settings& settings, const FilterDefaults& defaults);

/// Distinct names of models: a second dwna is dwna_2.
std::vector<std::string> names_of(const std::vector<MotionChoice>& motions);

/// Other motions in place of the filter's: models that it had keep their parameters, a new one is as the first.
void replace_models(FilterSettings& filter, const std::vector<std::string>& motions);

/// The matrix by which the mode of a kind moves on unless it is given.
std::vector<std::vector<double>> default_transition(const FilterSettings& filter, bool fuzzy);

/// The models of all filters, each once, in order.
std::vector<std::string> model_names(const std::vector<FilterSettings>& filters);

/// The settings of all filters in TOML: what is in force. It reads back as the same.
std::string as_toml(const std::vector<FilterSettings>& filters);

/// What people are told of a key.
struct KeyText {
  std::string meaning;
  std::string values;        ///< what may be given
  std::string by_default{};  ///< where no value can say it
};

/// Everything that is known of one key: reading, writing, and the table of keys are loops over these.
template <class Owner>
struct Key {
  std::string name;
  KeyText text;
  /// Leaves the owner's value where the key is absent; throws InputError for what cannot be.
  std::function<void(const Settings&, Owner&)> read;
  /// The value in TOML; empty if there is none.
  std::function<std::string(const Owner&)> write;
  /// Whether it changes anything; only then it is written.
  std::function<bool(const Owner&)> applies = [](const Owner&) { return true; };
};

/// The keys of a filter in the order in which they are read, written and listed.
const std::vector<Key<FilterSettings>>& filter_keys();

/// Those of a sensor, which a filter has too.
const std::vector<Key<SensorSettings>>& accuracy_keys();

/// --config, --set and --print-config.
struct FilterOptions {
  std::string config;
  std::vector<std::string> sets;
  bool print_config = false;
};
void add_filter_options(Subcommand app, FilterOptions& options);

/// The filters that they name for a recording: a radar is as accurate as the simulated one, if there is one. What they
/// know the accuracy of, velocities and range rates, is asked of the recording. Throws InputError for what cannot be,
/// and for keys that nobody knows.
std::vector<FilterSettings> filters_for(RecordingOptions& recording, const FilterOptions& options,
                                        const std::optional<std::array<double, 3>>& radar,
                                        FilterDefaults defaults = {});

/// Filters without a given start start at 0 with no knowledge of how the target moves, once: for recordings that tell
/// no position.
void start_at_zero(std::vector<FilterSettings>& filters);

}  // namespace sigmax::apps
