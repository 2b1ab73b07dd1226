#include <sigmax/core/scaled_number.hpp>

#include <ostream>

namespace sigmax {

std::ostream& operator<<(std::ostream& out, ScaledNumber number) {
  const double value = number.value();
  if (number.is_zero() || std::isnormal(value)) return out << value;
  const double logarithm = number.log() / std::numbers::ln10, power = std::floor(logarithm);
  return out << std::pow(10.0, logarithm - power) << 'e' << static_cast<std::int64_t>(power);
}

}  // namespace sigmax
