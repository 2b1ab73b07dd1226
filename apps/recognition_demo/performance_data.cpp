#include "recognition_demo/performance_data.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "support/csv.hpp"
#include "support/input.hpp"

namespace sigmax::apps {
namespace {

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
    return FittedDensity::normal(p[0], p[1]);
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
    return FittedDensity::gamma(p[0], p[1], p[2]);
  }
  if (name == "beta") {
    const auto p = parameters(row, column, 4);
    for (const std::size_t i : {0U, 1U, 3U}) require_positive(p[i]);
    return FittedDensity::beta(p[0], p[1], p[2], p[3]);
  }
  throw row.error(model, "norm, gamma or beta");
}

}  // namespace

FittedDensity FittedDensity::normal(double mean, double deviation) {
  return {boost::math::normal_distribution<>(0.0, 1.0), mean, deviation};
}
FittedDensity FittedDensity::gamma(double shape, double location, double scale) {
  return {boost::math::gamma_distribution<>(shape, 1.0), location, scale};
}
FittedDensity FittedDensity::beta(double a, double b, double location, double scale) {
  return {boost::math::beta_distribution<>(a, b), location, scale};
}

double FittedDensity::cdf(double x) const {
  if (std::isinf(x)) return x > 0.0 ? 1.0 : 0.0;
  const double z = (x - location_) / scale_;
  return std::visit(
      [z](const auto& standard) {
        const auto [least, greatest] = boost::math::support(standard);
        if (z <= least) return 0.0;
        if (z >= greatest) return 1.0;
        return boost::math::cdf(standard, z);
      },
      standard_);
}

double FittedDensity::quantile(double u) const {
  return location_ +
         scale_ * std::visit([u](const auto& standard) { return boost::math::quantile(standard, u); }, standard_);
}

PerformanceData read_performance(const std::string& file) {
  CsvReader reader = open_csv(file);
  const std::size_t type = reader.column("type"), variable = reader.column("variable");
  const std::size_t optimum = reader.column("optimum"), minimum = reader.column("minimum"),
                    maximum = reader.column("maximum");
  const std::size_t model = reader.column("model"), parameter_list = reader.column("parameters");
  PerformanceData data;
  std::map<std::pair<std::string, std::string>, Performance> cells;
  const auto remember = [](std::vector<std::string>& names, std::string name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
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
    throw InputError(message(
        {.where = reader.file(), .found = fmt::format("{} types", data.types.size()), .expected = "at least two"}));
  for (const auto& of_variable : data.variables) {
    auto& row = data.table.emplace_back();
    for (const auto& of_type : data.types) {
      const auto found = cells.find({of_type, of_variable});
      if (found == cells.end())
        throw InputError(
            message({.where = reader.file(),
                     .what = fmt::format("type {} has no quantity {}", in_quotes(of_type), in_quotes(of_variable)),
                     .remedy = "add the row, or remove the quantity from all types"}));
      row.push_back(found->second);
    }
  }
  return data;
}

}  // namespace sigmax::apps
