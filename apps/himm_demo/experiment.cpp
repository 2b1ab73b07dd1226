#include "himm_demo/experiment.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <utility>

#include "support/parallel.hpp"

namespace sigmax::apps {
namespace {

/// Adds up runs, in their order.
class RunSums {
 public:
  RunSums(const Experiment& experiment, const FilterSettings* filter) : experiment_(experiment), filter_(filter) {
    const auto samples = static_cast<std::size_t>(experiment.scenario.samples);
    squared_.assign(samples, {0.0, 0.0, 0.0});
    spread_.resize(samples);
    nees_position_.assign(samples, 0.0);
    nees_velocity_.assign(samples, 0.0);
    nis_.assign(samples, 0.0);
    nis_count_.assign(samples, 0.0);
    weights_.assign(samples, {});
  }

  void add(const Trace& trace) {
    for (std::size_t k = 0; k < squared_.size(); ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double square = trace.squared_error(k, axis);
        squared_[k][axis] += square;
        spread_[k][axis].add(square);
      }
      nees_position_[k] += trace.nees_position[k];
      nees_velocity_[k] += trace.nees_velocity[k];
      if (!std::isnan(trace.nis[k])) {  // else the gate turned the measurement away
        nis_[k] += trace.nis[k];
        nis_count_[k] += 1.0;
      }
      weights_[k].resize(trace.weights[k].size(), 0.0);
      for (std::size_t j = 0; j < trace.weights[k].size(); ++j) weights_[k][j] += trace.weights[k][j];
    }
    const auto& phases = experiment_.scenario.phases;
    for (std::size_t p = 0; p < phases.size(); ++p)
      for (std::size_t axis = 0; axis < 3; ++axis)
        run_mean_squares_[p][axis].push_back(
            phase_mean(phases[p], [&](std::size_t k) { return trace.squared_error(k, axis); }));
    if (filter_) {
      if (const auto model = manoeuvre_model(*filter_)) {
        const auto crossing = first_crossing(phases[1].first, experiment_.scenario.samples, [&](int k) {
          return weight_difference(trace.weights[static_cast<std::size_t>(k - 1)], *model);
        });
        if (crossing) crossings_.push_back(*crossing + experiment_.mode_sample_shift);
      }
    }
  }

  Performance performance() const {
    const auto runs = static_cast<double>(experiment_.runs);
    const auto& phases = experiment_.scenario.phases;
    Performance result;
    result.run_mean_squares = run_mean_squares_;
    for (std::size_t k = 0; k < squared_.size(); ++k) {
      auto& rmse = result.rmse.emplace_back();
      auto& half_width = result.rmse_half_width.emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        rmse[axis] = std::sqrt(squared_[k][axis] / runs);
        half_width[axis] = spread_[k][axis].interval().half_width / (2.0 * rmse[axis]);  // delta method
      }
      result.nees_by_sample.push_back(nees_position_[k] / runs);
      result.nis_by_sample.push_back(nis_count_[k] > 0.0 ? nis_[k] / nis_count_[k]
                                                         : std::numeric_limits<double>::quiet_NaN());
    }
    for (std::size_t p = 0; p < phases.size(); ++p) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        result.phase_rmse[p][axis] =
            std::sqrt(phase_mean(phases[p], [&](std::size_t k) { return squared_[k][axis] / runs; }));
        for (int k = phases[p].first; k <= phases[p].last; ++k)
          result.peak[axis] = std::max(result.peak[axis], result.rmse[static_cast<std::size_t>(k - 1)][axis]);
      }
      result.nees_position[p] = phase_mean(phases[p], [&](std::size_t k) { return nees_position_[k] / runs; });
      result.nees_velocity[p] = phase_mean(phases[p], [&](std::size_t k) { return nees_velocity_[k] / runs; });
      result.nis[p] = phase_mean(phases[p], [&](std::size_t k) { return nis_[k]; }) /
                      phase_mean(phases[p], [&](std::size_t k) { return nis_count_[k]; });
      const auto& rmse = result.phase_rmse[p];
      result.position_rmse[p] = std::sqrt(rmse[0] * rmse[0] + rmse[1] * rmse[1] + rmse[2] * rmse[2]);
    }
    result.weights = weights_;
    for (auto& weights : result.weights)
      for (double& weight : weights) weight /= runs;
    if (!crossings_.empty()) result.cross_time.mean_of_runs = mean_interval(crossings_);
    if (filter_) {
      if (const auto model = manoeuvre_model(*filter_)) {
        result.cross_time.runs_crossed = crossings_.size();
        auto crossing = first_crossing(phases[1].first, experiment_.scenario.samples, [&](int k) {
          return weight_difference(result.weights[static_cast<std::size_t>(k - 1)], *model);
        });
        if (crossing) result.cross_time.of_averaged_curves = *crossing + experiment_.mode_sample_shift;
      }
    }
    return result;
  }

 private:
  const Experiment& experiment_;
  const FilterSettings* filter_;
  std::vector<std::array<double, 3>> squared_;
  std::vector<std::array<RunningMean, 3>> spread_;  // of the same squares
  std::vector<double> nees_position_;
  std::vector<double> nees_velocity_;
  std::vector<double> nis_;
  std::vector<double> nis_count_;
  std::vector<std::vector<double>> weights_;
  std::array<std::array<std::vector<double>, 3>, 3> run_mean_squares_{};
  std::vector<double> crossings_;
};

}  // namespace

