#include <sigmax/estimation/named_motion.hpp>

#include <algorithm>
#include <array>
#include <utility>

#include <sigmax/estimation/motion_numbers.hpp>

namespace sigmax::detail {
namespace {

const NamedMotion& motion_of(const void* pointer) { return *static_cast<const NamedMotion*>(pointer); }

void law(const void* pointer, double dt, AxisLaw& law) {
  const NamedMotion& m = motion_of(pointer);
  double gain[3];
  law.order = m.order;
  if (m.type == NamedMotion::Type::discrete_white_noise)
    discrete_white_noise(m.order, m.first, dt, law.F, law.Q, gain);
  else if (m.type == NamedMotion::Type::white_noise)
    white_noise(m.order, m.first, dt, law.F, law.Q, gain);
  else
    ornstein_uhlenbeck(m.order, m.first, m.second, dt, law.F, law.Q, gain);
  std::fill_n(law.input, m.order * m.axes, 0.0);
}

void linear(const void* pointer, double dt, double* F, double* Q, double* input) {
  const NamedMotion& m = motion_of(pointer);
  known_turn(m.axes, m.first, m.second, dt, F, Q);
  std::fill_n(input, m.order * m.axes, 0.0);
}

void tangent(const void* pointer, const double* x, double dt, double* image, double* F, double* Q) {
  const NamedMotion& m = motion_of(pointer);
  coordinated_turn(m.axes, m.first, m.second, x, dt, image, F, Q);
}

MotionTable table_of(NamedMotion::Type type, int axes) {
  MotionTable table{axes, [](const void* pointer) { return static_cast<int>(motion_of(pointer).size()); },
                    [](const void* pointer) { return std::string(motion_of(pointer).name()); }};
  if (type == NamedMotion::Type::known_turn)
    table.linear = linear;
  else if (type == NamedMotion::Type::coordinated_turn)
    table.tangent = tangent;
  else
    table.law = law;
  return table;
}

}  // namespace

std::vector<std::string> NamedMotion::components() const {
  auto names = motion_components(axes, order);
  if (type == Type::coordinated_turn) names.push_back("omega");
  return names;
}

std::string_view NamedMotion::name() const {
  switch (type) {
    case Type::discrete_white_noise:
      return order == 2 ? "dwna" : "dwpa";
    case Type::white_noise:
      return order == 2 ? "cwna" : "cwpa";
    case Type::ornstein_uhlenbeck:
      return order == 1 ? "ou_position" : order == 2 ? "ou_velocity" : "singer";
    case Type::known_turn:
      return "known_turn";
    case Type::coordinated_turn:
      break;
  }
  return "coordinated_turn";
}

void NamedMotion::require() const {
  const auto names = [&]() -> std::pair<const char*, const char*> {
    switch (type) {
      case Type::discrete_white_noise:
        return {"sigma_w", nullptr};
      case Type::white_noise:
        return {"q", nullptr};
      case Type::ornstein_uhlenbeck:
        return {"the rate", "sigma"};
      case Type::known_turn:
        return {nullptr, "q"};
      case Type::coordinated_turn:
        break;
    }
    return {"q", "q_omega"};
  }();
  if (names.first) motion_parameter(first, names.first, name());
  if (names.second) motion_parameter(second, names.second, name());
  if (type == Type::known_turn) finite_rate(first);
}

ModelRef NamedMotion::ref() const {
  static const auto tables = [] {
    std::array<std::array<MotionTable, 4>, 5> all;
    for (std::size_t t = 0; t < all.size(); ++t)
      for (std::size_t a = 0; a < all[t].size(); ++a) all[t][a] = table_of(static_cast<Type>(t), static_cast<int>(a));
    return all;
  }();
  return {this, &tables[static_cast<std::size_t>(type)][static_cast<std::size_t>(axes)]};
}

}  // namespace sigmax::detail
