#include "laws/generate.hpp"

namespace transform_test {

/// An exponent from ¼ to 4, one among them.
double any_exponent() { return std::exp2(0.5 * static_cast<double>(*rc::gen::inRange(-4, 5))); }

/// Greater stays greater and equal stays equal; numbers that powers or divisions underflow may meet at zero.
void require_same_order(std::span<const double> before, std::span<const double> after) {
  for (std::size_t i = 0; i < before.size(); ++i)
    for (std::size_t k = 0; k < before.size(); ++k) {
      if (before[i] == before[k]) RC_ASSERT(after[i] == after[k]);
      if (before[i] < before[k]) RC_ASSERT(after[i] <= after[k]);
      if (before[i] < before[k] * (1.0 - 1e-9) && before[k] > 1e-60) RC_ASSERT(after[i] < after[k]);
      if (before[i] == 0.0) RC_ASSERT(after[i] == 0.0);
    }
}

/// Π(A) ≥ P(A) for each of the 2ⁿ events.
void require_dominated(const Distribution<Random>& p, const Distribution<Fuzzy>& pi) {
  for (std::size_t bits = 0; bits < (std::size_t{1} << p.size()); ++bits) {
    std::vector<std::size_t> members;
    for (std::size_t i = 0; i < p.size(); ++i)
      if ((bits >> i) % 2 == 1) members.push_back(i);
    RC_ASSERT(possibility(pi, Event{pi.variable(), members}) >= probability(p, Event{p.variable(), members}) - 1e-12);
  }
}

PROPERTY(RatioScaleLaws, ItIsItsRestatement) {
  const RatioScale scale{any_exponent()};
  const auto p = any_distribution(any_variable<Random>("x"));
  const auto pi = to_possibility(p, scale);
  const double greatest = p[index_of_greatest(p.values())];
  for (std::size_t i = 0; i < p.size(); ++i) require_near(pi[i], std::pow(p[i] / greatest, scale.exponent));
  double sum = 0.0;
  for (const double value : pi.values()) sum += std::pow(value, 1.0 / scale.exponent);
  const auto back = to_probability(pi, scale);
  for (std::size_t i = 0; i < p.size(); ++i) require_near(back[i], std::pow(pi[i], 1.0 / scale.exponent) / sum);
}

PROPERTY(DuboisPradeLaws, ItIsItsRestatement) {  // π_i = Σ {p_j : p_j ≤ p_i}
  const auto p = any_distribution(any_variable<Random>("x"));
  const auto pi = to_possibility(p, DuboisPrade{});
  for (std::size_t i = 0; i < p.size(); ++i) {
    long double sum = 0;
    for (const double value : p.values())
      if (value <= p[i]) sum += value;
    require_near(pi[i], static_cast<double>(sum));
  }
}

PROPERTY(DuboisPradeLaws, ItKeepsTheOrderAndDominates) {
  const auto p = any_distribution(any_variable<Random>("x"));
  const auto pi = to_possibility(p, DuboisPrade{});
  require_same_order(p.values(), pi.values());
  require_dominated(p, pi);
}

PROPERTY(DuboisPradeSandriLaws, ItIsItsRestatement) {  // π_i = Σ_j min(p_i, p_j)
  const auto p = any_distribution(any_variable<Random>("x"));
  const auto pi = to_possibility(p, DuboisPradeSandri{});
  for (std::size_t i = 0; i < p.size(); ++i) {
    long double sum = 0;
    for (const double value : p.values()) sum += std::min(value, p[i]);
    require_near(pi[i], static_cast<double>(sum));
  }
}

PROPERTY(DuboisPradeSandriLaws, ItsInverseSharesEveryCutEqually) {  // p_i = ∫_0^{π_i} dλ / |{j : π_j ≥ λ}|
  const auto pi = any_distribution(any_variable<Fuzzy>("y"));
  const auto p = to_probability(pi, DuboisPradeSandri{});
  for (std::size_t i = 0; i < pi.size(); ++i) {
    long double integral = 0;
    for (const double top : pi.values()) {  // the piece of the integral that ends at this value, if it is the first
      if (top > pi[i] || top == 0.0) continue;
      double bottom = 0.0;
      int above = 0, same = 0;
      for (const double value : pi.values()) {
        if (value < top) bottom = std::max(bottom, value);
        above += value >= top;
        same += value == top;
      }
      integral += (static_cast<long double>(top) - bottom) / above / same;
    }
    require_near(p[i], static_cast<double>(integral));
  }
}

PROPERTY(DuboisPradeSandriLaws, EachDirectionKeepsTheOrderAndDominates) {
  const auto p = any_distribution(any_variable<Random>("x"));
  const auto pi = to_possibility(p, DuboisPradeSandri{});
  require_same_order(p.values(), pi.values());
  require_dominated(p, pi);
  const auto given = any_distribution(any_variable<Fuzzy>("y"));
  const auto pignistic = to_probability(given, DuboisPradeSandri{});
  require_same_order(given.values(), pignistic.values());
  require_dominated(pignistic, given);
}

TYPED_SUITE(TransformLaws, Random, Fuzzy);

TYPED_PROPERTY(TransformLaws, ARelationIsTransformedRowByRow) {
  const auto from = any_variable<TypeParam>("from");
  const auto p = any_relation(any_variable<Random>("x"), from);
  const auto pi = any_relation(any_variable<Fuzzy>("y"), from);
  const RatioScale scale{any_exponent()};
  for (std::size_t i = 0; i < from.size(); ++i) {
    RC_ASSERT(numbers_of(to_possibility(p, scale).row(i)) == numbers_of(to_possibility(p.given(i), scale).values()));
    RC_ASSERT(numbers_of(to_possibility(p, DuboisPrade{}).row(i)) ==
              numbers_of(to_possibility(p.given(i), DuboisPrade{}).values()));
    RC_ASSERT(numbers_of(to_probability(pi, DuboisPradeSandri{}).row(i)) ==
              numbers_of(to_probability(pi.given(i), DuboisPradeSandri{}).values()));
  }
}

}  // namespace transform_test
