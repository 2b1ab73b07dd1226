#pragma once

#include <concepts>

#include <sigmax/core/outcomes.hpp>
#include <sigmax/core/uncertainty.hpp>

namespace sigmax {

/// An uncertain variable with finitely many outcomes (Definitions 2.1 and 2.2).
///
///     const FuzzyVariable age{"age", {"young", "middle", "old"}};
///     const RandomVariable cell{"cell", 100000};   // outcomes "0" … "99999"
///
/// Its kind is checked by the compiler; which variable it is, by name and outcomes, at run time.
template <Uncertainty Kind>
class Variable : public Outcomes {
 public:
  using kind = Kind;
  using Outcomes::Outcomes;

 private:
  template <Uncertainty Other>
  friend Variable<Other> interpreted_as(const Outcomes& outcomes);
  explicit Variable(const Outcomes& outcomes) : Outcomes(outcomes) {}
};

/// Variables of different kinds are not compared: one is never the other.
template <Uncertainty A, Uncertainty B>
  requires(!std::same_as<A, B>)
bool operator==(const Variable<A>&, const Variable<B>&) = delete;

using RandomVariable = Variable<Random>;
using FuzzyVariable = Variable<Fuzzy>;
using OrdinalVariable = Variable<Ordinal>;

}  // namespace sigmax
