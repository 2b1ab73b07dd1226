#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include <sigmax/estimation/any_model.hpp>

namespace sigmax {

/// The parameters that motions have, each in the unit that its key names.
enum class MotionParameter { sigma_w, tau, turn_rate, turn_drift };

/// What is to be known of a parameter.
struct KnownParameter {
  std::string_view key;       ///< "tau_s"
  std::string_view meaning;   ///< in a sentence
  double otherwise;           ///< if nobody says
  bool (*valid)(double);      ///< of a finite value
  std::string_view expected;  ///< what is valid, in words
};

/// All parameters, in the order of MotionParameter.
std::span<const KnownParameter> motion_parameters();

/// The filter of a model that is not linear, or of a sensor that is not; the rest has the Kalman filter.
enum class MemberType { kf, ekf, ukf, ckf };

struct MotionChoice;

/// A motion that can be chosen by its name.
struct KnownMotion {
  std::string_view name;
  int derivatives = 0;  ///< that it has of the position, itself included
  int least_axes = 1;   ///< 2 of one that turns
  bool linear = true;
  bool manoeuvres = false;    ///< whether it stands for a manoeuvre beside a model that does not
  std::array<bool, 4> has{};  ///< which parameters
  AnyModel (*make)(const MotionChoice&, int axes, MemberType) = nullptr;  ///< see known_model
  bool has_parameter(MotionParameter parameter) const { return has[static_cast<std::size_t>(parameter)]; }
};

/// All motions that a program can name, in the order of the documentation.
std::span<const KnownMotion> known_motions();

/// The motion of this name, or null.
const KnownMotion* known_motion(std::string_view name);

/// A motion by its name with its parameters; those that it does not have are ignored.
struct MotionChoice {
  std::string name = "dwna";
  std::array<double, 4> parameters{3.0, 10.0, 3.0, 0.2};

  double& operator[](MotionParameter parameter) { return parameters[static_cast<std::size_t>(parameter)]; }
  double operator[](MotionParameter parameter) const { return parameters[static_cast<std::size_t>(parameter)]; }

  /// Throws std::invalid_argument, naming it, for a motion that is not known; so do the others.
  const KnownMotion& known() const;
  bool linear() const { return known().linear; }
  bool manoeuvres() const { return known().manoeuvres; }
};

/// The model of a motion that is chosen by name, along 1, 2 or 3 axes, in a member of the Kalman family. Throws
/// std::invalid_argument for a name that is not known, and for a motion that does not go along so few axes.
AnyModel known_model(const MotionChoice& choice, int axes, MemberType member = MemberType::ekf);

}  // namespace sigmax
