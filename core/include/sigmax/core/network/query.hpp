#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sigmax/core/likelihood.hpp>
#include <sigmax/core/measure.hpp>
#include <sigmax/core/network.hpp>
#include <sigmax/core/scaled_number.hpp>

namespace sigmax {

/// What is known about the variables of a network: outcomes that were seen, and likelihoods.
///
///     query(network, {"age"}, Evidence{{"speed", "fast"}}.observe(Likelihood{mood, {0.2, 1.0}}))
///
/// Pieces of evidence about one variable multiply. Names and labels are looked up by the verb that takes the evidence.
class Evidence {
 public:
  struct Outcome {
    std::string variable;
    std::string label;
  };
  struct Weights {
    NetworkVariable variable;
    std::vector<ScaledNumber> numbers;  ///< one for every outcome
  };

  Evidence() = default;
  Evidence(std::initializer_list<std::pair<std::string, std::string>> outcomes);

  Evidence& observe(std::string variable, std::string label);

  template <NetworkKind Kind>
  Evidence& observe(const Likelihood<Kind>& likelihood) {
    return observe(likelihood.variable(), likelihood.evidence());
  }

  /// What was seen is only known to be one of the outcomes of an event.
  template <NetworkKind Kind>
  Evidence& observe(const Event<Kind>& event) {
    std::vector<double> members(event.variable().size());
    for (std::size_t i = 0; i < members.size(); ++i) members[i] = event.contains(i) ? 1.0 : 0.0;
    return observe(Likelihood<Kind>{event.variable(), members});
  }

  const std::vector<Outcome>& outcomes() const& { return outcomes_; }
  std::vector<Outcome> outcomes() const&& { return outcomes_; }
  const std::vector<Weights>& likelihoods() const& { return likelihoods_; }
  std::vector<Weights> likelihoods() const&& { return likelihoods_; }

 private:
  Evidence& observe(const NetworkVariable& variable, const kernels::Evidence& likelihood);

  std::vector<Outcome> outcomes_;
  std::vector<Weights> likelihoods_;
};

/// In which order a query eliminated, and what that cost.
struct Elimination {
  std::vector<std::string> order;           ///< the variables in the order in which they were eliminated
  double greatest_table = 1.0;              ///< the most outcomes that one elimination or the answer ranged over
  bool forced = false;                      ///< whether the kinds ever forbade the choice of the least fill
  double greatest_table_if_one_kind = 1.0;  ///< what it would have been had all variables been of one kind
};

/// The numbers of a query, one for each outcome of its variables together: not normalised, and never silently so.
class NetworkAnswer {
 public:
  NetworkAnswer(std::vector<NetworkVariable> variables, std::vector<ScaledNumber> values, ScaledNumber total,
                bool induced, Elimination elimination)
      : variables_(std::move(variables)),
        values_(std::move(values)),
        total_(total),
        induced_(induced),
        elimination_(std::move(elimination)) {}

  /// Views that live as long as the answer; of a temporary, copies. In `values` the last variable varies fastest.
  std::span<const NetworkVariable> variables() const& { return variables_; }
  std::vector<NetworkVariable> variables() const&& { return variables_; }
  std::span<const ScaledNumber> values() const& { return values_; }
  std::vector<ScaledNumber> values() const&& { return values_; }

  /// The number of one outcome, a label per variable. Throws std::invalid_argument if there is no such outcome.
  ScaledNumber operator[](std::initializer_list<std::string_view> labels) const { return values_[index_of(labels)]; }

  /// The ⊕ of all numbers over the variables asked for, again innermost first: β times the evidence.
  ScaledNumber total() const { return total_; }

  /// Whether a variable of another kind had to be eliminated before one that was declared within it. If not, the total
  /// provably is the evidence, query(network, {}, evidence), and one if there is none. If so, it is only (15)–(18).
  bool induced() const { return induced_; }

  /// All numbers divided by their total: the distribution reading.
  std::vector<double> normalized() const;

  /// The distribution reading of the one variable asked for. Throws std::invalid_argument if it is of the other kind,
  /// or not the only one.
  template <NetworkKind Kind>
  Distribution<Kind> normalized() const {
    return sigmax::normalized(only<Kind>(), std::span<const double>(normalized()));
  }

  /// The likelihood reading of the one variable asked for.
  template <NetworkKind Kind>
  Likelihood<Kind> likelihood() const {
    return {only<Kind>(), kernels::UnboundedRow(values_), detail::ByLaw{}};
  }

  const Elimination& elimination() const& { return elimination_; }
  Elimination elimination() const&& { return elimination_; }

 private:
  std::size_t index_of(std::initializer_list<std::string_view> labels) const;
  const NetworkVariable& only() const&;
  template <NetworkKind Kind>
  const Variable<Kind>& only() const& {
    return only().template as<Kind>();
  }

  std::vector<NetworkVariable> variables_;
  std::vector<ScaledNumber> values_;
  ScaledNumber total_;
  bool induced_;
  Elimination elimination_;
};

/// The most memory in bytes that one table of a query may take, unless the caller says otherwise: 1 GiB.
inline constexpr std::size_t default_table_limit = std::size_t{1} << 30;

/// The numbers of `variables` under the evidence: all others eliminated innermost first, those asked for held fixed.
/// The order in which it is done is one of those that provably give the same value, docs/networks.md.
///
/// Throws std::invalid_argument if a variable or an outcome is not the network's or a variable is asked for twice,
/// std::domain_error, naming the evidence, if that excludes every outcome, and std::length_error, naming variables,
/// before any arithmetic, if a table would take more than `table_limit` bytes.
NetworkAnswer query(const RelationNetwork& network, const std::vector<std::string>& variables,
                    const Evidence& evidence = {}, std::size_t table_limit = default_table_limit);

/// What a query would cost: its elimination, without any arithmetic and without a limit.
Elimination cost(const RelationNetwork& network, const std::vector<std::string>& variables,
                 const Evidence& evidence = {});

/// query(network, {name}, evidence) of every variable, in the order of declaration, from one tree of cliques if they
/// are of one kind: little more work than a single query. The total of each is the evidence.
///
/// Of different kinds, those that are not induced share a tree for each kind, with all others eliminated before. Each
/// that is induced has an order of its own, and is a query by itself; as are all where the tree is above the limit.
/// What a tree tells of its elimination is its size, not its order. Throws as `query` does.
std::vector<NetworkAnswer> marginals(const RelationNetwork& network, const Evidence& evidence = {},
                                     std::size_t table_limit = default_table_limit);

}  // namespace sigmax
