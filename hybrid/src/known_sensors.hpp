#pragma once

#include <span>
#include <stdexcept>

#include <sigmax/estimation/any_sensor.hpp>
#include <sigmax/estimation/doppler_sensor.hpp>
#include <sigmax/hybrid/any_target.hpp>

/// The sensors that a plot can name: the type and a case here are all that a new one needs beside its name in AnyPlot.
namespace sigmax::detail {

using KnownSensor = AnySensor<PositionSensor<1>, PositionSensor<2>, PositionSensor<3>, PolarSensor<2>, PolarSensor<3>,
                              BearingSensor, ComponentSensor<6>, DopplerSensor<2>, DopplerSensor<3>>;

inline ComponentSensor<6> known_components(const AnyPlot& plot, int axes) {
  return ComponentSensor<6>(std::span(plot.places).first(static_cast<std::size_t>(plot.size)), axes);
}

/// The sensor of a plot along one axis. Throws std::invalid_argument for one that needs a plane.
inline KnownSensor known_sensor_of_a_line(const AnyPlot& plot) {
  if (plot.sensor == AnyPlot::Sensor::components) return known_components(plot, 1);
  if (plot.sensor != AnyPlot::Sensor::position)
    throw std::invalid_argument("along one axis a plot is a position or components; a radar needs a plane");
  return PositionSensor<1>{};
}

/// The sensor of a plot that has one.
template <int Axes>
KnownSensor known_sensor(const AnyPlot& plot) {
  const Vector<Axes> origin(plot.origin.data());
  switch (plot.sensor) {
    case AnyPlot::Sensor::polar:
      return PolarSensor<Axes>(origin);
    case AnyPlot::Sensor::bearing:
      return BearingSensor(Vector<2>(plot.origin.data()));
    case AnyPlot::Sensor::components:
      return known_components(plot, Axes);
    case AnyPlot::Sensor::doppler:
      return DopplerSensor<Axes>(origin);
    case AnyPlot::Sensor::none:
    case AnyPlot::Sensor::position:
      break;
  }
  return PositionSensor<Axes>{};
}

}  // namespace sigmax::detail
