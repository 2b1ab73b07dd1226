#include "himm_demo/tune_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "support/angle.hpp"
#include "support/spelling.hpp"

namespace sigmax::apps {
namespace {

double rounded(double value) {
  return value == 0.0 ? value : std::strtod(fmt::format("{:.4g}", value).c_str(), nullptr);
}

void add_motions(const FilterSettings& settings, std::vector<FreeNumber>& numbers) {
  for (std::size_t j = 0; j < settings.motions.size(); ++j)
    for (const auto which :
         {MotionParameter::sigma_w, MotionParameter::tau, MotionParameter::turn_rate, MotionParameter::turn_drift}) {
      const MotionChoice& motion = settings.motions[j];
      const bool linear = which == MotionParameter::turn_rate;
      if (!motion.known().has_parameter(which) || !(linear || motion[which] > 0.0)) continue;
      const auto& known = motion_parameters()[static_cast<std::size_t>(which)];
      FreeNumber& number = numbers.emplace_back();
      number.parameter.name = fmt::format("{} of {}", known.key, settings.models[j]);
      number.parameter.start = motion[which];
      number.parameter.scale = linear ? Scale::linear : Scale::logarithmic;
      number.set = [=](FilterSettings& changed, double value) { changed.motions[j][which] = value; };
    }
}

/// The accuracy of a sensor: that of all where rows name none.
Accuracy& accuracy_in(FilterSettings& settings, const std::string& sensor) {
  return sensor.empty() ? settings.accuracy : settings.sensors.try_emplace(sensor, settings.accuracy).first->second;
}

void add_sensor(const FilterSettings& settings, const std::string& name, const TuneSensor& sensor, int axes,
                std::vector<FreeNumber>& numbers) {
  const Accuracy& now = settings.accuracy_of(name);
  const auto add = [&](std::string_view what, double start, const std::function<void(Accuracy&, double)>& set) {
    FreeNumber& number = numbers.emplace_back();
    number.parameter.name = fmt::format("{}{}{}", what, name.empty() ? "" : " of ", name);
    number.sensor = true;
    number.parameter.start = start;
    number.set = [=](FilterSettings& changed, double value) { set(accuracy_in(changed, name), value); };
  };
  if (sensor.position) {
    const auto& sigma = now.position_m;
    const double ratio = sigma.size() == 1 ? 1.0 : sigma[1] / sigma[0];
    const double height = sigma.back();
    const bool one = axes < 3 && sigma.size() == 1;
    add("sigma_position_m", sigma[0], [=](Accuracy& accuracy, double value) {
      if (one)
        accuracy.position_m = {value};
      else
        accuracy.position_m = {value, ratio * value, accuracy.position_m.back()};
    });
    if (axes == 3)
      add("height's sigma_position_m", height,
          [](Accuracy& accuracy, double value) { accuracy.position_m.back() = value; });
  }
  if (sensor.velocity && now.velocity_mps)
    add("sigma_velocity_mps", *now.velocity_mps,
        [](Accuracy& accuracy, double value) { accuracy.velocity_mps = value; });
  if (sensor.range_rate && now.range_rate_mps)
    add("sigma_range_rate_mps", *now.range_rate_mps,
        [](Accuracy& accuracy, double value) { accuracy.range_rate_mps = value; });
  if (sensor.radar || sensor.bearing)
    add("sigma_azimuth_deg", now.radar.azimuth / degree,
        [](Accuracy& accuracy, double value) { accuracy.radar.azimuth = value * degree; });
  if (!sensor.radar) return;
  add("sigma_range_m", now.radar.range, [](Accuracy& accuracy, double value) { accuracy.radar.range = value; });
  if (axes == 3)
    add("sigma_elevation_deg", now.radar.elevation / degree,
        [](Accuracy& accuracy, double value) { accuracy.radar.elevation = value * degree; });
}

/// Leaving for another mode becomes more likely, or more possible, by a factor.
void leave(FilterSettings& settings, double factor) {
  for (double& sojourn : settings.sojourn_s) sojourn /= factor;
  for (std::size_t i = 0; i < settings.transition.size(); ++i) {
    auto& row = settings.transition[i];
    for (std::size_t j = 0; j < row.size(); ++j)
      if (j != i) row[j] *= factor;
    const double total =
        settings.fuzzy ? *std::max_element(row.begin(), row.end()) : std::accumulate(row.begin(), row.end(), 0.0);
    for (double& value : row) value /= total;
  }
}

}  // namespace

bool has_transition(const FilterSettings& settings, const TuneOptions& options) {
  return settings.models.size() > 1 && settings.scheme != Scheme::independent && options.fits("transition");
}

std::vector<FreeNumber> free_numbers(const FilterSettings& settings, const TuneData& data, const TuneOptions& options) {
  std::vector<FreeNumber> numbers;
  if (options.fits("models")) add_motions(settings, numbers);
  if (options.fits("sensors") && options.objective != Objective::rmse)
    for (const auto& [name, sensor] : data.sensors) add_sensor(settings, name, sensor, data.axes, numbers);
  if (has_transition(settings, options))
    numbers.push_back({{.name = "leaving a mode, times", .start = 1.0, .reach = 4.0}, leave, false, true});
  return numbers;
}

FilterSettings with(FilterSettings settings, const std::vector<FreeNumber>& numbers,
                    const std::vector<double>& values) {
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i].set(settings, values[i]);
  return settings;
}

