#include "arrays.hpp"
#include "kinds.hpp"
#include "rooms.hpp"

#include <algorithm>
#include <sstream>
#include <vector>

#include <pybind11/operators.h>
#include <pybind11/stl.h>

namespace sigmax::python {

void bind_core_verbs(py::module_& module);

namespace {

template <class T>
std::string printed(const T& value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

void bind_variables(py::module_& module) {
  py::class_<Outcomes> base(module, "Variable", "An uncertain variable with finitely many outcomes, of any kind.");
  base.def_property_readonly("name", [](const Outcomes& self) { return self.name(); })
      .def_property_readonly("size", &Outcomes::size)
      .def_property_readonly("labels",
                             [](const Outcomes& self) {
                               std::vector<std::string> labels(self.size());
                               for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = self.label(i);
                               return labels;
                             })
      .def(
          "label", [](const Outcomes& self, const py::object& index) { return self.label(index_of(self, index)); },
          "Label of the outcome of this index.")
      .def(
          "index_of", [](const Outcomes& self, std::string_view label) { return self.index_of(label); },
          "Index of the outcome of this label; ValueError, which names the outcomes, if there is none.")
      .def("__len__", &Outcomes::size)
      .def("__eq__",
           [](const py::object& self, const py::object& other) {
             return py::type::handle_of(self).is(py::type::handle_of(other)) &&
                    py::cast<const Outcomes&>(self) == py::cast<const Outcomes&>(other);
           })
      .def("__hash__", [](const Outcomes& self) { return py::hash(py::str(self.name())); })
      .def("__repr__",
           [](const py::object& self) {
             const auto& outcomes = py::cast<const Outcomes&>(self);
             return class_name(self) + "('" + outcomes.name() + "', " + std::to_string(outcomes.size()) + " outcomes)";
           })
      .def("__reduce__", [](const py::object& self) {
        const auto& outcomes = py::cast<const Outcomes&>(self);
        const bool numbered = outcomes == Outcomes(outcomes.name(), outcomes.size());
        const py::object labels = numbered ? py::cast(outcomes.size()) : py::object(self.attr("labels"));
        return py::make_tuple(py::type::of(self), py::make_tuple(outcomes.name(), labels));
      });
  Variables::for_each([&]<class V>() {
    using Kind = typename V::kind;
    py::class_<V, Outcomes>(module, (kind_name<Kind>() + "Variable").c_str(),
                            "A variable of this kind: its name, and its labels or how many outcomes it has.")
        .def(py::init<std::string, std::size_t>(), py::arg("name"), py::arg("outcomes"))
        .def(py::init<std::string, std::vector<std::string>>(), py::arg("name"), py::arg("outcomes"))
        .attr("kind") = Kind::name;
  });
  module.def("as_fuzzy", &interpreted_as<Fuzzy>, py::arg("variable"),
             "The same name and outcomes, read as a fuzzy variable.");
  module.def("as_random", &interpreted_as<Random>, py::arg("variable"),
             "The same name and outcomes, read as a random variable.");
}

/// What all functions of one variable have: a number for each outcome.
template <class T>
void bind_row(py::class_<T>& type) {
  type.def_property_readonly("variable", [](const T& self) { return self.variable(); })
      .def("__len__", [](const T& self) { return self.variable().size(); })
      .def(
          "__getitem__", [](const T& self, const py::object& key) { return self[index_of(self.variable(), key)]; },
          "The number of one outcome, by its label or index.")
      .def("__repr__", [](const py::object& self) {
        const auto& row = py::cast<const T&>(self);
        std::ostringstream out;
        const std::size_t shown = std::min<std::size_t>(row.variable().size(), 12);
        for (std::size_t i = 0; i < shown; ++i)
          out << (i == 0 ? ": " : ", ") << row.variable().label(i) << ' ' << row[i];
        const std::string rest = shown < row.variable().size() ? ", …" : "";
        return "<" + class_name(self) + " " + row.variable().name() + out.str() + rest + ">";
      });
}

template <class T>
void bind_values(py::class_<T>& type) {
  bind_row(type);
  type.def_property_readonly(
          "values",
          [](const py::object& self) {
            const auto& row = py::cast<const T&>(self);
            return view(row.values().data(), self, row.values().size());
          },
          "Numbers in the order of the outcomes, (n,): a read-only view that keeps its owner.")
      .def(
          "__array__",
          [](const py::object& self, const py::object& dtype) -> py::object {
            return dtype.is_none() ? self.attr("values") : self.attr("values").attr("astype")(dtype);
          },
          py::arg("dtype") = py::none())
      .def(
          "normalized", [](const T& self) { return self.normalized(); },
          "The distribution reading, (16): what is only induced is divided by β.");
}

void bind_distributions(py::module_& module) {
  const Family family = Family::make<DistributionOf<Random>>(
      module, "Distribution", "a variable",
      "A normalised distribution of one variable: Σ p = 1, (3), or max π = 1, (2).");
  const Family induced = Family::make<InducedOf<Random>>(
      module, "InducedDistribution", "no arguments: it comes from compose",
      "What eliminating a variable of the other kind leaves, (15), (16): not normalised.");
  Variables::for_each([&]<class V>() {
    using Kind = typename V::kind;
    using D = Distribution<Kind>;
    py::class_<D> type = family.add<D>(kind_name<Kind>() + "Distribution");
    family.accept<D, V>();
    bind_values(type);
    type.def(py::init([](const V& variable, const Array& values) {
               expect_shape(values, "values", -1);
               return D(variable, numbers(values));
             }),
             py::arg("variable"), py::arg("values"),
             "Values (n,), stored unchanged. ValueError, with variable and value, unless they are normalised to 1e-9.")
        .def(py::self == py::self)
        .def("__reduce__", [](const py::object& self) {
          return py::make_tuple(py::type::of(self), py::make_tuple(self.attr("variable"), self.attr("values")));
        });
    py::class_<InducedOf<Kind>> unnormalised =
        induced.add<InducedOf<Kind>>("Induced" + kind_name<Kind>() + "Distribution");
    bind_values(unnormalised);
    unnormalised.def_property_readonly("beta", &InducedOf<Kind>::beta, "The normalisation factor β of (16).");

    module.def(
        "normalized",
        [](const V& variable, const Array& weights) {
          expect_shape(weights, "weights", -1);
          return normalized(variable, numbers(weights));
        },
        py::arg("variable"), py::arg("weights"),
        "The distribution, or the relation, in proportion to weights or counts.");
    module.def("uninformative", &uninformative<Kind>, py::arg("variable"), "1/n each if random, else one each.");
    module.def("most_likely", py::overload_cast<const D&>(&most_likely<Kind>), py::arg("distribution"),
               "Label of the greatest number; on a tie the first declared.");
  });
}

void bind_evidence(py::module_& module) {
  const Family family = Family::make<LikelihoodOf<Random>>(
      module, "Likelihood", "a variable", "How well each outcome explains evidence, up to a factor; never normalised.");
  Variables::for_each([&]<class V>() {
    using L = Likelihood<typename V::kind>;
    py::class_<L> type = family.add<L>(kind_name<typename V::kind>() + "Likelihood");
    family.accept<L, V>();
    bind_row(type);
    const auto values = [](const L& self) {
      py::array_t<double> all(static_cast<py::ssize_t>(self.size()));
      for (std::size_t i = 0; i < self.size(); ++i) all.mutable_at(i) = self[i];
      return all;
    };
    type.def(py::init([](const V& variable, const Array& numbers_of) {
               expect_shape(numbers_of, "values", -1);
               return L(variable, numbers(numbers_of));
             }),
             py::arg("variable"), py::arg("values"), "Likelihoods (n,); ValueError unless finite and not negative.")
        .def(py::init<V>(), py::arg("variable"))
        .def_property_readonly("values", values, "The likelihoods as numbers, (n,).");
    if constexpr (L::has_logs)
      type.def(py::init([](const V& variable, const Array& logs) {
                 expect_shape(logs, "logs", variable.size());
                 L likelihood(variable);
                 for (std::size_t i = 0; i < variable.size(); ++i) likelihood.set_log(i, logs.data()[i]);
                 return likelihood;
               }),
               py::arg("variable"), py::kw_only(), py::arg("logs"))
          .def_property_readonly(
              "logs",
              [](const py::object& self) {
                const auto& likelihood = py::cast<const L&>(self);
                return view(likelihood.logs().data(), self, likelihood.size());
              },
              "Logarithms, (n,), −inf for what is excluded: a read-only view.");
  });

  const Family beliefs = Family::make<Belief<Random>>(module, "Belief", "a random or fuzzy distribution",
                                                      "A distribution kept as logarithms: no outcome underflows.");
  Beliefs::for_each([&]<class B>() {
    py::class_<B> type = beliefs.add<B>(kind_name<typename B::kind>() + "Belief");
    beliefs.accept<B, Distribution<typename B::kind>>();
    bind_row(type);
    type.def(py::init<const Distribution<typename B::kind>&>(), py::arg("distribution"))
        .def("distribution", &B::distribution, "The belief as numbers.")
        .def_property_readonly(
            "logs",
            [](const py::object& self) {
              const auto& belief = py::cast<const B&>(self);
              return view(belief.logs().data(), self, belief.size());
            },
            "Normalised logarithms, (n,): a read-only view.");
    module.def("most_likely", py::overload_cast<const B&>(&most_likely<typename B::kind>), py::arg("belief"));
  });
}

AnyRows proved_rows(const Outcomes& to, const Outcomes& from, const Array& rows, const auto& prove) {
  expect_shape(rows, "rows", -1, -1);
  check::rows(to, from, static_cast<std::size_t>(rows.shape(0)));
  const auto columns = static_cast<std::size_t>(rows.shape(1));
  Table table(from.size(), columns);
  std::copy_n(rows.data(), table.size(), table.data());
  for (std::size_t i = 0; i < from.size(); ++i) prove(check::Row{&from, i}, table.row(i));
  return table;
}

template <class T>
void bind_conditional(py::class_<T>& type) {
  type.def_property_readonly("to", [](const T& self) { return self.to(); })
      .def_property_readonly("from_", [](const T& self) { return self.from(); })
      .def_property_readonly(
          "table",
          [](const py::object& self) {
            const Table& table = py::cast<const T&>(self).table();
            return view(table.data(), self, table.rows(), table.columns());
          },
          "Numbers (from_.size, to.size): a read-only view. ValueError if the relation is stored sparse.")
      .def(
          "entries",
          [](const T& self, const py::object& from) {
            std::vector<std::size_t> columns;
            std::vector<double> values;
            self.for_each(index_of(self.from(), from), [&](std::size_t to, double value) {
              columns.push_back(to);
              values.push_back(value);
            });
            return py::make_tuple(copied(columns.data(), columns.size()), copied(values.data(), values.size()));
          },
          py::arg("from_"), "Columns and values that one row stores; all others are zero.")
      .def(
          "likelihood", [](const T& self, const py::object& to) { return self.likelihood(index_of(self.to(), to)); },
          py::arg("to"), "The column of one outcome, read as a function of `from_`: no β, so no bias.")
      .def(
          "normalized", [](const T& self) { return self.normalized(); },
          "The distribution reading of (17), (18): each row divided by its β.")
      .def(
          "__getitem__",
          [](const T& self, const std::pair<py::object, py::object>& key) {
            return self(index_of(self.from(), key.first), index_of(self.to(), key.second));
          },
          "The number of [from_, to], by labels or indices.")
      .def("__repr__", [](const py::object& self) {
        const auto& relation = py::cast<const T&>(self);
        return "<" + class_name(self) + " " + relation.to().name() + " given " + relation.from().name() + ", " +
               std::to_string(relation.from().size()) + " rows of " + std::to_string(relation.to().size()) + ">";
      });
}

void bind_relations(py::module_& module) {
  const Family family = Family::make<RelationOf<Random, Random>>(
      module, "Relation", "two variables of one kind, or a random and a fuzzy one",
      "A normalised relation, \"to given from_\": a row per outcome of `from_`, each a distribution of `to`.");
  const Family induced =
      Family::make<InducedRelationOf<Random, Random>>(module, "InducedRelation", "no arguments: it comes from compose",
                                                      "An induced relation, (17), (18): not normalised.");
  Relations::for_each([&]<class R>() {
    using To = typename R::to_kind;
    using From = typename R::from_kind;
    const std::string name = kind_name<To>() + "Given" + kind_name<From>();
    py::class_<R> type = family.add<R>(name);
    family.accept<R, Variable<To>, Variable<From>>();
    bind_conditional(type);
    type.def(py::init([](const Variable<To>& to, const Variable<From>& from, const py::object& rows) {
               if (is_sparse(rows)) return R(to, from, sparse_rows(rows));
               const auto proved = [&](check::Row row, auto values) { prove_normalized<To>(to, row, values); };
               return R(to, from, proved_rows(to, from, as_array(rows), proved), detail::ByLaw{});
             }),
             py::arg("to"), py::arg("from_"), py::arg("rows"),
             "Rows (from_.size, to.size), stored unchanged, or sparse rows of SciPy, which stay sparse.\n\n"
             "ValueError, with variable, row and value, unless each row is normalised to 1e-9.")
        .def(
            "given", [](const R& self, const py::object& from) { return self.given(index_of(self.from(), from)); },
            py::arg("from_"), "The distribution of `to` when `from_` has this outcome.")
        .def("dense", &R::dense, "The same relation stored as a dense table.")
        .def(py::self == py::self)
        .def("__str__", &printed<R>)
        .def("__reduce__", [](const py::object& self) {
          const py::object dense =
              std::holds_alternative<Table>(py::cast<const R&>(self).rows()) ? self : self.attr("dense")();
          return py::make_tuple(py::type::of(self),
                                py::make_tuple(self.attr("to"), self.attr("from_"), dense.attr("table")));
        });
    module.def(
        "normalized",
        [](const Variable<To>& to, const Variable<From>& from, const Array& weights) {
          const auto condition_row = [&](check::Row row, std::span<double> values) {
            check::size(to, row, values.size());
            check::weights(to, row, values, detail::algebra_of<To>());
            condition<AlgebraOf<To>>(values);
          };
          return R(to, from, proved_rows(to, from, weights, condition_row), detail::ByLaw{});
        },
        py::arg("to"), py::arg("from_"), py::arg("weights"));

    using I = InducedRelationOf<To, From>;
    py::class_<I> unnormalised = induced.add<I>("Induced" + name);
    bind_conditional(unnormalised);
    unnormalised.def_property_readonly(
        "betas", [](const I& self) { return array_of(self.betas()); },
        "The normalisation factor β of each row, (from_.size,).");
  });
}

}  // namespace

void bind_core(py::module_& module) {
  bind_variables(module);
  bind_distributions(module);
  bind_evidence(module);
  bind_relations(module);
  bind_core_verbs(module);
}

}  // namespace sigmax::python
