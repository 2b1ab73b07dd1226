#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "himm_demo/error_ellipse.hpp"
#include "himm_demo/simulate_page.hpp"

namespace sigmax::apps {
namespace {

/// The corners of the target's way from a little before the manoeuvre on.
std::vector<double> around_onset(const Experiment& experiment, const TracedRun& run) {
  const auto onset = static_cast<std::size_t>(experiment.scenario.phases[1].first - 1);
  const std::size_t first = onset < 3 ? 0 : onset - 3, last = std::min(onset + 15, run.truth.size() - 1);
  std::vector<double> focus;
  for (const Eigen::Index axis : {0, 1}) {
    const auto [least, greatest] = std::minmax(run.truth[first](axis), run.truth[last](axis));
    focus.insert(focus.end(), {least, greatest});
  }
  return focus;
}

}  // namespace

Plan plan_of(const Experiment& experiment, const TracedRun& run, std::size_t number) {
  Plan plan{.title = fmt::format("Track of run {}", number), .x_label = "x, m", .y_label = "y, m", .traces = {}};
  const auto add = [&](const std::string& of, PlanTrace::Shape shape, const auto& position) {
    PlanTrace trace{.name = of, .group = of, .shape = shape, .x = {}, .y = {}};
    for (std::size_t k = 0; k < run.truth.size(); ++k) {
      const Vector<3> at = position(k);
      trace.x.push_back(at.x());
      trace.y.push_back(at.y());
      trace.z.push_back(at.z());
    }
    plan.traces.push_back(std::move(trace));
  };
  const auto seen_by = [&](const Trace& trace) {
    return [&](std::size_t k) -> Vector<3> { return run.truth[k].head<3>() + Vector<3>(trace.error[k].data()); };
  };
  add(measurement_name, PlanTrace::Shape::dots, seen_by(run.measurement));
  add(truth_name, PlanTrace::Shape::line, [&](std::size_t k) -> Vector<3> { return run.truth[k].head<3>(); });
  for (std::size_t f = 0; f < experiment.filters.size(); ++f) {
    add(experiment.filters[f].name, PlanTrace::Shape::line, seen_by(run.filters[f]));
    for (std::size_t k = 4; !crowded(experiment) && k < run.truth.size(); k += 5) {
      const auto& covariance = run.filters[f].covariance[k];
      const Vector<3> at = seen_by(run.filters[f])(k);
      if (!std::isnan(covariance(0, 0)))
        plan.ellipses.push_back(
            error_ellipse(experiment.filters[f].name, at.head<2>(), covariance.topLeftCorner<2, 2>()));
    }
  }
  plan.focus = around_onset(experiment, run);
  plan.note = "It opens at the beginning of the manoeuvre.";
  if (!plan.ellipses.empty()) plan.note += " Ellipses: 95 % as each filter states it, every 5 samples.";
  return plan;
}

}  // namespace sigmax::apps
