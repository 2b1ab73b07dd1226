#include "arrays.hpp"
#include "kinds.hpp"
#include "rooms.hpp"

#include <sstream>
#include <vector>

#include <pybind11/stl.h>

#include <sigmax/core/network/bif.hpp>
#include <sigmax/core/network/compose.hpp>
#include <sigmax/core/network/explanation.hpp>
#include <sigmax/core/network/query.hpp>

namespace sigmax::python {

namespace {

using Names = std::vector<std::string>;

NetworkVariable network_variable(py::handle object) {
  if (py::isinstance<RandomVariable>(object)) return object.cast<RandomVariable>();
  if (py::isinstance<FuzzyVariable>(object)) return object.cast<FuzzyVariable>();
  throw py::type_error("declare: expected a random or a fuzzy variable, found " + class_name(object));
}

py::object variable_of(const NetworkVariable& variable) {
  return variable.visit([](const auto& of_kind) { return py::cast(of_kind); });
}

/// A distribution or a relation of one parent; or a variable, its parents and rows, the last parent fastest.
void declare(RelationNetwork& network, py::handle table) {
  visit(MixedRelations{} + Types<Distribution<Random>, Distribution<Fuzzy>>{}, table,
        "declare: expected a distribution or relation of random and fuzzy variables",
        [&](const auto& of_kinds) { return network.declare(of_kinds), true; });
}
void declare_rows(RelationNetwork& network, py::handle variable, const py::iterable& parents, const py::object& rows) {
  std::vector<NetworkVariable> conditions;
  for (const py::handle parent : parents) conditions.push_back(network_variable(parent));
  if (is_sparse(rows)) return network.declare(network_variable(variable), conditions, sparse_rows(rows));
  network.declare(network_variable(variable), conditions, as_array(rows).cast<std::vector<std::vector<double>>>());
}

/// Evidence from a dict: of each variable's name the label that was seen, a likelihood, or an event.
Evidence evidence_of(const py::object& known) {
  Evidence evidence;
  if (known.is_none()) return evidence;
  for (const auto& [key, value] : py::dict(known)) {
    const auto name = py::cast<std::string>(py::str(key));
    if (py::isinstance<py::str>(value)) {
      evidence.observe(name, py::cast<std::string>(value));
      continue;
    }
    visit(Types<Likelihood<Random>, Likelihood<Fuzzy>, Event<Random>, Event<Fuzzy>>{}, value,
          "evidence of '" + name + "': expected a label, a likelihood or an event", [&](const auto& of_kind) {
            if (of_kind.variable().name() == name) return evidence.observe(of_kind), true;
            throw py::value_error("evidence of '" + name + "': found that of '" + of_kind.variable().name() + "'");
          });
  }
  return evidence;
}

/// Numbers with an axis for each variable.
template <class Numbers, class Read>
py::array shaped(const NetworkAnswer& answer, const Numbers& all, const Read& read) {
  std::vector<py::ssize_t> shape;
  for (const NetworkVariable& variable : answer.variables()) shape.push_back(static_cast<py::ssize_t>(variable.size()));
  py::array_t<double> array(shape);
  double* out = array.mutable_data();
  for (const auto& number : all) *out++ = read(number);
  return std::move(array);
}

/// read.operator()<Kind>() of the kind of the one variable asked for, which it checks to be the only one.
template <class Read>
py::object of_kind(const NetworkAnswer& answer, const Read& read) {
  const bool fuzzy = !answer.variables().empty() && answer.variables()[0].is<Fuzzy>();
  return fuzzy ? py::cast(read.template operator()<Fuzzy>()) : py::cast(read.template operator()<Random>());
}

void bind_answer(py::module_& module) {
  using Answer = NetworkAnswer;
  py::class_<Answer> type(module, "NetworkAnswer",
                          "The numbers of a query, an axis for each variable: not normalised.");
  type.def_property_readonly("induced", &Answer::induced, "Whether a variable of another kind was eliminated before.");
  property(type, "variables", "The variables asked for.", [](const Answer& self) {
    py::list variables;
    for (const NetworkVariable& variable : self.variables()) variables.append(variable_of(variable));
    return variables;
  });
  property(type, "values", "The numbers; zero where a double cannot say better.", [](const Answer& self) {
    return shaped(self, self.values(), [](ScaledNumber number) { return number.value(); });
  });
  property(type, "logs", "Their logarithms, which do not underflow.", [](const Answer& self) {
    return shaped(self, self.values(), [](ScaledNumber number) { return number.log(); });
  });
  property(type, "log_total", "Logarithm of the ⊕ of all numbers: of β times the evidence.",
           [](const Answer& self) { return self.total().log(); });
  method(type, "normalized", "All numbers divided by their total: the distribution reading.",
         [](const Answer& self) { return shaped(self, self.normalized(), [](double number) { return number; }); });
  method(type, "distribution", "The distribution reading of the one variable asked for.",
         [](const Answer& self) { return of_kind(self, [&]<class Kind>() { return self.normalized<Kind>(); }); });
  method(type, "likelihood", "The likelihood reading of the one variable asked for.",
         [](const Answer& self) { return of_kind(self, [&]<class Kind>() { return self.likelihood<Kind>(); }); });
}

/// The relation of the kinds that the network's variables have.
py::object compose_network(const RelationNetwork& network, const std::string& from, const std::string& to) {
  const ComposedRelation found = unlocked([&] { return compose(network, from, to); });
  const py::object relation = found.to().visit([&]<class To>(const Variable<To>&) {
    return found.from().visit([&]<class From>(const Variable<From>&) {
      return std::visit([](const auto& of_kinds) { return py::cast(of_kinds); }, found.relation<To, From>());
    });
  });
  return inverse(relation, found.unreachable());
}

void bind_declarations(py::module_& module) {
  using Network = RelationNetwork;
  py::class_<Network> type(module, "RelationNetwork",
                           "Random and fuzzy variables, each with a table given variables declared before it.");
  type.def(py::init());
  type.def("__len__", &Network::size);
  type.def("declare", &declare);
  method(type, "declare",
         "Declares the variable of a distribution, or of a relation given one declared before.\n\n"
         "Or a variable, its parents and rows (product of their sizes, size), the last parent fastest.",
         &declare_rows);
  property(type, "names", "Names in the order of declaration.", [](const Network& self) {
    Names names;
    for (const auto& vertex : self.vertices()) names.push_back(vertex.variable.name());
    return names;
  });
  method(type, "variable", "The variable of this name.",
         [](const Network& self, const std::string& name) { return variable_of(self[self.index_of(name)].variable); });
  method(type, "parents", "Names of the parents of a variable.", [](const Network& self, const std::string& name) {
    Names names;
    for (const std::size_t parent : self[self.index_of(name)].parents) names.push_back(self[parent].variable.name());
    return names;
  });
  method(type, "compose", "One variable given another, all others eliminated, as Inverse(relation, unreachable).",
         &compose_network);
  method(type, "table", "A copy of the table of a variable, a row per outcome of its parents.",
         [](const Network& self, const std::string& name) {
           const Table table = self[self.index_of(name)].table();
           return copied(table.data(), table.rows(), table.columns());
         });
}

/// Outcomes by the names of their variables, and the logarithm.
py::tuple explained(const RelationNetwork& network, const py::object& variables, const py::object& known) {
  const Evidence evidence = evidence_of(known);
  const Explanation found = variables.is_none() ? most_likely_explanation(network, evidence)
                                                : most_likely_outcomes(network, variables.cast<Names>(), evidence);
  py::dict outcomes;
  for (std::size_t i = 0; i < found.variables.size(); ++i)
    outcomes[py::str(found.variables[i].name())] = found.variables[i].label(found.outcomes[i]);
  return py::make_tuple(outcomes, found.log_value);
}

void bind_queries(py::module_& module) {
  const auto none = py::arg("evidence") = py::none();
  const auto limit = py::arg("table_limit") = default_table_limit;
  function(
      module, "query(network, variables, evidence=None, table_limit=1073741824)",
      "The numbers of variables under evidence: all others eliminated innermost first, each by the ⊕ of its kind.\n\n"
      "`evidence` is a dict: of a variable's name its label, a Likelihood or an Event. ValueError, before any\n"
      "arithmetic, if a table would take more than `table_limit` bytes.",
      [](const RelationNetwork& network, const Names& variables, const py::object& known, std::size_t bytes) {
        const Evidence evidence = evidence_of(known);
        return unlocked([&] { return query(network, variables, evidence, bytes); });
      },
      py::arg("network"), py::arg("variables"), none, limit);
  function(
      module, "marginals(network, evidence=None)",
      "The query of every variable, in the order of declaration, from one tree of cliques where kinds allow it.",
      [](const RelationNetwork& network, const py::object& known) {
        const Evidence evidence = evidence_of(known);
        return unlocked([&] { return marginals(network, evidence); });
      },
      py::arg("network"), none);
  function(module, "most_likely_explanation(network, variables=None, evidence=None)",
           "The outcomes favoured most, a dict of names and labels, and the logarithm: of all variables together,\n"
           "or of some, all others eliminated by their own kinds (the marginal MAP).",
           &explained, py::arg("network"), py::arg("variables") = py::none(), none);
}

void bind_files(py::module_& module) {
  const py::object path_of = py::module_::import("pathlib").attr("Path");
  function(module, "read_bif(path, /)",
           "Reads a network of random variables in the Bayesian Interchange Format, version 0.15.\n\n"
           "ValueError gives file, line, what was found and what was expected.",
           [path_of](const py::object& path) {
             std::istringstream in(path_of(path).attr("read_text")("utf-8").cast<std::string>());
             return read_bif(in, py::str(path).cast<std::string>());
           });
  function(
      module, "write_bif(path, network, name='network', /)",
      "Writes a network of random variables in the same format, with all digits.",
      [path_of](const py::object& path, const RelationNetwork& network, const std::string& name) {
        std::ostringstream out;
        write_bif(out, network, name);
        path_of(path).attr("write_text")(out.str(), "utf-8");
      },
      py::arg("path"), py::arg("network"), py::arg("name") = "network");
}

}  // namespace

void bind_network(py::module_& module) {
  bind_answer(module);
  bind_declarations(module);
  bind_queries(module);
  bind_files(module);
}

}  // namespace sigmax::python
