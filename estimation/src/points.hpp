#pragma once

#include <span>
#include <stdexcept>

#include <sigmax/estimation/gospa.hpp>

namespace sigmax::detail {

/// Throws std::invalid_argument unless the settings are those of a metric.
void check(const GospaSettings& settings);

/// Throws std::invalid_argument unless a point has so many coordinates, all of them finite.
void check_point(std::span<const double> point, std::size_t coordinates);

/// Euclidean, of two points of one size.
double distance(std::span<const double> a, std::span<const double> b);

}  // namespace sigmax::detail
