#include <nlohmann/json.hpp>
#include <regex>

#include <sigmax/recognition/table_classifier.hpp>

#include "apps/recognition_demo_support.hpp"
#include "shell/text.hpp"

namespace recognition_demo_learning_test {

const std::vector<std::string> classes = {"ash", "elm", "oak"};
const std::vector<std::string> colours = {"amber", "blue", "green, dark", "red"};

struct Tree {
  std::size_t kind;
  std::optional<std::size_t> colour;
  std::optional<double> height;
  std::optional<std::size_t> rings;  // 1, 2, 10: numbers that count as words
};

const std::vector<std::string> ring_words = {"1", "2", "10"};

/// Trees that differ by kind, with gaps.
std::vector<Tree> forest(std::size_t size) {
  std::mt19937_64 engine(5);
  const auto below = [&](std::size_t n) -> std::size_t { return engine() % n; };
  std::vector<Tree> trees;
  for (std::size_t i = 0; i < size; ++i) {
    Tree tree{below(3), below(4), 0.0, below(3)};
    if (below(2) == 0) tree.colour = tree.kind;
    tree.height = 5.0 + 2.0 * static_cast<double>(tree.kind) + 0.01 * static_cast<double>(below(700));
    if (below(9) == 0) tree.colour.reset();
    if (below(9) == 0) tree.height.reset();
    if (below(9) == 0) tree.rings.reset();
    trees.push_back(tree);
  }
  return trees;
}

std::string csv(const std::vector<Tree>& trees) {
  std::ostringstream text;
  text.precision(17);
  text << "id,colour,height,rings,kind\n";
  for (std::size_t i = 0; i < trees.size(); ++i) {
    const Tree& tree = trees[i];
    text << i << ',' << (tree.colour ? '"' + colours[*tree.colour] + '"' : "?") << ',';
    if (tree.height) text << *tree.height;
    text << ',' << (tree.rings ? ring_words[*tree.rings] : "") << ',' << classes[tree.kind] << '\n';
  }
  return text.str();
}

/// What the library learns of some of the trees; it is compared with plain counting by its own tests.
TableClassifier learned(const std::vector<Tree>& trees, std::size_t bins, double misread,
                        const std::function<bool(std::size_t row)>& chosen) {
  std::vector<double> heights;
  std::vector<std::string> shown_colours, rings;
  std::vector<std::size_t> labels;
  for (const Tree& tree : trees) {
    heights.push_back(tree.height.value_or(std::nan("")));
    shown_colours.push_back(tree.colour ? colours[*tree.colour] : "");
    rings.push_back(tree.rings ? ring_words[*tree.rings] : "");
    labels.push_back(tree.kind);
  }
  const std::vector<TableColumn> columns{{"colour", shown_colours}, {"height", heights}, {"rings", rings}};
  return TableClassifier{
      TableModel::fit(columns, {"kind", classes}, labels, {.bins = bins, .misread = misread}, chosen)};
}

/// Compares a row of a predictions.csv with what the library says of the tree.
void compare(const TextRow& row, const TableClassifier& sigma, const Tree& tree) {
  std::vector<TableCell> cells{tree.colour ? colours[*tree.colour] : "", tree.height.value_or(std::nan("")),
                               tree.rings ? ring_words[*tree.rings] : ""};
  const std::map<std::string, TableInference> inferences = {
      {"sigma", TableInference::sigma},
      {"max, ratio scale", TableInference::max_by_ratio},
      {"max, Dubois-Prade", TableInference::max_by_dubois_prade},
      {"sigma-max, Dubois-Prade", TableInference::sigma_max_by_dubois_prade}};
  const TablePrediction expected = sigma.by(inferences.at(row.at("classifier"))).predict(cells);
  Numbers found;
  for (const auto& name : classes) found.push_back(std::stod(row.at(name)));
  EXPECT_CLOSE(found, degrees_of(expected.belief), 1e-12) << row.at("classifier") << ", line " << row.at("line");
  EXPECT_EQ(row.at("decision"), expected.label) << row.at("classifier") << ", line " << row.at("line");
}

const Arguments columns = {"--label", "kind", "--ignore", "id", "--categorical", "rings"};

/// Tests that learn from a text and classify another one.
class RecognitionDemoLearning : public InDirectory {
 protected:
  void train(const std::string& text, const Arguments& options = {"--label", "kind"}) const {
    recognition_demo_succeeds(Arguments{"train", directory.write("train.csv", text), "--model", model} + options);
  }
  /// What is printed; the results are in `out`.
  std::string classify(const std::string& text, const Arguments& options = {}) const {
    const auto data = directory.write("new.csv", text);
    return recognition_demo_succeeds(Arguments{"classify", model, data, "--quiet", "--out", out} + options).output;
  }
  std::string predictions() const { return contents(out / "predictions.csv"); }
  nlohmann::json summary() const { return nlohmann::json::parse(contents(out / "summary.json")); }

