#include "arrays.hpp"
#include "kinds.hpp"

#include <span>
#include <vector>

#include <pybind11/stl.h>

namespace sigmax::python {

void bind_verbs(py::module_& module);

namespace {

/// The kind of the variable that a table of the right is a function of, and its name in messages.
template <class Right>
constexpr std::string_view left_kind() {
  if constexpr (requires { typename Right::to_kind; })
    return Right::to_kind::name;
  else
    return Right::kind::name;
}
template <class Left>
constexpr std::string_view right_kind() {
  if constexpr (requires { typename Left::from_kind; })
    return Left::from_kind::name;
  else
    return Left::kind::name;
}

py::object compose_any(py::handle left, py::handle right) {
  constexpr auto lefts = Relations{} + InducedRelations{} + Likelihoods{};
  constexpr auto rights = Relations{} + InducedRelations{} + Distributions{} + InducedDistributions{};
  return visit(lefts, left, "compose: expected a relation or a likelihood", [&]<class L>(const L& l) {
    return visit(rights, right, "compose: expected a relation or a distribution",
                 [&]<class R>(const R& r) -> py::object {
                   if constexpr (requires { compose(l, r); })
                     return py::cast(unlocked([&] { return compose(l, r); }));
                   else
                     refuse("compose", right_kind<L>(), "condition or likelihood on the left", left_kind<R>(),
                            "variable on the right");
                 });
  });
}

py::object update_any(py::handle prior, py::handle likelihood) {
  return visit(Distributions{}, prior, "update: expected a distribution", [&]<class P>(const P& p) {
    return visit(Likelihoods{}, likelihood, "update: expected a likelihood", [&]<class L>(const L& l) -> py::object {
      if constexpr (requires { update(p, l); })
        return py::cast(update(p, l));
      else
        refuse("update", P::kind::name, "prior", L::kind::name, "likelihood");
    });
  });
}

py::object invert_any(py::handle relation, py::handle prior) {
  return visit(Relations{}, relation, "invert: expected a relation", [&]<class R>(const R& r) {
    return visit(Distributions{}, prior, "invert: expected a distribution", [&]<class P>(const P& p) -> py::object {
      if constexpr (requires { invert(r, p); }) {
        return inverse_of(unlocked([&] { return invert(r, p); }));
      } else {
        refuse("invert", R::from_kind::name, "condition", P::kind::name, "prior");
      }
    });
  });
}

void bind_transforms(py::module_& module) {
  py::class_<RatioScale>(module, "RatioScale", "Klir's ratio scale: π ∝ p^exponent, (34), and its inverse, (35).")
      .def(py::init([](double exponent) { return RatioScale{exponent}; }), py::arg("exponent") = 1.0);
  py::class_<DuboisPrade>(module, "DuboisPrade", "π_i = Σ {p_j : p_j ≤ p_i}: the most specific that is consistent.")
      .def(py::init());
  py::class_<DuboisPradeSandri>(module, "DuboisPradeSandri", "π_i = Σ_j min(p_i, p_j); its inverse is pignistic.")
      .def(py::init());
  function(module, "to_possibility(p, method, /)",
           "The possibilities that a method makes of probabilities, row by row.",
           [](py::handle p, py::handle method_of) {
             using Methods = Types<RatioScale, DuboisPrade, DuboisPradeSandri>;
             using Probable = Types<Distribution<Random>, Relation<Random, Random>, Relation<Random, Fuzzy>>;
             return visit(Methods{}, method_of, "to_possibility: expected a transform", [&](const auto& by) {
               return visit(Probable{}, p, "to_possibility: expected a random distribution or relation",
                            [&](const auto& random) { return to_possibility(random, by); });
             });
           });
  function(
      module, "to_probability(pi, method, /)", "The probabilities that a method makes of possibilities, row by row.",
      [](py::handle pi, py::handle method_of) {
        using Methods = Types<RatioScale, DuboisPradeSandri>;
        using Possible = Types<Distribution<Fuzzy>, Relation<Fuzzy, Random>, Relation<Fuzzy, Fuzzy>>;
        return visit(Methods{}, method_of, "to_probability: expected an invertible transform", [&](const auto& by) {
          return visit(Possible{}, pi, "to_probability: expected a fuzzy distribution or relation",
                       [&](const auto& fuzzy) { return to_probability(fuzzy, by); });
        });
      });
  function(module, "with_fuzzy_condition(relation, /)", "The same rows, the condition read as fuzzy: (49) as (50).",
           [](py::handle relation) {
             return visit(MixedRelations{}, relation, "with_fuzzy_condition: expected a random or fuzzy relation",
                          [](const auto& r) { return with_fuzzy_condition(r); });
           });
}

}  // namespace

void bind_verbs(py::module_& module) {
  function(
      module, "compose(left, right, /)",
      "`left` after `right`: the variable between them is eliminated by the ⊕ of its kind, (5)–(7), (15)–(18).\n\n"
      "Of one kind the result is a relation or distribution, else only induced. A likelihood is carried back, (42).",
      &compose_any);
  function(module, "update(prior, likelihood, /)",
           "Posterior: the prior times the likelihood, divided by the ⊕ of the prior's kind, (8), (19), (20).\n\n"
           "ValueError if the evidence excludes every outcome that the prior left.",
           &update_any);
  function(
      module, "invert(relation, prior, /)",
      "The relation read backwards under a prior of its condition, (43), (46), (52), (54).\n\n"
      "Returns Inverse(relation, unreachable): rows of outcomes that nothing reaches are uninformative, and listed.",
      &invert_any);
  bind_transforms(module);
}

}  // namespace sigmax::python
