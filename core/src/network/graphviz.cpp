#include <sigmax/core/network/graphviz.hpp>

#include <cstddef>
#include <ostream>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/graphviz.hpp>

namespace sigmax {

void write_graphviz(std::ostream& out, const RelationNetwork& network) {
  boost::adjacency_list<boost::vecS, boost::vecS, boost::bidirectionalS> graph(network.size());
  for (std::size_t child = 0; child < network.size(); ++child)
    for (const std::size_t parent : network[child].parents) boost::add_edge(parent, child, graph);
  boost::write_graphviz(out, graph, [&](std::ostream& text, std::size_t v) {
    const NetworkVariable& variable = network[v].variable;
    text << "[label=" << boost::escape_dot_string(variable.name())
         << ", shape=" << (variable.is<Fuzzy>() ? "box" : "ellipse") << "]";
  });
}

}  // namespace sigmax
