#include "himm_demo/experiment/experiment.hpp"

#include <sigmax/estimation/metrics.hpp>

namespace sigmax::apps {
namespace {

void record(const TargetPoint& point, const Vector<6>& truth, Trace& trace) {
  const auto n = static_cast<Eigen::Index>(point.mean.size());
  const Eigen::Map<const Eigen::VectorXd> mean(point.mean.data(), n);
  const Eigen::Map<const Eigen::MatrixXd> covariance(point.covariance.data(), n, n);
  trace.error[point.tag] = mean.head<3>() - truth.head<3>();
  trace.covariance[point.tag] = covariance.topLeftCorner<3, 3>();
  trace.nees_position[point.tag] = normalized_error_squared<3, 3>(trace.error[point.tag], trace.covariance[point.tag]);
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
    errors.push_back(to_cartesian(recording.measured[k]) - recording.truth[k].head<3>());
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

Experiment experiment_of(Preset preset, int scenario_number, int group_number, const Settings& settings, int runs,
                         std::uint64_t seed) {
  const Group parameters = group(group_number, scenario_number);
  auto filters = read_filters(settings, FilterDefaults::of(preset, parameters));
  settings.refuse_unknown();
  const int mode_sample_shift = preset == Preset::released ? -1 : 0;
  return {scenario(scenario_number, preset), parameters, std::move(filters), runs, seed, mode_sample_shift};
}

std::optional<std::size_t> manoeuvre_model(const FilterSettings& filter) {
  if (filter.smooth || std::ranges::all_of(filter.motions, &MotionChoice::manoeuvres)) return std::nullopt;
  for (std::size_t j = filter.motions.size(); j-- > 0;)
    if (filter.motions[j].manoeuvres()) return j;
  return std::nullopt;
}

double weight_difference(const std::vector<double>& weights, std::size_t model) {
  if (weights.empty()) return 0.0;
  double other = 0.0;
  for (std::size_t j = 0; j < weights.size(); ++j)
    if (j != model) other = std::max(other, weights[j]);
  return weights[model] - other;
}

void add_squares(const Scenario& scenario, const Errors& error, double* sums) {
  for (const Phase& phase : scenario.phases)
    for (const Eigen::Index axis : {0, 1, 2})
      *sums++ += phase_mean(phase, [&](std::size_t k) { return error[k](axis) * error[k](axis); });
}

}  // namespace sigmax::apps
