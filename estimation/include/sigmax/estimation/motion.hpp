#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sigmax::detail {

/// The names of the components of a motion, ordered by derivative: x, y, z, vx, vy, vz, ax, ay, az, cut to the axes and
/// to the number of derivatives, position included. Models that use them can be mixed.
inline std::vector<std::string> motion_components(int axes, int orders) {
  std::vector<std::string> names;
  for (const char* derivative : {"", "v", "a"})
    for (const char* axis : {"x", "y", "z"})
      if (static_cast<int>(names.size()) < axes * orders && axis[0] - 'x' < axes)
        names.push_back(std::string(derivative) + axis);
  return names;
}

/// Returns the parameter of a model. Throws std::invalid_argument, naming both, unless `least` ≤ value ≤ 1e150, so that
/// its square is finite.
inline double motion_parameter(double value, std::string_view parameter, std::string_view model, double least = 0.0) {
  if (value >= least && value <= 1e150) return value;
  throw std::invalid_argument(std::string(parameter) + " of model '" + std::string(model) + "' is " +
                              std::to_string(value) + "; expected a finite number of at least " +
                              std::to_string(least));
}

}  // namespace sigmax::detail
