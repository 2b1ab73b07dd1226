#include "arrays.hpp"
#include "kinds.hpp"
#include "rooms.hpp"

#include <optional>
#include <sstream>
#include <vector>

#include <pybind11/stl.h>

#include <sigmax/core/network/bif.hpp>
#include <sigmax/core/network/compose.hpp>
#include <sigmax/core/network/explanation.hpp>
#include <sigmax/core/network/graphviz.hpp>
#include <sigmax/core/network/measure.hpp>
#include <sigmax/core/network/query.hpp>
#include <sigmax/core/network/transform.hpp>

namespace sigmax::python {

namespace {

using Names = std::vector<std::string>;

NetworkVariable network_variable(const py::object& object) {
  if (py::isinstance<RandomVariable>(object)) return object.cast<RandomVariable>();
  if (py::isinstance<FuzzyVariable>(object)) return object.cast<FuzzyVariable>();
  throw py::type_error("declare: expected a random or a fuzzy variable, found " + class_name(object));
}

py::object variable_of(const NetworkVariable& variable) {
  return variable.visit([](const auto& of_kind) { return py::cast(of_kind); });
}

void declare(RelationNetwork& network, const py::object& variable, const py::iterable& parents,
             const py::object& rows) {
  std::vector<NetworkVariable> conditions;
  for (const py::handle parent : parents)
    conditions.push_back(network_variable(py::reinterpret_borrow<py::object>(parent)));
  if (is_sparse(rows)) return network.declare(network_variable(variable), conditions, sparse_rows(rows));
  const Array dense = as_array(rows);
  expect_shape(dense, "rows", -1, -1);
  std::vector<std::vector<double>> lists;
  for (py::ssize_t i = 0; i < dense.shape(0); ++i)
    lists.emplace_back(dense.data() + i * dense.shape(1), dense.data() + (i + 1) * dense.shape(1));
  network.declare(network_variable(variable), conditions, lists);
}

/// Evidence from a dict: of each variable's name the label that was seen, a likelihood, or an event.
Evidence evidence_of(const py::object& known) {
  Evidence evidence;
  if (known.is_none()) return evidence;
  for (const auto& [key, value] : py::dict(known)) {
    const auto name = py::cast<std::string>(key);
    if (py::isinstance<py::str>(value)) {
      evidence.observe(name, py::cast<std::string>(value));
      continue;
    }
    visit(Types<Likelihood<Random>, Likelihood<Fuzzy>, Event<Random>, Event<Fuzzy>>{}, value,
          "evidence: expected a label, a likelihood or an event", [&](const auto& of_kind) {
            if (of_kind.variable().name() != name)
              throw py::value_error("evidence: '" + name + "' is the key of evidence about '" +
                                    of_kind.variable().name() + "'");
            evidence.observe(of_kind);
            return true;
          });
  }
  return evidence;
}

/// Numbers with an axis for each variable.
template <class Numbers, class Read>
py::array shaped(const NetworkAnswer& answer, const Numbers& numbers_of, const Read& read) {
  std::vector<py::ssize_t> shape;
  for (const NetworkVariable& variable : answer.variables()) shape.push_back(static_cast<py::ssize_t>(variable.size()));
  py::array_t<double> array(shape);
  double* out = array.mutable_data();
  for (const auto& number : numbers_of) *out++ = read(number);
  return std::move(array);
}

/// The distribution or the likelihood of the one variable asked for.
template <class Read>
py::object of_kind(const NetworkAnswer& answer, const Read& read) {
  return answer.variables().empty() ? read.template operator()<Random>()
                                    : answer.variables()[0].visit([&]<class Kind>(const Variable<Kind>&) {
                                        return read.template operator()<Kind>();
                                      });
}

void bind_answer(py::module_& module) {
  py::class_<Elimination>(module, "Elimination", "In which order a query eliminated, and what that cost.")
      .def_readonly("order", &Elimination::order, "Names in the order in which they were eliminated.")
      .def_readonly("greatest_table", &Elimination::greatest_table, "The most outcomes that one step ranged over.")
      .def_readonly("forced", &Elimination::forced, "Whether the kinds forbade the order of least fill.")
      .def_readonly("greatest_table_if_one_kind", &Elimination::greatest_table_if_one_kind);
  py::class_<NetworkAnswer>(module, "NetworkAnswer",
                            "The numbers of a query, an axis for each variable: not normalised.")
      .def_property_readonly("variables",
                             [](const NetworkAnswer& self) {
                               py::list variables;
                               for (const NetworkVariable& variable : self.variables())
                                 variables.append(variable_of(variable));
                               return variables;
                             })
      .def_property_readonly(
          "values",
          [](const NetworkAnswer& self) {
            return shaped(self, self.values(), [](ScaledNumber number) { return number.value(); });
          },
          "Numbers; zero where a double cannot say better.")
      .def_property_readonly(
          "logs",
          [](const NetworkAnswer& self) {
            return shaped(self, self.values(), [](ScaledNumber number) { return number.log(); });
          },
          "Their logarithms, which do not underflow.")
      .def_property_readonly(
          "total", [](const NetworkAnswer& self) { return self.total().value(); },
          "⊕ of all numbers: β times the evidence.")
      .def_property_readonly("log_total", [](const NetworkAnswer& self) { return self.total().log(); })
      .def_property_readonly("induced", &NetworkAnswer::induced,
                             "Whether a variable of another kind was eliminated before.")
      .def_property_readonly("elimination", [](const NetworkAnswer& self) { return self.elimination(); })
      .def(
          "normalized",
          [](const NetworkAnswer& self) {
            return shaped(self, self.normalized(), [](double number) { return number; });
          },
          "All numbers divided by their total: the distribution reading.")
      .def(
          "distribution",
          [](const NetworkAnswer& self) {
            return of_kind(self, [&]<class Kind>() { return py::cast(self.normalized<Kind>()); });
          },
          "The distribution reading of the one variable asked for.")
      .def(
          "likelihood",
          [](const NetworkAnswer& self) {
            return of_kind(self, [&]<class Kind>() { return py::cast(self.likelihood<Kind>()); });
          },
          "The likelihood reading of the one variable asked for.");
}

void bind_declarations(py::module_& module) {
  py::class_<RelationNetwork> type(module, "RelationNetwork",
                                   "Random and fuzzy variables, each with a table given variables declared before it.");
  type.def(py::init())
      .def("__len__", &RelationNetwork::size)
      .def("declare", &declare, py::arg("variable"), py::arg("parents"), py::arg("rows"),
           "A variable with parents: rows (product of their sizes, variable.size), the last parent fastest.\n\n"
           "ValueError, with variable, row and value, if a row is no distribution.")
      .def_property_readonly(
          "names",
          [](const RelationNetwork& self) {
            Names names;
            for (const auto& vertex : self.vertices()) names.push_back(vertex.variable.name());
            return names;
          },
          "Names in the order of declaration.")
      .def(
          "variable",
          [](const RelationNetwork& self, const std::string& name) {
            return variable_of(self[self.index_of(name)].variable);
          },
          py::arg("name"))
      .def(
          "parents",
          [](const RelationNetwork& self, const std::string& name) {
            Names names;
            for (const std::size_t parent : self[self.index_of(name)].parents)
              names.push_back(self[parent].variable.name());
            return names;
          },
          py::arg("name"), "Names of a variable's parents.")
      .def(
          "table",
          [](const RelationNetwork& self, const std::string& name) {
            const Table table = self[self.index_of(name)].table();
            return copied(table.data(), table.rows(), table.columns());
          },
          py::arg("name"), "A copy of a variable's table, a row per outcome of its parents.")
      .def(
          "as_fuzzy",
          [](const RelationNetwork& self, const py::object& method, const std::optional<Names>& names) {
            const RowTransform transform = [&](std::span<const double> row) {
              return method.attr("possibilities")(copied(row.data(), row.size())).cast<std::vector<double>>();
            };
            return names ? as_fuzzy(self, transform, *names) : as_fuzzy(self, transform);
          },
          py::arg("method"), py::arg("names") = py::none(),
          "The network with its random variables, or those named, made fuzzy.")
      .def(
          "graphviz",
          [](const RelationNetwork& self) {
            std::ostringstream out;
            write_graphviz(out, self);
            return out.str();
          },
          "The network in the DOT language.");
  const auto declare_one = [&]<class T>() {
    type.def(
        "declare", [](RelationNetwork& self, const T& table) { self.declare(table); }, py::arg("table"));
  };
  Types<Distribution<Random>, Distribution<Fuzzy>, Relation<Random, Random>, Relation<Random, Fuzzy>,
        Relation<Fuzzy, Random>, Relation<Fuzzy, Fuzzy>>::for_each(declare_one);
}

py::object explanation(const Explanation& found) {
  py::dict outcomes;
  for (std::size_t i = 0; i < found.variables.size(); ++i)
    outcomes[py::str(found.variables[i].name())] = found.variables[i].label(found.outcomes[i]);
  return py::make_tuple(outcomes, found.log_value);
}

void bind_queries(py::module_& module) {
  const auto limit = py::arg("table_limit") = default_table_limit;
  const auto evidence = py::arg("evidence") = py::none();
  module.def(
      "query",
      [](const RelationNetwork& network, const Names& variables, const py::object& known, std::size_t table_limit) {
        const Evidence given = evidence_of(known);
        return unlocked([&] { return query(network, variables, given, table_limit); });
      },
      py::arg("network"), py::arg("variables"), evidence, limit,
      R"(query(network, variables, evidence=None, table_limit=1073741824)
--

The numbers of variables under evidence: all others eliminated innermost first, each by the ⊕ of its kind.

`evidence` is a dict: of a variable's name its label, a Likelihood or an Event. ValueError, before any arithmetic, if a
table would take more than `table_limit` bytes.)");
  module.def(
      "marginals",
      [](const RelationNetwork& network, const py::object& known, std::size_t table_limit) {
        const Evidence given = evidence_of(known);
        return unlocked([&] { return marginals(network, given, table_limit); });
      },
      py::arg("network"), evidence, limit, R"(marginals(network, evidence=None, table_limit=1073741824)
--

The query of every variable, in the order of declaration, from one tree of cliques where the kinds allow it.)");
  module.def(
      "cost",
      [](const RelationNetwork& network, const Names& variables, const py::object& known) {
        return cost(network, variables, evidence_of(known));
      },
      py::arg("network"), py::arg("variables"), evidence,
      "cost(network, variables, evidence=None)\n--\n\nWhat a query would cost.");
  module.def(
      "most_likely_explanation",
      [](const RelationNetwork& network, const py::object& known, std::size_t table_limit) {
        return explanation(most_likely_explanation(network, evidence_of(known), table_limit));
      },
      py::arg("network"), evidence, limit, R"(most_likely_explanation(network, evidence=None, table_limit=1073741824)
--

The outcomes of all variables together that are favoured most: a dict of names and labels, and the logarithm.)");
  module.def(
      "most_likely_outcomes",
      [](const RelationNetwork& network, const Names& variables, const py::object& known, std::size_t table_limit) {
        return explanation(most_likely_outcomes(network, variables, evidence_of(known), table_limit));
      },
      py::arg("network"), py::arg("variables"), evidence, limit,
      R"(most_likely_outcomes(network, variables, evidence=None, table_limit=1073741824)
--

The same of some variables, all others eliminated by their own kinds: of random ones the marginal MAP.)");
  module.def(
      "compose",
      [](const RelationNetwork& network, const std::string& from, const std::string& to, std::size_t table_limit) {
        const ComposedRelation found = unlocked([&] { return compose(network, from, to, table_limit); });
        const py::object relation = found.to().visit([&]<class To>(const Variable<To>&) {
          return found.from().visit([&]<class From>(const Variable<From>&) {
            return std::visit([](const auto& of_kinds) { return py::cast(of_kinds); }, found.relation<To, From>());
          });
        });
        return py::module_::import("sigmax._sigmax").attr("Inverse")(relation, found.unreachable());
      },
      py::arg("network"), py::arg("from_"), py::arg("to"), limit);
}

void bind_files(py::module_& module) {
  module.def(
      "read_bif",
      [](const py::object& path) {
        const py::object text = py::module_::import("pathlib").attr("Path")(path).attr("read_text")("utf-8");
        std::istringstream in(text.cast<std::string>());
        return read_bif(in, py::str(path).cast<std::string>());
      },
      py::arg("path"), R"(read_bif(path)
--

Reads a network of random variables in the Bayesian Interchange Format, version 0.15.

ValueError gives file, line, what was found and what was expected.)");
  module.def(
      "write_bif",
      [](const py::object& path, const RelationNetwork& network, const std::string& name) {
        std::ostringstream out;
        write_bif(out, network, name);
        py::module_::import("pathlib").attr("Path")(path).attr("write_text")(out.str(), "utf-8");
      },
      py::arg("path"), py::arg("network"), py::arg("name") = "network", R"(write_bif(path, network, name='network')
--

Writes a network of random variables in the same format, every number with the digits that it takes to read it again.)");
}

}  // namespace

void bind_network(py::module_& module) {
  bind_answer(module);
  bind_declarations(module);
  bind_queries(module);
  bind_files(module);
}

}  // namespace sigmax::python
