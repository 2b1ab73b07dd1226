#include "core/network_grid.hpp"
#include "support/plain_network.hpp"

/// Published networks against a plain computation that eliminates strictly in the reverse order of declaration.
namespace network_data_test {

using plain::By;

std::string path_of(const std::string& name) { return std::string(SIGMAX_DATA) + "/relations/" + name + ".bif.gz"; }

/// What a compressed file holds.
std::string unpacked(const std::string& path) {
  std::FILE* const pipe = popen(("gzip -dc '" + path + "'").c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("gzip cannot be run");
  std::string text;
  std::array<char, 1 << 16> buffer{};
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe)) text.append(buffer.data(), count);
  if (pclose(pipe) != 0) throw std::runtime_error("gzip cannot read " + path);
  return text;
}

RelationNetwork read(const std::string& name) {
  std::istringstream in(unpacked(path_of(name)));
  return read_bif(in, name + ".bif");
}

class PublishedNetwork : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(path_of(GetParam()))) GTEST_SKIP() << path_of(GetParam()) << " is absent";
    network = read(GetParam());
  }
  RelationNetwork network;
};

plain::Network plain_of(const RelationNetwork& network, bool all_by_max = false) {
  plain::Network result;
  for (const auto& vertex : network.vertices()) {
    const auto& [variable, parents, stored] = vertex;
    const Table rows = vertex.table();
    plain::Network::Node node{all_by_max || variable.is<Fuzzy>() ? By::max : By::sum, variable.size(), parents, {}};
    for (std::size_t r = 0; r < rows.rows(); ++r) node.rows.emplace_back(rows.row(r).begin(), rows.row(r).end());
    result.nodes.push_back(node);
  }
  return result;
}

/// Evidence on variables that have no children, `count` of them: what each is least likely to be but may be together
/// with the others; and a likelihood on the first variable.
struct Case {
  Evidence evidence;
  plain::Weights weights;
};
Case symptoms(const RelationNetwork& network, std::size_t count) {
  const plain::Network plain_network = plain_of(network);
  Case result{{}, plain::no_evidence(plain_network)};
  std::vector<bool> has_children(network.size(), false);
  std::vector<std::size_t> world;
  for (const auto& node : plain_network.nodes) {
    std::size_t row = 0;
    for (const std::size_t parent : node.parents) {
      has_children[parent] = true;
      row = row * plain_network.nodes[parent].size + world[parent];
    }
    const auto rank = [](double value) { return value > 0.0 ? value : 2.0; };
    const auto& values = node.rows[row];
    const auto least =
        std::min_element(values.begin(), values.end(), [&](double a, double b) { return rank(a) < rank(b); });
    world.push_back(static_cast<std::size_t>(least - values.begin()));
  }
  for (std::size_t v = 0; v < network.size() && count > 0; ++v) {
    if (has_children[v]) continue;
    --count;
    result.evidence.observe(network[v].variable.name(), network[v].variable.label(world[v]));
    result.weights[v].assign(network[v].variable.size(), 0.0);
    result.weights[v][world[v]] = 1.0;
  }
  network[0].variable.visit([&](const auto& variable) {
    for (std::size_t i = 0; i < variable.size(); ++i) result.weights[0][i] = 0.5 / static_cast<double>(i + 1);
    result.evidence.observe(Likelihood(variable, result.weights[0]));
  });
  return result;
}

/// Of every sixth variable, beginning with another for every amount of evidence.
void expect_posteriors(const RelationNetwork& network, std::size_t evidence) {
  const Case given = symptoms(network, evidence);
  const plain::Network plain_network = plain_of(network);
  for (std::size_t v = evidence % 6; v < network.size(); v += 6) {
    SCOPED_TRACE(network[v].variable.name());
    const auto expected = plain::eliminate_in_reverse(plain_network, given.weights, {v});
    const auto total = plain::eliminate(plain_network.nodes[v].by, expected);
    const NetworkAnswer answer = query(network, {network[v].variable.name()}, given.evidence);
    std::vector<double> normalized;
    for (const auto value : expected) normalized.push_back(static_cast<double>(value / total));
    EXPECT_CLOSE(answer.normalized(), normalized, 1e-12);
    EXPECT_CLOSE(answer.total().log(), static_cast<double>(std::log(total)), 1e-12);
  }
}

void expect_explanation(const RelationNetwork& network, std::size_t evidence) {
  const Case given = symptoms(network, evidence);
  const plain::Network by_max = plain_of(network, true);
  const auto greatest = std::log(plain::eliminate_in_reverse(by_max, given.weights, {}).front());
  const Explanation found = most_likely_explanation(network, given.evidence);
  EXPECT_CLOSE(found.log_value, static_cast<double>(greatest), 1e-12);
  const auto route = std::log(plain::joint(by_max, given.weights, found.outcomes));
  EXPECT_CLOSE(static_cast<double>(route), static_cast<double>(greatest), 1e-12);
}

using SmallNetwork = PublishedNetwork;

