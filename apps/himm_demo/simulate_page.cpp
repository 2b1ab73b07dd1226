#include "himm_demo/simulate_page.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <sigmax/estimation/chi_square.hpp>

#include "himm_demo/paper_claims.hpp"
#include "himm_demo/simulate_tables.hpp"

namespace sigmax::apps {
namespace {

constexpr const char* sample_label = "sample";

/// Makes the panels of all runs and of one run alike.
class Pages {
 public:
  explicit Pages(const SimulateReport& report) : report_(report), experiment_(report.experiment) {
    const Phase& manoeuvre = experiment_.scenario.phases[1];
    shaded_ = {{static_cast<double>(manoeuvre.first), static_cast<double>(manoeuvre.last), "manoeuvre"}};
    for (int k = 1; k <= experiment_.scenario.samples; ++k) samples_.push_back(k);
  }

  View all_runs() const {
    View view{experiment_.runs == 1 ? "the only run" : fmt::format("all {} runs", experiment_.runs), {}};
    for (std::size_t axis = 0; axis < 3; ++axis) view.panels.emplace_back(rmse(axis));
    view.panels.emplace_back(weights(
        "Mode weights", "mean probability (IMM) or possibility (HIMM)", [&](std::size_t f) -> const auto& {
          return report_.outcome.filters[f].weights;
        }));
    LineChart nees = chart("NEES of the position", "mean NEES", 3, experiment_.runs);
    LineChart nis = chart("NIS", "mean NIS", 3, experiment_.runs);
    for (std::size_t f = 0; f < experiment_.filters.size(); ++f) {
      nees.curves.push_back({name(f), name(f), report_.outcome.filters[f].nees_by_sample});
      nis.curves.push_back({name(f), name(f), report_.outcome.filters[f].nis_by_sample});
    }
    limit_axis(nees);
    limit_axis(nis);
    view.panels.emplace_back(std::move(nees));
    view.panels.emplace_back(std::move(nis));
    if (!report_.outcome.runs.empty()) view.panels.emplace_back(plan_of(experiment_, report_.outcome.runs.front(), 1));
    return view;
  }

  View one_run(std::size_t number) const {
    const TracedRun& run = report_.outcome.runs[number];
    View view{fmt::format("run {}", number + 1), {}};
    for (std::size_t axis = 0; axis < 3; ++axis) view.panels.emplace_back(error(run, axis));
    view.panels.emplace_back(weights(
        "Mode weights", "probability (IMM) or possibility (HIMM)", [&](std::size_t f) -> const auto& {
          return run.filters[f].weights;
        }));
    LineChart nees = chart("NEES of the position", "NEES", 3, 1);
    LineChart nis = chart("NIS", "NIS", 3, 1);
    for (std::size_t f = 0; f < experiment_.filters.size(); ++f) {
      nees.curves.push_back({name(f), name(f), run.filters[f].nees_position});
      nis.curves.push_back({name(f), name(f), run.filters[f].nis});
    }
    limit_axis(nees);
    limit_axis(nis);
    view.panels.emplace_back(std::move(nees));
    view.panels.emplace_back(std::move(nis));
    view.panels.emplace_back(plan_of(experiment_, run, number + 1));
    return view;
  }

 private:
  const std::string& name(std::size_t f) const { return report_.filter(f).name; }

  LineChart chart(std::string title, std::string y_label, double degrees, double count) const {
    LineChart chart{.title = std::move(title),
                    .x_label = sample_label,
                    .y_label = std::move(y_label),
                    .x = samples_,
                    .curves = {},
                    .shaded = shaded_};
    if (degrees > 0.0) {
      const Band band = chi_square_band(degrees, count);
      chart.expected = {{band.lower, band.upper, "95 % if consistent"}};
    }
    return chart;
  }

  LineChart rmse(std::size_t axis) const {
    LineChart made = chart(fmt::format("RMSE in {}", axis_names[axis]), "RMSE, m", 0, 0);
    const auto add = [&](const std::string& of, const Performance& performance) {
      Curve curve{of, of, {}};
      for (std::size_t k = 0; k < performance.rmse.size(); ++k) {
        const double value = performance.rmse[k][axis], half_width = performance.rmse_half_width[k][axis];
        curve.values.push_back(value);
        if (crowded(experiment_)) continue;
        curve.lower.push_back(value - half_width);
        curve.upper.push_back(value + half_width);
      }
      made.curves.push_back(std::move(curve));
    };
    add(measurement_name, report_.outcome.measurement);
    for (std::size_t f = 0; f < experiment_.filters.size(); ++f) add(name(f), report_.outcome.filters[f]);
    if (experiment_.runs > 1 && !crowded(experiment_)) made.note = "Bands: 95 % confidence of the RMSE over the runs.";
    return made;
  }

  LineChart error(const TracedRun& run, std::size_t axis) const {
    LineChart made = chart(fmt::format("Error in {}", axis_names[axis]), "error, m", 0, 0);
    const auto errors = [&](const Trace& trace) {
      std::vector<double> values;
      for (const auto& error : trace.error) values.push_back(error[axis]);
      return values;
    };
    made.curves.push_back(
        {.name = measurement_name, .group = measurement_name, .values = errors(run.measurement), .dots = true});
    for (std::size_t f = 0; f < experiment_.filters.size(); ++f)
      made.curves.push_back({name(f), name(f), errors(run.filters[f])});
    return made;
  }

