#include "laws/generate.hpp"

namespace measure_test {

/// The laws of measures of events, Definition 2.4: of a probability and a possibility alike.
TYPED_SUITE(MeasureLaws, Random, Fuzzy);

template <Uncertainty Kind>
Event<Kind> any_event(const Variable<Kind>& variable) {
  const auto bits = any([](rc::Random& random) { return random.next(); });
  std::vector<std::size_t> members;
  for (std::size_t i = 0; i < variable.size(); ++i)
    if ((bits >> i) % 2 == 1) members.push_back(i);
  return {variable, members};
}

template <Uncertainty Kind>
Numbers members(const Distribution<Kind>& distribution, const Event<Kind>& event) {
  Numbers result = numbers_of(distribution.values());
  for (std::size_t i = 0; i < result.size(); ++i)
    if (!event.contains(i)) result[i] = 0.0;
  return result;
}

/// A distribution and two events of its variable.
template <Uncertainty Kind>
struct AnyEvents {
  Variable<Kind> x = any_variable<Kind>("x");
  Distribution<Kind> distribution = any_distribution(x);
  Event<Kind> a = any_event(x), b = any_event(x);
};

TYPED_PROPERTY(MeasureLaws, AMeasureIsItsRestatement) {
  const auto [x, distribution, a, b] = AnyEvents<TypeParam>{};
  require_near(measure(distribution, a), static_cast<double>(plain::evidence(
                                             by_kind<TypeParam>, members(distribution, a), Numbers(x.size(), 1.0))));
}

TYPED_PROPERTY(MeasureLaws, AUnionOfDisjointEventsIsTheirCombination) {
  using Algebra = AlgebraOf<TypeParam>;
  const auto [x, distribution, a, b] = AnyEvents<TypeParam>{};
  require_near(measure(distribution, a | b), Algebra::plus(measure(distribution, a), measure(distribution, b & ~a)));
}

TYPED_PROPERTY(MeasureLaws, ConditioningIsTheUpdateByCrispEvidence) {
  const auto [x, distribution, a, b] = AnyEvents<TypeParam>{};
  RC_PRE(measure(distribution, b) > 0.0);
  Numbers crisp(x.size());
  for (std::size_t i = 0; i < crisp.size(); ++i) crisp[i] = b.contains(i) ? 1.0 : 0.0;
  require_near(given(distribution, b).values(),
               plain::update(by_kind<TypeParam>, numbers_of(distribution.values()), crisp));
}

TYPED_PROPERTY(MeasureLaws, EventsAreABooleanAlgebra) {
  const auto x = any_variable<TypeParam>("x");
  const auto a = any_event(x), b = any_event(x), c = any_event(x);
  RC_ASSERT(~(a | b) == (~a & ~b));
  RC_ASSERT((a & (b | c)) == ((a & b) | (a & c)));
  RC_ASSERT((a | (a & b)) == a);
  RC_ASSERT((a & ~a) == empty_event(x));
  RC_ASSERT((a | ~a) == ~empty_event(x));
}

PROPERTY(PossibilityLaws, NecessityIsOneLessThePossibilityOfTheComplement) {  // N(A) = 1 − Π(Aᶜ) = min over Aᶜ of 1 − π
  const auto [y, pi, a, b] = AnyEvents<Fuzzy>{};
  double least = 1.0;
  for (std::size_t i = 0; i < y.size(); ++i)
    if (!a.contains(i)) least = std::min(least, 1.0 - pi[i]);
  RC_ASSERT(necessity(pi, a) == least);
  RC_ASSERT(necessity(pi, a) == 1.0 - possibility(pi, ~a));
  RC_ASSERT(necessity(pi, a & b) == std::min(necessity(pi, a), necessity(pi, b)));
}

PROPERTY(CompatibilityLaws, IsTheShareOfTheObjectsMeasure) {  // (1)
  const std::size_t n = any_size();
  const Numbers object = any_unit_numbers(n), outcome = any_unit_numbers(n), weights = any_unit_numbers(n);
  long double shared = 0, all = 0;
  for (std::size_t f = 0; f < n; ++f) {
    shared += static_cast<long double>(weights[f]) * (object[f] < outcome[f] ? object[f] : outcome[f]);
    all += static_cast<long double>(weights[f]) * object[f];
  }
  RC_PRE(all > 1e-300L);
  require_near(compatibility(object, outcome, weights), static_cast<double>(shared / all));
  RC_ASSERT(compatibility(object, object, weights) == 1.0);
  RC_ASSERT(compatibility(object, Numbers(n, 0.0), weights) == 0.0);
}

}  // namespace measure_test
