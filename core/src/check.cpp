#include <sigmax/core/check.hpp>

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace sigmax::check {
namespace {

std::string shown(double value) {
  std::ostringstream text;
  text.precision(12);
  text << value;
  return text.str();
}

std::string named(const Outcomes& variable, Row row) {
  std::string name = "'" + variable.name() + "'";
  if (row.variable) name += " given " + row.variable->name() + " = '" + row.variable->label(row.index) + "'";
  return name;
}

}  // namespace

void values(const Outcomes& variable, Row row, std::span<const double> values, double greatest) {
  for (std::size_t i = 0; i < values.size(); ++i) value(variable, row, i, values[i], greatest);
}

void value(const Outcomes& variable, Row row, std::size_t index, double value, double greatest) {
  if (!(value >= 0.0 && value <= greatest))
    throw std::invalid_argument("the value of " + named(variable, row) + " at outcome '" + variable.label(index) +
                                "' is " + shown(value) + "; expected a number " +
                                (greatest > 2.0 ? "that is finite and not negative" : "between 0 and 1"));
}

void index(const Outcomes& variable, std::size_t index) {
  if (index >= variable.size()) variable.label(index);  // throws
}

void ascending(const Outcomes& variable, Row row, std::size_t next_allowed, std::size_t index) {
  if (index >= variable.size())
    throw std::invalid_argument(named(variable, row) + " has " + std::to_string(variable.size()) +
                                " outcomes, but a value of outcome " + std::to_string(index) + " was given");
  if (index < next_allowed)
    throw std::invalid_argument("the values of " + named(variable, row) + " are not in ascending order: that of '" +
                                variable.label(index) + "' follows that of '" + variable.label(next_allowed - 1) + "'");
}

void size(const Outcomes& variable, Row row, std::size_t size) {
  if (size != variable.size())
    throw std::invalid_argument(named(variable, row) + " has " + std::to_string(variable.size()) + " outcomes, but " +
                                std::to_string(size) + " values were given");
}

void rows(const Outcomes& to, const Outcomes& from, std::size_t rows) {
  if (rows != from.size())
    throw std::invalid_argument("the relation '" + to.name() + "' given '" + from.name() + "' needs " +
                                std::to_string(from.size()) + " rows, but " + std::to_string(rows) + " were given");
}

void normalized(const Outcomes& variable, Row row, std::span<const double> numbers, const detail::AnyAlgebra& algebra,
                std::string_view name_of_total) {
  size(variable, row, numbers.size());
  values(variable, row, numbers, 1.0 + normalization_tolerance);
  total(variable, row, detail::total(algebra, numbers), name_of_total);
}

void likelihoods(const Outcomes& variable, Row row, std::span<const double> numbers,
                 const detail::AnyAlgebra& algebra) {
  values(variable, row, numbers, algebra.scales ? std::numeric_limits<double>::max() : algebra.one);
}

void weights(const Outcomes& variable, Row row, std::span<const double> weights, const detail::AnyAlgebra& algebra) {
  likelihoods(variable, row, weights, algebra);
  for (const double weight : weights)
    if (weight > 0.0) return;
  throw std::invalid_argument("every weight of variable " + named(variable, row) + " is zero");
}

void log_likelihood(const Outcomes& variable, std::size_t index, double log) {
  if (!(log <= std::numeric_limits<double>::max()))
    throw std::invalid_argument("the log-likelihood of '" + variable.name() + "' at outcome '" + variable.label(index) +
                                "' is not a number below infinity");
}

void total(const Outcomes& variable, Row row, double total, std::string_view name_of_total) {
  if (!(std::abs(total - 1.0) <= normalization_tolerance))
    throw std::invalid_argument("the " + std::string(name_of_total) + " of " + named(variable, row) + " is " +
                                shown(total) + ", not 1");
}

void differ(const Outcomes& expected, const Outcomes& found, std::string_view where) {
  throw std::invalid_argument(std::string(where) + ": " + difference(expected, found));
}

void excluded(const Outcomes& variable, Row row) {
  throw std::domain_error("the evidence excludes every outcome of variable " + named(variable, row));
}

void other_kind(const std::string& variable, std::string_view kind, std::string_view expected) {
  throw std::invalid_argument("variable '" + variable + "' is " + std::string(kind) + ", not " + std::string(expected));
}

void impossible(const std::string& event, std::string_view name_of_measure) {
  throw std::domain_error("the event " + event + " has " + std::string(name_of_measure) +
                          " 0 and cannot be a condition");
}

}  // namespace sigmax::check
