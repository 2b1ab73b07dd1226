#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <fmt/format.h>

#include <sigmax/core/transform.hpp>
#include <sigmax/recognition/discretization.hpp>

#include "recognition_demo/contest_report.hpp"
#include "recognition_demo/draws.hpp"
#include "recognition_demo/pages.hpp"
#include "recognition_demo/performance_data.hpp"
#include "recognition_demo/subcommands.hpp"
#include "support/command_line.hpp"

namespace sigmax::apps {
namespace {

struct PerformanceOptions {
  std::string file;
  std::string drawn_from = "density";  ///< or "triangle"
  std::size_t bins = 40;
  double least = 0.01;  ///< possibility of what lies outside [minimum, maximum]
  DrawOptions draws;
};

/// All but a thousandth of every type's density at either end.
std::pair<double, double> range_of(const std::vector<Performance>& types) {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (const Performance& type : types) {
    least = std::min(least, type.density.quantile(0.001));
    greatest = std::max(greatest, type.density.quantile(0.999));
  }
  return {least, greatest};
}

/// Bins of one quantity over that range.
Discretization bins_of(const std::vector<Performance>& types, std::size_t bins) {
  const auto [least, greatest] = range_of(types);
  std::vector<double> cuts;
  for (std::size_t i = 1; i < bins; ++i)
    cuts.push_back(least + (greatest - least) * static_cast<double>(i) / static_cast<double>(bins));
  return Discretization{cuts};
}

/// p(bin|type) from the densities.
Relation<Random, Random> probable(const RandomVariable& feature, const RandomVariable& type, const Discretization& bins,
                                  const std::vector<Performance>& types) {
  std::vector<std::vector<double>> rows;
  for (const Performance& each : types) {
    auto& row = rows.emplace_back();
    for (std::size_t b = 0; b < bins.size(); ++b)
      row.push_back(std::max(0.0, each.density.cdf(bins.upper(b)) - each.density.cdf(bins.lower(b))));
  }
  return {feature, type, rows};
}

/// π(bin|type) from [minimum, optimum, maximum].
Relation<Fuzzy, Fuzzy> possible(const RandomVariable& feature, const RandomVariable& type, const Discretization& bins,
                                const std::vector<Performance>& types, double least) {
  std::vector<std::vector<double>> rows;
  for (const Performance& each : types) {
    const auto row = triangular(as_fuzzy(feature), bins, each.triangle, least);
    rows.emplace_back(row.values().begin(), row.values().end());
  }
  return {as_fuzzy(feature), as_fuzzy(type), rows};
}

/// A number with the density that is in proportion to the triangle.
double draw_from(const Triangle& triangle, double u) {
  const double a = triangle.minimum(), c = triangle.optimum(), b = triangle.maximum();
  const double below = (c - a) / (b - a);
  return u < below ? a + std::sqrt(u * (b - a) * (c - a)) : b - std::sqrt((1.0 - u) * (b - a) * (b - c));
}

struct World {
  std::vector<Discretization> bins;
  std::vector<Contestant> contestants;
};

World world_of(const PerformanceData& data, const PerformanceOptions& options) {
  const RandomVariable type{"type", data.types};
  std::vector<FeatureModel<Random, Random>> by_density, by_triangle_p;
  std::vector<FeatureModel<Fuzzy, Fuzzy>> by_triangle, by_ratio, by_dubois_prade;
  World world;
  for (std::size_t v = 0; v < data.variables.size(); ++v) {
    const auto bins = bins_of(data.table[v], options.bins);
    const auto feature = bins.variable<Random>(data.variables[v]);
    const auto p = probable(feature, type, bins, data.table[v]);
    const auto pi = possible(feature, type, bins, data.table[v], options.least);
    by_density.emplace_back(p);
    by_triangle.emplace_back(pi);
    by_triangle_p.emplace_back(with_random_condition(to_probability(pi, RatioScale{})));
    by_ratio.emplace_back(with_fuzzy_condition(to_possibility(p, RatioScale{})));
    by_dubois_prade.emplace_back(with_fuzzy_condition(to_possibility(p, DuboisPrade{})));
    world.bins.push_back(bins);
  }
  const auto random_prior = uninformative(type);
  const auto fuzzy_prior = uninformative(as_fuzzy(type));
  world.contestants = {
      {"sigma, p of the density", SigmaClassifier{random_prior, std::move(by_density)}},
      {"max, π of the triangle", MaxClassifier{fuzzy_prior, std::move(by_triangle)}},
      {"sigma, p in proportion to the triangle", SigmaClassifier{random_prior, std::move(by_triangle_p)}},
      {"max, density by the ratio scale", MaxClassifier{fuzzy_prior, std::move(by_ratio)}},
      {"max, density by Dubois-Prade", MaxClassifier{fuzzy_prior, std::move(by_dubois_prade)}},
  };
  return world;
}

double mean_probability_inside(const PerformanceData& data) {
  double sum = 0.0;
  for (const auto& row : data.table)
    for (const Performance& each : row)
      sum += each.density.cdf(each.triangle.maximum()) - each.density.cdf(each.triangle.minimum());
  return sum / static_cast<double>(data.table.size() * data.types.size());
}

/// A type and, independently, its quantities; a report is one of them.
RunTraces drawn_run(const PerformanceData& data, const World& world, const PerformanceOptions& options,
                    RandomStream& random) {
  const std::size_t truth = draw_index(random, data.types.size());
  std::vector<Readings> reports;
  for (std::size_t v = 0; v < data.variables.size(); ++v) {
    const Performance& of_type = data.table[v][truth];
    const double u = random.uniform();
    const double value = options.drawn_from == "density" ? of_type.density.quantile(u) : draw_from(of_type.triangle, u);
    reports.emplace_back(data.variables.size(), missing)[v] = world.bins[v].bin(value);
  }
  return follow_all(world.contestants, truth, reports);
}

void say_performance(const PerformanceOptions& options, const PerformanceData& data, Result& result) {
  result.say(fmt::format(
      "{}: {} types of aircraft, {} quantities, each known as [min, opt, max] and as a density\n"
      "[min, max] holds {:.1f} % of the density on average; outside it the possibility is taken to be {}",
      options.file, data.types.size(), data.variables.size(), 100.0 * mean_probability_inside(data), options.least));
  for (const auto& remark : data.remarks) result.say(remark);
  result.say(
      fmt::format("{} seeded draws of a type and, independently, of its quantities from {}, seed {}; {} bins a "
                  "quantity",
                  options.draws.runs,
                  options.drawn_from == "density" ? "the densities: sigma inference knows them"
                                                  : "densities in proportion to the triangles",
                  options.draws.seed, options.bins));
}

/// A quantity as far as classifiers by maxima know it: of each type's values.
LineChart quantity_chart(const PerformanceData& data, const PerformanceOptions& options, const World& world,
                         std::size_t variable, std::size_t type) {
  const auto& types = data.table[variable];
  const auto [least, greatest] = range_of(types);
  const Discretization& bins = world.bins[variable];
  const RandomVariable type_variable{"type", data.types};
  const auto feature = bins.variable<Random>(data.variables[variable]);
  const auto p = probable(feature, type_variable, bins, types);
  LineChart chart{.title = data.variables[variable],
                  .x_label = data.variables[variable] + ", in the file's unit",
                  .y_label = "possibility",
                  .x = {},
                  .curves = {},
                  .greatest_y = 1.05};
  const double width = (greatest - least) / static_cast<double>(bins.size());
  for (std::size_t b = 0; b < bins.size(); ++b) chart.x.push_back(least + (static_cast<double>(b) + 0.5) * width);
  const auto add = [&](const std::string& name, const auto& relation) {
    chart.curves.push_back({.name = name, .values = {}});
    for (std::size_t b = 0; b < bins.size(); ++b) chart.curves.back().values.push_back(relation(type, b));
  };
  add("triangle", possible(feature, type_variable, bins, types, options.least));
  add("density by the ratio scale", to_possibility(p, RatioScale{}));
  add("density by Dubois-Prade", to_possibility(p, DuboisPrade{}));
  return chart;
}

/// The quantities that tell the types apart best.
std::vector<std::size_t> most_telling(const PerformanceData& data, const World& world, std::size_t most) {
  const RandomVariable type{"type", data.types};
  std::vector<std::pair<double, std::size_t>> all;
  for (std::size_t v = 0; v < data.variables.size(); ++v)
    all.emplace_back(
        -telling(probable(world.bins[v].variable<Random>(data.variables[v]), type, world.bins[v], data.table[v])), v);
  std::sort(all.begin(), all.end());
  std::vector<std::size_t> best;
  for (std::size_t i = 0; i < std::min(most, all.size()); ++i) best.push_back(all[i].second);
  return best;
}

void fill(Report& page, const PerformanceOptions& options, const PerformanceData& data, const World& world,
          const std::vector<Score>& scores) {
  constexpr std::size_t most_types = 20, most_quantities = 6;
  page.verdict = {
      fmt::format("{} seeded draws of one of {} types and its quantities, seed {}. The possibilities are "
                  "those of the {} quantities that tell the types apart best.",
                  options.draws.runs, data.types.size(), options.draws.seed, most_quantities)};
  page.panels = {accuracy_chart(scores, "quantities")};
  page.chooser = "Type";
  const auto quantities = most_telling(data, world, most_quantities);
  for (std::size_t type = 0; type < std::min(most_types, data.types.size()); ++type) {
    View& view = page.views.emplace_back(View{data.types[type], {}});
    for (const std::size_t variable : quantities)
      view.panels.emplace_back(quantity_chart(data, options, world, variable, type));
  }
}

void run_performance(const PerformanceOptions& options) {
  const DrawOptions& draws = options.draws;
  refuse_to_overwrite(draws.output, {options.file}, {"curves.csv"});
  ResultFiles files(draws.output);
  const PerformanceData data = read_performance(options.file);
  const World world = world_of(data, options);
  Scoreboard board(world.contestants);
  Progress progress("runs", draws.runs, draws.output.quiet);
  for_each_draw(
      draws, progress, [&](RandomStream& random) { return drawn_run(data, world, options, random); },
      [&](std::size_t, const RunTraces& traces) { board.add(traces); });
  progress.finish();
  const auto scores = board.scores();
  Result result = result_of_contest("Which type of aircraft is it?", draws.output, world.contestants);
  say_performance(options, data, result);
  result.fact({"file"}, options.file);
  result.fact({"drawn_from"}, options.drawn_from);
  result.fact({"bins"}, options.bins);
  result.fact({"least_possibility"}, options.least);
  result.fact({"runs"}, draws.runs);
  result.fact({"seed"}, draws.seed);
  result.fact({"remarks"}, data.remarks);
  if (files.report_wanted()) fill(result.page, options, data, world, scores);
  add_scores(result, scores, "quantities");
  result.publish(files);
}

}  // namespace

void add_performance(CLI::App& program, const std::string& command) {
  const auto options = std::make_shared<PerformanceOptions>();
  options->draws.output.command = command;
  options->draws.runs = 60000;  // intervals below a tenth of the differences
  Subcommand app(program, "performance",
                 "Which type of aircraft is it? From [min, opt, max] and from densities of the same quantities.");
  app.option("data", options->file,
             "A CSV file with type, variable, optimum, minimum, maximum, model and parameters, or - for the standard "
             "input")
      .required()
      .type("PERFORMANCE.csv");
  app.option("--draws", options->drawn_from, "What the quantities are drawn from")
      .one_of(std::vector<std::string>{"density", "triangle"})
      .shows_default();
  app.option("--bins", options->bins, "Bins of a quantity").in(2, 10000).shows_default();
  app.option("--least", options->least, "Possibility of what lies outside [min, max]")
      .number_in(0.0, 1.0)
      .shows_default();
  add_draws(app, options->draws);
  add_report(app, options->draws.output);
  app.footer(
      "Examples:\n"
      "  recognition_demo performance openap_performance.csv\n"
      "  recognition_demo performance openap_performance.csv --draws triangle \\\n"
      "    --least 0.1");
  app.run([options] { run_performance(*options); });
}

}  // namespace sigmax::apps
