#include <sigmax/estimation/any_sensor.hpp>

#include <stdexcept>
#include <utility>

namespace sigmax {

AnyModel::AnyModel(std::shared_ptr<const void> motion, const detail::ModelRef& ref, std::vector<std::string> components)
    : motion_(std::move(motion)),
      ref_{motion_.get(), ref.table, ref.points},
      size_(ref_.size()),
      name_(ref_.name()),
      components_(std::move(components)) {
  if (size_ > max_state_size)
    throw std::invalid_argument("model '" + name_ + "' has " + std::to_string(size_) + " states; a bank takes " +
                                std::to_string(max_state_size) + " at most");
}

const AnySensor& detail::position_sensor(int axes) {
  static const AnySensor all[]{PositionSensor<1>{}, PositionSensor<2>{}, PositionSensor<3>{}};
  return all[axes - 1];
}

}  // namespace sigmax
