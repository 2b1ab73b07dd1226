#include "himm_demo/experiment/experiment.hpp"

#include <sigmax/estimation/metrics.hpp>

namespace sigmax::apps {
namespace {

std::array<double, 3> by_axis(const Vector<3>& error) { return {error.x(), error.y(), error.z()}; }

void record(const TargetPoint& point, const Vector<6>& truth, Trace& trace) {
  const auto n = static_cast<Eigen::Index>(point.mean.size());
  const Eigen::Map<const Eigen::VectorXd> mean(point.mean.data(), n);
  const Eigen::Map<const Eigen::MatrixXd> covariance(point.covariance.data(), n, n);
  trace.error[point.tag] = by_axis(mean.head<3>() - truth.head<3>());
  trace.covariance[point.tag] = covariance.topLeftCorner<3, 3>();
  trace.nees_position[point.tag] =
      normalized_error_squared<3, 3>(mean.head<3>() - truth.head<3>(), trace.covariance[point.tag]);
  if (n >= 6)
    trace.nees_velocity[point.tag] =
        normalized_error_squared<6, 6>(mean.head<6>() - truth, covariance.topLeftCorner<6, 6>());
  trace.nis[point.tag] = point.nis.value_or(nan);
  trace.weights[point.tag] = point.weights;
}

}  // namespace

std::vector<AnyPlot> plots_of(const FilterSettings& filter, double step_s, std::span<const Polar> seen) {
  std::vector<AnyPlot> plots;
  for (const auto& [range, azimuth, elevation] : seen) {
    const std::array z = {range, azimuth, elevation}, unknown = {nan, nan, nan};
    AnyPlot plot = AnyPlot::polar(step_s * static_cast<double>(plots.size()), z, unknown);
    plot.tag = plots.size();
    plots.push_back(believed(filter, "", plot, 3));
  }
  return plots;
}

void follow(const FilterSettings& filter, double step_s, const Recording& recording,
            const std::function<void(const TargetPoint&)>& visit) {
  const auto plots = plots_of(filter, step_s, recording.measured);
  AnyTarget target(choice_of(filter, 3));
  for (std::size_t k = 0; k < plots.size(); ++k) try {
      target.follow({&plots[k], 1}, [&](const TargetPoint& point) {
        if (!filter.smooth) visit(point);
      });
      if (filter.smooth && k + 1 == plots.size()) target.smoothed(visit);
    } catch (const std::exception& error) {
      throw std::runtime_error(fmt::format("filter '{}', sample {}: {}", filter.name, k + 1, error.what()));
    }
}

Errors errors_of(const Recording& recording) {
  Errors errors;
  for (std::size_t k = 0; k < recording.truth.size(); ++k)
    errors.push_back(by_axis(to_cartesian(recording.measured[k]) - recording.truth[k].head<3>()));
  return errors;
}

TracedRun Experiment::traced(std::uint64_t number) const {
  RandomStream random(seed, number);
  const Recording recording = simulate(scenario, group.data, random);
  const std::size_t samples = recording.truth.size();
  TracedRun run{recording.truth, {samples}, std::vector(filters.size(), Trace{samples})};
  run.measurement.error = errors_of(recording);
  try {
    for (std::size_t f = 0; f < filters.size(); ++f)
      follow(filters[f], scenario.step_s, recording,
             [&](const TargetPoint& point) { record(point, recording.truth[point.tag], run.filters[f]); });
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
  const bool all = std::ranges::all_of(motions, [](const MotionChoice& motion) { return motion.manoeuvres(); });
  return all ? std::nullopt : model;
}

double weight_difference(const std::vector<double>& weights, std::size_t model) {
  if (weights.empty()) return 0.0;
  double other = 0.0;
  for (std::size_t j = 0; j < weights.size(); ++j)
    if (j != model) other = std::max(other, weights[j]);
  return weights[model] - other;
}

std::optional<std::size_t> Experiment::mode_sample(std::size_t sample) const {
  const int source = static_cast<int>(sample) - mode_sample_shift;
  return source >= 0 && source < scenario.samples ? std::optional(static_cast<std::size_t>(source)) : std::nullopt;
}

void add_squares(const Scenario& scenario, const Errors& error, double* sums) {
  for (std::size_t i = 0; i < squares; ++i)
    sums[i] += phase_mean(scenario.phases[i / 3], [&](std::size_t k) { return error[k][i % 3] * error[k][i % 3]; });
}

}  // namespace sigmax::apps
