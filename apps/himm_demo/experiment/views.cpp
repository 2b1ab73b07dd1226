#include <sigmax/estimation/chi_square.hpp>

#include "himm_demo/experiment/sentences.hpp"

namespace sigmax::apps {
namespace {

/// Where a position in plan lies with a probability of 95 %, if it is normal.
ErrorEllipse error_ellipse(const std::string& group, const Vector<3>& centre, const SquareMatrix<3>& covariance) {
  const double chi_square = -2.0 * std::log(0.05);  // the 95 % quantile with two degrees of freedom
  const double mean = 0.5 * (covariance(0, 0) + covariance(1, 1)), apart = 0.5 * (covariance(0, 0) - covariance(1, 1));
  const double radius = std::hypot(apart, covariance(0, 1));  // of Mohr's circle: variances are mean ± radius
  const double angle = 0.5 * std::atan2(covariance(0, 1), apart) / degree;
  const double major = std::sqrt(chi_square * (mean + radius));
  const double minor = std::sqrt(chi_square * std::max(0.0, mean - radius));
  // Of both directions of the axis the one from −135° on.
  return {group, centre.x(), centre.y(), major, minor, angle > 45.0 ? angle - 180.0 : angle};
}

/// The numbers of all samples, counted from 0.
template <class Value>
std::vector<double> by_sample(const Tally& tally, const Value& value) {
  return each_below(tally.experiment.samples(), value);
}

/// A curve of value(of, sample) for each from a first one on.
template <class Value>
LineChart chart(const Tally& tally, const std::string& title, const std::string& y_label, std::size_t first,
                const Value& value) {
  const Phase& manoeuvre = tally.experiment.scenario.phases[1];
  LineChart made{.title = title,
                 .x_label = "sample",
                 .y_label = y_label,
                 .x = by_sample(tally, [](std::size_t k) { return static_cast<double>(k + 1); }),
                 .shaded = {{static_cast<double>(manoeuvre.first), static_cast<double>(manoeuvre.last), "manoeuvre"}}};
  for (std::size_t of = first; of < tally.size(); ++of)
    made.curves.push_back(
        {tally.name(of), tally.name(of), by_sample(tally, [&](std::size_t k) { return value(of, k); })});
  return made;
}

LineChart rmse_chart(const Tally& tally, std::size_t axis) {
  LineChart made = chart(tally, fmt::format("RMSE in {}", axis_names[axis]), "RMSE, m", 0,
                         [&](std::size_t of, std::size_t k) { return tally.rmse_at(of, k, axis); });
  if (crowded(tally.experiment)) return made;
  for (std::size_t of = 0; of < tally.size(); ++of) {
    const auto shifted = [&](double widths) {
      return by_sample(
          tally, [&](std::size_t k) { return tally.rmse_at(of, k, axis) + widths * tally.half_width_at(of, k, axis); });
    };
    made.curves[of].lower = shifted(-1.0);
    made.curves[of].upper = shifted(1.0);
  }
  if (tally.experiment.runs > 1) made.note = "Bands: 95 % confidence of the RMSE over the runs.";
  return made;
}

/// A curve of each filter and model; the dash tells the model.
LineChart weights_chart(const Tally& tally) {
  LineChart made = chart(tally, "Mode weights", "mean probability (IMM) or possibility (HIMM)", tally.size(),
                         [](std::size_t, std::size_t) { return nan; });
  made.greatest_y = 1.05;
  const std::vector<std::string> models = model_names(tally.experiment.filters);
  for (std::size_t of = 1; of < tally.size(); ++of) {
    const auto& own = tally.filter(of)->models;
    for (std::size_t j = 0; j < own.size(); ++j) {
      const auto weight = [&](std::size_t k) {
        const std::vector<double> weights = tally.weights_at(of, k);
        return weights.empty() ? nan : weights[j];
      };
      const auto model = std::ranges::find(models, own[j]) - models.begin();
      made.curves.push_back({.name = tally.name(of) + " " + own[j],
                             .group = tally.name(of),
                             .values = by_sample(tally, weight),
                             .dash = static_cast<int>(model)});
    }
  }
  return made;
}

LineChart consistency_chart(const Tally& tally, const char* title, const std::string& y_label, Tally::BySample figure) {
  LineChart made =
      chart(tally, title, y_label, 1, [&](std::size_t of, std::size_t k) { return tally.mean_at(of, k, figure); });
  const Band band = chi_square_band(3, tally.experiment.runs);
  made.expected = {{band.lower, band.upper, "95 % if consistent"}};
  keep_usual(made);
  return made;
}

/// The track of the first run; with an error ellipse of each filter at a few samples.
MapChart plan(const Tally& tally) {
  const TracedRun run = tally.experiment.traced(0);
  MapChart plan{.title = "Track of run 1", .x_label = "x, m", .y_label = "y, m"};
  const auto seen_by = [&](std::size_t of, std::size_t k) -> Vector<3> {
    return run.truth[k].head<3>() + run.traces[of][k].error;
  };
  const auto add = [&](const std::string& name, PlanTrace::Shape shape, const auto& at) {
    const auto along = [&](Eigen::Index axis) { return by_sample(tally, [&](std::size_t k) { return at(k)(axis); }); };
    plan.traces.push_back({.name = name, .group = name, .shape = shape, .x = along(0), .y = along(1), .z = along(2)});
  };
  for (std::size_t of = 0; of < tally.size(); ++of) {
    add(tally.name(of), of == 0 ? PlanTrace::Shape::dots : PlanTrace::Shape::line,
        [&](std::size_t k) { return seen_by(of, k); });
    if (of == 0) add(truth_name, PlanTrace::Shape::line, [&](std::size_t k) -> Vector<6> { return run.truth[k]; });
    for (std::size_t k = 4; of > 0 && !crowded(tally.experiment) && k < run.truth.size(); k += 5)
      if (const auto& covariance = run.traces[of][k].covariance; !std::isnan(covariance(0, 0)))
        plan.ellipses.push_back(error_ellipse(tally.name(of), seen_by(of, k), covariance));
  }
  // The corners of the target's way from a little before the manoeuvre on.
  const auto onset = static_cast<std::size_t>(tally.experiment.scenario.onset() - 1);
  const std::size_t first = onset < 3 ? 0 : onset - 3, last = std::min(onset + 15, run.truth.size() - 1);
  for (const Eigen::Index axis : {0, 1}) {
    const auto [least, greatest] = std::minmax(run.truth[first](axis), run.truth[last](axis));
    plan.focus.insert(plan.focus.end(), {least, greatest});
  }
  plan.note = "It opens at the beginning of the manoeuvre.";
  if (!plan.ellipses.empty()) plan.note += " Ellipses: 95 % as each filter states it, every 5 samples.";
  return plan;
}

/// The figures of all sentences that are of this scenario and group, and where the sentences want them: those of the
/// RMSE of the same two filters together, and others by their unit.
std::vector<Panel> charts_of(const std::vector<Judged>& sentences, const Condition& condition) {
  std::vector<IntervalChart> charts;
  for (std::size_t s = 0; s < sentences.size(); ++s)
    for (const Measured& measured : sentences[s].figures) {
      const Statement& statement = *measured.statement;
      if (place_of(statement) != place_of(condition)) continue;
      const bool rmse = statement.figure->by_axis, relative = statement.figure->relative;
      const double scale = relative ? 100.0 : 1.0;
      const std::string title = rmse       ? fmt::format("RMSE of {} against {}", statement.of, statement.against)
                                : relative ? "The z axis after the onset, and who leads"
                                : statement.against.empty() ? "Cross-times and switches"
                                                            : "Differences of cross-times and switches";
      auto chart = std::ranges::find(charts, title, &IntervalChart::title);
      if (chart == charts.end()) {
        charts.push_back({.title = title,
                          .x_label = relative ? "relative difference or share, %" : "samples, or switches a run",
                          .series = {{.name = "with the correct IMM"}, {.name = "with the released IMM"}},
                          .reference = statement.against.empty() ? std::nullopt : std::optional(0.0),
                          .wanted_label = "where the sentence wants it",
                          .digits = relative ? 1 : 2,
                          .note = "The number is the sentence's; the intervals hold together for all its figures."});
        chart = charts.end() - 1;
      }
      chart->rows.push_back(fmt::format(
          "{}. {}", s + 1,
          rmse ? fmt::format("{} {}", phase_names[*measured.phase], axis_names[*measured.axis]) : measured.subject()));
      for (const std::size_t imm : {0U, 1U}) {
        chart->series[imm].values.push_back(measured.shown(imm));
        chart->series[imm].wanted.push_back({scale * statement.region.above, scale * statement.region.below});
      }
    }
  return {charts.begin(), charts.end()};
}

}  // namespace

View view_of(const std::vector<Judged>& sentences, const Condition& condition, const std::vector<std::string>& names) {
  View view{fmt::format("{}: scenario {}, group {}", words_of(condition.preset), condition.scenario, condition.group),
            charts_of(sentences, condition)};
  for (std::size_t axis = 0; axis < axis_names.size(); ++axis) {
    IntervalChart chart{.title = fmt::format("RMSE in {}", axis_names[axis]),
                        .x_label = "RMSE, m",
                        .rows = {phase_names.begin(), phase_names.end()}};
    for (const auto& name : names) {
      const auto of = condition.tally.place(name);
      if (!of) continue;
      IntervalSeries& series = chart.series.emplace_back(IntervalSeries{.name = name, .group = name});
      for (std::size_t phase = 0; phase < phase_names.size(); ++phase)
        series.values.push_back(condition.tally.rmse(*of, phase, axis).interval());
    }
    view.panels.emplace_back(std::move(chart));
  }
  return view;
}

std::vector<Panel> panels_of(const Tally& tally) {
  std::vector<Panel> panels;
  for (std::size_t axis = 0; axis < 3; ++axis) panels.emplace_back(rmse_chart(tally, axis));
  panels.emplace_back(weights_chart(tally));
  panels.emplace_back(consistency_chart(tally, "NEES of the position", "mean NEES", Tally::nees_position));
  panels.emplace_back(consistency_chart(tally, "NIS", "mean NIS", Tally::nis));
  panels.emplace_back(plan(tally));
  return panels;
}

}  // namespace sigmax::apps
