#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sigmax/estimation/any_model.hpp>
#include <sigmax/estimation/any_motion.hpp>
#include <sigmax/estimation/coordinated_turn.hpp>
#include <sigmax/estimation/cubature.hpp>
#include <sigmax/estimation/extended.hpp>
#include <sigmax/estimation/kinematic_model.hpp>
#include <sigmax/estimation/known_turn.hpp>
#include <sigmax/estimation/observed.hpp>
#include <sigmax/estimation/ornstein_uhlenbeck.hpp>
#include <sigmax/estimation/unscented.hpp>
#include <sigmax/estimation/white_noise.hpp>

#include "himm_demo/row_sensor.hpp"
#include "support/angle.hpp"

namespace sigmax::apps {

/// The models that settings can name.
enum class MotionType { dwna, dwpa, cwna, cwpa, singer, ou_position, ou_velocity, known_turn, ct };

/// The filter of a model that is not linear; a linear one has the Kalman filter, which all are then.
enum class MemberType { kf, ekf, ukf, ckf };

/// One model of a filter with its parameters; those that its type does not have are of no account.
struct Motion {
  MotionType type = MotionType::dwna;
  double sigma_w = 3.0;  ///< the strength of the noise; its unit depends on the type
  double tau_s = 10.0;
  double turn_deg_s = 3.0;        ///< counter-clockwise from above
  double turn_drift_deg_s = 0.2;  ///< standard deviation of what the rate changes in one second

  bool linear() const { return type != MotionType::ct; }
  /// Whether it stands for a manoeuvre beside a model that does not.
  bool manoeuvres() const;
  bool has_tau() const;
  /// Number of derivatives, position included.
  int order() const;
};

/// The names of all types.
std::vector<std::string_view> motion_names();
std::string_view name_of(MotionType type);
std::optional<MotionType> motion_type(std::string_view name);

/// The numbers in TOML.
std::string toml_list(const std::vector<double>& numbers);

/// Distinct names of the models: a second dwna is dwna_2.
std::vector<std::string> names_of(const std::vector<Motion>& motions);

/// The fast bank, if every model is dwna or dwpa.
template <int Axes>
using KinematicBank = std::vector<KinematicModel<Axes, Eigen::Dynamic>>;

/// The bank of all models, seen by any sensor.
template <int Axes>
using AnyMotionOf = AnyMotion<3 * Axes + 1, KinematicModel<Axes, 2>, KinematicModel<Axes, 3>,
                              IndependentAxes<Axes, WhiteNoise<2>>, IndependentAxes<Axes, WhiteNoise<3>>,
                              IndependentAxes<Axes, OrnsteinUhlenbeck<1>>, IndependentAxes<Axes, OrnsteinUhlenbeck<2>>,
                              IndependentAxes<Axes, OrnsteinUhlenbeck<3>>, KnownTurn<Axes>, CoordinatedTurn<Axes>>;
template <int Axes>
using SeenMotion = Observed<AnyMotionOf<Axes>, RowSensor<Axes>>;
template <int Axes>
using AnyBank = std::vector<
    AnyModel<3 * Axes + 1, Extended<SeenMotion<Axes>>, Unscented<SeenMotion<Axes>>, Cubature<SeenMotion<Axes>>>>;

/// Whether the fast bank has all models.
bool kinematic(const std::vector<Motion>& motions);

template <int Axes>
KinematicBank<Axes> kinematic_bank(const std::vector<Motion>& motions) {
  KinematicBank<Axes> bank;
  for (const auto& motion : motions) bank.emplace_back(motion.sigma_w, Vector<Axes>::Zero(), motion.order());
  return bank;
}

template <int Axes>
AnyMotionOf<Axes> any_motion(const Motion& motion) {
  const double sigma = motion.sigma_w;
  switch (motion.type) {
    case MotionType::dwna:
      return dwna<Axes>(sigma);
    case MotionType::dwpa:
      return dwpa<Axes>(sigma);
    case MotionType::cwna:
      return cwna<Axes>(sigma * sigma);
    case MotionType::cwpa:
      return cwpa<Axes>(sigma * sigma);
    case MotionType::singer:
      return singer<Axes>(1.0 / motion.tau_s, sigma);
    case MotionType::ou_position:
      return ou_position<Axes>(1.0 / motion.tau_s, sigma);
    case MotionType::ou_velocity:
      return ou_velocity<Axes>(1.0 / motion.tau_s, sigma);
    case MotionType::known_turn:
      return KnownTurn<Axes>(motion.turn_deg_s * degree, sigma * sigma);
    case MotionType::ct:
      break;
  }
  const double drift = motion.turn_drift_deg_s * degree;
  return CoordinatedTurn<Axes>(sigma * sigma, drift * drift);
}

/// `linear` is the member of linear motions, `other` that of the others; all look through `radar`.
template <int Axes>
AnyBank<Axes> any_bank(const std::vector<Motion>& motions, MemberType linear, MemberType other,
                       const typename RowSensor<Axes>::Radar& radar) {
  AnyBank<Axes> bank;
  for (const auto& motion : motions) {
    const SeenMotion<Axes> seen(any_motion<Axes>(motion), RowSensor<Axes>(radar));
    const MemberType member = motion.linear() ? linear : other;
    if (member == MemberType::ukf)
      bank.push_back(Unscented{seen});
    else if (member == MemberType::ckf)
      bank.push_back(Cubature{seen});
    else
      bank.push_back(Extended{seen});  // the Kalman filter, where motion and sensor are linear
  }
  return bank;
}

}  // namespace sigmax::apps
