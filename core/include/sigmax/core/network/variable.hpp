#pragma once

#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include <sigmax/core/check.hpp>
#include <sigmax/core/variable.hpp>

namespace sigmax {

namespace detail {

template <class... Kinds>
struct KindList {
  using AnyVariable = std::variant<Variable<Kinds>...>;
  template <class Kind>
  static constexpr bool has = (std::same_as<Kind, Kinds> || ...);
  static constexpr std::string_view names[] = {Kinds::name...};
  static const Outcomes& outcomes_of(const AnyVariable& variable) {
    const Outcomes* outcomes = nullptr;
    ((outcomes = outcomes ? outcomes : std::get_if<Variable<Kinds>>(&variable)), ...);
    return *outcomes;
  }
};

}  // namespace detail

/// The kinds that can meet in one network; all that a network knows of them. They are mixable: their ⊗ is the product.
using NetworkKinds = detail::KindList<Random, Fuzzy>;

template <class Kind>
concept NetworkKind = NetworkKinds::has<Kind> && ScalingAlgebra<AlgebraOf<Kind>>;

/// A variable whose kind is known only when the program runs.
class NetworkVariable {
 public:
  template <NetworkKind Kind>
  NetworkVariable(Variable<Kind> variable) : variable_(std::move(variable)) {}

  /// Calls `action` with the Variable<Kind> that it is.
  template <class Action>
  decltype(auto) visit(const Action& action) const {
    return std::visit(action, variable_);
  }

  /// The number of its kind among the kinds of networks.
  std::size_t kind() const { return variable_.index(); }

  template <NetworkKind Kind>
  bool is() const {
    return std::holds_alternative<Variable<Kind>>(variable_);
  }

  /// Throws std::invalid_argument if the variable is of another kind.
  template <NetworkKind Kind>
  const Variable<Kind>& as() const& {
    if (const auto* const variable = std::get_if<Variable<Kind>>(&variable_)) return *variable;
    check::other_kind(name(), kind_name(), Kind::name);
  }

  template <NetworkKind Kind>
  Variable<Kind> as() const&& {
    const NetworkVariable& named = *this;
    return named.as<Kind>();
  }

  /// "random" or "fuzzy".
  std::string_view kind_name() const { return NetworkKinds::names[kind()]; }
  const Outcomes& outcomes() const& { return NetworkKinds::outcomes_of(variable_); }
  Outcomes outcomes() const&& { return NetworkKinds::outcomes_of(variable_); }
  const std::string& name() const& { return outcomes().name(); }
  std::string name() const&& { return outcomes().name(); }
  std::size_t size() const { return outcomes().size(); }
  std::string label(std::size_t index) const { return outcomes().label(index); }
  std::size_t index_of(std::string_view label) const { return outcomes().index_of(label); }

  friend bool operator==(const NetworkVariable& a, const NetworkVariable& b) {
    return a.kind() == b.kind() && a.outcomes() == b.outcomes();
  }

 private:
  NetworkKinds::AnyVariable variable_;
};

}  // namespace sigmax
