#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sigmax/estimation/radar.hpp>
#include <sigmax/hybrid/interaction.hpp>

#include "himm_demo/motion.hpp"
#include "himm_demo/reading.hpp"
#include "himm_demo/scenario.hpp"
#include "support/settings.hpp"

namespace sigmax::apps {

/// How a filter gets its first estimates.
enum class Start {
  points,    ///< from the first three measurements, each model by as many as it needs
  released,  ///< from the first three as the authors' program does
  given      ///< from start_mean and start_covariance_diagonal
};

/// When and how what a mode's model starts from is made one Gaussian.
enum class Scheme {
  interacting,   ///< before the measurement, for each mode: IMM and HIMM
  common_start,  ///< before the measurement, once for all modes: GPB1
  second_order,  ///< after the measurement: GPB2 and Viterbi
  independent    ///< never: a static (autonomous) bank
};

/// A sensor's standard deviations, as a filter believes them.
struct Accuracy {
  Polar radar{};                   ///< m and rad
  std::vector<double> position_m;  ///< of measurements that are no radar's: one, or one an axis
};

/// Everything that one filter is made of.
struct FilterSettings {
  std::string name;
  bool fuzzy = false;  ///< whether the mode is fuzzy rather than random
  Scheme scheme = Scheme::interacting;
  std::vector<Motion> motions = {{MotionType::dwna}, {MotionType::dwpa}};
  std::vector<std::string> models;  ///< their names, all different
  MemberType member = MemberType::ekf;
  std::vector<std::vector<double>> transition;  ///< per scan
  double leaving_possibility = 0.5;             ///< of a mode for each other one, unless `transition` is given
  std::vector<double> sojourn_s;                ///< of each mode on average; if given, the transition follows the time
  MixedCovariance mixed_covariance = MixedCovariance::own_recentred;
  MixingWeights imm_mixing = MixingWeights::correct;
  Lift lift = Lift::borrowed_variance;
  Tie mixing_tie = Tie::stay;
  Tie output_tie = Tie::stay;
  LikelihoodForm likelihood = LikelihoodForm::density;
  OutputSpread output_spread = OutputSpread::included;
  bool most_likely_output = false;
  Start start = Start::points;
  std::vector<double> start_mean;
  std::vector<double> start_covariance_diagonal;
  double start_sigma_turn_deg_s = 3.0;  ///< of a rate that is estimated; it starts from 0
  std::optional<double> start_time_s;
  double gate_probability = 1.0;          ///< that a right measurement passes the gate; 1 is no gate
  std::optional<double> restart_after_s;  ///< without a measurement that passes
  bool smooth = false;                    ///< whether the output is of the whole recording rather than the past
  RadarForm radar_measurement = RadarForm::standard;
  Accuracy accuracy{{}, {10.0}};
  std::map<std::string, Accuracy, std::less<>> sensors;  ///< those with an accuracy of their own

  const Accuracy& accuracy_of(std::string_view sensor) const {
    const auto own = sensors.find(sensor);
    return own == sensors.end() ? accuracy : own->second;
  }
};

/// What the keys have as defaults, and the filters that run by default: the library's, or those of a preset.
struct FilterDefaults {
  FilterSettings filter;
  std::vector<std::string> names = {"imm", "himm"};

  static FilterDefaults of(Preset preset);
};

/// Whether the settings ask for every filter that has a name of its own, `filters = "all"`.
bool asks_for_all(const Settings& settings);

/// The filters that the settings name, in order; "all" stands for those that have names of their own. Throws
/// InputError, with the key, for what cannot be.
std::vector<FilterSettings> read_filters(const Settings& settings, const FilterDefaults& defaults);

/// The models of all filters, each once, in order.
std::vector<std::string> model_names(const std::vector<FilterSettings>& filters);

/// The settings of all filters in TOML: what is in force. It reads back as the same.
std::string as_toml(const std::vector<FilterSettings>& filters);

}  // namespace sigmax::apps
