#include "arrays.hpp"
#include "kinds.hpp"
#include "rooms.hpp"

#include <vector>

#include <pybind11/operators.h>
#include <pybind11/stl.h>

namespace sigmax::python {
namespace {

void bind_variables(py::module_& module) {
  py::class_<Outcomes> base(module, "Variable", "An uncertain variable with finitely many outcomes, of any kind.");
  base.def_property_readonly("name", [](const Outcomes& self) { return self.name(); });
  base.def("__len__", &Outcomes::size);
  property(base, "labels", "The label of each outcome.", [](const Outcomes& self) {
    std::vector<std::string> labels(self.size());
    for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = self.label(i);
    return labels;
  });
  base.def("__repr__", [](const py::object& self) {
    return py::str("{}({!r}, {})").format(class_name(self), self.attr("name"), self.attr("labels"));
  });
  Kinds::for_each([&]<class Kind>() {
    using V = Variable<Kind>;
    py::class_<V, Outcomes> type(module, (capital(Kind::name) + "Variable").c_str(),
                                 "A variable of this kind: its name, and its labels or how many outcomes it has.");
    type.def(py::init<std::string, std::size_t>(), py::arg("name"), py::arg("outcomes"));
    type.def(py::init<std::string, std::vector<std::string>>(), py::arg("name"), py::arg("outcomes"));
    type.def(py::self == py::self);
    type.attr("kind") = Kind::name;
  });
}

/// A number for each outcome of a variable: a distribution, a likelihood, or what is only induced. The class has a name
/// in the scope, if there is one.
template <class T>
py::class_<T> bind_row(py::handle scope, const py::object& base, const std::string& name) {
  using V = Variable<typename T::kind>;
  py::class_<T> type(scope, name.c_str(), base);
  type.def_property_readonly("variable", [](const T& self) { return self.variable(); });
  type.def("__len__", [](const T& self) { return self.variable().size(); });
  method(type, "__getitem__", "The number of one outcome, by its label or index.",
         [](const T& self, const Key& key) { return self[index_of(self.variable(), key)]; });
  type.def("__repr__", [](const py::object& self) {
    return py::str("<{} {} {}>").format(class_name(self), self.attr("variable").attr("name"), py::list(self));
  });
  property(type, "values", "Numbers in the order of the outcomes, (n,): a view, or a copy of likelihoods.",
           [](const py::object& self) {
             const T& row = self.cast<const T&>();
             if constexpr (requires { row.values(); }) return view(row.values().data(), self, row.values().size());
             std::vector<double> values(row.variable().size());
             for (std::size_t i = 0; i < values.size(); ++i) values[i] = row[i];
             return array_of(values);
           });
  if constexpr (std::constructible_from<T, const V&, std::span<const double>>)
    type.def(py::init([](const V& variable, const Array& values) { return T(variable, row_of(values)); }),
             "Values (n,); ValueError, with the value, unless they are right.");
  if constexpr (requires(const T& row) { row.normalized(); })
    method(type, "normalized", "The distribution reading, (16): what is only induced is divided by β.",
           [](const T& self) { return self.normalized(); });
  return type;
}

void bind_rows(py::module_& module) {
  const py::class_<Abstract<Distribution<Random>>> distributions(
      module, "Distribution", "A normalised distribution of a variable: Σ p = 1, (3), or max π = 1, (2), to 1e-9.");
  const py::class_<Abstract<Induced<Distribution<Random>>>> induced(
      module, "InducedDistribution", "What eliminating a variable of the other kind leaves, (15): not normalised.");
  const py::class_<Abstract<Likelihood<Random>>> likelihoods(
      module, "Likelihood", "How well each outcome explains evidence, up to a factor; never normalised.");
  const py::dict distribution_of = members_of(distributions), likelihood_of = members_of(likelihoods);
  Kinds::for_each([&]<class Kind>() {
    using V = Variable<Kind>;
    using D = Distribution<Kind>;
    using L = Likelihood<Kind>;
    const std::string kind = capital(Kind::name);
    const auto variable = py::make_tuple(py::type::of<V>());
    distribution_of[variable] = bind_row<D>(module, distributions, kind + "Distribution").def(py::self == py::self);
    bind_row<Induced<D>>({}, induced, "Induced" + kind + "Distribution")
        .def_property_readonly("beta", &Induced<D>::beta, "The normalisation factor β of (16).");
    auto likelihood = bind_row<L>(module, likelihoods, kind + "Likelihood");
    likelihood_of[variable] = likelihood;
    if constexpr (L::has_logs) {
      property(likelihood, "logs", "Logarithms, (n,), −inf for what is excluded.", [](const py::object& self) {
        const auto logs = self.cast<const L&>().logs();
        return view(logs.data(), self, logs.size());
      });
      likelihood.def(py::init([](const V& variable, const Array& logs) {
                       expect_shape(logs, "logs", variable.size());
                       L made(variable);
                       for (std::size_t i = 0; i < variable.size(); ++i) made.set_log(i, logs.data()[i]);
                       return made;
                     }),
                     py::arg("variable"), py::kw_only(), py::arg("logs"));
    }

    function(module, "normalized(*variables_and_weights)", "The distribution, or relation, in proportion to weights.",
             [](const V& variable, const Array& weights) { return normalized(variable, row_of(weights)); });
    function(module, "uninformative(variable, /)", "1/n each if random, else one each.", &uninformative<Kind>);
    function(module, "most_likely(distribution, /)", "Label of the greatest number; on a tie the first declared.",
             [](const D& distribution) { return most_likely(distribution); });
  });
}

/// A row for each outcome of the condition: a relation, or what is only induced.
template <class T>
py::class_<T> bind_conditional(py::handle scope, const py::object& base, const std::string& prefix) {
  const std::string name = prefix + capital(T::to_kind::name) + "Given" + capital(T::from_kind::name);
  py::class_<T> type(scope, name.c_str(), base);
  type.def_property_readonly("to", [](const T& self) { return self.to(); });
  type.def_property_readonly("from_", [](const T& self) { return self.from(); });
  property(type, "table", "Numbers (from_, to): a read-only view that keeps its owner.", [](const py::object& self) {
    const Table& table = self.cast<const T&>().table();
    return view(table.data(), self, table.rows(), table.columns());
  });
  method(type, "__getitem__", "The number of [from_, to], by labels or indices.",
         [](const T& self, const std::pair<Key, Key>& key) {
           return self(index_of(self.from(), key.first), index_of(self.to(), key.second));
         });
  method(type, "likelihood", "The column of one outcome, read as a function of `from_`: no β, so no bias.",
         [](const T& self, const Key& to) { return self.likelihood(index_of(self.to(), to)); });
  method(type, "normalized", "The distribution reading of (17), (18): each row divided by its β.",
         [](const T& self) { return self.normalized(); });
  return type;
}

void bind_relations(py::module_& module) {
  const py::class_<Abstract<Relation<Random, Random>>> relations(
      module, "Relation",
      "\"to given from_\": rows (from_, to), each a distribution of `to`.\n\n"
      "ValueError, with variable, row and value, unless each row is normalised to 1e-9.");
  const py::class_<Abstract<Induced<Relation<Random, Random>>>> induced(
      module, "InducedRelation", "What compose leaves of mixed kinds, (17), (18): not normalised.");
  const py::dict relation_of = members_of(relations);
  Relations::for_each([&]<class R>() {
    using To = Variable<typename R::to_kind>;
    using From = Variable<typename R::from_kind>;
    auto type = bind_conditional<R>(module, relations, "");
    relation_of[py::make_tuple(py::type::of<To>(), py::type::of<From>())] = type;
    type.def(py::init([](const To& to, const From& from, const Array& rows) { return R(to, from, rows_of(rows)); }));
    type.def(py::self == py::self);
    method(type, "given", "The distribution of `to` when `from_` has this outcome.",
           [](const R& self, const Key& from) { return self.given(index_of(self.from(), from)); });

    bind_conditional<Induced<R>>({}, induced, "Induced")
        .def_property_readonly(
            "betas", [](const Induced<R>& self) { return array_of(self.betas()); }, "The β of each row, (from_,).");

    module.def("normalized", [](const To& to, const From& from, const Array& weights) {
      return normalized(to, from, rows_of(weights));
    });
  });
}

}  // namespace

void bind_core(py::module_& module) {
  bind_variables(module);
  bind_rows(module);
  bind_relations(module);
  bind_verbs(module);
}

}  // namespace sigmax::python
