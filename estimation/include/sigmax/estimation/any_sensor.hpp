#pragma once

#include <algorithm>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <sigmax/estimation/any_model.hpp>

namespace sigmax {

/// Quantities that are measured at one time, at most: position and velocity in space.
inline constexpr int max_measurement_size = 6;

/// A sensor of any type, chosen at run time, also a user's own: what a program has whose next row may be anybody's.
///
///     const AnySensor camera = BearingSensor{Vector<2>(0.0, 500.0)};
///
/// It sees leading components of the state, or can be asked with an AnyModel. The library's own, and others that are
/// small and plain, are held without allocation.
class AnySensor {
 public:
  static constexpr int measurement_size = Eigen::Dynamic;
  static constexpr int max_measurement_size = sigmax::max_measurement_size;

  template <Sensing Sensor>
    requires(!std::is_same_v<Sensor, AnySensor> && SensorOf<Sensor, AnyModel> &&
             detail::max_measurement_size_of<Sensor> <= max_measurement_size)
  AnySensor(Sensor sensor) : table_(&detail::sensor_table<Sensor, AnyModel, true>), position_(position_of<Sensor>) {
    if constexpr (std::is_trivially_copyable_v<Sensor> && sizeof(Sensor) <= sizeof(inline_))
      ::new (static_cast<void*>(inline_)) Sensor(std::move(sensor));
    else
      shared_ = std::make_shared<const Sensor>(std::move(sensor));
  }

  /// Writes the position that a single measurement determines, with its covariance. Returns the number of axes, at most
  /// three, or 0 if the measurement does not determine a position. Throws std::invalid_argument for a measurement of
  /// another number of quantities.
  int position(detail::ConstView z, double* mean, double* covariance) const {
    return position_(sensor(), z, mean, covariance);
  }

  /// The sensor that it is, if it is of this type, or null.
  template <class Sensor>
  const Sensor* as() const {
    return table_ == &detail::sensor_table<Sensor, AnyModel, true> ? static_cast<const Sensor*>(sensor()) : nullptr;
  }

  /// For a model, which it may ask. Throws std::invalid_argument if it would ask another than an AnyModel.
  template <class Model>
  detail::SensorRef ref_for(const Model& model) const {
    if constexpr (!std::is_same_v<Model, AnyModel>)
      if (table_->seen(sensor()) == 0)
        throw std::invalid_argument("a sensor that asks its model, held as any, can only ask an AnyModel");
    return {sensor(), table_, &model};
  }

  /// The sensor that it is, and its functions, which take the AnyModel if they ask one.
  const void* sensor() const { return shared_ ? shared_.get() : inline_; }
  const detail::SensorTable* const& table() const { return table_; }

 private:
  template <class Sensor>
  static int position_of(const void* pointer, detail::ConstView z, double* mean, double* covariance) {
    if constexpr (requires(const Sensor& own, const MeasurementOf<Sensor>& measured) { own.position(measured); }) {
      if constexpr (Sensor::measurement_size != Eigen::Dynamic) detail::require_measured(Sensor::measurement_size, z.n);
      MeasurementOf<Sensor> measured;
      const detail::View numbers = detail::sized_view(measured, z.n);
      std::copy_n(z.mean, z.n, numbers.mean);
      std::copy_n(z.covariance, z.n * z.n, numbers.covariance);
      const std::optional result = static_cast<const Sensor*>(pointer)->position(measured);
      if (!result) return 0;
      const detail::ConstView position = detail::view(*result);
      std::copy_n(position.mean, position.n, mean);
      std::copy_n(position.covariance, position.n * position.n, covariance);
      return position.n;
    } else {
      return 0;
    }
  }

  const detail::SensorTable* table_;
  int (*position_)(const void*, detail::ConstView, double*, double*);
  alignas(double) unsigned char inline_[48] = {};
  std::shared_ptr<const void> shared_;
};

namespace detail {
/// That of the position along one, two or three axes, which leads the state of every model.
const AnySensor& position_sensor(int axes);
}  // namespace detail

}  // namespace sigmax
