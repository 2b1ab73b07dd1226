#include <sigmax/core/network/graphviz.hpp>

#include <cstddef>
#include <ostream>
#include <string>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/graphviz.hpp>

namespace sigmax {

namespace {

/// In DOT a backslash escapes what follows, the closing quote as well.
std::string quoted(const std::string& name) {
  if (name.find('\\') == std::string::npos) return boost::escape_dot_string(name);
  std::string text = "\"";
  for (const char c : name) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + '"';
}

bool selects(const NetworkVariable& variable) {
  return variable.visit([]<class Kind>(const Variable<Kind>&) { return SelectiveAlgebra<AlgebraOf<Kind>>; });
}

}  // namespace

void write_graphviz(std::ostream& out, const RelationNetwork& network) {
  boost::adjacency_list<boost::vecS, boost::vecS, boost::bidirectionalS> graph(network.size());
  for (std::size_t child = 0; child < network.size(); ++child)
    for (const std::size_t parent : network[child].parents) boost::add_edge(parent, child, graph);
  boost::write_graphviz(out, graph, [&](std::ostream& text, std::size_t v) {
    const NetworkVariable& variable = network[v].variable;
    text << "[label=" << quoted(variable.name()) << ", shape=" << (selects(variable) ? "box" : "ellipse") << "]";
  });
}

}  // namespace sigmax