std::size_t count_of(const std::vector<FreeNumber>& numbers, const FilterSettings& settings,
                     const TuneOptions& options) {
  if (!has_transition(settings, options)) return numbers.size();
  const std::size_t modes = settings.models.size();  // the factor on leaving is one of those of the transition
  return numbers.size() - 1 + (settings.sojourn_s.empty() ? modes * (modes - 1) : modes);
}

void round_off(FilterSettings& settings) {
  for (auto& motion : settings.motions)
    for (double& value : motion.parameters) value = rounded(value);
  const auto round_accuracy = [](Accuracy& accuracy) {
    for (double& sigma : accuracy.position_m) sigma = rounded(sigma);
    if (accuracy.velocity_mps) accuracy.velocity_mps = rounded(*accuracy.velocity_mps);
    if (accuracy.range_rate_mps) accuracy.range_rate_mps = rounded(*accuracy.range_rate_mps);
    accuracy.radar = {rounded(accuracy.radar.range), rounded(accuracy.radar.azimuth / degree) * degree,
                      rounded(accuracy.radar.elevation / degree) * degree};
  };
  round_accuracy(settings.accuracy);
  for (auto& [name, accuracy] : settings.sensors) round_accuracy(accuracy);
  for (double& sojourn : settings.sojourn_s) sojourn = rounded(sojourn);
  for (std::size_t i = 0; i < settings.transition.size(); ++i) {
    auto& row = settings.transition[i];
    double others = 0.0;
    for (std::size_t j = 0; j < row.size(); ++j) {
      if (settings.fuzzy || j != i) row[j] = rounded(row[j]);
      if (j != i) others += row[j];
    }
    if (!settings.fuzzy) row[i] = std::strtod(fmt::format("{:.12f}", 1.0 - others).c_str(), nullptr);
  }
}

FilterSettings with_models(const FilterSettings& settings, const std::string& joined) {
  FilterSettings result = settings;
  result.motions.clear();
  std::vector<std::string_view> known;
  for (const auto& motion : known_motions()) known.push_back(motion.name);
  std::vector<bool> used(settings.motions.size(), false);
  for (std::size_t from = 0; from <= joined.size();) {
    const std::size_t to = std::min(joined.find('+', from), joined.size());
    const std::string name = joined.substr(from, to - from);
    from = to + 1;
    if (!known_motion(name))
      throw UsageError(message({.what = "--models",
                                .found = in_quotes(name),
                                .expected = fmt::format("one of {}, joined by + as dwna+dwpa", fmt::join(known, ", ")),
                                .remedy = nearest_word(name, known)}));
    std::size_t same = 0;
    while (same < used.size() && (used[same] || settings.motions[same].name != name)) ++same;
    if (same < used.size()) used[same] = true;
    result.motions.push_back(same < used.size() ? settings.motions[same] : settings.motions.front());
    result.motions.back().name = name;
  }
  result.models = names_of(result.motions);
  const std::size_t modes = result.models.size();
  if (modes == settings.models.size()) return result;
  const double others = static_cast<double>(std::max<std::size_t>(modes, 2) - 1);
  result.transition.assign(modes,
                           std::vector<double>(modes, result.fuzzy ? result.leaving_possibility : 0.05 / others));
  for (std::size_t i = 0; i < modes; ++i) result.transition[i][i] = result.fuzzy || modes == 1 ? 1.0 : 0.95;
  if (!result.sojourn_s.empty()) {
    const double usual = result.sojourn_s.front();
    result.sojourn_s.assign(modes > 1 ? modes : 0, usual);
  }
  return result;
}

}  // namespace sigmax::apps
