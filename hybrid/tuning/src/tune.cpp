#include <sigmax/tuning/tune.hpp>

#include <numeric>

namespace sigmax {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double surface_step = 0.25;  // rows jump over a gate, which is no slope

/// The losses; for each row that is judged a very great one where the filter fails.
RowLosses losses_or_worst(const TuneProblem& problem, const std::vector<double>& values, const RowLosses& judged) {
  try {
    return problem.losses(values);
  } catch (const std::exception&) {
    constexpr double of_failure = 1e6;
    RowLosses worst = judged;
    for (auto& rows : worst)
      for (double& loss : rows) loss = std::isnan(loss) ? loss : of_failure;
    return worst;
  }
}

double objective_of(const TuneProblem& problem, const std::vector<double>& values) {
  try {
    const double found = problem.objective(problem.losses(values), {});
    return std::isnan(found) ? infinity : found;
  } catch (const std::exception&) {
    return infinity;
  }
}

std::vector<std::size_t> inside_bounds(const TuneProblem& problem, const std::vector<double>& values) {
  const FitSearch space = fit_search(problem.parameters);
  std::vector<std::size_t> inside;
  for (std::size_t i = 0; i < values.size(); ++i) {
    constexpr double at_it = 1e-6;
    const double at = problem.parameters[i].scaled(values[i]);
    if (at > space.lower[i] + at_it && at < space.upper[i] - at_it) inside.push_back(i);
  }
  return inside;
}

std::vector<double> moved(const TuneProblem& problem, std::vector<double> values,
                          const std::vector<std::size_t>& inside, const std::vector<double>& offsets,
                          double times = 1.0) {
  for (std::size_t k = 0; k < inside.size(); ++k) {
    const FitParameter& parameter = problem.parameters[inside[k]];
    double& value = values[inside[k]];
    value = parameter.value(parameter.scaled(value) + times * offsets[k]);
  }
  return values;
}

/// The least objective with a number put aside by so much, and the others searched anew.
double held(const TuneProblem& problem, std::vector<double> values, std::size_t number, double offset) {
  values = moved(problem, values, {number}, {offset});
  std::vector<FitParameter> others;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i == number) continue;
    places.push_back(i);
    others.push_back(problem.parameters[i]);
    others.back().start = values[i];
  }
  const auto loss = [&](const std::vector<double>& x) {
    std::vector<double> all = values;
    for (std::size_t k = 0; k < x.size(); ++k) all[places[k]] = x[k];
    return objective_of(problem, all);
  };
  return search(others, loss, {.samples = 0, .starts = 1, .local = 10, .rounds = 0}).loss;
}

}  // namespace

Tuned tune(const TuneProblem& problem, const RowFolds& folds, const SearchOptions& options) {
  Fit fit = search(
      problem.parameters, [&](const auto& values) { return objective_of(problem, values); }, options);
  const auto inside = inside_bounds(problem, fit.values);
  RowLosses best = problem.losses(fit.values);
  LossSurface surface(inside.size(), surface_step, [&](const std::vector<double>& offsets) {
    return losses_or_worst(problem, moved(problem, fit.values, inside, offsets), best);
  });
  std::size_t count = 0;
  for (const auto& rows : folds)
    for (const std::size_t fold : rows) count = std::max(count, fold + 1);
  std::vector<RowLosses> without;
  for (std::size_t fold = 0; fold < count; ++fold) {
    const RowCounts others = [&](std::size_t t, std::size_t k) { return folds[t][k] != fold; };
    const auto values = moved(problem, fit.values, inside, surface.shape(others).least);
    const RowLosses own = losses_or_worst(problem, values, best);
    without.push_back(problem.objective(own, others) < problem.objective(best, others) ? own : best);
  }
  return {std::move(fit), held_out(folds, without), std::move(surface), inside};
}

std::vector<double> standard_errors(const TuneProblem& problem, const Tuned& tuned, std::size_t together) {
  std::vector<double> errors(problem.parameters.size(), infinity);
  const auto shape = tuned.surface.shape({}, together);
  const std::vector<double>& values = tuned.fit.values;
  double rows = 0.0;
  for (const auto& judged : tuned.held_out)
    rows += static_cast<double>(std::ranges::count_if(judged, [](double loss) { return !std::isnan(loss); }));
  for (std::size_t k = 0; k < tuned.inside.size(); ++k) {
    double& error = errors[tuned.inside[k]];
    error = shape.error[k];
    if (!problem.likelihood) continue;
    // At twice the error all rows lose two nats, the others following by the parabola, or searched where there is none.
    const bool known = 2.0 * error < 1.0;
    const double offset = known ? 2.0 * error : 1.0;
    double lost = infinity;
    for (const double side : {offset, -offset})
      lost = std::min(lost, known ? objective_of(problem, moved(problem, values, tuned.inside, shape.ridges[k], side))
                                  : held(problem, values, tuned.inside[k], side));
    const double rise = rows * (lost - tuned.fit.loss);
    error = std::max(known ? error : 0.0, rise > 0.0 ? offset / std::sqrt(2.0 * rise) : infinity);
  }
  for (double& error : errors)
    if (!(error < 1.0)) error = infinity;
  return errors;
}

}  // namespace sigmax
