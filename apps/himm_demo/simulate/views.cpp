#include "himm_demo/simulate/performance.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include <sigmax/estimation/chi_square.hpp>

#include "support/numbers.hpp"

namespace sigmax::apps {
namespace {

using Samples = std::vector<double>;

/// Where a position in plan lies with a probability of 95 %, if it is normal.
ErrorEllipse error_ellipse(const std::string& group, const Vector<3>& centre, const SquareMatrix<3>& covariance) {
  const double chi_square = -2.0 * std::log(0.05);  // the 95 % quantile with two degrees of freedom
  const double mean = 0.5 * (covariance(0, 0) + covariance(1, 1)), apart = 0.5 * (covariance(0, 0) - covariance(1, 1));
  const double radius = std::hypot(apart, covariance(0, 1));  // of Mohr's circle: variances are mean ± radius
  const double angle = 0.5 * std::atan2(covariance(0, 1), apart) / degree;
  return {group,
          centre.x(),
          centre.y(),
          std::sqrt(chi_square * (mean + radius)),
          std::sqrt(chi_square * std::max(0.0, mean - radius)),
          angle > 45.0 ? angle - 180.0 : angle};  // of both directions of the axis the one from −135° on
}

/// Makes the panels of all runs and of one run alike.
class Views {
 public:
  explicit Views(const Experiment& experiment) : experiment_(experiment), one_(experiment) {
    one_.runs = 1;
    const Phase& manoeuvre = experiment_.scenario.phases[1];
    shaded_ = {{static_cast<double>(manoeuvre.first), static_cast<double>(manoeuvre.last), "manoeuvre"}};
  }

  View all_runs(const std::vector<Performance>& found, const TracedRun& first) const {
    View view{experiment_.runs == 1 ? "the only run" : fmt::format("all {} runs", experiment_.runs), {}};
    for (std::size_t axis = 0; axis < 3; ++axis) view.panels.emplace_back(rmse(found, axis));
    add_consistency(view, found, "mean ");
    view.panels.emplace_back(plan(first, 1));
    return view;
  }

  View one_run(const TracedRun& run, std::size_t number) const {
    View view{fmt::format("run {}", number), {}};
    for (std::size_t axis = 0; axis < 3; ++axis) view.panels.emplace_back(error(run, axis));
    std::vector<Performance> found = performances(one_);
    add(row_of(found, run), found);
    add_consistency(view, found, "");
    view.panels.emplace_back(plan(run, number));
    return view;
  }

 private:
  const std::string& name(std::size_t f) const { return experiment_.filters[f].name; }

  /// The numbers of all samples, counted from 0.
  template <class Value>
  Samples by_sample(const Value& value) const {
    Samples values;
    for (int k = 0; k < experiment_.scenario.samples; ++k) values.push_back(value(static_cast<std::size_t>(k)));
    return values;
  }

  LineChart chart(std::string title, std::string y_label) const {
    return {.title = std::move(title),
            .x_label = "sample",
            .y_label = std::move(y_label),
            .x = by_sample([](std::size_t k) { return static_cast<double>(k + 1); }),
            .curves = {},
            .shaded = shaded_};
  }

  LineChart rmse(const std::vector<Performance>& found, std::size_t axis) const {
    LineChart made = chart(fmt::format("RMSE in {}", axis_names[axis]), "RMSE, m");
    for (const Performance& of : found) {
      const auto value = [&](std::size_t k) { return of.rmse(k, axis); };
      const auto shifted = [&](double widths) {
        return by_sample([&](std::size_t k) { return value(k) + widths * of.rmse_half_width(k, axis); });
      };
      Curve& curve = made.curves.emplace_back(Curve{of.name(), of.name(), by_sample(value)});
      if (crowded(experiment_)) continue;
      curve.lower = shifted(-1.0);
      curve.upper = shifted(1.0);
    }
    if (experiment_.runs > 1 && !crowded(experiment_)) made.note = "Bands: 95 % confidence of the RMSE over the runs.";
    return made;
  }

  LineChart error(const TracedRun& run, std::size_t axis) const {
    LineChart made = chart(fmt::format("Error in {}", axis_names[axis]), "error, m");
    const auto errors = [&](const Trace& trace) {
      return by_sample([&](std::size_t k) { return trace.error[k][axis]; });
    };
    made.curves.push_back(
        {.name = measurement_name, .group = measurement_name, .values = errors(run.measurement), .dots = true});
    for (std::size_t f = 0; f < experiment_.filters.size(); ++f)
      made.curves.push_back({name(f), name(f), errors(run.filters[f])});
    return made;
  }

