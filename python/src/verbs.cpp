#include "arrays.hpp"
#include "kinds.hpp"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

namespace sigmax::python {
namespace {

/// The function for whatever else it is called with.
void refuse_others(py::module_& module, const std::string& signature) {
  const std::string name = signature.substr(0, signature.find('('));
  module.def(name.c_str(), [name](const py::args& arguments) { refuse(name, arguments); });
}

/// A function of two objects, of all types for which it compiles. Other threads run meanwhile.
template <class Lefts, class Rights, class Call>
void verb(py::module_& module, const char* signature, const char* doc, Lefts, Rights, const Call& call) {
  Lefts::for_each([&]<class L>() {
    Rights::for_each([&]<class R>() {
      if constexpr (std::invocable<const Call&, const L&, const R&>)
        function(
            module, signature, doc, [call](const L& left, const R& right) { return call(left, right); },
            py::call_guard<py::gil_scoped_release>());
    });
  });
  refuse_others(module, signature);
}

/// A function of a distribution and an event, which is a sequence of outcomes; for the kinds that have it.
template <class Call>
void measure(py::module_& module, const char* signature, const char* doc, const Call& call) {
  Distributions::for_each([&]<class D>() {
    using E = Event<typename D::kind>;
    if constexpr (std::invocable<const Call&, const D&, const E&>)
      function(module, signature, doc, [call](const D& distribution, const std::vector<Key>& outcomes) {
        std::vector<std::size_t> members;
        for (const Key& each : outcomes) members.push_back(index_of(distribution.variable(), each));
        return call(distribution, E(distribution.variable(), std::span<const std::size_t>(members)));
      });
  });
  refuse_others(module, signature);
}

py::object match_any(const Array& none, const Array& weights, const std::string& pattern,
                     const std::string& permutation) {
  expect_shape(none, "log_none", -1);
  expect_shape(weights, "log_weights", none.size(), -1);
  Choices choices;
  for (const auto& row : rows_of(weights)) {
    choices.add_row(none.data()[choices.rows()]);
    for (std::size_t j = 0; j < row.size(); ++j)
      if (row[j] != log_zero) choices.add(j, row[j]);
  }
  for (const std::string& kind : {pattern, permutation})
    if (kind != Random::name && kind != Fuzzy::name)
      throw py::value_error("match: expected 'random' or 'fuzzy', found '" + kind + "'");
  const auto by = [&]<class Pattern>(Pattern) {
    return permutation == Fuzzy::name ? &match<Pattern, Fuzzy> : &match<Pattern, Random>;
  };
  const auto matching = pattern == Fuzzy::name ? by(Fuzzy{}) : by(Random{});
  const Matching found = unlocked([&] { return matching(choices, {}); });
  Array log_none = unknown(none.size()), log_marginals = unknown(weights.shape(0), weights.shape(1));
  std::fill_n(log_marginals.mutable_data(), log_marginals.size(), log_zero);
  std::vector<std::int64_t> best;
  for (std::size_t i = 0; i < choices.rows(); ++i) {
    best.push_back(found.best[i] == no_column ? -1 : static_cast<std::int64_t>(found.best[i]));
    log_none.mutable_at(i) = found.marginals.none(i);
    const ListOfEntries entries = found.marginals.entries(i);
    for (std::size_t k = 0; k < entries.columns.size(); ++k)
      log_marginals.mutable_at(i, entries.columns[k]) = entries.values[k];
  }
  return record(py::arg("log_total") = found.log_total, py::arg("log_best") = found.log_best,
                py::arg("best") = array_of(best), py::arg("log_marginals") = log_marginals,
                py::arg("log_none") = log_none, py::arg("exact") = found.exact);
}

}  // namespace

void bind_verbs(py::module_& module) {
  const auto conditionals = Relations{} + induced(Relations{});
  verb(module, "compose(left, right, /)",
       "`left` after `right`: the variable between them is eliminated by the ⊕ of its kind, (5)–(7), (15)–(18).\n\n"
       "Of one kind the result is a relation or distribution, else only induced. A likelihood is carried back, (42).",
       conditionals + Likelihoods{}, conditionals + Distributions{} + induced(Distributions{}),
       [](const auto& left, const auto& right) -> decltype(compose(left, right)) { return compose(left, right); });
  verb(module, "update(prior, likelihood, /)",
       "Posterior: the prior times the likelihood, divided by the ⊕ of the prior's kind, (8), (19), (20).\n\n"
       "ValueError if the evidence excludes every outcome that the prior left.",
       Distributions{}, Likelihoods{},
       [](const auto& prior, const auto& seen) -> decltype(update(prior, seen)) { return update(prior, seen); });
  verb(module, "invert(relation, prior, /)",
       "The relation read backwards under a prior of its condition, (43), (46), (52), (54).\n\n"
       "Returns (relation, unreachable): rows of outcomes that nothing reaches are uninformative, and listed.",
       Relations{}, Distributions{},
       [](const auto& relation,
          const auto& prior) -> decltype(std::pair(invert(relation, prior).relation, std::vector<std::size_t>())) {
         auto inverse = invert(relation, prior);
         return {std::move(inverse.relation), std::move(inverse.unreachable)};
       });
  measure(module, "probability(distribution, outcomes, /)", "P(A) = Σ p(x) over the event A.",
          [](const auto& d, const auto& e) -> decltype(probability(d, e)) { return probability(d, e); });
  measure(module, "possibility(distribution, outcomes, /)", "Π(A) = max π(x) over the event A, Definition 2.4.",
          [](const auto& d, const auto& e) -> decltype(possibility(d, e)) { return possibility(d, e); });
  measure(module, "necessity(distribution, outcomes, /)", "N(A) = 1 − Π(not A): how far the event A is implied.",
          [](const auto& d, const auto& e) -> decltype(necessity(d, e)) { return necessity(d, e); });

  py::class_<RatioScale>(module, "RatioScale", "Klir's ratio scale: π ∝ p^exponent, (34), and its inverse, (35).")
      .def(py::init([](double exponent) { return RatioScale{exponent}; }), py::arg("exponent") = 1.0);
  py::class_<DuboisPrade>(module, "DuboisPrade", "π_i = Σ {p_j : p_j ≤ p_i}: the most specific that is consistent.")
      .def(py::init());
  py::class_<DuboisPradeSandri>(module, "DuboisPradeSandri", "π_i = Σ_j min(p_i, p_j); its inverse is pignistic.")
      .def(py::init());
  using Methods = Types<RatioScale, DuboisPrade, DuboisPradeSandri>;
  verb(module, "to_possibility(p, method, /)", "The possibilities that a method makes of probabilities, row by row.",
       Distributions{} + Relations{}, Methods{},
       [](const auto& p, const auto& by) -> decltype(to_possibility(p, by)) { return to_possibility(p, by); });
  verb(module, "to_probability(pi, method, /)", "The probabilities that a method makes of possibilities, row by row.",
       Distributions{} + Relations{}, Methods{},
       [](const auto& pi, const auto& by) -> decltype(to_probability(pi, by)) { return to_probability(pi, by); });

  function(
      module, "match(log_none, log_weights, pattern, permutation, /)",
      "Marginals of all events that give each row a column or none, and no column twice.\n\n"
      "Weights are of no column, `log_none` (rows,), and of each, `log_weights` (rows, columns); −inf excludes.\n"
      "Kinds of pattern and permutation: random, random is JPDA; random, fuzzy is JPDA*; fuzzy, fuzzy is GNN.\n"
      "Returns log_marginals (rows, columns), log_none (rows,), log_total of all events, the best of them (rows,)\n"
      "with −1 for none, log_best, and exact, which is false if a cluster had too many states.",
      &match_any);
}

}  // namespace sigmax::python
