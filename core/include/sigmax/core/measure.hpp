#pragma once

#include <cstddef>
#include <initializer_list>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sigmax/core/distribution.hpp>

namespace sigmax {

/// An event of one variable: a set A of its outcomes.
///
///     const Event young{age, {"child", "youth"}};
///     const Event grown = ~young;   // complement; | is union, & intersection
template <Uncertainty Kind>
class Event {
 public:
  using kind = Kind;

  /// The event of these outcomes. Throws std::invalid_argument, naming the variable, if it has no such outcome.
  Event(Variable<Kind> variable, std::initializer_list<std::string_view> labels)
      : variable_(std::move(variable)), members_(variable_.size(), false) {
    for (const auto label : labels) members_[variable_.index_of(label)] = true;
  }
  Event(Variable<Kind> variable, std::initializer_list<std::size_t> indices)
      : Event(std::move(variable), std::span(indices.begin(), indices.size())) {}
  Event(Variable<Kind> variable, std::span<const std::size_t> indices)
      : variable_(std::move(variable)), members_(variable_.size(), false) {
    for (const std::size_t index : indices) {
      check::index(variable_, index);
      members_[index] = true;
    }
  }

  const Variable<Kind>& variable() const& { return variable_; }
  Variable<Kind> variable() const&& { return variable_; }

  /// Throws std::invalid_argument if the variable has no such outcome.
  bool contains(std::size_t index) const {
    check::index(variable_, index);
    return members_[index];
  }
  bool contains(std::string_view label) const { return members_[variable_.index_of(label)]; }

  /// "age in {child, youth}", for messages.
  std::string description() const {
    std::string list;
    for (std::size_t i = 0; i < members_.size(); ++i)
      if (members_[i]) list += (list.empty() ? "" : ", ") + variable_.label(i);
    return variable_.name() + " in {" + list + "}";
  }

  /// Both throw std::invalid_argument, naming both, for events of different variables.
  friend Event operator|(Event a, const Event& b) {
    check::same(a.variable_, b.variable_, "union");
    for (std::size_t i = 0; i < a.members_.size(); ++i) a.members_[i] = a.members_[i] || b.members_[i];
    return a;
  }
  friend Event operator&(Event a, const Event& b) {
    check::same(a.variable_, b.variable_, "intersection");
    for (std::size_t i = 0; i < a.members_.size(); ++i) a.members_[i] = a.members_[i] && b.members_[i];
    return a;
  }
  friend Event operator~(Event a) {
    a.members_.flip();
    return a;
  }
  friend bool operator==(const Event& a, const Event& b) {
    return a.variable_ == b.variable_ && a.members_ == b.members_;
  }

 private:
  Variable<Kind> variable_;
  std::vector<bool> members_;
};

/// The event that no outcome belongs to, ∅. Its complement has every outcome, Ψ or Ω.
template <Uncertainty Kind>
Event<Kind> empty_event(Variable<Kind> variable) {
  return {std::move(variable), std::span<const std::size_t>{}};
}

/// How much of a distribution an event holds: ⊕ over its outcomes. `possibility` or `probability` for generic code.
/// Throws std::invalid_argument, naming both, if the event is of another variable.
template <Uncertainty Kind>
double measure(const Distribution<Kind>& distribution, const Event<Kind>& event) {
  check::same(distribution.variable(), event.variable(), "measure");
  double sum = AlgebraOf<Kind>::zero();
  for (std::size_t i = 0; i < distribution.size(); ++i)
    if (event.contains(i)) sum = AlgebraOf<Kind>::plus(sum, distribution[i]);
  return sum;
}

/// P(A) = Σ_{x ∈ A} p(x).
template <Uncertainty Kind>
  requires(!SelectiveAlgebra<AlgebraOf<Kind>>)
double probability(const Distribution<Kind>& distribution, const Event<Kind>& event) {
  return measure(distribution, event);
}

/// Π(A) = max_{x ∈ A} π(x), Definition 2.4: how far A is consistent with what is known.
template <Uncertainty Kind>
  requires SelectiveAlgebra<AlgebraOf<Kind>>
double possibility(const Distribution<Kind>& distribution, const Event<Kind>& event) {
  return measure(distribution, event);
}

/// N(A) = 1 − Π(Aᶜ): how far A is implied by what is known. N(A) > 0 only if Π(A) = 1.
template <Uncertainty Kind>
  requires SelectiveAlgebra<AlgebraOf<Kind>>
double necessity(const Distribution<Kind>& distribution, const Event<Kind>& event) {
  return 1.0 - measure(distribution, ~event);
}

/// The distribution when an event is known to have come true, which every conditional event is a measure of:
///
///     possibility(given(belief, grown), old)   // Π(A|B) = Π(A ∩ B) / Π(B)
///     necessity(given(belief, grown), old)     // N(A|B) = 1 − Π(Aᶜ|B)
///     probability(given(weather, wet), snow)   // P(A|B) = P(A ∩ B) / P(B)
///
/// Throws std::domain_error, naming the event, if its measure is zero.
template <Uncertainty Kind>
  requires(ScalingAlgebra<AlgebraOf<Kind>>)
Distribution<Kind> given(const Distribution<Kind>& distribution, const Event<Kind>& event) {
  if (measure(distribution, event) == 0.0) check::impossible(event.description(), Kind::measure);
  Table left(1, distribution.size());
  for (std::size_t i = 0; i < left.size(); ++i) left(0, i) = event.contains(i) ? distribution[i] : 0.0;
  return normalized(distribution.variable(), left.values());
}

/// Compatibility (1) of graded features, degree(f_X ⊆ f_x) = Σ μ min(f_X, f_x) / Σ μ f_X. `object` and `outcome` are
/// the degrees to which X and the concept x have each feature; `measure` is the weight μ of the feature.
///
/// Raw: it need not reach one for any outcome. To make it a distribution is a step of its own:
///
///     normalized(age, std::vector{compatibility(man, young), compatibility(man, middle_aged)})
///
/// Throws std::invalid_argument if the lengths differ, a degree is outside [0, 1], a measure is negative or not
/// finite, or X has no feature of positive measure.
double compatibility(std::span<const double> object, std::span<const double> outcome, std::span<const double> measure);

/// Compatibility (1) of sets of features (intensions): |f_X ∩ f_x| / |f_X|, where |·| sums `measure(feature)`.
template <class Feature, class Measure>
double compatibility(const std::set<Feature>& object, const std::set<Feature>& outcome, const Measure& measure) {
  std::vector<double> shared, measures;
  for (const Feature& feature : object) {
    shared.push_back(outcome.contains(feature) ? 1.0 : 0.0);
    measures.push_back(measure(feature));
  }
  return compatibility(std::vector<double>(object.size(), 1.0), shared, measures);
}

/// The same, where |·| counts.
template <class Feature>
double compatibility(const std::set<Feature>& object, const std::set<Feature>& outcome) {
  return compatibility(object, outcome, [](const Feature&) { return 1.0; });
}

}  // namespace sigmax