  /// Weights, NEES and NIS of the filters.
  void add_consistency(View& view, const std::vector<Performance>& found, const std::string& mean) const {
    view.panels.emplace_back(weights(found, mean + "probability (IMM) or possibility (HIMM)"));
    for (const auto& [title, label, figure] : {std::tuple("NEES of the position", "NEES", Performance::nees_position),
                                               std::tuple("NIS", "NIS", Performance::nis)}) {
      LineChart made = chart(title, mean + label);
      const Band band = chi_square_band(3, mean.empty() ? 1 : experiment_.runs);
      made.expected = {{band.lower, band.upper, "95 % if consistent"}};
      for (std::size_t f = 0; f < experiment_.filters.size(); ++f)
        made.curves.push_back(
            {name(f), name(f), by_sample([&, figure = figure](std::size_t k) { return found[f + 1].at(k, figure); })});
      limit_axis(made);
      view.panels.emplace_back(std::move(made));
    }
  }

  /// A curve of each filter and model; the dash tells the model.
  LineChart weights(const std::vector<Performance>& found, std::string y_label) const {
    LineChart made = chart("Mode weights", std::move(y_label));
    made.greatest_y = 1.05;
    const std::vector<std::string> models = model_names(experiment_.filters);
    for (std::size_t f = 0; f < experiment_.filters.size(); ++f) {
      const auto& own = experiment_.filters[f].models;
      for (std::size_t j = 0; j < own.size(); ++j) {
        const auto weight = [&](std::size_t k) {
          const std::vector<double> weights = found[f + 1].told_weights(k);
          return weights.empty() ? nan : weights[j];
        };
        const auto model = std::find(models.begin(), models.end(), own[j]) - models.begin();
        made.curves.push_back({.name = name(f) + " " + own[j],
                               .group = name(f),
                               .values = by_sample(weight),
                               .dash = static_cast<int>(model)});
      }
    }
    return made;
  }

  /// The track of a run; with an error ellipse of each filter at a few samples.
  Plan plan(const TracedRun& run, std::size_t number) const {
    Plan plan{.title = fmt::format("Track of run {}", number), .x_label = "x, m", .y_label = "y, m", .traces = {}};
    const auto add = [&](const std::string& of, PlanTrace::Shape shape, const auto& at) {
      const auto along = [&](Eigen::Index axis) { return by_sample([&](std::size_t k) { return at(k)(axis); }); };
      plan.traces.push_back({.name = of, .group = of, .shape = shape, .x = along(0), .y = along(1), .z = along(2)});
    };
    const auto seen_by = [&](const Trace& trace) {
      return [&](std::size_t k) -> Vector<3> { return run.truth[k].head<3>() + Vector<3>(trace.error[k].data()); };
    };
    add(measurement_name, PlanTrace::Shape::dots, seen_by(run.measurement));
    add(truth_name, PlanTrace::Shape::line, [&](std::size_t k) -> Vector<3> { return run.truth[k].head<3>(); });
    for (std::size_t f = 0; f < experiment_.filters.size(); ++f) {
      add(name(f), PlanTrace::Shape::line, seen_by(run.filters[f]));
      for (std::size_t k = 4; !crowded(experiment_) && k < run.truth.size(); k += 5) {
        const auto& covariance = run.filters[f].covariance[k];
        if (!std::isnan(covariance(0, 0)))
          plan.ellipses.push_back(error_ellipse(name(f), seen_by(run.filters[f])(k), covariance));
      }
    }
    // The corners of the target's way from a little before the manoeuvre on.
    const auto onset = static_cast<std::size_t>(experiment_.scenario.phases[1].first - 1);
    const std::size_t first = onset < 3 ? 0 : onset - 3, last = std::min(onset + 15, run.truth.size() - 1);
    for (const Eigen::Index axis : {0, 1}) {
      const auto [least, greatest] = std::minmax(run.truth[first](axis), run.truth[last](axis));
      plan.focus.insert(plan.focus.end(), {least, greatest});
    }
    plan.note = "It opens at the beginning of the manoeuvre.";
    if (!plan.ellipses.empty()) plan.note += " Ellipses: 95 % as each filter states it, every 5 samples.";
    return plan;
  }

  const Experiment& experiment_;
  Experiment one_;  // of one run
  std::vector<Marked> shaded_;
};

int runs_in_page(const Experiment& experiment) {
  constexpr std::size_t most_numbers = 42000;                          // some 350 kB
  const std::size_t per_sample = 12 + experiment.filters.size() * 12;  // coordinates, errors, weights, NEES and NIS
  const auto fit =
      static_cast<int>(most_numbers / (per_sample * static_cast<std::size_t>(experiment.scenario.samples)));
  return crowded(experiment) ? 1 : std::min(std::clamp(fit, 1, 8), experiment.runs);
}

}  // namespace

std::vector<View> views_of(const Experiment& experiment, const std::vector<Performance>& found) {
  const Views views(experiment);
  std::vector<View> all;
  for (int number = 0; number < runs_in_page(experiment); ++number) {
    const TracedRun run = experiment.traced(static_cast<std::uint64_t>(number));
    if (number == 0) all.push_back(views.all_runs(found, run));
    if (!crowded(experiment)) all.push_back(views.one_run(run, static_cast<std::size_t>(number) + 1));
  }
  return all;
}

std::vector<LineChart> charts_of(const View& view) {
  return {std::get<LineChart>(view.panels[0]), std::get<LineChart>(view.panels[3])};
}

}  // namespace sigmax::apps
