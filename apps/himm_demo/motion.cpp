#include "himm_demo/motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "support/output.hpp"

namespace sigmax::apps {
namespace {

const std::initializer_list<std::pair<std::string_view, MotionType>> types = {{"dwna", MotionType::dwna},
                                                                              {"dwpa", MotionType::dwpa},
                                                                              {"cwna", MotionType::cwna},
                                                                              {"cwpa", MotionType::cwpa},
                                                                              {"singer", MotionType::singer},
                                                                              {"ou_position", MotionType::ou_position},
                                                                              {"ou_velocity", MotionType::ou_velocity},
                                                                              {"known_turn", MotionType::known_turn},
                                                                              {"ct", MotionType::ct}};

}  // namespace

bool Motion::manoeuvres() const {
  return type == MotionType::dwpa || type == MotionType::cwpa || type == MotionType::singer ||
         type == MotionType::known_turn || type == MotionType::ct;
}

bool Motion::has_tau() const {
  return type == MotionType::singer || type == MotionType::ou_position || type == MotionType::ou_velocity;
}

int Motion::order() const {
  if (type == MotionType::ou_position) return 1;
  return type == MotionType::dwpa || type == MotionType::cwpa || type == MotionType::singer ? 3 : 2;
}

std::vector<std::string_view> motion_names() {
  std::vector<std::string_view> names;
  for (const auto& [name, type] : types) names.push_back(name);
  return names;
}

std::string_view name_of(MotionType type) {
  return std::find_if(types.begin(), types.end(), [&](const auto& entry) { return entry.second == type; })->first;
}

std::optional<MotionType> motion_type(std::string_view name) {
  const auto found = std::find_if(types.begin(), types.end(), [&](const auto& entry) { return entry.first == name; });
  return found == types.end() ? std::nullopt : std::optional(found->second);
}

std::string toml_list(const std::vector<double>& numbers) {
  std::vector<std::string> texts;
  for (const double number : numbers) {
    std::string text = shortest(number);
    if (text.find_first_of(".eni") == std::string::npos) text += ".0";  // TOML tells integers from floats
    texts.push_back(std::move(text));
  }
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

std::vector<std::string> names_of(const std::vector<Motion>& motions) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const auto earlier = motions.begin() + static_cast<std::ptrdiff_t>(i);
    const auto before =
        std::count_if(motions.begin(), earlier, [&](const Motion& motion) { return motion.type == motions[i].type; });
    const std::string_view name = name_of(motions[i].type);
    names.push_back(before == 0 ? std::string(name) : fmt::format("{}_{}", name, before + 1));
  }
  return names;
}

bool kinematic(const std::vector<Motion>& motions) {
  return std::all_of(motions.begin(), motions.end(), [](const Motion& motion) {
    return motion.type == MotionType::dwna || motion.type == MotionType::dwpa;
  });
}

}  // namespace sigmax::apps
