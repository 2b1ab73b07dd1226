#include "himm_demo/simulate/performance.hpp"

#include <algorithm>
#include <cmath>

#include "support/numbers.hpp"

namespace sigmax::apps {

Performance::Performance(const Experiment& experiment, const FilterSettings* filter)
    : experiment_(experiment),
      filter_(filter),
      manoeuvre_(filter ? manoeuvre_model(*filter) : std::nullopt),
      figures_(first_weight + (filter ? filter->models.size() : 0)),
      sums_(figures_ * static_cast<std::size_t>(experiment.scenario.samples), 0.0),
      spread_(3 * static_cast<std::size_t>(experiment.scenario.samples)) {}

void Performance::append(const Trace& trace, Study::Row& row) const {
  row.resize(row.size() + squares, 0.0);
  add_squares(experiment_.scenario, trace.error, &row[row.size() - squares]);
  std::optional<double> crossing;
  if (manoeuvre_)
    crossing = cross_time(experiment_, [&](std::size_t k) { return weight_difference(trace.weights[k], *manoeuvre_); });
  row.push_back(crossing.value_or(nan));
  for (std::size_t k = 0; k < trace.error.size(); ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) row.push_back(trace.squared_error(k, axis));
    const bool taken = !std::isnan(trace.nis[k]);  // else the gate turned the measurement away
    const auto& weights = trace.weights[k];
    row.insert(row.end(), {trace.nees_position[k], trace.nees_velocity[k], taken ? trace.nis[k] : 0.0,
                           taken ? 1.0 : 0.0, weights.empty() ? 0.0 : 1.0});
    row.insert(row.end(), weights.begin(), weights.end());
    row.resize(row.size() + figures_ - first_weight - weights.size(), 0.0);
  }
}

void Performance::add(std::span<const double>& row) {
  for (std::size_t i = 0; i < squares; ++i) run_squares_[i].push_back(row[i]);
  if (!std::isnan(row[squares])) crossings_.push_back(row[squares]);
  row = row.subspan(squares + 1);
  for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += row[i];
  for (std::size_t i = 0; i < spread_.size(); ++i) spread_[i].add(row[i / 3 * figures_ + i % 3]);
  row = row.subspan(sums_.size());
}

double Performance::rmse(std::size_t sample, std::size_t axis) const { return std::sqrt(sum(sample, axis) / runs()); }

double Performance::rmse_half_width(std::size_t sample, std::size_t axis) const {
  return spread_[3 * sample + axis].interval().half_width / (2.0 * rmse(sample, axis));  // delta method
}

double Performance::at(std::size_t sample, Figure figure) const {
  const double count = figure == nis ? sum(sample, nis_count) : runs();
  return count > 0.0 ? sum(sample, figure) / count : nan;
}

double Performance::mean(Figure figure, std::optional<std::size_t> phase) const {
  double sums = 0.0, samples = 0.0;
  for (const Phase& each : experiment_.scenario.phases) {
    const double mean = figure == nis ? phase_mean(each, [&](std::size_t k) { return sum(k, nis); }) /
                                            phase_mean(each, [&](std::size_t k) { return sum(k, nis_count); })
                                      : phase_mean(each, [&](std::size_t k) { return sum(k, figure) / runs(); });
    if (phase && &each == &experiment_.scenario.phases[*phase]) return mean;
    const double length = each.last - each.first + 1;
    sums += length * mean;
    samples += length;
  }
  return sums / samples;
}

std::vector<double> Performance::weights(std::size_t sample) const {
  std::vector<double> weights;
  for (std::size_t i = first_weight; i < figures_ && sum(sample, weight_count) > 0.0; ++i)
    weights.push_back(sum(sample, i) / runs());
  return weights;
}

std::vector<double> Performance::told_weights(std::size_t sample) const {
  const auto source = experiment_.mode_sample(sample);
  return source ? weights(*source) : std::vector<double>();
}

double Performance::phase_rmse(std::size_t phase, std::size_t axis) const {
  return std::sqrt(
      phase_mean(experiment_.scenario.phases[phase], [&](std::size_t k) { return sum(k, axis) / runs(); }));
}

double Performance::phase_rmse(std::size_t phase) const {
  const double x = phase_rmse(phase, 0), y = phase_rmse(phase, 1), z = phase_rmse(phase, 2);
  return std::sqrt(x * x + y * y + z * z);
}

double Performance::peak_rmse(std::size_t axis) const {
  double peak = 0.0;
  for (const Phase& phase : experiment_.scenario.phases)
    for (int k = phase.first; k <= phase.last; ++k) peak = std::max(peak, rmse(static_cast<std::size_t>(k - 1), axis));
  return peak;
}

std::optional<Interval> Performance::cross_time_of_runs() const {
  return crossings_.empty() ? std::nullopt : std::optional(mean_interval(crossings_));
}

std::optional<std::size_t> Performance::runs_crossed() const {
  return manoeuvre_ ? std::optional(crossings_.size()) : std::nullopt;
}

std::optional<double> Performance::cross_time_of_curves() const {
  if (!manoeuvre_) return std::nullopt;
  return cross_time(experiment_, [&](std::size_t k) { return weight_difference(weights(k), *manoeuvre_); });
}

Interval Performance::minus(const Performance& other, std::size_t phase, std::size_t axis) const {
  // RMSE = √mean(m) over the runs' mean squares m; its first-order change with one run's m is m / (2 RMSE n).
  const double own = phase_rmse(phase, axis), others = other.phase_rmse(phase, axis);
  const auto& own_squares = run_squares_[3 * phase + axis];
  const auto& others_squares = other.run_squares_[3 * phase + axis];
  std::vector<double> influence(own_squares.size());
  for (std::size_t s = 0; s < influence.size(); ++s)
    influence[s] = own_squares[s] / (2.0 * own) - others_squares[s] / (2.0 * others);
  return {own - others, mean_interval(influence).half_width};
}

std::vector<Performance> performances(const Experiment& experiment) {
  std::vector<Performance> all = {Performance(experiment, nullptr)};
  for (const auto& filter : experiment.filters) all.emplace_back(experiment, &filter);
  return all;
}

Study::Row row_of(const std::vector<Performance>& performances, const TracedRun& run) {
  Study::Row row;
  performances[0].append(run.measurement, row);
  for (std::size_t f = 0; f < run.filters.size(); ++f) performances[f + 1].append(run.filters[f], row);
  return row;
}

void add(std::span<const double> row, std::vector<Performance>& performances) {
  for (Performance& of : performances) of.add(row);
}

}  // namespace sigmax::apps