  /// A curve of each filter and model; the dash tells the model.
  template <class Weights>
  LineChart weights(std::string title, std::string y_label, const Weights& of) const {
    LineChart made = chart(std::move(title), std::move(y_label), 0, 0);
    made.greatest_y = 1.05;
    const std::vector<std::string> models = model_names(experiment_.filters);
    for (std::size_t f = 0; f < experiment_.filters.size(); ++f) {
      const auto& own = report_.filter(f).models;
      for (std::size_t j = 0; j < own.size(); ++j) {
        const auto model = std::find(models.begin(), models.end(), own[j]) - models.begin();
        Curve curve{.name = name(f) + " " + own[j], .group = name(f), .values = {}, .dash = static_cast<int>(model)};
        const auto& by_sample = of(f);
        const auto samples = static_cast<int>(by_sample.size());
        for (int k = 0; k < samples; ++k) {
          const int source = k - experiment_.mode_sample_shift;
          const bool known = source >= 0 && source < samples && !by_sample[static_cast<std::size_t>(source)].empty();
          curve.values.push_back(known ? by_sample[static_cast<std::size_t>(source)][j] : std::nan(""));
        }
        made.curves.push_back(std::move(curve));
      }
    }
    return made;
  }

  const SimulateReport& report_;
  const Experiment& experiment_;
  std::vector<double> samples_;
  std::vector<Marked> shaded_;
};

/// What the runs say of the paper's claims, a sentence for each comparison that it makes.
std::vector<std::string> verdict_of(const SimulateReport& report) {
  std::vector<std::string> sentences;
  for (const auto& comparison : report.comparisons) {
    const auto& filter = report.filter(comparison.filter);
    const auto& reference = report.filter(comparison.reference);
    if (!judged(filter, reference) || sentences.size() == 2) continue;
    std::string sentence = fmt::format("{} against {}:", filter.name, reference.name);
    for (std::size_t p = 0; p < 3; ++p) {
      const Claim claim = claim_of(report.options.scenario, report.options.group, p);
      sentence += fmt::format(
          "{} {} the manoeuvre the paper says {}, which {}", p ? ";" : "", report.experiment.scenario.phases[p].name,
          word(claim),
          verdict(claim, comparison.difference[p], report.outcome.filters[comparison.reference].phase_rmse[p]));
    }
    sentences.push_back(sentence + ".");
  }
  return sentences;
}

}  // namespace

int runs_in_page(const Experiment& experiment) {
  constexpr std::size_t most_numbers = 42000;  // some 350 kB
  const std::size_t filters = experiment.filters.size();
  const std::size_t per_sample = 12 + filters * 12;  // coordinates, errors, weights, NEES and NIS
  const auto fit =
      static_cast<int>(most_numbers / (per_sample * static_cast<std::size_t>(experiment.scenario.samples)));
  return std::min(std::clamp(fit, 1, 8), experiment.runs);
}

std::vector<LineChart> charts_of(const SimulateReport& report) {
  const View all = Pages(report).all_runs();
  return {std::get<LineChart>(all.panels[0]), std::get<LineChart>(all.panels[3])};
}

Report page_of(const SimulateReport& report) {
  const Experiment& experiment = report.experiment;
  Report page{.title = fmt::format("Scenario {}, group {}: {} simulated runs", report.options.scenario,
                                   report.options.group, experiment.runs),
              .verdict = verdict_of(report),
              .command = report.options.output.command,
              .groups = {{measurement_name, true}, {truth_name, true}},
              .panels = {},
              .chooser = "Show",
              .views = {},
              .last = {}};
  page.verdict.push_back(fmt::format("Preset {}, seed {}; a sample is {} s. The manoeuvre is in samples {} to {}.",
                                     name_of(report.options.preset), experiment.seed,
                                     shortest(experiment.scenario.step_s), experiment.scenario.phases[1].first,
                                     experiment.scenario.phases[1].last));
  for (const auto& filter : experiment.filters)
    page.groups.push_back({.name = filter.name, .shown = !crowded(experiment) || page.groups.size() < 4});
  if (crowded(experiment)) page.verdict.push_back("Two filters are switched on at first.");
  const Pages pages(report);
  page.views.push_back(pages.all_runs());
  for (std::size_t run = 0; !crowded(experiment) && run < report.outcome.runs.size(); ++run)
    page.views.push_back(pages.one_run(run));
  page.last.emplace_back(ReportTable{"Position RMSE by phase", figures(report, Figures::rmse)});
  if (!crowded(experiment))
    for (const auto& comparison : report.comparisons)
      page.last.emplace_back(ReportTable{"Difference of RMSE, paired by run, ± 95 %", differences(report, comparison)});
  page.last.emplace_back(ReportTable{"Mean NEES", figures(report, Figures::nees)});
  page.last.emplace_back(
      ReportTable{"Cross-time: when the manoeuvre model overtakes", figures(report, Figures::cross_time)});
  page.last.emplace_back(Words{"Settings in force", as_toml(experiment.filters), true});
  return page;
}

}  // namespace sigmax::apps
