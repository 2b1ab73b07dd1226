#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include <sigmax/estimation/angle.hpp>

namespace sigmax {

/// A detection of a target at one time, in plain numbers. The functions make one; the tag may be set afterwards:
///
///     AnyDetection detection = AnyDetection::polar(0.2, std::array{5030.2, 0.1096}, std::array{100.0, 4e-6});
///     detection.tag = 17;
///
/// Each takes the covariance of what was measured row by row, or its diagonal alone: variances of errors that do not
/// depend on each other. They throw std::invalid_argument for numbers of measured quantities that no such sensor has,
/// and for covariances of another size.
struct AnyDetection {
  enum class Sensor {
    none,        ///< there was no measurement
    position,    ///< x, y[, z] in m
    polar,       ///< range in m, azimuth counter-clockwise from x[, elevation] in rad, seen from `origin`; in space a
                 ///< radar may have no elevation
    bearing,     ///< azimuth alone
    components,  ///< components of the state, at `places`
    doppler      ///< as polar, and the rate of the range in m/s
  };

  double time = 0.0;    ///< in s
  std::size_t tag = 0;  ///< comes back with what the detection leads to
  Sensor sensor = Sensor::none;
  int size = 0;                         ///< number of measured quantities, at most six
  std::array<double, 6> z{};            ///< as many numbers
  std::array<double, 36> covariance{};  ///< of them, row by row without gaps
  std::array<double, 3> origin{};       ///< of the sensor, in m
  std::array<int, 6> places{};          ///< in the state, where the position and its derivatives lead

  /// There was no measurement.
  static AnyDetection missed(double time);

  /// Along 1, 2 or 3 axes, in m.
  static AnyDetection position(double time, std::span<const double> z, std::span<const double> covariance);

  /// Range in m and azimuth, in three axes perhaps also the elevation, in rad.
  static AnyDetection polar(double time, std::span<const double> z, std::span<const double> covariance,
                            const std::array<double, 3>& origin = {});

  /// As `polar`, and then the rate of the range in m/s.
  static AnyDetection doppler(double time, std::span<const double> z, std::span<const double> covariance,
                              const std::array<double, 3>& origin = {});

  /// The azimuth alone, with its standard deviation.
  static AnyDetection bearing(double time, Angle azimuth, Angle sigma, const std::array<double, 3>& origin = {});

  /// Some components of the state by themselves, as the height and a velocity: those at these places, 1 to 6.
  static AnyDetection components(double time, std::span<const int> places, std::span<const double> z,
                                 std::span<const double> covariance);

  /// Of the quantity number i, from 0.
  double variance(int i) const { return covariance[static_cast<std::size_t>(i * (size + 1))]; }
};

/// The measured value of one component of the state, if the detection has it. Components of the position come first,
/// then components of the velocity.
std::optional<double> component_of(const AnyDetection& detection, int component);

/// Along how many of so many axes a detection tells the position; a radar's without an elevation, of three, along two.
int axes_seen(const AnyDetection& detection, int axes);

/// Whether components hold some of the velocity.
bool is_moving(const AnyDetection& detection, int axes);

}  // namespace sigmax
