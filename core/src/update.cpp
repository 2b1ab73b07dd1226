#include <sigmax/core/update.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <variant>

#include "algebras.hpp"
#include "belief.hpp"
#include "exponents.hpp"
#include "kernels/transpose.hpp"
#include "kernels/unbounded_row.hpp"

namespace sigmax::detail {
namespace {

/// values(k) = prior(k) · number(k) up to a common power of two, by plain arithmetic: if all of them lie so close
/// together that no product underflows. Else false, and the values are unspecified.
bool assign_plain_products(std::span<const double> prior, std::span<const ScaledNumber> numbers,
                           std::span<double> values) {
  constexpr std::int64_t depth = 450;  // of each of the two
  if (numbers.empty()) return false;
  const auto [top, range] = exponents_of(numbers);
  double least_prior = 1.0;
  for (const double number : prior) least_prior = number < least_prior && number > 0.0 ? number : least_prior;
  if (range > depth || least_prior < 0x1p-450) return false;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = prior[i] * numbers[i].normal_value_in_units_of(top);
  return true;
}

/// values(k) = product(k) of a scaling algebra, up to a common power of two, so that none underflows for being small.
template <class Product>
void assign_in_proportion(std::span<double> values, const Product& product) {
  ScaledNumber top;
  for (std::size_t k = 0; k < values.size(); ++k) top = std::max(top, product(k));
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = product(k).value_in_units_of(top.exponent());
}

/// Multiplies the numbers of a row by those of the prior, up to a common factor, so that none underflows.
template <class A, class Entries>
void weigh(A algebra, const Prior& prior, const Entries& row, std::span<double> values) {
  if (prior.numbers.empty()) {
    double greatest = log_zero;
    for (std::size_t k = 0; k < row.size(); ++k) {
      values[k] = prior.logs[row.index(k)] + std::log(row.value(k));
      greatest = std::max(greatest, values[k]);
    }
    for (double& value : values) value = value == log_zero ? 0.0 : std::exp(value - greatest);
  } else if constexpr (Scaling<A>) {
    assign_in_proportion(
        values, [&](std::size_t k) { return ScaledNumber{prior.numbers[row.index(k)]} * ScaledNumber{row.value(k)}; });
  } else {
    for (std::size_t k = 0; k < row.size(); ++k) values[k] = algebra.times(prior.numbers[row.index(k)], row.value(k));
  }
}

template <class A>
bool is_nothing(A algebra, std::span<const double> joint) {
  return std::all_of(joint.begin(), joint.end(), [algebra](double value) { return value == algebra.zero(); });
}

template <class A, class Rows>
void condition_rows(A algebra, Rows& rows, std::vector<std::size_t>& unreachable) {
  for (std::size_t r = 0; r < rows.rows(); ++r) {
    const std::span<double> row = rows.values(r);
    if (is_nothing(algebra, row))
      unreachable.push_back(r);
    else
      condition(algebra, row);
  }
  if (!unreachable.empty()) rows.fill_rows(unreachable, equal_share(algebra, rows.columns()));
}

}  // namespace

double update_logs(const Outcomes& variable, std::span<const double> prior, std::span<const double> likelihood,
                   const AnyAlgebra& algebra, std::span<double> result) {
  const double *const prior_logs = prior.data(), *const likelihood_logs = likelihood.data();
  return with_scaling(algebra, [&](auto a) {
    return assign_logs(a, variable, result, [=](std::size_t i) { return prior_logs[i] + likelihood_logs[i]; });
  });
}

Table updated(const Outcomes& variable, std::span<const double> prior, const kernels::Evidence& likelihood,
              const AnyAlgebra& algebra) {
  Table result(1, prior.size());
  const std::span<double> joint = result.values();
  with(algebra, [&]<class A>(A a) {
    if constexpr (!Scaling<A>)
      for (std::size_t i = 0; i < joint.size(); ++i) joint[i] = a.times(prior[i], likelihood.logs_or_plain[i]);
    else if (!assign_plain_products(prior, likelihood.numbers, joint))
      assign_in_proportion(joint, [&](std::size_t i) { return ScaledNumber{prior[i]} * number_of(likelihood, i); });
    if (is_nothing(a, joint)) check::excluded(variable);
    condition(a, joint);
  });
  return result;
}

void invert(const AnyRows& rows, const Prior& prior, const AnyAlgebra& algebra, AnyRows& result,
            std::vector<std::size_t>& unreachable) {
  kernels::transpose(rows, result);
  unreachable.clear();
  with(algebra, [&](auto a) {
    const auto invert_columns = [&](auto& columns) {
      for (std::size_t to = 0; to < columns.rows(); ++to) weigh(a, prior, columns.entries(to), columns.values(to));
      condition_rows(a, columns, unreachable);
    };
    if (Table* const table = std::get_if<Table>(&result))
      invert_columns(*table);
    else
      invert_columns(std::get<SparseRows>(result));  // columns are never banded
  });
}

void condition_rows(const AnyAlgebra& algebra, Table& rows, std::vector<std::size_t>& unreachable) {
  with(algebra, [&](auto a) { condition_rows(a, rows, unreachable); });
}

}  // namespace sigmax::detail
