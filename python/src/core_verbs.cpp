#include "arrays.hpp"
#include "kinds.hpp"

#include <set>
#include <span>
#include <vector>

#include <pybind11/operators.h>
#include <pybind11/stl.h>

namespace sigmax::python {

void bind_matching(py::module_& module);
void bind_core_verbs(py::module_& module);

namespace {

template <class Outer, class Inner>
using HybridOf = HybridDistribution<Outer, Inner>;
using Hybrids =
    Types<HybridOf<Random, Random>, HybridOf<Random, Fuzzy>, HybridOf<Fuzzy, Random>, HybridOf<Fuzzy, Fuzzy>>;

/// The namedtuple Inverse(relation, unreachable).
template <class I>
py::object inverse(I result) {
  const py::object type = py::module_::import("sigmax._sigmax").attr("Inverse");
  return type(py::cast(std::move(result.relation)), py::cast(std::move(result.unreachable)));
}

void bind_compose(py::module_& module) {
  const auto compose_any = [](const py::object& left, const py::object& right) {
    return visit(Relations{} + InducedRelations{} + Likelihoods{}, left, "compose: expected a relation or a likelihood",
                 [&]<class Left>(const Left& l) {
                   return visit(Relations{} + InducedRelations{} + Distributions{} + InducedDistributions{} + Beliefs{},
                                right, "compose: expected a relation, a distribution or a belief",
                                [&]<class Right>(const Right& r) -> py::object {
                                  if constexpr (requires { compose(l, r); }) {
                                    return py::cast(unlocked([&] { return compose(l, r); }));
                                  } else if constexpr (requires {
                                                         typename Left::from_kind;
                                                         typename Right::to_kind;
                                                       }) {
                                    mixed<typename Left::from_kind, typename Right::to_kind>(
                                        "compose", "condition on the left", "relation on the right");
                                  } else if constexpr (requires { typename Left::from_kind; }) {
                                    mixed<typename Left::from_kind, typename Right::kind>(
                                        "compose", "condition on the left", "distribution on the right");
                                  } else if constexpr (requires { typename Right::to_kind; }) {
                                    mixed<typename Left::kind, typename Right::to_kind>("compose", "likelihood",
                                                                                        "relation");
                                  } else {
                                    throw py::type_error("compose: a likelihood is composed with a relation only");
                                  }
                                });
                 });
  };
  module.def("compose", compose_any, py::arg("left"), py::arg("right"), R"(compose(left, right)
--

`left` after `right`: the variable between them is eliminated by the ⊕ of its kind, (5)–(7), (15)–(18).

Of one kind the result is a relation or a distribution, else it is only induced. A likelihood on the left is carried
back through the relation, (42), (45); a belief on the right makes a transition, (51), (53).)");
}

void bind_update(py::module_& module) {
  const auto update_any = [](const py::object& prior, const py::object& likelihood) {
    return visit(Distributions{} + Beliefs{}, prior, "update: expected a distribution or a belief",
                 [&]<class P>(const P& p) {
                   return visit(Likelihoods{}, likelihood, "update: expected a likelihood",
                                [&]<class L>(const L& l) -> py::object {
                                  if constexpr (std::same_as<typename P::kind, typename L::kind>)
                                    return py::cast(update(p, l));
                                  else
                                    mixed<typename P::kind, typename L::kind>("update", "prior", "likelihood");
                                });
                 });
  };
  module.def("update", update_any, py::arg("prior"), py::arg("likelihood"), R"(update(prior, likelihood)
--

Posterior: the prior times the likelihood, divided by the ⊕ of the prior's kind, (8), (19), (20).

ValueError if the evidence excludes every outcome that the prior left.)");

  const auto invert_any = [](const py::object& relation, const py::object& prior) {
    return visit(Relations{}, relation, "invert: expected a relation", [&]<class R>(const R& r) {
      return visit(Distributions{} + Beliefs{}, prior, "invert: expected a distribution or a belief",
                   [&]<class P>(const P& p) -> py::object {
                     if constexpr (std::same_as<typename R::from_kind, typename P::kind>)
                       return inverse(unlocked([&] { return invert(r, p); }));
                     else
                       mixed<typename R::from_kind, typename P::kind>("invert", "condition", "prior");
                   });
    });
  };
  module.def("invert", invert_any, py::arg("relation"), py::arg("prior"), R"(invert(relation, prior)
--

The relation read backwards under a prior of its condition, (43), (46), (52), (54).

Returns Inverse(relation, unreachable): rows of outcomes that nothing reaches are uninformative, and listed.)");
}

void bind_hybrids(py::module_& module) {
  const Family family = Family::make<HybridOf<Random, Random>>(
      module, "HybridDistribution", "a relation and a distribution of its condition, or two variables",
      "The joint of two variables of any kinds, (9): ⊕ over outer of ⊕ over inner is one.\n\n"
      "Made of (conditional, marginal), (12), (13), or of (outer, inner, rows).");
  Hybrids::for_each([&]<class H>() {
    using Outer = typename H::outer_kind;
    using Inner = typename H::inner_kind;
    py::class_<H> type = family.add<H>("Hybrid" + kind_name<Outer>() + kind_name<Inner>());
    family.accept<H, Relation<Inner, Outer>, Distribution<Outer>>();
    family.accept<H, Relation<Outer, Inner>, Induced<Distribution<Inner>>>();
    family.accept<H, Variable<Outer>, Variable<Inner>>();
    type.def(py::init<const Relation<Inner, Outer>&, const Distribution<Outer>&>(), py::arg("conditional"),
             py::arg("marginal"))
        .def(py::init<const Relation<Outer, Inner>&, const Induced<Distribution<Inner>>&>(), py::arg("conditional"),
             py::arg("marginal"))
        .def(py::init<Variable<Outer>, Variable<Inner>, const std::vector<std::vector<double>>&>(), py::arg("outer"),
             py::arg("inner"), py::arg("rows"))
        .def_property_readonly("outer", [](const H& self) { return self.outer(); })
        .def_property_readonly("inner", [](const H& self) { return self.inner(); })
        .def_property_readonly(
            "table",
            [](const py::object& self) {
              const Table& table = py::cast<const H&>(self).table();
              return view(table.data(), self, table.rows(), table.columns());
            },
            "The joint, (outer.size, inner.size): a read-only view.")
        .def("outer_marginal", &H::outer_marginal, "What is left of outer, (5).")
        .def("inner_marginal", &H::inner_marginal,
             "What is left of inner: of another kind than outer only induced, (15).")
        .def("total", &H::total, "⊕ over outer of ⊕ over inner: one, (10), (11).")
        .def("beta", &H::beta, "⊕ over inner of ⊕ over outer: the β of (14) and (16).")
        .def(
            "inner_given_outer", [](const H& self) { return inverse(self.inner_given_outer()); },
            "The conditional of (12), (13), as Inverse(relation, unreachable).")
        .def(
            "outer_given_inner", [](const H& self) { return inverse(self.outer_given_inner()); },
            "The other conditional, (14), as Inverse(relation, unreachable).");
  });
}

/// Any object of Python that transforms rows of numbers.
struct Method {
  py::object object;
  std::vector<double> possibilities(std::span<const double> p) const { return call("possibilities", p); }
  std::vector<double> probabilities(std::span<const double> pi) const { return call("probabilities", pi); }
  std::vector<double> call(const char* direction, std::span<const double> values) const {
    return object.attr(direction)(copied(values.data(), values.size())).cast<std::vector<double>>();
  }
};

void bind_transforms(py::module_& module) {
  const auto bind = [](auto type) {
    using M = typename decltype(type)::type;
    type.def(
        "possibilities", [](const M& self, const Array& p) { return array_of(self.possibilities(numbers(p))); },
        py::arg("p"), "Numbers in proportion to which the possibilities of probabilities (n,) are.");
    if constexpr (ProbabilityTransform<M>)
      type.def(
          "probabilities", [](const M& self, const Array& pi) { return array_of(self.probabilities(numbers(pi))); },
          py::arg("pi"), "Numbers in proportion to which the probabilities of possibilities (n,) are.");
  };
  bind(py::class_<RatioScale>(module, "RatioScale", "Klir's ratio scale: π ∝ p^exponent, (34), and its inverse, (35).")
           .def(py::init([](double exponent) { return RatioScale{exponent}; }), py::arg("exponent") = 1.0)
           .def_readonly("exponent", &RatioScale::exponent));
  bind(py::class_<DuboisPrade>(module, "DuboisPrade", "The most specific possibility that is consistent with p.")
           .def(py::init()));
  bind(py::class_<DuboisPradeSandri>(module, "DuboisPradeSandri",
                                     "Σ min(p_i, p_j), and its inverse, the pignistic probability.")
           .def(py::init()));

  module.def(
      "to_possibility",
      [](const py::object& p, const py::object& method) {
        return visit(Types<Distribution<Random>, Relation<Random, Random>, Relation<Random, Fuzzy>>{}, p,
                     "to_possibility: expected a random distribution or relation",
                     [&](const auto& random) { return to_possibility(random, Method{method}); });
      },
      py::arg("p"), py::arg("method"), R"(to_possibility(p, method)
--

The possibility distribution that a method makes of a probability distribution, or of each row of a relation.

`method` is a RatioScale, DuboisPrade, DuboisPradeSandri, or any object with `possibilities(row)`.)");
  module.def(
      "to_probability",
      [](const py::object& pi, const py::object& method) {
        return visit(Types<Distribution<Fuzzy>, Relation<Fuzzy, Random>, Relation<Fuzzy, Fuzzy>>{}, pi,
                     "to_probability: expected a fuzzy distribution or relation",
                     [&](const auto& fuzzy) { return to_probability(fuzzy, Method{method}); });
      },
      py::arg("pi"), py::arg("method"), R"(to_probability(pi, method)
--

The probability distribution that a method makes of a possibility distribution, or of each row of a relation.)");
  using Scalable =
      Types<Relation<Random, Random>, Relation<Random, Fuzzy>, Relation<Fuzzy, Random>, Relation<Fuzzy, Fuzzy>>;
  module.def(
      "with_fuzzy_condition",
      [](const py::object& relation) {
        return visit(Scalable{}, relation, "with_fuzzy_condition: expected a random or fuzzy relation",
                     [](const auto& r) { return with_fuzzy_condition(r); });
      },
      py::arg("relation"),
      "with_fuzzy_condition(relation)\n--\n\nThe same rows, with the condition read as fuzzy: (49) as (50).");
  module.def(
      "with_random_condition",
      [](const py::object& relation) {
        return visit(Scalable{}, relation, "with_random_condition: expected a random or fuzzy relation",
                     [](const auto& r) { return with_random_condition(r); });
      },
      py::arg("relation"), "with_random_condition(relation)\n--\n\nThe same rows, with the condition read as random.");
}

void bind_events(py::module_& module) {
  const Family family =
      Family::make<EventOf<Random>>(module, "Event", "a variable", "A set of outcomes; |, & and ~ combine.");
  Variables::for_each([&]<class V>() {
    using E = Event<typename V::kind>;
    py::class_<E> type = family.add<E>(kind_name<typename V::kind>() + "Event");
    family.accept<E, V>();
    type.def(py::init([](const V& variable, const py::iterable& outcomes) {
               std::vector<std::size_t> indices;
               for (const py::handle outcome : outcomes) indices.push_back(index_of(variable, outcome));
               return E(variable, std::span<const std::size_t>(indices));
             }),
             py::arg("variable"), py::arg("outcomes"), "Outcomes by their labels or indices.")
        .def_property_readonly("variable", [](const E& self) { return self.variable(); })
        .def("__contains__",
             [](const E& self, const py::object& key) { return self.contains(index_of(self.variable(), key)); })
        .def(py::self | py::self)
        .def(py::self & py::self)
        .def(~py::self)
        .def(py::self == py::self)
        .def("__repr__", [](const py::object& self) {
          return "<" + class_name(self) + " " + py::cast<const E&>(self).description() + ">";
        });
  });
}

/// What a function says of an event under a distribution of the same kind.
template <class Measure>
void bind_measure(py::module_& module, const std::string& name, const char* doc, const Measure& measure_of) {
  const auto of_any = [name, measure_of](const py::object& distribution, const py::object& event) {
    return visit(Distributions{}, distribution, name + ": expected a distribution", [&]<class D>(const D& d) {
      return visit(Events{}, event, name + ": expected an event", [&]<class E>(const E& e) -> py::object {
        if constexpr (!std::same_as<typename D::kind, typename E::kind>)
          mixed<typename D::kind, typename E::kind>(name, "distribution", "event");
        else if constexpr (std::invocable<Measure, const D&, const E&>)
          return py::cast(measure_of(d, e));
        else
          throw py::type_error(name + ": not defined for a distribution that is " + std::string(D::kind::name));
      });
    });
  };
  module.def(name.c_str(), of_any, py::arg("distribution"), py::arg("event"), doc);
}

void bind_measures(py::module_& module) {
  bind_measure(module, "measure", "⊕ over the outcomes of an event: its probability or possibility.",
               [](const auto& d, const auto& e) { return measure(d, e); });
  bind_measure(module, "probability", "P(A) = Σ p(x) over A.",
               [](const auto& d, const auto& e) -> decltype(probability(d, e)) { return probability(d, e); });
  bind_measure(module, "possibility", "Π(A) = max π(x) over A, Definition 2.4.",
               [](const auto& d, const auto& e) -> decltype(possibility(d, e)) { return possibility(d, e); });
  bind_measure(module, "necessity", "N(A) = 1 − Π(not A): how far A is implied.",
               [](const auto& d, const auto& e) -> decltype(necessity(d, e)) { return necessity(d, e); });
  bind_measure(module, "given",
               "The distribution when an event is known to have come true; ValueError if its measure is zero.",
               [](const auto& d, const auto& e) -> decltype(given(d, e)) { return given(d, e); });
  using Features = std::set<std::string>;
  module.def(
      "compatibility", [](const Features& object, const Features& outcome) { return compatibility(object, outcome); },
      py::arg("object"), py::arg("outcome"), "Compatibility (1) of two sets of features, or of degrees (n,).");
  module.def(
      "compatibility",
      [](const Array& object, const Array& outcome, const Array& measure_of) {
        return compatibility(numbers(object), numbers(outcome), numbers(measure_of));
      },
      py::arg("object"), py::arg("outcome"), py::arg("measure"));
}

}  // namespace

void bind_core_verbs(py::module_& module) {
  const py::object namedtuple = py::module_::import("collections").attr("namedtuple");
  module.attr("Inverse") = namedtuple("Inverse", "relation unreachable", py::arg("module") = "sigmax._sigmax");
  bind_compose(module);
  bind_update(module);
  bind_hybrids(module);
  bind_transforms(module);
  bind_events(module);
  bind_measures(module);
  bind_matching(module);
}

}  // namespace sigmax::python
