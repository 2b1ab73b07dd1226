#include "arrays.hpp"
#include "kinds.hpp"
#include "rooms.hpp"

#include <sstream>
#include <vector>

#include <pybind11/operators.h>
#include <pybind11/stl.h>

namespace sigmax::python {

void bind_verbs(py::module_& module);
void bind_measures(py::module_& module);
void bind_matching(py::module_& module);

namespace {

/// Read-only arrays over what get(object) returns, a row or a table; they keep the object.
template <class T, class Get>
auto row_view(const Get& get) {
  return [get](const py::object& self) {
    const auto row = get(py::cast<const T&>(self));
    return view(row.data(), self, row.size());
  };
}
template <class T>
py::array table_view(const py::object& self) {
  const Table& table = py::cast<const T&>(self).table();
  return view(table.data(), self, table.rows(), table.columns());
}

/// Pickling: the object is made again of these attributes.
template <class T, class... Name>
void made_of(py::class_<T>& type, Name... names) {
  type.def("__reduce__", [names...](const py::object& self) {
    return py::make_tuple(py::type::of(self), py::make_tuple(self.attr(names)...));
  });
}

void bind_variables(py::module_& module) {
  py::class_<Outcomes> base(module, "Variable", "An uncertain variable with finitely many outcomes, of any kind.");
  base.def_property_readonly("name", [](const Outcomes& self) { return self.name(); });
  base.def("__len__", &Outcomes::size);
  base.def("__hash__", [](const Outcomes& self) { return py::hash(py::str(self.name())); });
  property(base, "size", "How many outcomes it has.", &Outcomes::size);
  property(base, "labels", "The label of each outcome.", [](const Outcomes& self) {
    std::vector<std::string> labels(self.size());
    for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = self.label(i);
    return labels;
  });
  property(base, "outcomes", "Its labels, or how many outcomes it has if they are numbered.",
           [](const py::object& self) {
             const auto& outcomes = py::cast<const Outcomes&>(self);
             const bool numbered = outcomes == Outcomes(outcomes.name(), outcomes.size());
             return numbered ? py::cast(outcomes.size()) : py::object(self.attr("labels"));
           });
  method(base, "index_of",
         "Index of the outcome of this label; ValueError, which names the outcomes, if there is none.",
         [](const Outcomes& self, std::string_view label) { return self.index_of(label); });
  base.def("__eq__", [](const py::object& self, const py::object& other) {
    return py::type::handle_of(self).is(py::type::handle_of(other)) &&
           py::cast<const Outcomes&>(self) == py::cast<const Outcomes&>(other);
  });
  base.def("__repr__", [](const py::object& self) {
    return py::str("{}({!r}, {})").format(class_name(self), self.attr("name"), self.attr("outcomes"));
  });
  made_of(base, "name", "outcomes");
  Variables::for_each([&]<class V>() {
    py::class_<V, Outcomes> type(module, (capital(V::kind::name) + "Variable").c_str(),
                                 "A variable of this kind: its name, and its labels or how many outcomes it has.");
    type.def(py::init<std::string, std::size_t>(), py::arg("name"), py::arg("outcomes"));
    type.def(py::init<std::string, std::vector<std::string>>(), py::arg("name"), py::arg("outcomes"));
    type.attr("kind") = V::kind::name;
  });
  function(module, "as_fuzzy(variable, /)", "The same name and outcomes, read as fuzzy.", &interpreted_as<Fuzzy>);
  function(module, "as_random(variable, /)", "The same name and outcomes, read as random.", &interpreted_as<Random>);
}

/// What all functions of one variable have: a number for each outcome.
template <class T>
void bind_row(py::class_<T>& type) {
  type.def_property_readonly("variable", [](const T& self) { return self.variable(); });
  type.def("__len__", [](const T& self) { return self.variable().size(); });
  method(type, "__getitem__", "The number of one outcome, by its label or index.",
         [](const T& self, py::handle key) { return self[index_of(self.variable(), key)]; });
  type.def("__repr__", [](const py::object& self) {
    const py::list shown = self.attr("values").attr("tolist")();
    return py::str("<{} {} {}>").format(class_name(self), self.attr("variable").attr("name"), shown);
  });
}

template <class T>
void bind_values(py::class_<T>& type) {
  bind_row(type);
  property(type, "values", "Numbers in the order of the outcomes, (n,): a read-only view that keeps its owner.",
           row_view<T>([](const T& self) { return self.values(); }));
  method(type, "normalized", "The distribution reading, (16): what is only induced is divided by β.",
         [](const T& self) { return self.normalized(); });
}

void bind_distributions(py::module_& module) {
  const Family family = Family::make<Distribution<Random>>(
      module, "Distribution", "a variable", "A normalised distribution: Σ p = 1, (3), or max π = 1, (2).");
  const Family induced = Family::make<Induced<Distribution<Random>>>(
      module, "InducedDistribution", "no arguments: it comes from compose",
      "What eliminating a variable of the other kind leaves, (15), (16): not normalised.");
  const Family likelihoods = Family::make<Likelihood<Random>>(
      module, "Likelihood", "a variable", "How well each outcome explains evidence, up to a factor; never normalised.");
  Variables::for_each([&]<class V>() {
    using D = Distribution<typename V::kind>;
    const std::string kind = capital(V::kind::name);
    py::class_<D> type = family.add<D>(kind + "Distribution");
    family.accept<D, V>();
    bind_values(type);
    constructor(type, "Values (n,), stored unchanged; ValueError, with the value, unless normalised to 1e-9.",
                [](const V& variable, const Array& values) { return D(variable, row_of(values)); });
    type.def(py::self == py::self);
    made_of(type, "variable", "values");

    using I = Induced<D>;
    py::class_<I> unnormalised = induced.add<I>("Induced" + kind + "Distribution");
    bind_values(unnormalised);
    property(unnormalised, "beta", "The normalisation factor β of (16).", &I::beta);

    using L = Likelihood<typename V::kind>;
    py::class_<L> likelihood = likelihoods.add<L>(kind + "Likelihood");
    likelihoods.accept<L, V>();
    bind_row(likelihood);
    property(likelihood, "values", "The likelihoods as numbers, (n,).", [](const L& self) {
      std::vector<double> values(self.size());
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = self[i];
      return array_of(values);
    });
    likelihood.def(py::init([](const V& variable, const Array& values) { return L(variable, row_of(values)); }));
    if constexpr (L::has_logs) {
      property(likelihood, "logs", "Logarithms, (n,), −inf for what is excluded: a read-only view.",
               row_view<L>([](const L& self) { return self.logs(); }));
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
    function(module, "uninformative(variable, /)", "1/n each if random, else one each.",
             &uninformative<typename V::kind>);
    function(module, "most_likely(distribution, /)", "Label of the greatest number; on a tie the first declared.",
             [](const D& distribution) { return most_likely(distribution); });
  });
}

/// Rows as a dense table, each proved to be a distribution, or made one.
AnyRows rows_of(const Outcomes& to, const Outcomes& from, const Array& rows, const auto& prove) {
  expect_shape(rows, "rows", -1, -1);
  check::rows(to, from, static_cast<std::size_t>(rows.shape(0)));
  Table table(from.size(), static_cast<std::size_t>(rows.shape(1)));
  std::copy_n(rows.data(), table.size(), table.data());
  for (std::size_t i = 0; i < from.size(); ++i) prove(check::Row{&from, i}, table.row(i));
  return table;
}

template <class T>
void bind_conditional(py::class_<T>& type) {
  type.def_property_readonly("to", [](const T& self) { return self.to(); });
  type.def_property_readonly("from_", [](const T& self) { return self.from(); });
  property(type, "table", "Numbers (from_.size, to.size): a read-only view. ValueError if they are stored sparse.",
           &table_view<T>);
  method(type, "__getitem__", "The number of [from_, to], by labels or indices.",
         [](const T& self, const std::pair<py::object, py::object>& key) {
           return self(index_of(self.from(), key.first), index_of(self.to(), key.second));
         });
  method(type, "likelihood", "The column of one outcome, read as a function of `from_`: no β, so no bias.",
         [](const T& self, py::handle to) { return self.likelihood(index_of(self.to(), to)); });
  method(type, "normalized", "The distribution reading of (17), (18): each row divided by its β.",
         [](const T& self) { return self.normalized(); });
  type.def("__repr__", [](const py::object& self) {
    return py::str("<{} {} given {}>")
        .format(class_name(self), self.attr("to").attr("name"), self.attr("from_").attr("name"));
  });
}

void bind_relations(py::module_& module) {
  const Family family = Family::make<Relation<Random, Random>>(
      module, "Relation", "two variables of one kind, or a random and a fuzzy one",
      "A normalised relation, \"to given from_\": a row per outcome of `from_`, each a distribution of `to`.");
  const Family induced =
      Family::make<Induced<Relation<Random, Random>>>(module, "InducedRelation", "no arguments: it comes from compose",
                                                      "An induced relation, (17), (18): not normalised.");
  Relations::for_each([&]<class R>() {
    using To = typename R::to_kind;
    using From = typename R::from_kind;
    const std::string name = capital(To::name) + "Given" + capital(From::name);
    py::class_<R> type = family.add<R>(name);
    family.accept<R, Variable<To>, Variable<From>>();
    bind_conditional(type);
    constructor(type,
                "Rows (from_.size, to.size), or a sparse matrix of SciPy, which stays sparse.\n\n"
                "ValueError, with variable, row and value, unless each row is normalised to 1e-9.",
                [](const Variable<To>& to, const Variable<From>& from, const py::object& rows) {
                  if (is_sparse(rows)) return R(to, from, sparse_rows(rows));
                  const auto prove = [&](check::Row row, auto values) { prove_normalized<To>(to, row, values); };
                  return R(to, from, rows_of(to, from, as_array(rows), prove), detail::ByLaw{});
                });
    method(type, "given", "The distribution of `to` when `from_` has this outcome.",
           [](const R& self, py::handle from) { return self.given(index_of(self.from(), from)); });
    method(type, "dense", "The same relation stored as a dense table.", &R::dense);
    type.def(py::self == py::self);
    type.def("__reduce__", [](const py::object& self) {
      return py::make_tuple(py::type::of(self),
                            py::make_tuple(self.attr("to"), self.attr("from_"), self.attr("dense")().attr("table")));
    });

    using I = Induced<R>;
    py::class_<I> unnormalised = induced.add<I>("Induced" + name);
    bind_conditional(unnormalised);
    property(unnormalised, "betas", "The normalisation factor β of each row, (from_.size,).",
             [](const I& self) { return array_of(self.betas()); });

    module.def("normalized", [](const Variable<To>& to, const Variable<From>& from, const Array& weights) {
      const auto conditioned = [&](check::Row row, std::span<double> values) {
        check::size(to, row, values.size());
        check::weights(to, row, values, detail::algebra_of<To>());
        condition<AlgebraOf<To>>(values);
      };
      return R(to, from, rows_of(to, from, weights, conditioned), detail::ByLaw{});
    });
  });
}

void bind_hybrids(py::module_& module) {
  const Family family = Family::make<HybridDistribution<Fuzzy, Random>>(
      module, "HybridDistribution", "a relation and a distribution of its condition, or two variables",
      "The joint of two variables of any kinds, (9): ⊕ over outer of ⊕ over inner is one.\n\n"
      "It is made of (conditional, marginal), (12), (13), or of (outer, inner, rows).");
  MixedRelations::for_each([&]<class R>() {
    using Outer = typename R::from_kind;
    using Inner = typename R::to_kind;
    using H = HybridDistribution<Outer, Inner>;
    using Rows = std::vector<std::vector<double>>;
    py::class_<H> type = family.add<H>("Hybrid" + capital(Outer::name) + capital(Inner::name));
    family.accept<H, R, Distribution<Outer>>();
    family.accept<H, Relation<Outer, Inner>, Induced<Distribution<Inner>>>();
    family.accept<H, Variable<Outer>, Variable<Inner>>();
    type.def(py::init<const R&, const Distribution<Outer>&>());
    type.def(py::init<const Relation<Outer, Inner>&, const Induced<Distribution<Inner>>&>());
    type.def(py::init<Variable<Outer>, Variable<Inner>, const Rows&>());
    type.def_property_readonly("outer", [](const H& self) { return self.outer(); });
    type.def_property_readonly("inner", [](const H& self) { return self.inner(); });
    property(type, "table", "The joint, (outer.size, inner.size): a read-only view.", &table_view<H>);
    method(type, "outer_marginal", "What is left of outer, (5).", &H::outer_marginal);
    method(type, "inner_marginal", "What is left of inner: only induced if its kind differs, (15).",
           &H::inner_marginal);
    method(type, "total", "⊕ over outer of ⊕ over inner: one, (10), (11).", &H::total);
    method(type, "beta", "⊕ over inner of ⊕ over outer: the β of (14) and (16).", &H::beta);
    method(type, "inner_given_outer", "The conditional of (12), (13), as Inverse(relation, unreachable).",
           [](const H& self) { return inverse_of(self.inner_given_outer()); });
    method(type, "outer_given_inner", "The other conditional, (14), as Inverse(relation, unreachable).",
           [](const H& self) { return inverse_of(self.outer_given_inner()); });
  });
}

}  // namespace

void bind_core(py::module_& module) {
  const py::object namedtuple = py::module_::import("collections").attr("namedtuple");
  module.attr("Inverse") = namedtuple("Inverse", "relation unreachable", py::arg("module") = "sigmax._sigmax");
  bind_variables(module);
  bind_distributions(module);
  bind_relations(module);
  bind_hybrids(module);
  bind_verbs(module);
  bind_measures(module);
  bind_matching(module);
}

}  // namespace sigmax::python
