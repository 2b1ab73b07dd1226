#include "arrays.hpp"
#include "kinds.hpp"
#include "rooms.hpp"

#include <map>
#include <sstream>
#include <vector>

#include <pybind11/stl.h>

#include <sigmax/core/network/bif.hpp>
#include <sigmax/core/network/explanation.hpp>
#include <sigmax/core/network/query.hpp>

namespace sigmax::python {
namespace {

using Names = std::vector<std::string>;

/// Of each variable's name its label, or a likelihood.
using Known = std::map<std::string, std::variant<std::string, Likelihood<Random>, Likelihood<Fuzzy>>>;

Evidence evidence_of(const Known& known) {
  Evidence evidence;
  for (const auto& [key, value] : known) {
    const auto observe = [&, name = key](const auto& seen) {
      if constexpr (requires { evidence.observe(name, seen); })
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

/// Logarithms of the numbers, with an axis for each variable.
Array logs_of(const NetworkAnswer& answer) {
  std::vector<py::ssize_t> shape;
  for (const auto& variable : answer.variables()) shape.push_back(static_cast<py::ssize_t>(variable.size()));
  Array array(shape);
  std::ranges::transform(answer.values(), array.mutable_data(), &ScaledNumber::log);
  return array;
}

void bind_classes(py::module_& module) {
  py::class_<NetworkAnswer> answer(module, "NetworkAnswer", "Numbers of a query: not normalised.");
  property(answer, "induced", "Whether a variable of another kind was eliminated before.", &NetworkAnswer::induced);
  property(answer, "logs", "Logarithms of the numbers, with an axis for each variable.", &logs_of);
  property(answer, "log_total", "Logarithm of the ⊕ of all numbers: of β times the evidence.",
           [](const NetworkAnswer& self) { return self.total().log(); });
  method(answer, "distribution", "The distribution reading of the one variable asked for.",
         [](const NetworkAnswer& self) {
           const bool fuzzy = !self.variables().empty() && self.variables()[0].is<Fuzzy>();
           return fuzzy ? py::cast(self.normalized<Fuzzy>()) : py::cast(self.normalized<Random>());
         });

  py::class_<NetworkVariable>(module, "_NetworkVariable")
      .def(py::init<RandomVariable>())
      .def(py::init<FuzzyVariable>());
  py::implicitly_convertible<RandomVariable, NetworkVariable>();
  py::implicitly_convertible<FuzzyVariable, NetworkVariable>();

  using Network = RelationNetwork;
  py::class_<Network> network(module, "RelationNetwork",
                              "Random and fuzzy variables, each with a table given variables declared before it.");
  network.def(py::init());
  (MixedRelations{} + Types<Distribution<Random>, Distribution<Fuzzy>>{}).for_each([&]<class T>() {
    network.def("declare", [](Network& self, const T& table) { self.declare(table); });
  });
  method(network, "declare",
         "Declares the variable of a distribution, or of a relation given one declared before.\n\n"
         "Or a variable, its parents and rows (product of their sizes, size), the last parent fastest.",
         [](Network& self, const NetworkVariable& variable, const std::vector<NetworkVariable>& parents,
            const Array& rows) { self.declare(variable, parents, rows_of(rows)); });
  method(network, "variable", "The variable of this name.", [](const Network& self, const std::string& name) {
    return self[self.index_of(name)].variable.visit([](const auto& of_kind) { return py::cast(of_kind); });
  });
  property(network, "parents", "Names of the parents of each variable, in the order of declaration.",
           [](const Network& self) {
             py::dict all;
             for (const auto& vertex : self.vertices()) {
               py::list names;
               for (const std::size_t parent : vertex.parents) names.append(self[parent].variable.name());
               all[py::str(vertex.variable.name())] = names;
             }
             return all;
           });
  method(network, "table", "A copy of the table of a variable, a row per outcome of its parents.",
         [](const Network& self, const std::string& name) {
           const Table table = self[self.index_of(name)].table();
           return copied(table.data(), table.rows(), table.columns());
         });
}

}  // namespace

void bind_network(py::module_& module) {
  bind_classes(module);
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

  const py::object path_of = py::module_::import("pathlib").attr("Path");
  function(module, "read_bif(path, /)",
           "Reads a network of random variables in the Bayesian Interchange Format, version 0.15.\n\n"
           "ValueError gives file, line, what was found and what was expected.",
           [path_of](const py::object& path) {
             std::istringstream in(path_of(path).attr("read_text")("utf-8").cast<std::string>());
             return read_bif(in, std::string(py::str(path)));
           });
  function(module, "write_bif(path, network, /)",
           "Writes a network of random variables in the same format, with all digits.",
           [path_of](const py::object& path, const RelationNetwork& network) {
             std::ostringstream out;
             write_bif(out, network, path_of(path).attr("stem").cast<std::string>());
             path_of(path).attr("write_text")(out.str(), "utf-8");
           });
}

}  // namespace sigmax::python
