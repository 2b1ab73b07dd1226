#include "himm_demo/trace.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <sigmax/estimation/metrics.hpp>

#include "support/missing.hpp"

namespace sigmax::apps {
namespace {

std::array<double, 3> by_axis(const Vector<3>& error) { return {error.x(), error.y(), error.z()}; }

void record(TrackPoint<3> point, const Vector<6>& truth, std::size_t sample, Trace& trace) {
  const auto& estimate = point.estimate;
  trace.error[sample] = by_axis(estimate.mean.head<3>() - truth.head<3>());
  trace.covariance[sample] = estimate.covariance.topLeftCorner<3, 3>();
  trace.nees_position[sample] = normalized_error_squared<3, 3>(estimate.mean.head<3>() - truth.head<3>(),
                                                               estimate.covariance.topLeftCorner<3, 3>());
  if (estimate.size() >= 6)
    trace.nees_velocity[sample] =
        normalized_error_squared<6, 6>(estimate.mean.head<6>() - truth, estimate.covariance.topLeftCorner<6, 6>());
  trace.nis[sample] = point.nis.value_or(nan);
  trace.weights[sample] = std::move(point.weights);
}

}  // namespace

Trace::Trace(std::size_t samples)
    : error(samples, {nan, nan, nan}),
      covariance(samples, SquareMatrix<3>::Constant(nan)),
      nees_position(samples, nan),
      nees_velocity(samples, nan),
      nis(samples, nan),
      weights(samples) {}

Reading<3> reading(const Polar& seen, const FilterSettings& filter) {
  return radar_reading<3>(seen, filter.accuracy.radar, Vector<3>::Zero(), filter.radar_measurement);
}

void follow(const FilterSettings& filter, double step_s, const Recording& recording,
            const std::function<void(TrackPoint<3>, std::size_t)>& visit) {
  Tracker<3> tracker(filter);
  const std::size_t samples = recording.measured.size();
  for (std::size_t k = 0; k < samples; ++k) {
    try {
      bool stepped_now = false;
      tracker.take(step_s * static_cast<double>(k), reading(recording.measured[k], filter), k, [&](std::size_t tag) {
        stepped_now = true;
        if (!filter.smooth) visit(tracker.now(), tag);
      });
      if (tracker.running() && !stepped_now && !filter.smooth) visit(tracker.now(), k);  // the start
      if (k + 1 == samples)
        for (const auto& point : tracker.finish())
          if (!point.is_start || filter.start != StartRule::given) visit(point, point.tag);
    } catch (const std::exception& error) {
      throw std::runtime_error(fmt::format("filter '{}', sample {}: {}", filter.name, k + 1, error.what()));
    }
  }
}

TracedRun trace_run(const Scenario& scenario, const Polar& data, std::span<const FilterSettings> filters,
                    std::uint64_t seed, std::uint64_t number) {
  RandomStream random(seed, number);
  const Recording recording = simulate(scenario, data, random);
  const std::size_t samples = recording.truth.size();
  TracedRun run{recording.truth, Trace(samples), std::vector<Trace>(filters.size(), Trace(samples))};
  for (std::size_t k = 0; k < samples; ++k)
    run.measurement.error[k] = by_axis(to_cartesian(recording.measured[k]) - recording.truth[k].head<3>());
  try {
    for (std::size_t f = 0; f < filters.size(); ++f)
      follow(filters[f], scenario.step_s, recording, [&](TrackPoint<3> point, std::size_t k) {
        record(std::move(point), recording.truth[k], k, run.filters[f]);
      });
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("run {}, {}", number + 1, error.what()));
  }
  return run;
}

std::optional<std::size_t> manoeuvre_model(const FilterSettings& filter) {
  if (filter.smooth) return std::nullopt;
  const auto& motions = filter.motions;
  std::optional<std::size_t> model;
  for (std::size_t j = 0; j < motions.size(); ++j)
    if (motions[j].manoeuvres()) model = j;
  const bool all =
      std::all_of(motions.begin(), motions.end(), [](const Motion& motion) { return motion.manoeuvres(); });
  return all ? std::nullopt : model;
}

double weight_difference(const std::vector<double>& weights, std::size_t model) {
  if (weights.empty()) return 0.0;
  double other = 0.0;
  for (std::size_t j = 0; j < weights.size(); ++j)
    if (j != model) other = std::max(other, weights[j]);
  return weights[model] - other;
}

}  // namespace sigmax::apps
