#include "himm_demo/tune_diagnosis.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

#include "support/output.hpp"

namespace sigmax::apps {

void InnovationTally::add(const std::vector<double>& innovation, const std::vector<double>* before) {
  ++rows_;
  for (const double number : innovation) squares_ += number * number;
  numbers_ += innovation.size();
  if (!before || before->size() != innovation.size()) return;
  for (std::size_t i = 0; i < innovation.size(); ++i) products_ += innovation[i] * (*before)[i];
  pairs_ += innovation.size();
}

Band InnovationTally::band() const { return chi_square_band(1.0, static_cast<double>(numbers_)); }

double InnovationTally::autocorrelation_band() const {
  return 1.96 * std::sqrt(static_cast<double>(pairs_)) / static_cast<double>(numbers_);
}

std::string Diagnosis::verdict(const InnovationTally& sensor) {
  if (sensor.rows() < 10) return "too few rows to say";
  const double nis = sensor.mean_square(), apart = sensor.autocorrelation();
  const bool high = nis > sensor.band().upper, low = nis < sensor.band().lower;
  const bool lags = apart > sensor.autocorrelation_band(), overshoots = apart < -sensor.autocorrelation_band();
  if (high && lags) return "models too stiff";
  if (high) return "optimistic sensor";
  if (low && overshoots) return "models too loose";
  if (low) return "pessimistic sensor";
  if (lags) return "gain too low";
  return overshoots ? "gain too high" : "as it should be";
}

std::vector<std::string> Diagnosis::advice() const {
  std::vector<std::string> sentences;
  const std::map<std::string_view, std::string_view> remedies = {
      {"models too stiff", "errors are greater than believed, and last: raise sigma_w, or add a model that manoeuvres"},
      {"optimistic sensor", "errors are greater than believed, and do not last: raise its sigmas"},
      {"models too loose", "errors are smaller than believed, and alternate: lower sigma_w"},
      {"pessimistic sensor", "errors are smaller than believed: lower its sigmas"},
      {"gain too low", "errors last: raise sigma_w, or lower its sigmas"},
      {"gain too high", "errors alternate: lower sigma_w, or raise its sigmas"}};
  for (const auto& sensor : sensors) {
    const auto found = remedies.find(verdict(sensor.innovations));
    if (found == remedies.end()) continue;
    std::string of = sensor.name;
    if (of != "all rows") of = "sensor " + of;
    std::string sentence = fmt::format("{}: {}", of, found->second);
    const double factor = std::sqrt(sensor.innovations.mean_square());
    if (found->first == "optimistic sensor" || found->first == "pessimistic sensor")
      sentence += fmt::format(", by a factor of {:.2g} at most", factor);
    sentences.push_back(sentence + ".");
  }
  for (const auto& mode : modes) {
    if (modes.size() == 1) break;
    std::size_t rows = 0;
    for (const auto& other : modes) rows += other.innovations.rows();
    if (100 * mode.innovations.rows() < rows)
      sentences.push_back(
          fmt::format("model {}: it is almost never the most likely: drop it, or let it differ more.", mode.name));
  }
  if (sentences.empty())
    sentences.push_back("nothing: the innovations are as large and as independent as they should be.");
  return sentences;
}

Diagnosis diagnose(const TuneData& data, const FilterSettings& settings, Objective objective) {
  Diagnosis diagnosis;
  std::map<std::string, InnovationTally, std::less<>> sensors;
  for (const auto& model : settings.models) diagnosis.modes.push_back({model, {}, 0.0});
  std::map<std::string, std::vector<double>, std::less<>> last;  // by sensor, of the track at hand
  std::size_t track = 0, rows = 0, judged = 0;
  double squares = 0.0;
  const auto look = [&](std::size_t t, std::size_t row, const TargetPoint& now) {
    if (t != track) last.clear();
    track = t;
    const Fix& fix = data.tracks[t].rows[row];
    if (fix.truth) {
      for (int axis = 0; axis < data.axes; ++axis)
        squares += std::pow(now.mean[static_cast<std::size_t>(axis)] - (*fix.truth)(axis), 2);
      ++judged;
    }
    if (!now.nis) return;
    const auto before = last.find(fix.sensor);
    sensors[fix.sensor].add(now.normalized_innovation, before == last.end() ? nullptr : &before->second);
    diagnosis.modes[now.most_likely_mode].innovations.add(now.normalized_innovation, nullptr);
    last[fix.sensor] = now.normalized_innovation;
    for (std::size_t j = 0; j < now.weights.size(); ++j) diagnosis.modes[j].weight += now.weights[j];
    ++rows;
  };
  try {
    diagnosis.losses = losses(data, settings, objective, look);
  } catch (const std::exception& error) {
    const Fix& fix = data.tracks[track].rows.front();
    throw InputError(
        message({.where = fmt::format("{}:{}", data.tracks[track].file, fix.line),
                 .what = fmt::format("filter '{}' on the track that begins here: {}", settings.name, error.what()),
                 .remedy = "begin with settings that track takes, see --config and --set"}));
  }
  const bool any = std::any_of(diagnosis.losses.begin(), diagnosis.losses.end(), [](const auto& of_track) {
    return std::any_of(of_track.begin(), of_track.end(), [](double loss) { return !std::isnan(loss); });
  });
  if (!any)
    throw InputError(
        message({.where = data.tracks.front().file,
                 .what = fmt::format("filter '{}' makes no estimate that could be judged: its start may want positions",
                                     settings.name),
                 .remedy = "give bearings a start of their own, --set start=given; see himm_demo tune --help"}));
  for (auto& mode : diagnosis.modes) mode.weight /= static_cast<double>(std::max<std::size_t>(rows, 1));
  for (auto& [name, tally] : sensors) diagnosis.sensors.push_back({name.empty() ? "all rows" : name, tally, 0.0});
  if (judged > 0) diagnosis.rmse_m = std::sqrt(squares / static_cast<double>(judged));
  return diagnosis;
}

}  // namespace sigmax::apps