TEST_P(SmallNetwork, AnswersAsThePlainComputation) {
  for (const std::size_t evidence : {0U, 3U, 8U}) expect_posteriors(network, evidence);
}
TEST_P(SmallNetwork, MadeFuzzyAnswersAsThePlainComputation) {
  for (const std::size_t evidence : {0U, 3U, 8U}) expect_posteriors(as_fuzzy(network, RatioScale{}), evidence);
}
TEST_P(SmallNetwork, MadeFuzzyInPartAnswersAsThePlainComputation) {
  std::vector<std::string> every_third;
  for (std::size_t v = 0; v < network.size(); v += 3) every_third.push_back(network[v].variable.name());
  for (const std::size_t evidence : {0U, 3U, 8U})
    expect_posteriors(as_fuzzy(network, DuboisPrade{}, every_third), evidence);
}
TEST_P(SmallNetwork, HasTheSameAnswersAllAtOnce) {
  std::vector<std::string> the_last;
  for (std::size_t v = network.size() / 2; v < network.size(); ++v) the_last.push_back(network[v].variable.name());
  for (const std::size_t evidence : {0U, 8U})
    for (const RelationNetwork& each :
         {network, as_fuzzy(network, RatioScale{}), as_fuzzy(network, RatioScale{}, the_last)})
      expect_single_queries(each, symptoms(each, evidence).evidence);
}
TEST_P(SmallNetwork, IsExplainedAsByThePlainComputation) {
  for (const std::size_t evidence : {0U, 3U, 8U}) {
    expect_explanation(network, evidence);
    expect_explanation(as_fuzzy(network, RatioScale{}), evidence);
  }
}
INSTANTIATE_TEST_SUITE_P(Bif, SmallNetwork, testing::Values("alarm", "insurance"),
                         [](const auto& test) { return std::string(test.param); });

using LargeNetwork = PublishedNetwork;

TEST_P(LargeNetwork, HasTheTotalOneInEveryMarginal) {
  for (const auto& vertex : network.vertices()) {
    const NetworkAnswer answer = query(network, {vertex.variable.name()});
    EXPECT_CLOSE(answer.total().value(), 1.0, 1e-12) << vertex.variable.name();
    EXPECT_FALSE(answer.induced());
  }
}

TEST_P(LargeNetwork, GivesTheSameEvidenceWhateverIsAsked) {
  for (const RelationNetwork& each : {network, as_fuzzy(network, RatioScale{})}) {
    const Case own = symptoms(each, 10);
    const double evidence = query(each, {}, own.evidence).total().log();
    EXPECT_LT(evidence, 0.0);
    for (std::size_t v = 0; v < each.size(); v += 5) {
      const NetworkAnswer answer = query(each, {each[v].variable.name()}, own.evidence);
      EXPECT_CLOSE(answer.total().log(), evidence, 1e-12) << each[v].variable.name();
      EXPECT_FALSE(answer.elimination().forced);
    }
  }
}

TEST_P(LargeNetwork, HasTheSameAnswersAllAtOnce) { expect_single_queries(network, symptoms(network, 10).evidence); }

TEST_P(LargeNetwork, IsExplainedByARouteOfTheValueGiven) {
  const Case given = symptoms(network, 10);
  const Explanation found = most_likely_explanation(network, given.evidence);
  const auto route = std::log(plain::joint(plain_of(network), given.weights, found.outcomes));
  EXPECT_CLOSE(found.log_value, static_cast<double>(route), 1e-12);
  // Of normalised fuzzy tables alone, a route of possibility one always exists.
  const RelationNetwork fuzzy = as_fuzzy(network, RatioScale{});
  EXPECT_CLOSE(most_likely_explanation(fuzzy, {}).log_value, 0.0, 1e-12);
}
INSTANTIATE_TEST_SUITE_P(Bif, LargeNetwork, testing::Values("hailfinder", "win95pts", "pathfinder"),
                         [](const auto& test) { return std::string(test.param); });

TEST(PublishedNetworks, AreReadWhole) {
  struct Expected {
    const char* name;
    std::size_t variables, arcs, parameters;
  };
  // Counted in the files by other means; parameters are free ones, the last of each row not counted.
  for (const auto& [name, variables, arcs, parameters] : {Expected{"alarm", 37, 46, 509},
                                                          {"insurance", 27, 52, 1008},
                                                          {"hailfinder", 56, 66, 2656},
                                                          {"win95pts", 76, 112, 574},
                                                          {"pathfinder", 109, 195, 72079}}) {
    if (!std::filesystem::exists(path_of(name))) GTEST_SKIP() << path_of(name) << " is absent";
    const RelationNetwork network = read(name);
    std::size_t found_arcs = 0, found_parameters = 0;
    for (const auto& vertex : network.vertices()) {
      found_arcs += vertex.parents.size();
      const Table rows = vertex.table();
      found_parameters += rows.rows() * (rows.columns() - 1);
    }
    EXPECT_EQ(network.size(), variables) << name;
    EXPECT_EQ(found_arcs, arcs) << name;
    EXPECT_EQ(found_parameters, parameters) << name;
  }
}

}  // namespace network_data_test
