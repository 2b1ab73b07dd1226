#include "arrays.hpp"
#include "kinds.hpp"

#include <span>
#include <vector>

#include <pybind11/operators.h>

namespace sigmax::python {

void bind_measures(py::module_& module);

namespace {

void bind_events(py::module_& module) {
  const Family family =
      Family::make<Event<Random>>(module, "Event", "a variable", "A set of outcomes; |, & and ~ combine.");
  Variables::for_each([&]<class V>() {
    using E = Event<typename V::kind>;
    py::class_<E> type = family.add<E>(capital(V::kind::name) + "Event");
    family.accept<E, V>();
    constructor(type, "Outcomes by their labels or indices.", [](const V& variable, const py::iterable& outcomes) {
      std::vector<std::size_t> indices;
      for (const py::handle outcome : outcomes) indices.push_back(index_of(variable, outcome));
      return E(variable, std::span<const std::size_t>(indices));
    });
    type.def_property_readonly("variable", [](const E& self) { return self.variable(); });
    type.def("__contains__",
             [](const E& self, py::handle key) { return self.contains(index_of(self.variable(), key)); });
    type.def(py::self | py::self).def(py::self & py::self).def(~py::self).def(py::self == py::self);
    type.def("__repr__", [](const E& self) { return "<Event " + self.description() + ">"; });
  });
}

/// A function of a distribution and an event of its kind.
template <class Measure>
void bind_measure(py::module_& module, const std::string& name, const char* doc, const Measure& measure_of) {
  function(
      module, name + "(distribution, event, /)", doc, [name, measure_of](py::handle distribution, py::handle event) {
        return visit(Distributions{}, distribution, name + ": expected a distribution", [&]<class D>(const D& d) {
          return visit(Events{}, event, name + ": expected an event", [&]<class E>(const E& e) -> py::object {
            if constexpr (std::invocable<Measure, const D&, const E&>)
              return py::cast(measure_of(d, e));
            else if constexpr (std::same_as<typename D::kind, typename E::kind>)
              throw py::type_error(name + ": not defined for a distribution that is " + std::string(D::kind::name));
            else
              refuse(name, D::kind::name, "distribution", E::kind::name, "event");
          });
        });
      });
}

}  // namespace

void bind_measures(py::module_& module) {
  bind_events(module);
  bind_measure(module, "probability", "P(A) = Σ p(x) over the event A.",
               [](const auto& d, const auto& e) -> decltype(probability(d, e)) { return probability(d, e); });
  bind_measure(module, "possibility", "Π(A) = max π(x) over the event A, Definition 2.4.",
               [](const auto& d, const auto& e) -> decltype(possibility(d, e)) { return possibility(d, e); });
  bind_measure(module, "necessity", "N(A) = 1 − Π(not A): how far the event A is implied.",
               [](const auto& d, const auto& e) -> decltype(necessity(d, e)) { return necessity(d, e); });
  bind_measure(module, "given", "The distribution when an event has come true; ValueError if its measure is zero.",
               [](const auto& d, const auto& e) -> decltype(given(d, e)) { return given(d, e); });
  function(module, "compatibility(object, outcome, measure, /)",
           "Compatibility (1): Σ μ min(X, x) / Σ μ X of degrees (n,) and weights μ (n,) of features.",
           [](const Array& object, const Array& outcome, const Array& measure_of) {
             return compatibility(row_of(object), row_of(outcome), row_of(measure_of));
           });
}

}  // namespace sigmax::python
