#pragma once

#include "support/plain.hpp"

/// Generated cases for the laws. Zeros, ones, repeated maxima and subnormal numbers are as frequent as the rest, and
/// the first cases of every property have a single outcome.
namespace sigmax::laws {

using plain::By;
using support::require_near;

/// How the plain restatements eliminate a variable of this kind.
template <class Kind>
inline constexpr By by_kind = std::is_same_v<Kind, Random> ? By::sum : By::max;

inline double unit_number(rc::Random& random) {
  const auto bits = random.next();
  switch (bits % 8) {
    case 0:
      return 0.0;
    case 1:
      return least_subnormal * static_cast<double>(1 + (bits >> 40) % 1000);
    case 2:
      return 1.0;
    case 3:
      return 0.5;
    case 4:
      return 1e-9;
    default:
      return static_cast<double>(bits >> 11) * 0x1p-53;
  }
}

inline Numbers unit_numbers(rc::Random& random, std::size_t n) {
  Numbers numbers(n);
  for (double& number : numbers) number = unit_number(random);
  return numbers;
}

/// Numbers whose sum or maximum is one.
inline Numbers normalized_numbers(rc::Random& random, By by, std::size_t n) {
  Numbers numbers = unit_numbers(random, n);
  double divisor = 0.0;
  for (const double number : numbers) divisor = by == By::sum ? divisor + number : std::max(divisor, number);
  if (divisor == 0.0) divisor = numbers[random.next() % n] = 1.0;
  for (double& number : numbers) number /= divisor;
  return numbers;
}

/// A value drawn by `draw(random)`, the property's own; shown with the counterexample.
template <class Draw>
auto any(const Draw& draw) {
  using Value = std::invoke_result_t<Draw, rc::Random&>;
  return *rc::Gen<Value>([draw](const rc::Random& random, int /*size*/) {
    rc::Random own = random;
    return rc::shrinkable::just(draw(own));
  });
}

inline double any_unit_number() {
  return any([](rc::Random& random) { return unit_number(random); });
}
inline Numbers any_unit_numbers(std::size_t n) {
  return any([n](rc::Random& random) { return unit_numbers(random, n); });
}
inline Numbers any_normalized_numbers(By by, std::size_t n) {
  return any([=](rc::Random& random) { return normalized_numbers(random, by, n); });
}
inline Rows any_normalized_rows(By by, std::size_t rows, std::size_t columns) {
  return any([=](rc::Random& random) {
    Rows result(rows);
    for (Numbers& row : result) row = normalized_numbers(random, by, columns);
    return result;
  });
}
inline Rows any_unit_rows(std::size_t rows, std::size_t columns) {
  return any([=](rc::Random& random) {
    Rows result(rows);
    for (Numbers& row : result) row = unit_numbers(random, columns);
    return result;
  });
}

/// 1 to 6 outcomes: tables of one number up to more than Table keeps inline.
inline std::size_t any_size() { return *rc::gen::inRange<std::size_t>(1, 7); }

template <Uncertainty Kind>
Variable<Kind> any_variable(std::string name) {
  return {std::move(name), any_size()};
}
template <Uncertainty Kind>
Distribution<Kind> any_distribution(const Variable<Kind>& variable) {
  return {variable, any_normalized_numbers(by_kind<Kind>, variable.size())};
}
template <Uncertainty To, Uncertainty From>
Relation<To, From> any_relation(const Variable<To>& to, const Variable<From>& from) {
  return {to, from, any_normalized_rows(by_kind<To>, from.size(), to.size())};
}

template <Uncertainty To, Uncertainty From>
struct AnyJoint {
  Variable<To> x = any_variable<To>("x");
  Variable<From> y = any_variable<From>("y");
  Relation<To, From> relation = any_relation(x, y);
  Distribution<From> prior = any_distribution(y);
};
/// Two relations that can be composed.
template <Uncertainty To, Uncertainty Middle, Uncertainty From>
struct AnyRelations {
  Variable<To> x = any_variable<To>("x");
  Variable<Middle> m = any_variable<Middle>("m");
  Variable<From> y = any_variable<From>("y");
  Relation<To, Middle> left = any_relation(x, m);
  Relation<Middle, From> right = any_relation(m, y);
};

inline Numbers numbers_of(std::span<const double> values) { return {values.begin(), values.end()}; }

inline Rows rows_of(const Table& table) {
  Rows rows;
  for (std::size_t i = 0; i < table.rows(); ++i) rows.push_back(numbers_of(table.row(i)));
  return rows;
}
inline Table table_of(const Rows& rows) {
  Table table(rows.size(), rows.front().size());
  for (std::size_t i = 0; i < rows.size(); ++i) std::copy(rows[i].begin(), rows[i].end(), table.row(i).begin());
  return table;
}

inline void require_near(const Rows& found, const Rows& expected) {
  RC_ASSERT(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) require_near(found[i], expected[i]);
}

/// A generated order of n outcomes.
inline std::vector<std::size_t> any_order(std::size_t n) {
  return any([n](rc::Random& random) {
    std::vector<std::size_t> order(n);
    for (std::size_t i = 0; i < n; ++i) order[i] = i;
    for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[random.next() % i]);
    return order;
  });
}

}  // namespace sigmax::laws
