#pragma once

#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include <sigmax/core/likelihood.hpp>

namespace sigmax {

/// The index that stands for a feature of which a report, or a row of data, says nothing.
inline constexpr std::size_t missing = static_cast<std::size_t>(-1);

/// What a report says of one feature: the index of the value that was read or `missing`, or, where the sensor only
/// grades, how well each value of the feature explains what it saw.
template <Uncertainty Feature>
using Finding = std::variant<std::size_t, Likelihood<Feature>>;

/// One report: a finding for every feature of a classifier, in its order.
template <Uncertainty Feature>
using Report = std::vector<Finding<Feature>>;

/// A report of which every finding is crisp, as findings.
template <Uncertainty Feature>
Report<Feature> as_report(std::span<const std::size_t> readings) {
  return {readings.begin(), readings.end()};
}

}  // namespace sigmax
