// Any bytes are a network of random variables with normalised tables, which reads the same when written out again, or
// an error that names the file.
#include <numeric>
#include <stdexcept>

#include <sigmax/core/network/bif.hpp>

#include "fuzz/require.hpp"

namespace {

RelationNetwork read(const std::string& text, std::string_view name) {
  std::istringstream stream{text};
  return read_bif(stream, name);
}

/// Whether a variable has a name that the format cannot hold.
bool has_quotation_mark(const NetworkVariable& variable) {
  bool found = variable.name().find('"') != std::string::npos;
  for (std::size_t i = 0; i < variable.size(); ++i) found |= variable.label(i).find('"') != std::string::npos;
  return found;
}

void check_rows(const RelationNetwork::Vertex& vertex) {
  const Table table = vertex.table();
  for (std::size_t r = 0; r < table.rows(); ++r) {
    const auto row = table.row(r);
    require(std::abs(std::accumulate(row.begin(), row.end(), 0.0) - 1.0) <= 1e-9, "a row has the sum 1");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  RelationNetwork network;
  try {
    network = read({data, data + size}, "input");
  } catch (const std::invalid_argument& error) {
    require(std::string_view{error.what()}.starts_with("input:"), "an error names the file");
    return 0;
  }
  bool can_be_written = true;
  for (const auto& vertex : network.vertices()) {
    check_rows(vertex);
    can_be_written &= !has_quotation_mark(vertex.variable);
  }
  std::ostringstream written;
  try {
    write_bif(written, network, "network");
  } catch (const std::invalid_argument&) {
    require(!can_be_written && written.str().empty(), "only a quotation mark cannot be written, and nothing is");
    return 0;
  }
  const RelationNetwork again = read(written.str(), "output");
  require(again.size() == network.size(), "a network has as many variables when written out again");
  for (std::size_t v = 0; v < network.size(); ++v) {
    require(again[v].variable == network[v].variable, "a variable reads the same when written out again");
    require(again[v].parents == network[v].parents, "parents read the same when written out again");
    const Table found = again[v].table(), expected = network[v].table();
    require(std::ranges::equal(found.values(), expected.values()), "a table reads the same when written out again");
  }
  return 0;
}
