#include <map>

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/gamma.hpp>
#include <boost/math/distributions/normal.hpp>

#include <sigmax/core/transform.hpp>
#include <sigmax/recognition/discretization.hpp>
#include <sigmax/recognition/triangle.hpp>

#include "recognition_demo/subcommands.hpp"
#include "recognition_demo/world.hpp"
#include "support/csv.hpp"

namespace sigmax::apps {
namespace {

/// A density of a quantity, as it was fitted to flights: normal, gamma or beta, shifted and scaled.
struct FittedDensity {
  std::variant<boost::math::normal_distribution<>, boost::math::gamma_distribution<>, boost::math::beta_distribution<>>
      standard;
  double location, scale;

  /// Probability below x, which may be infinite.
  double cdf(double x) const {
    const double z = (x - location) / scale;
    return of_kind(standard, [z](const auto& density) {
      const auto [least, greatest] = boost::math::support(density);
      if (z <= least) return 0.0;
      if (z >= greatest) return 1.0;
      return boost::math::cdf(density, z);
    });
  }

  /// The number below which the probability is u, for 0 < u < 1.
  double quantile(double u) const {
    const auto of_standard = [u](const auto& density) { return boost::math::quantile(density, u); };
    return location + scale * of_kind(standard, of_standard);
  }
};

/// One quantity of one type of aircraft, known in two ways.
struct Performance {
  Triangle triangle;      ///< [minimum, optimum, maximum]
  FittedDensity density;  ///< fitted to the same flights
};

/// Types of aircraft and the quantities that are known of all of them.
struct PerformanceData {
  std::vector<std::string> types, variables;
  std::vector<std::vector<Performance>> table;  ///< by variable, then by type
  std::vector<std::string> remarks;             ///< what had to be mended, with its line
};

/// Numbers between bars: "8.56|0.43|0.14".
std::vector<double> parameters(const CsvRow& row, std::size_t column, std::size_t count) {
  std::vector<double> numbers;
  for (std::string_view rest = row[column];;) {
    const auto bar = rest.find('|');
    const auto number = parse_number(rest.substr(0, bar));
    if (!number) throw row.error(column, "numbers between bars, as 8.56|0.43|0.14");
    numbers.push_back(*number);
    if (bar == std::string_view::npos) break;
    rest.remove_prefix(bar + 1);
  }
  if (numbers.size() != count) throw row.error(column, fmt::format("{} numbers between bars", count));
  return numbers;
}

FittedDensity density(const CsvRow& row, std::size_t model, std::size_t column, double optimum,
                      std::vector<std::string>& remarks) {
  const std::string_view name = trimmed(row[model]);
  const auto require_positive = [&](double value) {
    if (!(value > 0.0)) throw row.error(column, "positive deviation, shapes and scale");
  };
  if (name == "norm") {
    const auto p = parameters(row, column, 2);
    require_positive(p[1]);
    return {boost::math::normal_distribution<>(0.0, 1.0), p[0], p[1]};
  }
  if (name == "gamma") {
    auto p = parameters(row, column, 3);
    require_positive(p[0]);
    if (p[2] == 0.0 && p[0] > 1.0 && optimum > p[1]) {
      p[2] = (optimum - p[1]) / (p[0] - 1.0);
      remarks.push_back(
          fmt::format("line {}: a scale printed as 0 is rebuilt from the mode, {:.4f}", row.line(), p[2]));
    }
    require_positive(p[2]);
    return {boost::math::gamma_distribution<>(p[0], 1.0), p[1], p[2]};
  }
  if (name == "beta") {
    const auto p = parameters(row, column, 4);
    for (const std::size_t i : {0U, 1U, 3U}) require_positive(p[i]);
    return {boost::math::beta_distribution<>(p[0], p[1]), p[2], p[3]};
  }
  throw row.error(model, "norm, gamma or beta");
}

/// Reads type,variable,optimum,minimum,maximum,model,parameters; other columns are ignored. Throws InputError with
/// file, line, column and value for what cannot be, and for a quantity that a type lacks.
PerformanceData read_performance(const std::string& file) {
  CsvReader reader = open_csv(file);
  const std::size_t type = reader.column("type"), variable = reader.column("variable");
  const std::size_t optimum = reader.column("optimum"), minimum = reader.column("minimum"),
                    maximum = reader.column("maximum");
  const std::size_t model = reader.column("model"), parameter_list = reader.column("parameters");
  PerformanceData data;
  std::map<std::pair<std::string, std::string>, Performance> cells;
  const auto remember = [](std::vector<std::string>& names, std::string name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(std::move(name));
  };
  for (CsvRow row; reader.next(row);) {
    for (const std::size_t column : {type, variable})
      if (row.blank(column)) throw row.error(column, "a name");
    const std::string of_type{trimmed(row[type])}, of_variable{trimmed(row[variable])};
    const double least = row.number(minimum), greatest = row.number(maximum);
    if (!(least < greatest)) throw row.error(maximum, fmt::format("a number above the minimum, {}", least));
    const double given = row.number(optimum), inside = std::clamp(given, least, greatest);
    if (inside != given)
      data.remarks.push_back(fmt::format("line {}: the optimum {} lies outside [{}, {}] and counts as {}", row.line(),
                                         given, least, greatest, inside));
    Performance performance{Triangle(least, inside, greatest),
                            density(row, model, parameter_list, given, data.remarks)};
    if (!cells.emplace(std::pair{of_type, of_variable}, performance).second)
      throw row.error(variable, "a quantity that the type does not have yet", "remove one of the two rows");
    remember(data.types, of_type);
    remember(data.variables, of_variable);
  }
  if (data.types.size() < 2)
    throw InputError("{}: found {} types, expected at least two", reader.file(), data.types.size());
  for (const auto& of_variable : data.variables) {
    auto& row = data.table.emplace_back();
    for (const auto& of_type : data.types) {
      const auto found = cells.find({of_type, of_variable});
      if (found == cells.end())
        throw InputError({.where = reader.file(),
                          .what = fmt::format("type {} has no quantity {}", in_quotes(of_type), in_quotes(of_variable)),
                          .remedy = "add the row, or remove the quantity from all types"});
      row.push_back(found->second);
    }
  }
  return data;
}

struct PerformanceOptions {
  std::string file;
  std::string drawn_from = "density";  ///< or "triangle"
  std::size_t bins = 40;
  double least = 0.01;  ///< possibility of what lies outside [minimum, maximum]
  DrawOptions draws;
};

/// What a quantity says of the types, over bins of all but a thousandth of every type's density at either end.
struct Knowledge {
  double least, greatest;
  Discretization bins;
  Relation<Random, Random> probable;  ///< p(bin|type) from the densities
  Relation<Fuzzy, Fuzzy> possible;    ///< π(bin|type) from [minimum, optimum, maximum]
};

Knowledge knowledge_of(const PerformanceData& data, std::size_t variable, const PerformanceOptions& options) {
  const auto& types = data.table[variable];
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (const Performance& type : types) {
    least = std::min(least, type.density.quantile(0.001));
    greatest = std::max(greatest, type.density.quantile(0.999));
  }
  std::vector<double> cuts;
  for (std::size_t i = 1; i < options.bins; ++i)
    cuts.push_back(least + (greatest - least) * static_cast<double>(i) / static_cast<double>(options.bins));
  Discretization bins{cuts};
  const auto feature = bins.variable<Random>(data.variables[variable]);
  std::vector<std::vector<double>> probable, possible;
  for (const Performance& each : types) {
    auto& row = probable.emplace_back();
    for (std::size_t b = 0; b < bins.size(); ++b)
      row.push_back(std::max(0.0, each.density.cdf(bins.upper(b)) - each.density.cdf(bins.lower(b))));
    const auto triangle = triangular(as_fuzzy(feature), bins, each.triangle, options.least);
    possible.emplace_back(triangle.values().begin(), triangle.values().end());
  }
  const RandomVariable type{"type", data.types};
  return {least, greatest, std::move(bins), {feature, type, probable}, {as_fuzzy(feature), as_fuzzy(type), possible}};
}

/// A number with the density that is in proportion to the triangle.
double draw_from(const Triangle& triangle, double u) {
  const double a = triangle.minimum(), c = triangle.optimum(), b = triangle.maximum();
  const double below = (c - a) / (b - a);
  return u < below ? a + std::sqrt(u * (b - a) * (c - a)) : b - std::sqrt((1.0 - u) * (b - a) * (b - c));
}

std::vector<Contestant> contestants(const std::vector<Knowledge>& all) {
  const auto random_prior = uninformative(all.front().probable.from());
  const auto fuzzy_prior = uninformative(all.front().possible.from());
  const auto in_proportion =
      each(all, [](const Knowledge& one) { return with_random_condition(to_probability(one.possible, RatioScale{})); });
  const auto by = [&](const auto& method) {
    return each(all, [&](const Knowledge& one) { return with_fuzzy_condition(to_possibility(one.probable, method)); });
  };
  return {{"sigma, p of the density", SigmaClassifier{random_prior, each(all, &Knowledge::probable)}},
          {"max, π of the triangle", MaxClassifier{fuzzy_prior, each(all, &Knowledge::possible)}},
          {"sigma, p in proportion to the triangle", SigmaClassifier{random_prior, in_proportion}},
          {"max, density by the ratio scale", MaxClassifier{fuzzy_prior, by(RatioScale{})}},
          {"max, density by Dubois-Prade", MaxClassifier{fuzzy_prior, by(DuboisPrade{})}}};
}

/// A type and, independently, its quantities; a report is one of them.
Drawn drawn(const PerformanceData& data, const std::vector<Knowledge>& knowledge, const PerformanceOptions& options,
            std::size_t run) {
  RandomStream random(options.draws.seed, run);
  const std::size_t truth = draw_index(random, data.types.size());
  std::vector<AnyReport> reports;
  for (std::size_t v = 0; v < knowledge.size(); ++v) {
    const Performance& of_type = data.table[v][truth];
    const double u = random.uniform();
    const double value = options.drawn_from == "density" ? of_type.density.quantile(u) : draw_from(of_type.triangle, u);
    Readings report(knowledge.size(), missing);
    report[v] = knowledge[v].bins.bin(value);
    reports.emplace_back(std::move(report));
  }
  return {truth, {std::move(reports)}};
}

void say_performance(const PerformanceOptions& options, const PerformanceData& data, Result& result) {
  double inside = 0.0;  // of the densities' probability
  for (const auto& of_types : data.table)
    for (const auto& [triangle, density] : of_types)
      inside += density.cdf(triangle.maximum()) - density.cdf(triangle.minimum());
  inside /= static_cast<double>(data.table.size() * data.types.size());
  result.say(
      "{}: {} types of aircraft, {} quantities, each known as [min, opt, max] and as a density\n"
      "[min, max] holds {:.1f} % of the density on average; outside it the possibility is taken to be {}",
      options.file, data.types.size(), data.variables.size(), 100.0 * inside, options.least);
  for (const auto& remark : data.remarks) result.say(remark);
  result.say("{} seeded draws of a type and, independently, of its quantities from {}, seed {}; {} bins a quantity",
             options.draws.runs,
             options.drawn_from == "density" ? "the densities: sigma inference knows them"
                                             : "densities in proportion to the triangles",
             options.draws.seed, options.bins);
}

/// A quantity as far as classifiers by maxima know it: of each type's values.
LineChart quantity_chart(const Knowledge& quantity, std::size_t type) {
  const auto& [least, greatest, bins, probable, possible] = quantity;
  const std::string& name = probable.to().name();
  LineChart chart{
      .title = name, .x_label = name + ", in the file's unit", .y_label = "possibility", .greatest_y = 1.05};
  const double width = (greatest - least) / static_cast<double>(bins.size());
  for (std::size_t b = 0; b < bins.size(); ++b) chart.x.push_back(least + (static_cast<double>(b) + 0.5) * width);
  const auto add = [&](const std::string& curve, const auto& relation) {
    chart.curves.push_back({.name = curve});
    for (std::size_t b = 0; b < chart.x.size(); ++b) chart.curves.back().values.push_back(relation(type, b));
  };
  add("triangle", possible);
  add("density by the ratio scale", to_possibility(probable, RatioScale{}));
  add("density by Dubois-Prade", to_possibility(probable, DuboisPrade{}));
  return chart;
}

void fill(Report& page, const PerformanceOptions& options, const PerformanceData& data,
          const std::vector<Knowledge>& knowledge, const Scores& scores) {
  constexpr std::size_t most_types = 20, most_quantities = 6;
  page.verdict = {
      fmt::format("{} seeded draws of one of {} types and its quantities, seed {}. The possibilities are those of the "
                  "{} quantities that tell the types apart best.",
                  options.draws.runs, data.types.size(), options.draws.seed, most_quantities)};
  page.panels.emplace_back(accuracy_chart(scores, "quantities"));
  page.chooser = "Type";
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t v = 0; v < knowledge.size(); ++v) order.emplace_back(-telling(knowledge[v].probable), v);
  std::ranges::sort(order);
  for (std::size_t type = 0; type < std::min(most_types, data.types.size()); ++type) {
    View& view = page.views.emplace_back(View{data.types[type], {}});
    for (std::size_t i = 0; i < std::min(most_quantities, order.size()); ++i)
      view.panels.emplace_back(quantity_chart(knowledge[order[i].second], type));
  }
}

void run_performance(const PerformanceOptions& options) {
  const DrawOptions& draws = options.draws;
  refuse_to_overwrite(draws.output, {options.file}, {"curves.csv"});
  ResultFiles files(draws.output);
  const PerformanceData data = read_performance(options.file);
  std::vector<Knowledge> knowledge;
  for (std::size_t v = 0; v < data.variables.size(); ++v) knowledge.push_back(knowledge_of(data, v, options));
  World world{"Which type of aircraft is it?",
              {{contestants(knowledge), [&](std::size_t run) { return drawn(data, knowledge, options, run); }}}};
  world.tell = [&](const std::vector<Scores>& scores, Result& result) {
    say_performance(options, data, result);
    result.facts("file", options.file, "drawn_from", options.drawn_from, "bins", options.bins, "least_possibility",
                 options.least, "runs", draws.runs, "seed", draws.seed);
    result.fact({"remarks"}, data.remarks);
    if (files.report_wanted()) fill(result.page, options, data, knowledge, scores.front());
    add_scores(result, scores.front(), "quantities");
  };
  run_world(world, draws, files);
}

}  // namespace

void add_performance(CLI::App& program, const std::string& command) {
  const auto options = std::make_shared<PerformanceOptions>();
  Subcommand app(program, "performance",
                 "Which type of aircraft is it? From [min, opt, max] and from densities of the same quantities.");
  app.option(
         "data", options->file,
         "A CSV file with type, variable, optimum, minimum, maximum, model and parameters, or - for the standard input")
      .required()
      .type("PERFORMANCE.csv");
  app.option("--draws", options->drawn_from, "What the quantities are drawn from").one_of({"density", "triangle"});
  app.option("--bins", options->bins, "Bins of a quantity").in(2, 10000);
  app.option("--least", options->least, "Possibility of what lies outside [min, max]").number_in(0.0, 1.0);
  add_draws(app, options->draws, command, 60000);  // intervals below a tenth of the differences
  app.run([options] { run_performance(*options); });
}

}  // namespace sigmax::apps
