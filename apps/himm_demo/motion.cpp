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

std::string_view name_of(MotionType type) {
  return std::find_if(types.begin(), types.end(), [&](const auto& entry) { return entry.second == type; })->first;
}

/// A number for each model: one, or one each.
template <class Valid>
std::vector<double> for_each_model(const Settings& settings, const char* key, std::size_t models, double otherwise,
                                   const char* expected, const Valid& valid) {
  auto values = settings.numbers(key, {otherwise});
  if (values.size() == 1) values.resize(models, values.front());
  if (values.size() != models) throw settings.error(key, "one number, or one for each model");
  for (const double value : values)
    if (!(std::isfinite(value) && valid(value))) throw settings.error(key, expected);
  return values;
}

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

std::vector<Motion> read_motions(const Settings& settings, double sigma_w) {
  std::vector<Motion> motions;
  std::vector<std::string_view> known;
  for (const auto& [name, type] : types) known.push_back(name);
  const std::string all = fmt::format("{}", fmt::join(known, ", "));
  for (const auto& name : settings.strings("models", {"dwna", "dwpa"})) {
    const auto found = std::find_if(types.begin(), types.end(), [&](const auto& entry) { return entry.first == name; });
    if (found == types.end()) throw settings.error("models", "names out of " + all);
    motions.emplace_back().type = found->second;
  }
  const Motion usual;
  const std::size_t count = motions.size();
  if (count == 0) throw settings.error("models", "at least one of " + all);

  const auto sigmas = for_each_model(settings, "sigma_w", count, sigma_w, "numbers that are not negative",
                                     [](double value) { return value >= 0.0; });
  const auto taus = for_each_model(settings, "tau_s", count, usual.tau_s, "positive times, in s",
                                   [](double value) { return value > 0.0; });
  const auto rates = for_each_model(settings, "turn_deg_s", count, usual.turn_deg_s,
                                    "rates in °/s, counter-clockwise from above", [](double) { return true; });
  const auto drifts =
      for_each_model(settings, "turn_drift_deg_s", count, usual.turn_drift_deg_s,
                     "numbers that are not negative, in °/s", [](double value) { return value >= 0.0; });
  for (std::size_t i = 0; i < count; ++i) {
    motions[i].sigma_w = sigmas[i];
    motions[i].tau_s = taus[i];
    motions[i].turn_deg_s = rates[i];
    motions[i].turn_drift_deg_s = drifts[i];
  }
  return motions;
}

std::string as_toml(const std::vector<Motion>& motions) {
  std::vector<std::string> names;
  for (const auto& motion : motions) names.push_back(fmt::format("\"{}\"", name_of(motion.type)));
  std::string text = fmt::format("models = [{}]\n", fmt::join(names, ", "));
  const auto line = [&](const char* key, auto has, auto value) {
    if (std::none_of(motions.begin(), motions.end(), has)) return;
    std::vector<double> values;
    for (const auto& motion : motions) values.push_back(value(motion));
    text += fmt::format("{} = {}\n", key, toml_list(values));
  };
  line(
      "sigma_w", [](const Motion&) { return true; }, [](const Motion& motion) { return motion.sigma_w; });
  line(
      "tau_s", [](const Motion& motion) { return motion.has_tau(); },
      [](const Motion& motion) { return motion.tau_s; });
  line(
      "turn_deg_s", [](const Motion& motion) { return motion.type == MotionType::known_turn; },
      [](const Motion& motion) { return motion.turn_deg_s; });
  line(
      "turn_drift_deg_s", [](const Motion& motion) { return motion.type == MotionType::ct; },
      [](const Motion& motion) { return motion.turn_drift_deg_s; });
  return text;
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