Outcome run(const Experiment& experiment, const std::function<void()>& advance) {
  RunSums measurement(experiment, nullptr);
  std::vector<RunSums> filters;
  for (const auto& filter : experiment.filters) filters.emplace_back(experiment, &filter);
  std::vector<TracedRun> kept;
  constexpr std::size_t block = 64;  // of runs that are kept at a time
  for_each_run(
      static_cast<std::size_t>(experiment.runs), experiment.threads,
      [&](std::size_t number) {
        TracedRun result =
            trace_run(experiment.scenario, experiment.group.data, experiment.filters, experiment.seed, number);
        advance();
        return result;
      },
      [&](std::size_t number, TracedRun result) {
        measurement.add(result.measurement);
        for (std::size_t f = 0; f < filters.size(); ++f) filters[f].add(result.filters[f]);
        if (number < static_cast<std::size_t>(experiment.kept_runs)) kept.push_back(std::move(result));
      },
      block);
  Outcome outcome{measurement.performance(), {}, std::move(kept)};
  for (const auto& filter : filters) outcome.filters.push_back(filter.performance());
  return outcome;
}

std::vector<double> nanoseconds_per_step(const Experiment& experiment) {
  constexpr int most_runs = 15;
  const auto cpu_time = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
  };
  std::vector<double> medians;
  for (const auto& filter : experiment.filters) {
    std::vector<double> times;
    for (int number = 0; number < std::min(most_runs, experiment.runs); ++number) {
      RandomStream random(experiment.seed, static_cast<std::uint64_t>(number));
      const auto plots = plots_of(filter, experiment.scenario.step_s,
                                  simulate(experiment.scenario, experiment.group.data, random).measured);
      AnyTarget target(choice_of(filter, 3));
      double start = 0.0;
      int steps = -1;  // the first only warms up
      for (const AnyPlot& plot : plots) {
        if (steps == 0) start = cpu_time();
        target.take(plot, [&](std::size_t, bool is_start) { steps += is_start ? 0 : 1; });
      }
      if (filter.smooth) target.smoothed([](const TargetPoint&) {});
      times.push_back((cpu_time() - start) / steps);
    }
    std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
    medians.push_back(times[times.size() / 2]);
  }
  return medians;
}

Interval paired_difference(const Performance& a, const Performance& b, std::size_t phase, std::size_t axis) {
  // RMSE = √mean(m) over the runs' mean squares m; its first-order change with one run's m is m / (2 RMSE n).
  const double rmse_a = a.phase_rmse[phase][axis];
  const double rmse_b = b.phase_rmse[phase][axis];
  const auto& squares_a = a.run_mean_squares[phase][axis];
  const auto& squares_b = b.run_mean_squares[phase][axis];
  std::vector<double> influence(squares_a.size());
  for (std::size_t s = 0; s < influence.size(); ++s)
    influence[s] = squares_a[s] / (2.0 * rmse_a) - squares_b[s] / (2.0 * rmse_b);
  return {rmse_a - rmse_b, mean_interval(influence).half_width};
}

}  // namespace sigmax::apps
