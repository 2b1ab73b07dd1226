#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <sigmax/hybrid/any_detection.hpp>
#include <sigmax/hybrid/interaction.hpp>
#include <sigmax/hybrid/motion_choice.hpp>
#include <sigmax/hybrid/target_rules.hpp>

namespace sigmax {

/// When a mode's predecessors are merged.
enum class Scheme {
  interacting,   ///< before the measurement, for each mode: IMM and HIMM
  common_start,  ///< before the measurement, once for all modes: GPB1
  second_order,  ///< after the measurement: GPB2 and Viterbi
  independent,   ///< never: a static (autonomous) bank
  histories      ///< never, and the mode changes: its histories are kept, the greatest of them
};

/// How a target gets its first estimates.
enum class StartRule {
  points,    ///< from three measurements, each model by as many as it needs
  released,  ///< from three as the authors' program does
  given      ///< from a given mean and variances; later starts are from points
};

/// Everything that one target's filter is made of, chosen at run time: plain data.
struct TargetChoice {
  int axes = 3;        ///< 1, 2 or 3; along 1 there is no radar, and no motion that turns
  bool fuzzy = false;  ///< whether the mode is fuzzy rather than random
  Scheme scheme = Scheme::interacting;
  std::vector<MotionChoice> motions;
  std::vector<std::string> models;  ///< their names, all different: the labels of the modes
  MemberType member = MemberType::ekf;
  std::vector<std::vector<double>> transition;  ///< per scan
  std::vector<double> sojourn_s;                ///< of each mode on average; if given, the transition follows the time
  MixedCovariance mixed_covariance = MixedCovariance::own_recentred;
  MixingWeights imm_mixing = MixingWeights::correct;
  StateAugmentation augmentation = StateAugmentation::borrowed_variance;
  EntryPrior entry = {};  ///< of StateAugmentation::prior
  Tie mixing_tie = Tie::stay;
  Tie output_tie = Tie::stay;
  LikelihoodForm likelihood = LikelihoodForm::density;
  OutputSpread output_spread = OutputSpread::included;
  std::size_t histories = 24;       ///< that Scheme::histories keeps at most
  double cut = 0.05;                ///< its output is of those with so much of the best one's weight
  double tempering = 1.0;           ///< its likelihoods count to this power
  bool most_likely_output = false;  ///< rather than the mixed output (67), (68) of a random mode
  StartRule start = StartRule::points;
  std::vector<double> start_mean;                 ///< x, y, z, vx, …, az, whatever the axes
  std::vector<double> start_covariance_diagonal;  ///< in the same order
  double start_sigma_turn_deg_s = 3.0;            ///< of a rate that is estimated; it starts from 0
  std::optional<double> start_time_s;             ///< of a given start; else one step before the first detection
  TargetRules rules{.gate_probability = 1.0, .rejections = 0};
};

/// What is known of a target at one time, in plain numbers.
struct TargetPoint {
  double time = 0.0;
  std::size_t tag = 0;  ///< of the detection
  bool is_start = false;
  std::vector<double> mean;        ///< in the order of `AnyTarget::components`
  std::vector<double> covariance;  ///< row by row
  std::vector<double> weights;     ///< of the modes
  std::size_t most_likely_mode = 0;
  std::optional<double> nis;                  ///< of the step, if it had a measurement that passed the gate
  std::vector<double> normalized_innovation;  ///< the same in its own standard deviations; none if smoothed
  /// How well the step's measurement was predicted, as MultipleModelFilter has them, whether it passed the gate or not.
  std::optional<double> log_evidence, log_score;
};

/// One stay of the mode in a history.
struct ModeStay {
  double since;  ///< in s: the time of the first step in it
  std::size_t tag;
  std::size_t mode;
  bool is_start;
};

/// A Target whose scheme, kind, models and sensors are chosen at run time. All of them are compiled once, inside the
/// library; what passes between is plain data, so that it does not matter with which flags a user compiles.
///
///     TargetChoice choice{.fuzzy = true, .motions = {{"dwna"}, {"dwpa"}}, .models = {"dwna", "dwpa"},
///                         .transition = {{1.0, 0.5}, {0.5, 1.0}}};
///     AnyTarget target{choice};
///     target.take(AnyDetection::position(0.2, std::array{5010.3, -203.7, 99.1}, std::array{100.0, 100.0, 400.0}));
class AnyTarget {
 public:
  /// Called after each step or start with the tag of its detection.
  using Stepped = std::function<void(std::size_t tag, bool is_start)>;

  /// Throws std::invalid_argument, saying what, if the choice makes no sense.
  explicit AnyTarget(const TargetChoice& choice);

  /// As Target::take. Throws also std::invalid_argument for a detection whose numbers do not fit its sensor.
  Verdict take(const AnyDetection& detection, const Stepped& stepped = {});

  /// @{
  /// As of Target.
  bool running() const;
  std::size_t starts() const;
  std::size_t rejected() const;
  double time() const;
  double accepted_time() const;
  bool transform(std::span<const double> A, std::span<const double> b);  ///< A row by row
  /// @}

  /// Takes detections one after another, and calls visit(point) after each step and start with what is known then, with
  /// the tag of its detection.
  void follow(std::span<const AnyDetection> detections, const std::function<void(const TargetPoint&)>& visit);

  /// The names of what is estimated: the position and its derivatives, x, y, vx, …, and then others.
  const std::vector<std::string>& components() const;

  /// What is known now; `tag` and `is_start` are left alone. The form with a result reuses its memory.
  TargetPoint output() const;
  void output(TargetPoint& result) const;

  /// Calls visit(point) for all that was recorded, see TargetRules::record and Target::smoothed.
  void smoothed(const std::function<void(const TargetPoint&)>& visit) const;

  /// When did the mode change? The best history by all that was recorded, see Target::explained; of a scheme that keeps
  /// no histories nothing.
  std::vector<ModeStay> explained() const;

 private:
  struct Chosen;
  std::function<Chosen&()> chosen_;  ///< what it returns is inside it, and copied with it
};

}  // namespace sigmax
