#include "arrays.hpp"
#include "kinds.hpp"
#include "rooms.hpp"

#include <map>
#include <sstream>
#include <type_traits>
#include <vector>

#include <pybind11/stl.h>

#include <sigmax/core/network/bif.hpp>
#include <sigmax/core/network/explanation.hpp>
#include <sigmax/core/network/query.hpp>

namespace sigmax::python {
namespace {

using Names = std::vector<std::string>;
using AnyVariable = std::variant<std::monostate, RandomVariable, FuzzyVariable>;

/// Of each variable's name its label, or a likelihood.
using Known = std::map<std::string, std::variant<std::string, Likelihood<Random>, Likelihood<Fuzzy>>>;

NetworkVariable network_variable(const AnyVariable& variable) {
  if (const auto* const fuzzy = std::get_if<FuzzyVariable>(&variable)) return *fuzzy;
  return std::get<RandomVariable>(variable);
}
py::object variable_of(const NetworkVariable& variable) {
  return variable.visit([](const auto& of_kind) { return py::cast(of_kind); });
}

Evidence evidence_of(const Known& known) {
  Evidence evidence;
  for (const auto& [key, value] : known) {
    const auto observe = [&, name = key](const auto& seen) {
      if constexpr (std::is_same_v<decltype(seen), const std::string&>)
        evidence.observe(name, seen);
      else if (seen.variable().name() == name)
        evidence.observe(seen);
      else
        throw py::value_error("evidence of '" + name + "': found that of '" + seen.variable().name() + "'");
    };
    std::visit(observe, value);
  }
  return evidence;
}

/// What read(number) is of all numbers, with an axis for each variable.
template <class Read>
auto shaped(const Read& read) {
  return [read](const NetworkAnswer& answer) {
    std::vector<py::ssize_t> shape;
    for (const auto& variable : answer.variables()) shape.push_back(static_cast<py::ssize_t>(variable.size()));
    Array array(shape);
    double* out = array.mutable_data();
    for (const ScaledNumber& number : answer.values()) *out++ = read(number);
    return array;
  };
}

/// read(answer, kind) by the kind of the first variable.
template <class Read>
auto of_kind(const Read& read) {
  return [read](const NetworkAnswer& self) {
    const bool fuzzy = !self.variables().empty() && self.variables()[0].is<Fuzzy>();
    return fuzzy ? py::cast(read(self, Fuzzy{})) : py::cast(read(self, Random{}));
  };
}

void bind_answer(py::module_& module) {
  using Answer = NetworkAnswer;
  py::class_<Answer> type(module, "NetworkAnswer", "Numbers of a query, an axis for each variable: not normalised.");
  property(type, "induced", "Whether a variable of another kind was eliminated before.", &Answer::induced);
  property(type, "values", "The numbers; zero where a double cannot say better.",
           shaped([](const ScaledNumber& number) { return number.value(); }));
  property(type, "logs", "Their logarithms, which do not underflow.",
           shaped([](const ScaledNumber& number) { return number.log(); }));
  property(type, "log_total", "Logarithm of the ⊕ of all numbers: of β times the evidence.",
           [](const Answer& self) { return self.total().log(); });
  method(type, "distribution", "The distribution reading of the one variable asked for.",
         of_kind([]<class Kind>(const Answer& self, Kind) { return self.normalized<Kind>(); }));
  method(type, "likelihood", "The likelihood reading of the one variable asked for.",
         of_kind([]<class Kind>(const Answer& self, Kind) { return self.likelihood<Kind>(); }));
}

void bind_declarations(py::module_& module) {
  using Network = RelationNetwork;
  py::class_<Network> type(module, "RelationNetwork",
                           "Random and fuzzy variables, each with a table given variables declared before it.");
  type.def(py::init());
  (MixedRelations{} + Types<Distribution<Random>, Distribution<Fuzzy>>{}).for_each([&]<class T>() {
    type.def("declare", [](Network& self, const T& table) { self.declare(table); });
  });
  method(type, "declare",
         "Declares the variable of a distribution, or of a relation given one declared before.\n\n"
         "Or a variable, its parents and rows (product of their sizes, size), the last parent fastest.",
         [](Network& self, const AnyVariable& variable, const std::vector<AnyVariable>& parents, const Array& rows) {
           std::vector<NetworkVariable> conditions;
           for (const AnyVariable& parent : parents) conditions.push_back(network_variable(parent));
           self.declare(network_variable(variable), conditions, rows_of(rows));
         });
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
  method(type, "table", "A copy of the table of a variable, a row per outcome of its parents.",
         [](const Network& self, const std::string& name) {
           const Table table = self[self.index_of(name)].table();
           return copied(table.data(), table.rows(), table.columns());
         });
}

void bind_queries(py::module_& module) {
  const auto known = py::arg("evidence") = py::dict();
  function(
      module, "query(network, variables, evidence={}, table_limit=1073741824)",
      "The numbers of variables under evidence: all others eliminated innermost first, each by the ⊕ of its kind.\n\n"
      "`evidence` has a label or a Likelihood for names of variables. ValueError, before any arithmetic, if a table\n"
      "would take more than `table_limit` bytes.",
      [](const RelationNetwork& network, const Names& variables, const Known& evidence, std::size_t bytes) {
        return unlocked([&] { return query(network, variables, evidence_of(evidence), bytes); });
      },
      py::arg("network"), py::arg("variables"), known, py::arg("table_limit") = default_table_limit);
  function(
      module, "marginals(network, evidence={})",
      "The query of every variable, in the order of declaration, from one tree of cliques where kinds allow it.",
      [](const RelationNetwork& network, const Known& evidence) {
        return unlocked([&] { return marginals(network, evidence_of(evidence)); });
      },
      py::arg("network"), known);
  function(
      module, "most_likely_explanation(network, variables=None, evidence={})",
      "The outcomes favoured most, a dict of names and labels, and the logarithm: of all variables together,\n"
      "or of some, all others eliminated by their own kinds (the marginal MAP).",
      [](const RelationNetwork& network, const std::optional<Names>& variables, const Known& given) {
        const Evidence evidence = evidence_of(given);
        const Explanation found = variables ? most_likely_outcomes(network, *variables, evidence)
                                            : most_likely_explanation(network, evidence);
        std::map<std::string, std::string> outcomes;
        for (const NetworkVariable& each : found.variables) outcomes[each.name()] = found[each.name()];
        return std::pair(outcomes, found.log_value);
      },
      py::arg("network"), py::arg("variables") = py::none(), known);
}

void bind_files(py::module_& module) {
  const py::object path_of = py::module_::import("pathlib").attr("Path");
  function(module, "read_bif(path, /)",
           "Reads a network of random variables in the Bayesian Interchange Format, version 0.15.\n\n"
           "ValueError gives file, line, what was found and what was expected.",
           [path_of](const py::object& path) {
             std::istringstream in(path_of(path).attr("read_text")("utf-8").cast<std::string>());
             return read_bif(in, std::string(py::str(path)));
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
