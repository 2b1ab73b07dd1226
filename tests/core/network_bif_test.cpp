#include "support/core.hpp"

namespace network_bif_test {

RelationNetwork read(const std::string& text) {
  std::istringstream in(text);
  return read_bif(in, "test.bif");
}

testing::AssertionResult refused(const std::string& text, std::initializer_list<std::string_view> words) {
  return throws<std::invalid_argument>([&] { read(text); }, words);
}

const std::string header = "network unknown {\n}\n";
const std::string variables = header + "variable a {\n  type discrete [ 2 ] { yes, no };\n}\n" +
                              "variable b {\n  type discrete [ 3 ] { low, mid, high };\n}\n";  // lines 1 to 8
const std::string a_block = "probability ( a ) {\n  table 0.25, 0.75;\n}\n";                   // lines 9 to 11
const std::string b_block = "probability ( b | a ) {\n  (yes) 0.5, 0.25, 0.25;\n  (no) 0.125, 0.125, 0.75;\n}\n";

TEST(Bif, ReadsVariablesAndTheirTables) {
  const RelationNetwork network = read(variables + a_block + b_block);
  ASSERT_EQ(network.size(), 2U);
  EXPECT_EQ(network[0].variable, NetworkVariable(RandomVariable{"a", {"yes", "no"}}));
  EXPECT_EQ(network[1].variable, NetworkVariable(RandomVariable{"b", {"low", "mid", "high"}}));
  EXPECT_EQ(network[1].parents, std::vector<std::size_t>{0});
  EXPECT_CLOSE(network[0].table().values(), (std::vector{0.25, 0.75}), 0.0);
  EXPECT_CLOSE(network[1].table().values(), (std::vector{0.5, 0.25, 0.25, 0.125, 0.125, 0.75}), 0.0);
}

TEST(Bif, PutsParentsFirstWhateverTheOrderOfTheFile) {
  const RelationNetwork network = read(header +
                                       "variable child { type discrete [ 2 ] { 0, 1 }; }"
                                       "variable second { type discrete [ 2 ] { 0, 1 }; }"
                                       "variable first { type discrete [ 2 ] { 0, 1 }; }"
                                       "probability ( child | first, second ) { default 0.5, 0.5; (1, 0) 1, 0; }"
                                       "probability ( second ) { table 0.5, 0.5; }"
                                       "probability ( first | second ) { (1) 0, 1; (0) 1, 0; }");
  ASSERT_EQ(network.size(), 3U);
  EXPECT_EQ(network[0].variable.name(), "second");
  EXPECT_EQ(network[1].variable.name(), "first");
  EXPECT_EQ(network[2].variable.name(), "child");
  EXPECT_EQ(network[2].parents, (std::vector<std::size_t>{1, 0}));  // first, second: as in the file
  EXPECT_CLOSE(network[2].table().values(), (std::vector{0.5, 0.5, 0.5, 0.5, 1.0, 0.0, 0.5, 0.5}), 0.0);
}

TEST(Bif, ReadsATableWithTheOutcomesOfTheVariableSlowest) {
  const std::string parents =
      header +
      "variable p { type discrete [ 2 ] { 0, 1 }; } variable q { type discrete [ 2 ] { 0, 1 }; }"
      "variable c { type discrete [ 2 ] { 0, 1 }; }"
      "probability ( p ) { table 0.5 0.5; } probability ( q ) { table 0.5 0.5; }";
  const RelationNetwork network = read(parents + "probability ( c | p, q ) { table 0.1 0.2 0.3 0.4 0.9 0.8 0.7 0.6; }");
  EXPECT_CLOSE(network[2].table().values(), (std::vector{0.1, 0.9, 0.2, 0.8, 0.3, 0.7, 0.4, 0.6}), 1e-15);
}

TEST(Bif, ReadsQuotesCommentsPropertiesAndNumbersOfAnyForm) {
  const RelationNetwork network = read(
      "// a network\nnetwork \"two; words\" { property \"version; 1\" ; property author me; }\n"
      "variable \"light on\" /* a lamp\n */ { property position = (1, 2) ; type discrete[2] { \"}\" \"<5\" }; property "
      "x; }\n"
      "probability(\"light on\") { property seen ; table 1e-3 9.99E-1 ; // done\n}");
  ASSERT_EQ(network.size(), 1U);
  EXPECT_EQ(network[0].variable, NetworkVariable(RandomVariable{"light on", {"}", "<5"}}));
  EXPECT_CLOSE(network[0].table().values(), (std::vector{0.001, 0.999}), 1e-15);
}

TEST(Bif, DividesRowsThatAreRoundedInPrint) {
  const RelationNetwork network = read(variables + "probability ( a ) { table 0.3333, 0.6666; }" + b_block);
  EXPECT_CLOSE(network[0].table().values(), (std::vector{0.3333 / 0.9999, 0.6666 / 0.9999}), 1e-15);
  EXPECT_CLOSE(query(network, {}).total().value(), 1.0, 1e-15);
}

TEST(Bif, RefusesRowsThatAreNotRoundedButWrong) {
  EXPECT_TRUE(
      refused(variables + "probability ( a ) {\n  table 0.25, 0.748;\n}\n", {"test.bif:10:", "sum 1", "0.998"}));
  EXPECT_TRUE(
      refused(variables + a_block + "probability ( b | a ) {\n  (yes) 0.5, 0.25, 0.25;\n  (no) 0.5, 0.5, 0.5;\n}",
              {"test.bif:14:", "sum 1", "1.5"}));
}

TEST(Bif, NamesFileLineWhatWasExpectedAndWhatWasFound) {
  EXPECT_TRUE(refused("", {"test.bif:1:", "'network'", "the end of the file"}));
  EXPECT_TRUE(refused("\x1F\x8B\x08\n", {"test.bif:1:", "compressed", "gunzip"}));
  EXPECT_TRUE(refused("\n\nbayes x {}", {"test.bif:3:", "'network'", "'bayes'"}));
  EXPECT_TRUE(refused("network {", {"test.bif:1:", "name of the network", "'{'"}));
  EXPECT_TRUE(refused("network x {", {"test.bif:1:", "'property' or '}'", "the end of the file"}));
  EXPECT_TRUE(refused(header + "variables a", {"test.bif:3:", "'variable' or 'probability'", "'variables'"}));
  EXPECT_TRUE(refused(header + "variable a {\n type continuous;", {"test.bif:4:", "'discrete'", "'continuous'"}));
  EXPECT_TRUE(
      refused(header + "variable a { type discrete [ 3 ]\n { yes, no }; }", {"test.bif:3:", "'3'", "2 outcomes"}));
  EXPECT_TRUE(refused(header + "variable a { type discrete [ 2 ] { yes, yes }; }", {"test.bif:3:", "'a'", "'yes'"}));
  EXPECT_TRUE(refused(header + "variable a { type discrete [ 0 ] { }; }", {"test.bif:3:", "'a'", "at least one"}));
  EXPECT_TRUE(refused(header + "variable a { }", {"test.bif:3:", "'type'", "'}'"}));
  EXPECT_TRUE(refused(header + "variable a { property", {"test.bif:3:", "';'", "the end of the file"}));
  EXPECT_TRUE(refused(header + "variable \"a", {"test.bif:3:", "'\"'", "the end of the file"}));
  EXPECT_TRUE(refused(header + "\n/* variable", {"test.bif:4:", "'*/'", "the end of the file"}));
  EXPECT_TRUE(refused(variables + "variable a { type discrete [ 1 ] { x }; }", {"test.bif:9:", "'a'", "twice"}));
}

TEST(Bif, NamesTheLineOfABadProbability) {
  const std::string given = variables + a_block;  // eleven lines
  EXPECT_TRUE(refused(given + "probability ( c ) {", {"test.bif:12:", "declared variable", "'c'"}));
  EXPECT_TRUE(refused(given + "probability ( b | c ) {", {"test.bif:12:", "declared variable", "'c'"}));
  EXPECT_TRUE(refused(given + a_block, {"test.bif:12:", "'a'", "line 9"}));
  EXPECT_TRUE(refused(given + "probability ( b ) {\n  table 0.5, 0.5;", {"test.bif:13:", "3 numbers for 'b'", "';'"}));
  EXPECT_TRUE(refused(given + "probability ( b ) {\n  table 0.5, 0.5, 0.0, 0.0;", {"test.bif:13:", "';'", "'0.0'"}));
  EXPECT_TRUE(refused(given + "probability ( b ) {\n  table 0.5, 0,5;", {"test.bif:13:", "between 0 and 1", "'5'"}));
  for (const std::string number : {"nan", "inf", "-0.5", "1.5", "0.5x", "1e999", "+0.5", "0x1"})
    EXPECT_TRUE(refused(given + "probability ( b ) {\n  table " + number + ", 0.5, 0.5;\n}",
                        {"test.bif:13:", "between 0 and 1", "'" + number + "'"}));
  EXPECT_TRUE(refused(given + "probability ( b | a ) {\n (yes) 1, 0, 0;\n (maybe) 1, 0, 0;\n}",
                      {"test.bif:14:", "'a'", "'maybe'", "yes, no"}));
  EXPECT_TRUE(refused(given + "probability ( b | a ) {\n (yes) 1, 0, 0;\n (yes) 1, 0, 0;\n}",
                      {"test.bif:14:", "(yes)", "twice"}));
  EXPECT_TRUE(
      refused(given + "probability ( b | a ) {\n (yes) 1, 0, 0;\n}", {"test.bif:14:", "(no)", "'default'", "'}'"}));
  EXPECT_TRUE(refused(given + "probability ( b | a ) {\n (yes, no) 1, 0, 0;\n}", {"test.bif:13:", "')'", "'no'"}));
  EXPECT_TRUE(refused(given + "probability ( b | a ) {\n () 1, 0, 0;\n}", {"test.bif:13:", "outcome of 'a'", "')'"}));
  EXPECT_TRUE(refused(given + "probability ( b | a ) {\n (yes) 1, 0, 0;\n table 1, 0, 0, 0, 0, 1;\n}",
                      {"test.bif:14:", "'table'", "both"}));
  EXPECT_TRUE(refused(given, {"test.bif:6:", "probability of variable 'b'", "none"}));
}

TEST(Bif, RefusesCyclesByTheirNames) {
  const std::string b_given_a = "probability ( b | a ) { default 1, 0, 0; }\n";
  EXPECT_TRUE(refused(variables + "probability ( a | b ) { default 1, 0; }\n" + b_given_a,
                      {"test.bif:10:", "depend on 'b'", "'a'"}));
  EXPECT_TRUE(refused(variables + "probability ( a | a ) { default 1, 0; }\n" + b_given_a,
                      {"test.bif:9:", "depend on 'a'", "'a'"}));
  EXPECT_TRUE(refused(variables + a_block + "probability ( b | a, a ) { default 1, 0, 0; }\n",
                      {"test.bif:12:", "'b'", "'a'", "twice"}));
}

TEST(Bif, RefusesATableThatNoMemoryHolds) {
  std::string text = header;
  std::string parents;
  for (int i = 0; i < 64; ++i) {
    const std::string name = "p" + std::to_string(i);
    text += "variable " + name + " { type discrete [ 2 ] { 0, 1 }; }\n";
    parents += (i > 1 ? ", " : "") + (i > 0 ? name : "");
  }
  EXPECT_TRUE(refused(text + "probability ( p0 | " + parents + " ) { default 0.5, 0.5; }", {"test.bif:67:", "'p0'"}));
}

TEST(Bif, RefusesAStreamThatCannotBeRead) {
  std::ifstream none("no such file.bif");
  EXPECT_INVALID(("no such file.bif:1:", "read"), read_bif(none, "no such file.bif"));
}

}  // namespace network_bif_test