  const std::filesystem::path model = directory.path() / "model.json", out = directory.path() / "out";
};

class Learning : public RecognitionDemoLearning, public testing::WithParamInterface<std::string> {
 protected:
  /// Sigma-max inference by the ratio scale is max inference by it, and so is that by another where nothing is misread.
  static std::size_t classifiers() { return GetParam() == "0" ? 3 : 4; }
};

TEST_P(Learning, AModelSavedAndReadBackIsThatOfTheLibrary) {
  const auto trees = forest(120);
  train(csv(trees), columns + Arguments{"--bins", "4", "--misread", GetParam()});
  classify(csv(trees));
  const TableClassifier sigma = learned(trees, 4, std::stod(GetParam()), [](std::size_t) { return true; });
  const auto found = rows(predictions());
  ASSERT_EQ(found.size(), classifiers() * trees.size());
  for (const auto& row : found) {
    const Tree& tree = trees[std::stoul(row.at("line")) - 2];
    compare(row, sigma, tree);
    EXPECT_EQ(row.at("truth"), classes[tree.kind]);
  }
}

TEST_P(Learning, EveryFoldIsClassifiedByWhatTheOthersTeach) {
  const auto trees = forest(90);
  const auto data = directory.write("forest.csv", csv(trees));
  recognition_demo_succeeds(Arguments{"evaluate", data, "--misread", GetParam(), "--out", out} + columns +
                            words("--folds 4 --foldings 1 --bins 3 --quiet"));
  const auto rows = rows_of(out / "predictions.csv");
  ASSERT_EQ(rows.size(), classifiers() * trees.size());
  std::map<std::size_t, std::string> fold_of;  // by row
  for (const auto& row : rows) fold_of[std::stoul(row.at("line")) - 2] = row.at("fold");
  std::map<std::string, TableClassifier> by;
  for (const std::string fold : {"1", "2", "3", "4"})
    by.emplace(fold, learned(trees, 3, std::stod(GetParam()), [&](std::size_t row) { return fold_of[row] != fold; }));
  std::map<std::string, double> right;
  for (const auto& row : rows) {
    compare(row, by.at(row.at("fold")), trees[std::stoul(row.at("line")) - 2]);
    if (row.at("decision") == row.at("truth")) right[row.at("classifier")] += 1.0 / 90.0;
  }
  for (const auto& [name, accuracy] : right)
    EXPECT_CLOSE(summary().at("classifiers").at(name).at("accuracy").get<double>(), accuracy, 1e-9) << name;
}

INSTANTIATE_TEST_SUITE_P(RecognitionDemo, Learning, testing::Values("0", "0.2"),
                         [](const auto& test) { return test.param == "0" ? "NeverMisread" : "OftenMisread"; });

/// Files of what another subcommand draws, too.
TEST_F(RecognitionDemoLearning, TheNumberOfThreadsChangesNoByte) {
  const Arguments forest_csv = {"evaluate", directory.write("forest.csv", csv(forest(60)))};
  for (const auto& [command, files] : {std::pair{forest_csv + columns, "predictions.csv confusion.csv"},
                                       {words("esm --alpha 0.5 --runs 300 --reports 3"), "curves.csv"}}) {
    for (const std::string threads : {"1", "3"})
      recognition_demo_succeeds(command +
                                Arguments{"--quiet", "--threads", threads, "--out", directory.path() / threads});
    for (const auto& file : words(files))
      EXPECT_EQ(contents(directory.path() / "1" / file), contents(directory.path() / "3" / file)) << file;
  }
}

/// A table of one numeric column, where some cells are `gap`, and of one of words.
std::string with_gaps(const std::string& gap) {
  std::ostringstream text;
  text << "size,colour,kind\n";
  for (const Tree& tree : forest(200))
    text << (tree.height ? std::to_string(*tree.height) : gap) << ',' << (tree.colour ? colours[*tree.colour] : "?")
         << ',' << classes[tree.kind] << '\n';
  return std::regex_replace(text.str(), std::regex("green, dark"), "green");
}

TEST_F(RecognitionDemoLearning, WordsForMissingNumbersLeaveAColumnNumeric) {
  const auto result = [&](const std::string& gap, std::vector<std::string> more) {
    return recognition_demo(Arguments{"evaluate", directory.write("trees.csv", with_gaps(gap)), "--label", "kind",
                                      "--foldings", "1", "--wide"} +
                            more)
        .output;
  };
  const std::string expected = result("", {});
  EXPECT_TRUE(says(expected, {"2 features (1 categorical, 1 numeric)"}));
  for (const char* gap : {"NA", "nan", "N/A", "null", "-", "inf", "?", " NA ", "NaN", "NULL"})
    EXPECT_EQ(result(gap, {}), expected) << gap;
  EXPECT_EQ(result("none at all", {"--missing", "gone,none at all"}), expected);
  EXPECT_EQ(result("\"12,5\"", {"--missing", "gone,\"12,5\""}), expected);
  EXPECT_TRUE(says(result("unknown", {}), {"found 'unknown', expected a number"}));
  EXPECT_TRUE(says(result("\"12,5\"", {}), {"found '12,5', expected a number", R"(--missing='"12,5"')"}));
}

TEST_F(RecognitionDemoLearning, ClassifyTakesTheSameWordsForMissing) {
  train(with_gaps("lost"), {"--label", "kind", "--missing", "lost"});
  classify(with_gaps(""));
  const std::string expected = predictions();
  for (const char* gap : {"lost", "NA"}) {
    classify(with_gaps(gap));
    EXPECT_EQ(predictions(), expected) << gap;
  }
}

TEST_F(RecognitionDemoLearning, AFirstRowOfDataIsPointedOut) {
  const auto evaluate = [&](const std::string& csv, const std::string& label) {
    const auto ending = recognition_demo_succeeds(
        {"evaluate", directory.write("data.csv", csv), "--label", label, "--folds", "2", "--foldings", "1"});
    return ending.output;
  };
  const std::string rows = "1.5,red,a\n2.5,blue,b\n1.25,red,a\n3,blue,b\n";
  EXPECT_TRUE(
      says(evaluate("2.75,blue,b\n" + rows, "b"), {"the first row looks like data, since 'b' is also a class"}));
  EXPECT_EQ(evaluate("size,colour,kind\n" + rows, "kind").find("warning"), std::string::npos);
  EXPECT_TRUE(says(evaluate("size,,kind\n" + rows, "kind"), {"column 2 has no name and is left out"}));
}

TEST_F(RecognitionDemoLearning, UnseenValuesAreMissingIfThatIsWanted) {
  train(with_gaps(""));
  const std::string said = classify("size,colour,kind\n7,,oak\n,red,\n", {"--unseen", "missing"});
  const std::string expected = predictions();
  const std::string warned = classify("size,colour,kind\n7,mauve,oak\nhuge,red,pine\n", {"--unseen", "missing"});
  EXPECT_EQ(predictions(), expected);
  EXPECT_EQ(said.find("count as missing"), std::string::npos) << said;
  EXPECT_TRUE(says(warned, {"3 cells count as missing", "new.csv:2: column 'colour': found 'mauve'"}));
  EXPECT_EQ(warned.find("--unseen"), std::string::npos) << warned;
}

TEST_F(RecognitionDemoLearning, WhatNamesTheRowsIsPointedOut) {
  std::string text = "id,name,height,colour,kind\n";
  for (int k = 0; k < 30; ++k)
    text +=
        fmt::format("{0},n{0},{1}.5,{2},{3}\n", 100 + 3 * k, k * 7 % 31, k % 2 ? "red" : "blue", k % 5 % 2 ? "a" : "b");
  const auto data = directory.write("trees.csv", text);
  const auto said = [&](const Arguments& options) {
    return recognition_demo_succeeds(Arguments{"train", data, "--model", model} + options).output;
  };
  const std::string all = said({"--label", "kind"});
  EXPECT_TRUE(says(all, {"leave it out by --ignore id", "leave it out by --ignore name"}));
  EXPECT_EQ(said({"--label", "kind", "--ignore", "id,name"}).find("warning"), std::string::npos) << all;
  // Thirty classes of a row each, of which most are below others whatever is read: a warning for each classifier.
  const std::string names = said({"--label", "name", "--ignore", "id,height"});
  EXPECT_TRUE(says(names, {"column 'name' names the rows (30 classes in 30 rows)", "so for 25 others of 30 classes"}));
  const std::regex warning("can never prefer");
  EXPECT_LE(std::distance(std::sregex_iterator(names.begin(), names.end(), warning), {}), 5);
}

TEST_F(RecognitionDemoLearning, AClassThatIsNeverRecognisedHasNoPrecision) {
  std::string text = "colour,kind\n";
  for (int k = 0; k < 40; ++k) text += k % 10 == 9 ? "\"red, dark\",rare\n" : "\"red, dark\",usual\nblue,other\n";
  const auto data = directory.write("trees.csv", text);
  recognition_demo_succeeds({"evaluate", data, "--label", "kind", "--folds", "2", "--out", out});
  EXPECT_EQ(summary().at("of_each_class").at("rare").at("sigma: recall"), 0.0);
  EXPECT_TRUE(summary().at("of_each_class").at("rare").at("sigma: precision").is_null());
  train(text);
  const std::string said = classify(text + "blue,\n", {"--rows", "1", "--explain"});
  EXPECT_TRUE(says(said, {"whose class is known"}));
  EXPECT_EQ(said.find("sigma-max"), std::string::npos) << said;  // which would be max inference
  const auto refused = recognition_demo({"classify", model, directory.write("new.csv", "colour\ngreen\n")});
  EXPECT_TRUE(says(refused.output, {R"(expected a value that the model knows: blue, "red, dark";)"}));
}

TEST_F(RecognitionDemoLearning, ReadsTheStandardInput) {
  const auto data = directory.write("trees.csv", with_gaps(""));
  const auto from = [&](const std::string& arguments) {
    return program::run("/bin/sh", {"-c", program::quoted(program::chosen(SIGMAX_RECOGNITION_DEMO)) + " " + arguments});
  };
  const std::string file = program::quoted(data.string()), model = program::quoted((directory.path() / "m").string());
  const std::string options = " --label kind --foldings 2 ";
  std::string expected = from("evaluate " + file + options).output;
  expected.replace(expected.find(data.string()), data.string().size(), "standard input");
  EXPECT_EQ(lines_of(from("evaluate - " + options + " < " + file).output, any_width).back(),
            lines_of(expected, any_width).back());
  EXPECT_EQ(from("train - --label kind --model " + model + " < " + file).status, 0);
  const auto classified = from("classify " + model + " - < " + file);
  EXPECT_TRUE(classified.output.starts_with("standard input: 200 rows")) << classified.output;
}

TEST_F(RecognitionDemoLearning, FoldingsAreAveraged) {
  const auto data = directory.write("trees.csv", with_gaps(""));
  const auto accuracy = [&](const Arguments& more) {
    recognition_demo_succeeds(Arguments{"evaluate", data, "--label", "kind", "--folds", "3", "--out", out} + more);
    return summary().at("classifiers").at("max, Dubois-Prade").at("accuracy").get<double>();
  };
  // The first folding is that of one alone; more foldings change the mean, and the seed the first.
  const double one = accuracy({"--foldings", "1"}), two = accuracy({"--foldings", "2"});
  EXPECT_NE(one, two);
  EXPECT_NEAR(two, one, 0.1);
  EXPECT_NE(accuracy({"--foldings", "1", "--seed", "2"}), one);
}

/// Half of the cells of one class are missing: that tells the class, if it is a value.
TEST_F(RecognitionDemoLearning, AMissingCellIsAValueIfThatIsWanted) {
  std::string text = "size,colour,kind\n";
  for (int k = 0; k < 60; ++k)
    text += fmt::format("{},{},{}\n", k % 2 ? "" : fmt::format("{}.5", k * 7 % 11),
                        k % 2   ? "?"
                        : k % 3 ? "red"
                                : "blue",
                        k % 2 ? "ill" : "well");
  const auto data = directory.write("t.csv", text);
  const auto log_loss = [&](const Arguments& more) {
    recognition_demo_succeeds(Arguments{"evaluate", data, "--label", "kind", "--out", out} + more);
    return summary().at("classifiers").at("sigma").at("log_loss").get<double>();
  };
  const double before = log_loss({"--ignore", "colour"});
  EXPECT_LT(log_loss({"--missing-value", "size", "--ignore", "colour"}), 0.3 * before);
  EXPECT_LT(log_loss({"--missing-value", "colour", "--ignore", "size"}), 0.3 * before);
  train(text, {"--label", "kind", "--missing-value", "size,colour"});
  EXPECT_TRUE(says(classify("size,colour,kind\n,,ill\n", {"--explain"}),
                   {"p(size = missing|kind = ill)", "p(colour = missing|kind = ill)"}));
}

TEST_F(RecognitionDemoLearning, EscapeCodesInNamesNeverReachTheTerminal) {
  const auto data =
      directory.write("trees.csv", "si\x1B[31mze,kind\n1,\x1B]0;x\x07 a\n2,b\x1B[2J\n1,\x1B]0;x\x07 a\n2,b\x1B[2J\n");
  const auto model = directory.path() / "trees.json";
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"evaluate", data, "--label", "kind", "--folds", "2", "--foldings", "1"},
        {"train", data, "--label", "kind", "--model", model},
        {"classify", model, data, "--explain"}}) {
    const auto ending = recognition_demo_succeeds(arguments);
    EXPECT_EQ(ending.output.find('\x1B'), std::string::npos) << ending.output;
    EXPECT_EQ(ending.output.find('\x07'), std::string::npos) << ending.output;
  }
}

