#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <sigmax/estimation/model.hpp>
#include <sigmax/estimation/refs.hpp>

namespace sigmax::detail {

/// A motion of the library along as many axes as a number says: plain data, and the same numbers as the class that has
/// the axes in its type.
struct NamedMotion {
  enum class Type { discrete_white_noise, white_noise, ornstein_uhlenbeck, known_turn, coordinated_turn };

  static constexpr int state_size = Eigen::Dynamic;
  static constexpr int max_state_size = 9;

  Type type;
  int order;             ///< derivatives, position included
  int axes;              ///< along which it goes
  double first, second;  ///< parameters, in the order of the class's constructor

  Eigen::Index size() const { return order * axes + (type == Type::coordinated_turn ? 1 : 0); }
  std::string_view name() const;
  std::vector<std::string> components() const;
  ModelRef ref() const;

  /// Throws std::invalid_argument, naming it, if a parameter is not finite or negative where it must not be.
  void require() const;
};

}  // namespace sigmax::detail
