#pragma once

#include <optional>

#include <sigmax/estimation/sensors.hpp>

namespace sigmax::apps {

/// The sensor of the row at hand: a radar in its own space, or else one that measures positions. All models of a
/// filter look through the same `radar`, which changes from row to row and outlives them.
template <int Axes>
class RowSensor {
 public:
  static constexpr int axes = Axes;
  static constexpr int measurement_size = Axes;
  using Radar = std::optional<PolarSensor<Axes>>;

  explicit RowSensor(const Radar& radar) : radar_(&radar) {}

  Vector<Axes> measure(const Vector<Axes>& position) const { return *radar_ ? (*radar_)->measure(position) : position; }
  SquareMatrix<Axes> measurement_jacobian(const Vector<Axes>& position) const {
    return *radar_ ? (*radar_)->measurement_jacobian(position) : SquareMatrix<Axes>::Identity();
  }
  Vector<Axes> measurement_difference(const Vector<Axes>& z, const Vector<Axes>& predicted) const {
    return *radar_ ? (*radar_)->measurement_difference(z, predicted) : Vector<Axes>(z - predicted);
  }

 private:
  const Radar* radar_;
};

}  // namespace sigmax::apps
