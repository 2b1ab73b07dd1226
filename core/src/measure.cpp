#include <sigmax/core/measure.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sigmax {

double compatibility(std::span<const double> object, std::span<const double> outcome, std::span<const double> measure) {
  if (object.size() != outcome.size() || object.size() != measure.size())
    throw std::invalid_argument("compatibility needs object, outcome and measure of as many features, but has " +
                                std::to_string(object.size()) + ", " + std::to_string(outcome.size()) + " and " +
                                std::to_string(measure.size()));
  double shared = 0.0, all = 0.0;
  for (std::size_t f = 0; f < object.size(); ++f) {
    const auto refuse = [f](const std::string& what, double value) {
      throw std::invalid_argument("compatibility: the " + what + " of feature " + std::to_string(f) + " is " +
                                  std::to_string(value));
    };
    if (!(object[f] >= 0.0 && object[f] <= 1.0)) refuse("object's degree", object[f]);
    if (!(outcome[f] >= 0.0 && outcome[f] <= 1.0)) refuse("outcome's degree", outcome[f]);
    if (!(measure[f] >= 0.0)) refuse("measure", measure[f]);
    shared += measure[f] * std::min(object[f], outcome[f]);
    all += measure[f] * object[f];
  }
  if (!(all > 0.0 && std::isfinite(all)))
    throw std::invalid_argument("compatibility needs an object whose features have a positive, finite measure, not " +
                                std::to_string(all));
  return shared / all;
}

}  // namespace sigmax