TEST_F(RecognitionDemoLearning, TheTableOfTheReadmeTeachesWhatItHasNotSeen) {
  const std::filesystem::path data = SIGMAX_SOURCE "/apps/examples/data";
  train(contents(data / "fruit.csv"), {"--label", "fruit"});
  classify(contents(data / "fruit_new.csv"), {"--rows", "1", "--explain"});
  const auto found = summary();
  EXPECT_EQ(found.at("rows"), 40);
  for (const auto& [name, one] : found.at("classifiers").items())
    EXPECT_GE(one.at("accuracy_of_the_decided").get<double>(), 0.9) << name;
}

TEST_F(RecognitionDemoLearning, AModelHoldsOnlyTheKindsAskedFor) {
  train(csv(forest(60)), columns + Arguments{"--kinds", "sigma"});
  classify(csv(forest(60)));
  EXPECT_EQ(rows(predictions()).size(), 60U);
}

TEST_F(RecognitionDemoLearning, ALowMarginIsRejected) {
  train(csv(forest(60)), columns);
  classify(csv(forest(60)), {"--least-margin", "0.5"});
  std::size_t rejected = 0;
  for (const auto& row : rows(predictions())) {
    EXPECT_EQ(row.at("decision").empty(), std::stod(row.at("margin")) < 0.5) << row.at("line");
    rejected += row.at("decision").empty() ? 1U : 0U;
  }
  EXPECT_GT(rejected, 0U);
  EXPECT_LT(rejected, 300U);
}

TEST_F(RecognitionDemoLearning, AnExplanationShowsTheWinningValuesAndTheirProduct) {
  const std::string coins =
      "side,weight,coin\nheads,light,fair\ntails,light,fair\nheads,heavy,false\nheads,heavy,false\n";
  train(coins, {"--label", "coin", "--kinds", "sigma,max"});
  const std::string said = classify(coins, {"--explain", "--rows", "1"});
  // Laplace's rule on two values: 2/4 and 3/4 of fair, 3/4 and 1/4 of false.
  EXPECT_TRUE(says(said, {"p(side = heads|coin = fair) = 0.5", "p(weight = light|coin = fair) = 0.75",
                          "π(side = heads|coin = fair) = 1", "π(weight = light|coin = fair) = 1"}));
  // ½ ½ ¾ against ½ ¾ ¼: 2/3, and the logarithm of 2; and 1 against 1 · ⅓.
  EXPECT_TRUE(says(said, {"fair = 0.6667", "0.693", "1.1"}));
}

}  // namespace recognition_demo_learning_test
