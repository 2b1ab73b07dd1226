#include <nlohmann/json.hpp>
#include <regex>

#include "apps/recognition_demo_support.hpp"
#include "support/text.hpp"

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

/// Naive Bayes and its possibilistic counterparts, learned by counting.
class Restatement {
 public:
  Restatement(const std::vector<Tree>& trees, const std::set<std::size_t>& rows, std::size_t bins, double misread)
      : misread_(misread) {
    Numbers heights;
    for (const std::size_t row : rows)
      if (trees[row].height) heights.push_back(*trees[row].height);
    std::sort(heights.begin(), heights.end());
    for (std::size_t j = 1; j < bins; ++j) {
      const double cut = heights[j * heights.size() / bins];
      if (cut > heights.front() && (cuts_.empty() || cut > cuts_.back())) cuts_.push_back(cut);
    }
    const std::array<std::size_t, 3> sizes = {colours.size(), cuts_.size() + 1, ring_words.size()};
    for (std::size_t f = 0; f < 3; ++f) p_[f] = Matrix(3, Numbers(sizes[f], 1.0));  // Laplace
    prior_ = Numbers(3, 0.0);
    for (const std::size_t row : rows) {
      prior_[trees[row].kind] += 1.0;
      const auto readings = read(trees[row]);
      for (std::size_t f = 0; f < 3; ++f)
        if (readings[f]) p_[f][trees[row].kind][*readings[f]] += 1.0;
    }
    prior_ = divided(prior_, sum(prior_));
    for (auto& table : p_) table = each_row(table, [](const Numbers& row) { return divided(row, sum(row)); });
  }

  std::array<std::optional<std::size_t>, 3> read(const Tree& tree) const {
    std::optional<std::size_t> bin;
    if (tree.height) {
      bin = 0;
      for (const double cut : cuts_) *bin += *tree.height >= cut ? 1U : 0U;
    }
    return {tree.colour, bin, tree.rings};
  }

  Numbers sigma(const Tree& tree) const {
    return believed(tree, prior_, p_, false, [](const Numbers& row) { return row; });
  }
  template <class Transform>
  Numbers fuzzy(const Tree& tree, const Transform& transform, bool random_sensor) const {
    std::array<Matrix, 3> pi;
    for (std::size_t f = 0; f < 3; ++f) pi[f] = each_row(p_[f], transform);
    if (random_sensor) return believed(tree, transform(prior_), pi, true, [](const Numbers& row) { return row; });
    return believed(tree, transform(prior_), pi, true, transform);
  }

 private:
  template <class SensorTransform>
  Numbers believed(const Tree& tree, const Numbers& prior, const std::array<Matrix, 3>& tables, bool by_max,
                   const SensorTransform& sensor_transform) const {
    Numbers belief = prior;
    const auto readings = read(tree);
    for (std::size_t f = 0; f < 3; ++f) {
      if (!readings[f]) continue;
      const std::size_t size = tables[f].front().size();
      for (std::size_t c = 0; c < 3; ++c) {
        double likelihood = 0.0;
        for (std::size_t value = 0; value < size; ++value) {
          Numbers sensor(size, misread_ / static_cast<double>(size - 1));
          sensor[value] = 1.0 - misread_;
          const double term = sensor_transform(sensor)[*readings[f]] * tables[f][c][value];
          likelihood = by_max ? std::max(likelihood, term) : likelihood + term;
        }
        belief[c] *= likelihood;
      }
    }
    return divided(belief, by_max ? greatest(belief) : sum(belief));
  }

  double misread_;
  Numbers cuts_;
  Numbers prior_;
  std::array<Matrix, 3> p_;
};

/// Compares the rows of a predictions.csv of one line with the restatement.
void compare(const TextRow& row, const Restatement& learned, const Tree& tree) {
  const std::map<std::string, Numbers> expected = {
      {"sigma", learned.sigma(tree)},
      {"max, ratio scale", learned.fuzzy(tree, by_ratio, false)},
      {"max, Dubois-Prade", learned.fuzzy(tree, by_dubois_prade, false)},
      {"sigma-max, ratio scale", learned.fuzzy(tree, by_ratio, true)},
      {"sigma-max, Dubois-Prade", learned.fuzzy(tree, by_dubois_prade, true)}};
  Numbers found;
  for (const auto& name : classes) found.push_back(std::stod(row.at(name)));
  const Numbers& belief = expected.at(row.at("classifier"));
  EXPECT_CLOSE(found, belief, 1e-9) << row.at("classifier") << ", line " << row.at("line");
  const auto winner =
      static_cast<std::size_t>(std::find_if(belief.begin(), belief.end(),
                                            [&](double value) { return value >= greatest(belief) * (1.0 - 1e-9); }) -
                               belief.begin());
  EXPECT_EQ(row.at("decision"), classes[winner]) << row.at("classifier") << ", line " << row.at("line");
}

std::set<std::size_t> all_rows(std::size_t size) {
  std::set<std::size_t> rows;
  for (std::size_t row = 0; row < size; ++row) rows.insert(row);
  return rows;
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

class Learning : public RecognitionDemoLearning, public testing::WithParamInterface<std::string> {};

TEST_P(Learning, AModelSavedAndReadBackEqualsPlainCounting) {
  const auto trees = forest(120);
  train(csv(trees), columns + Arguments{"--bins", "4", "--misread", GetParam()});
  classify(csv(trees));
  const Restatement learned(trees, all_rows(trees.size()), 4, std::stod(GetParam()));
  const auto found = rows(predictions());
  ASSERT_EQ(found.size(), 5 * trees.size());
  for (const auto& row : found) {
    const Tree& tree = trees[std::stoul(row.at("line")) - 2];
    compare(row, learned, tree);
    EXPECT_EQ(row.at("truth"), classes[tree.kind]);
  }
}

TEST_P(Learning, EveryFoldIsClassifiedByWhatTheOthersTeach) {
  const auto trees = forest(90);
  const auto data = directory.write("forest.csv", csv(trees));
  recognition_demo_succeeds(Arguments{"evaluate", data, "--misread", GetParam(), "--out", out} + columns +
                            words("--folds 4 --foldings 1 --bins 3 --quiet"));
  const auto rows = rows_of(out / "predictions.csv");
  ASSERT_EQ(rows.size(), 5 * trees.size());
  std::map<std::string, std::set<std::size_t>> outside;
  for (const auto& row : rows)
    for (const std::string fold : {"1", "2", "3", "4"})
      if (row.at("fold") != fold) outside[fold].insert(std::stoul(row.at("line")) - 2);
  std::map<std::string, Restatement> learned;
  for (const auto& [fold, training] : outside)
    learned.emplace(fold, Restatement(trees, training, 3, std::stod(GetParam())));
  std::map<std::string, double> right;
  for (const auto& row : rows) {
    compare(row, learned.at(row.at("fold")), trees[std::stoul(row.at("line")) - 2]);
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
                                       {words("esm --usage dirichlet --runs 300 --reports 3"), "runs.csv curves.csv"},
                                       {words("manoeuvre --runs 20"), "samples.csv runs.csv curves.csv"}}) {
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
  EXPECT_TRUE(says(evaluate("2.75,blue,b\n" + rows, "b"), {"the first row looks like data ('2.75', 'blue')"}));
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
  EXPECT_TRUE(says(names, {"column 'name' has 30 classes in 30 rows", "so it is with 25 others of 30 classes"}));
  const std::regex warning("can never prefer");
  EXPECT_LE(std::distance(std::sregex_iterator(names.begin(), names.end(), warning), {}), 5);
}

TEST_F(RecognitionDemoLearning, WordsThatDifferInCaseAndFarNumbersArePointedOut) {
  std::string text = "warmth,flag,kind\n";
  for (int k = 0; k < 40; ++k)
    text += fmt::format("{},{},{}\n", 15 + k % 10 + k % 2, k % 3 ? "True" : "TRUE", k % 2 ? "a" : "b");
  const auto data = directory.write("rooms.csv", text);
  const auto learned = recognition_demo_succeeds({"train", data, "--label", "kind", "--model", model});
  EXPECT_TRUE(says(learned.output, {"column 'flag': 'TRUE' and 'True' differ in case, blanks, Unicode"}));
  EXPECT_EQ(classify("warmth,flag\n0,True\n40,True\n").find("far"), std::string::npos);
  const std::string said = classify("warmth,flag\n20,True\n68,True\n70,True\n");  // degrees Fahrenheit
  EXPECT_TRUE(says(said, {"2 numbers are far from those that the model was learned from", "'68'"}));
  EXPECT_EQ(summary().at("numbers_far_from_those_learned_from"), 2);
}

TEST_F(RecognitionDemoLearning, NumbersOnOneSideOfAllThatWereLearnedArePointedOut) {
  const auto rooms = [](int rows, int outside, int first, int step) {
    std::string text = "warmth,kind\n";
    for (int k = 0; k < rows; ++k)
      text += fmt::format("{},{}\n", k < outside ? first + step * (k % 3) : 15 + k % 11, k % 2 ? "a" : "b");
    return text;
  };
  const std::string outside = "that was learned, ";
  train(rooms(110, 0, 0, 0));
  EXPECT_TRUE(says(classify(rooms(30, 7, 26, 1)),
                   {"Column 'warmth': 7 of 30 numbers are above the greatest " + outside + "25:"}));
  EXPECT_EQ(summary().at("numbers_outside_those_learned_from").at("warmth"), 7);
  EXPECT_TRUE(says(classify(rooms(30, 7, 14, -1)), {"7 of 30 numbers are below the least that was learned, 15: "}));
  EXPECT_EQ(classify(rooms(30, 6, 26, 1)).find(outside), std::string::npos);
  EXPECT_EQ(classify(rooms(19, 7, 26, 1)).find(outside), std::string::npos);
  auto old = nlohmann::json::parse(contents(model));
  old.at("features").at(0).erase("range");
  directory.write("model.json", old.dump());
  EXPECT_EQ(classify(rooms(30, 7, 26, 1)).find(outside), std::string::npos);
  EXPECT_TRUE(says(classify(rooms(30, 7, 900, 1)), {"expected a number nearer to those learned from"}));
  train(rooms(30, 0, 0, 0));  // too few to know the range by
  EXPECT_EQ(classify(rooms(30, 7, 26, 1)).find(outside), std::string::npos);
}

TEST_F(RecognitionDemoLearning, WhatATableTellsTwiceIsPointedOut) {
  std::mt19937_64 engine(5);
  const auto said = [&](const std::string& names, const std::string& rows) {
    const auto data = directory.write("t.csv", names + ",kind\n" + rows);
    return recognition_demo_succeeds({"train", data, "--label", "kind", "--model", model}).output;
  };
  const auto times = [](int n, const std::string& rows) {
    std::string all;
    while (n-- > 0) all += rows;
    return all;
  };
  std::string fine, coarse, same;
  for (int k = 0; k < 3000; ++k) {
    const auto x = engine() % 100'000, y = engine() % 100'000;
    const double m = 1e-3 * static_cast<double>(x);
    if (k < 200) fine += fmt::format("{},{},{}\n", m, y, k % 2 ? "a" : "b");
    if (k < 200) coarse += fmt::format("{},{},{}\n", 0.5 * static_cast<double>(x % 7), y % 5, k % 2 ? "a" : "b");
    same += fmt::format("{},{},{:.3f},{},{}\n", m, y, 0.001 * m, -3.28 * m, k % 2 ? "a" : "b");
  }
  const std::string copies = "t.csv: 67 % of 600 rows repeat another, label included: ";
  EXPECT_TRUE(says(said("x,y", times(3, fine)), {copies}));
  EXPECT_EQ(said("x,y", fine).find("warning"), std::string::npos);
  EXPECT_EQ(said("x,y", coarse).find("warning"), std::string::npos);  // 70 different rows, by chance
  // Of a long table the rows to compare are chosen by chance.
  const std::string all = said("m,y,km,ft", times(2, same));
  EXPECT_TRUE(says(all, {"t.csv: 50 % of 6000 rows repeat another",
                         "column 'm' says the same as km,ft, as if in another unit or in other words: it counts 3 "
                         "times",
                         "leave the others out by --ignore km,ft"}));
  EXPECT_EQ(all.find("column 'y'"), std::string::npos) << all;
}

TEST_F(RecognitionDemoLearning, WordsThatSayTheSameArePointedOut) {
  const auto said = [&](int other) {  // one row has another word, perhaps
    std::string rows = "size,state,code,colour,farbe,kind\n";
    for (int k = 0; k < 60; ++k) {
      const int kind = k % 3, colour = k * k % 7, farbe = k == other ? (colour + 1) % 7 : colour;
      rows += fmt::format("{}.5,s{},{},c{},f{},{}\n", k * 7919 % 211, k == other ? (kind + 1) % 3 : kind, kind, colour,
                          farbe, "abc"[kind]);
    }
    return recognition_demo_succeeds(
               {"train", directory.write("rows.csv", rows), "--label", "kind", "--model", model, "--wide"})
        .output;
  };
  EXPECT_TRUE(says(
      said(-1), {"column 'state' alone tells the class of each row", "column 'code' alone tells the class of each row",
                 "column 'colour' says the same as farbe, as if in another unit or in other words"}));
  const std::string differs = said(30);
  EXPECT_EQ(differs.find("column 'state'"), std::string::npos) << differs;
  EXPECT_EQ(differs.find("column 'colour'"), std::string::npos) << differs;
}

TEST_F(RecognitionDemoLearning, GroupsThatArePartedAreSeenInLongTablesAndBehindSlips) {
  const auto said = [&](int persons, int each, int slip) {
    std::string rows = "who,x,y,kind\n";
    for (int k = 0; k < persons * each; ++k) {
      const int who = k % persons, kind = who * who % 7 % 2;
      rows += fmt::format("p{},{}.5,{}.5,{}\n", who, k * 7919 % 2111, k * 7727 % 2213, k == slip ? 1 - kind : kind);
    }
    return recognition_demo_succeeds(
               {"train", directory.write("rows.csv", rows), "--label", "kind", "--model", model, "--wide"})
        .output;
  };
  EXPECT_TRUE(
      says(said(500, 3, -1), {"each of 500 values of column 'who', of 3 rows on the average, is of one class only: "}));
  EXPECT_TRUE(
      says(said(20, 4, 50),
           {"each of 20 values of column 'who', of 4 rows on the average, is of one class only, but for 1 of them: "}));
  EXPECT_TRUE(says(said(100, 2, -1), {"each of 100 values of column 'who', of 2 rows on the average"}));
  EXPECT_EQ(said(20, 40, 50).find("of one class"), std::string::npos);  // as a feature that tells much
}

TEST_F(RecognitionDemoLearning, NumbersThatAreNoneAndClassesOfOneRowArePointedOut) {
  const auto said = [&](const auto& cell, const Arguments& options = {}) {
    std::string rows = "2019,2020,cls\n";
    for (int k = 0; k < 60; ++k)
      rows += fmt::format("{},{}.5,{}\n", cell(k), k * 7919 % 211, k == 50 ? "wel" : k % 2 ? "ill" : "well");
    return recognition_demo_succeeds(
               Arguments{"train", directory.write("rows.csv", rows), "--label", "cls", "--model", model, "--wide"} +
               options)
        .output;
  };
  const std::string plain = said([](int k) { return fmt::format("{}", 700 + k % 7 * 311); });
  EXPECT_TRUE(says(plain, {"column 'cls': a single row is of wel: is it a slip of writing?"}));
  EXPECT_EQ(plain.find("column '2019'"), std::string::npos) << plain;
  EXPECT_EQ(plain.find("first row"), std::string::npos) << plain;
  const auto thousands = [](int k) {
    return k % 7 < 1 ? std::string{"700"} : fmt::format("{}.{}", 1 + k % 7 / 3, 122 + k % 7 * 100);
  };
  EXPECT_TRUE(says(said(thousands), {"column '2019': every number with a point has three digits behind it, as 1.222"}));
  EXPECT_EQ(said([&](int k) { return k == 9 ? "0.5" : thousands(k); }).find("three digits"), std::string::npos);
  const auto code = [](int k) { return fmt::format("{:04}", k % 7 * 311); };
  EXPECT_TRUE(says(said(code), {"column '2019' holds codes, as 0000, that are read as numbers"}));
  EXPECT_EQ(said([&](int k) { return k == 9 ? "311" : code(k); }).find("holds codes"), std::string::npos);
  EXPECT_EQ(said(code, {"--categorical", "2019"}).find("holds codes"), std::string::npos);
  EXPECT_TRUE(says(said([](int k) { return k % 4 ? fmt::format("{}", k % 5) : "none"; }),
                   {"column '2019': 15 cells are 'none', which counts as missing among numbers"}));
  for (const char* none : {"-32768", "65535", "2147483647", "-3.4028235e+38", "1e20"})
    EXPECT_TRUE(says(said([&](int k) { return k % 9 == 3 ? none : fmt::format("{}.5", k % 7); }),
                     {fmt::format("cells are {}, far from the others", none)}));
  EXPECT_TRUE(says(said([](int k) { return k % 9 == 3 ? "-8888" : fmt::format("{}.5", k % 12); }),
                   {"column '2019': 7 cells are -8888, far from the others"}));
  for (const char* notation : {"\"{},500.00\"", "{} 500", "−{}", "{}:30", "{}'500"})
    EXPECT_TRUE(says(said([&](int k) { return fmt::format(fmt::runtime(notation), 1 + k); }),
                     {"column '2019' holds no plain numbers, as ", "which count as words"}));
  const auto long_one = [](int k) { return fmt::format("35693803564380980{}", k % 5); };
  EXPECT_EQ(said(long_one, {"--categorical", "2019"}).find("differ in case"), std::string::npos);
  EXPECT_TRUE(
      says(said([](int k) { return fmt::format("\"{},50 €\"", k); }), {"column '2019' holds numbers with a unit (€)"}));
}

TEST_F(RecognitionDemoLearning, WhatIsAskedFarFromWhatWasLearnedIsPointedOutForFewRows) {
  std::string rows = "level,kind\n";
  for (int k = 0; k < 200; ++k) rows += fmt::format("{},{}\n", 80 + k % 60, k % 2 ? "a" : "b");
  recognition_demo_succeeds({"train", directory.write("rows.csv", rows), "--label", "kind", "--model", model});
  EXPECT_TRUE(
      says(classify("level\n5\n6\n"), {"Column 'level': 2 of 2 numbers are below the least that was learned, 80"}));
  EXPECT_EQ(classify("level\n5\n90\n").find("below the least"), std::string::npos);
  EXPECT_EQ(classify("level\n79\n").find("below the least"), std::string::npos);
  EXPECT_TRUE(says(classify("level,other\n,1\n?,2\n"), {"Column 'level' has no value in any of 2 rows"}));
  EXPECT_EQ(classify("level,other\n,1\n90,2\n").find("no value"), std::string::npos);
}

TEST_F(RecognitionDemoLearning, ProbabilitiesThatAreWorseThanTheSharesAreNamed) {
  const auto said = [&](int copies, int size = 200, int one_in = 2, int wrong_in = 10, int wrong = 3) {
    std::string rows = "kind";
    for (int i = 0; i < copies; ++i) rows += fmt::format(",x{}", i);
    for (int k = 0; k < size; ++k) {
      const bool is_a = k % one_in == 1, is_right = (k + k / one_in) % wrong_in < wrong_in - wrong;
      rows += is_a ? "\na" : "\nb";
      for (int i = 0; i < copies; ++i) rows += is_a == is_right ? ",u" : ",v";
    }
    const std::string file = directory.write("rows.csv", rows + "\n");
    recognition_demo_succeeds({"train", file, "--label", "kind", "--model", model});
    return recognition_demo_succeeds({"evaluate", file, "--label", "kind", "--foldings", "1", "--wide"}).output +
           recognition_demo_succeeds({"classify", model, file, "--wide"}).output;
  };
  const std::string worse =
      "sigma: the shares of the classes alone have a log-loss of 0.693: its probabilities are worse than these";
  EXPECT_TRUE(says(said(20), {worse, "or bin has few rows of a", "or it was learned from few rows"}));
  const std::string seldom = "sigma: its answers are right 14 points more seldom than their probabilities say";
  EXPECT_TRUE(says(said(2), {seldom, "or bin has few rows of a", "or it was learned from few rows"}));
  EXPECT_TRUE(says(said(2, 4000, 30, 20, 1), {"sigma: its answers 'a' are right 53 points more seldom"}));
  for (const auto* const words : {"worse than these", "more seldom"}) EXPECT_EQ(said(1).find(words), std::string::npos);
}

TEST_F(RecognitionDemoLearning, LimitsAndCurrenciesInCellsArePointedOut) {
  const auto said = [&](const auto& cell) {
    std::string rows = "level,kind\n";
    for (int k = 0; k < 60; ++k) rows += fmt::format("{},{}\n", cell(k), k % 2 ? "a" : "b");
    return recognition_demo({"train", directory.write("rows.csv", rows), "--label", "kind", "--model", model, "--wide"})
        .output;
  };
  EXPECT_TRUE(says(said([](int k) { return k % 3 ? std::string{"<0.1"} : fmt::format("0.{}", 1 + k % 9); }),
                   {"column 'level' holds numbers and 40 limits, as <0.1, and all count as words"}));
  EXPECT_TRUE(says(said([](int k) { return k % 12 ? fmt::format("0.{}", k) : std::string{"<0.1"}; }),
                   {"column 'level': found '<0.1', expected a number, as 55 of 60 cells have; write one for what is "
                    "beyond a limit, as the limit itself"}));
  EXPECT_TRUE(says(said([](int k) { return fmt::format("${}.50", k); }),
                   {"column 'level' holds numbers with a unit ($), which count as words"}));
  EXPECT_TRUE(says(said([](int k) { return fmt::format("A{}", k); }), {"column 'level' seems to name the rows"}));
}

TEST_F(RecognitionDemoLearning, ANumberThatIsNearlyAlwaysZeroTellsTheRest) {
  std::string rows = "reading,kind\n";
  for (int k = 0; k < 200; ++k)
    rows += k % 10 == 0 ? fmt::format("{},rare\n", 1 + k / 10 % 2) : std::string{"0,usual\n"};
  recognition_demo_succeeds(Arguments{"evaluate", directory.write("zeros.csv", rows), "--label", "kind", "--out", out});
  for (const char* classifier : {"sigma", "max, ratio scale", "max, Dubois-Prade"})
    EXPECT_EQ(summary().at("classifiers").at(classifier).at("accuracy"), 1.0) << classifier;
}

TEST_F(RecognitionDemoLearning, WhatBelongsTogetherAndIsPartedIsPointedOut) {
  const auto said = [&](const auto& row) {
    std::string rows = "who,x,y,kind\n";
    for (int k = 0; k < 200; ++k) rows += row(k);
    return recognition_demo_succeeds(
               {"train", directory.write("rows.csv", rows), "--label", "kind", "--model", model, "--wide"})
        .output;
  };
  const auto noise = [](int k) { return fmt::format("{}.5,{}.5", k * 7919 % 211, k * 104729 % 223); };
  const auto kind = [](int k) { return k * k % 7 % 2 ? "a" : "b"; };
  // Patients by name and by number, ten rows of each; what tells the kinds apart by its size, and by few words, is
  // none.
  for (const char* patient : {"p{}", "{}"})
    EXPECT_TRUE(says(said([&](int k) {
                       return fmt::format(fmt::runtime(patient + std::string(",{},{}\n")), k % 20, noise(k),
                                          kind(k % 20));
                     }),
                     {"each of 20 values of column 'who', of 10 rows on the average, is of one class only"}));
  for (const char* other : {"{0},{1},{2}\n", "w{3},{1},{2}\n"})
    EXPECT_EQ(said([&](int k) {
                return fmt::format(fmt::runtime(other), k % 20, noise(k), k % 20 < 10 ? "a" : "b",
                                   k % 3 == 0 ? k % 2 : k % 20);
              }).find("of one class only"),
              std::string::npos);
  // Numbers of the rows, mixed.
  const std::string ids =
      said([&](int k) { return fmt::format("{},{},{}\n", 1000 + k * 77 % 200, noise(k), kind(k)); });
  EXPECT_TRUE(says(ids, {"column 'who' seems to name the rows, or to count them"}));
  EXPECT_EQ(said([&](int k) {
              return fmt::format("{},{},{}\n", k == 7 ? 8 : k * 77 % 200, noise(k), kind(k));
            }).find("seems to name"),
            std::string::npos);
  // A class of copies.
  const std::string copies = said(
      [&](int k) { return k % 2 == 0 ? fmt::format("u,{},a\n", noise(k)) : fmt::format("v,{},b\n", noise(k % 20)); });
  EXPECT_TRUE(says(copies, {"90 % of the rows of class 'b' repeat another, label included"}));
  EXPECT_EQ(copies.find("class 'a'"), std::string::npos);
}

TEST_F(RecognitionDemoLearning, ANumberThatWasLearnedIsNotFar) {
  std::string rows = "watt,kind\n";
  for (int k = 0; k < 100; ++k) rows += fmt::format("{},{}\n", k % 20 == 0 ? 2000 + k : 2 + k % 11, k % 2 ? "a" : "b");
  recognition_demo_succeeds({"train", directory.write("rows.csv", rows), "--label", "kind", "--model", model});
  EXPECT_EQ(classify(rows).find("far from"), std::string::npos);
  EXPECT_NE(classify("watt,kind\n400000,a\n").find("1 number is far from"), std::string::npos);
}

TEST_F(RecognitionDemoLearning, NinesFarFromTheOthersArePointedOut) {
  const auto said = [&](const std::string& word) {
    std::string rows = "reading,kind\n";
    for (int k = 0; k < 40; ++k)
      rows += fmt::format("{},{}\n", k % 20 == 5 ? word : std::to_string(90 + k % 12), k % 2 ? "a" : "b");
    return recognition_demo_succeeds(
               {"train", directory.write("nines.csv", rows), "--label", "kind", "--model", model, "--wide"})
        .output;
  };
  for (const char* word : {"-999", "9999", "-99.9", "999.0"})
    EXPECT_TRUE(says(said(word), {fmt::format("column 'reading': 2 cells are {0}, far from the others; if that stands "
                                              "for no value, give --missing={0}",
                                              word)}));
  for (const char* word : {"99", "-500", "NA"}) EXPECT_EQ(said(word).find("far from"), std::string::npos) << word;
}

TEST_F(RecognitionDemoLearning, MissingLabelsAndUnitsInCellsArePointedOut) {
  const auto said = [&](const std::string& missing, const Arguments& units, const Arguments& options = {}) {
    std::string text = "weight,flag,kind\n";
    for (std::size_t k = 0; k < 40; ++k)
      text += fmt::format("{}.5{},{},{}\n", k * 7 % 41, units[k % units.size()], k % 3,
                          k % 4 ? k % 2 ? "a" : "b" : missing);
    const auto data = directory.write("t.csv", text);
    return recognition_demo_succeeds(Arguments{"train", data, "--label", "kind", "--model", model} + options).output;
  };
  for (const char* missing : {"NA", "n/a", "nan", "NULL", "-", "Unknown"})
    EXPECT_TRUE(says(said(missing, {""}), {fmt::format("10 of 40 rows hold '{}', which counts as a class", missing)}));
  EXPECT_EQ(said("none", {""}).find("warning"), std::string::npos);
  const auto survey = [&](const std::string& sex, const std::string& kind, int first = 0) {
    std::string text = "sex,weight,kind\n";
    for (int k = 0; k < 40; ++k)
      text += fmt::format("{},{}.5,{}\n", k % 4 ? k % 3 ? "f" : "m" : sex, k * 7 % 40,
                          k % 5 ? fmt::format("{}", first + k % 2) : kind);
    const auto data = directory.write("t.csv", text);
    return recognition_demo_succeeds({"train", data, "--label", "kind", "--model", model, "--wide"}).output;
  };
  for (const char* word : {"NA", "n/a", "null"})
    EXPECT_TRUE(says(survey(word, "1"),
                     {fmt::format("column 'sex': 10 of 40 rows hold '{0}', which counts as a value among words: if it "
                                  "stands for no value, give --missing={0}",
                                  word)}));
  for (const char* nines : {"-9", "99"})
    EXPECT_TRUE(says(survey("u", nines), {fmt::format("8 of 40 rows hold '{}', which counts as a class", nines)}));
  for (const char* kind : {"2", "-1", "12"}) EXPECT_EQ(survey("u", kind).find("warning"), std::string::npos) << kind;
  EXPECT_EQ(survey("u", "9", 30).find("warning"), std::string::npos);
  const std::string units = said("c", {" kg", "g"});
  EXPECT_TRUE(says(units, {"column 'weight' holds numbers with a unit (g, kg)"}));
  EXPECT_EQ(units.find("--ignore"), std::string::npos) << units;
  const std::string names = "column 'weight' seems to name the rows";
  EXPECT_TRUE(says(said("c", {" kg"}, {"--categorical", "weight"}), {names}));
  EXPECT_TRUE(says(said("c", {"a", "b", "c", "d", "e", "f", "g", "h", "i"}), {names}));
  EXPECT_TRUE(says(said("c", {" m 2"}), {names}));
  std::string many = "weight,kind\n";
  for (int k = 0; k < 5000; ++k) many += fmt::format("{}.5 kg,a\n", k);
  const auto refused = recognition_demo({"train", directory.write("t.csv", many), "--label", "kind", "--model", model});
  EXPECT_TRUE(says(refused.output, {"4096 different values; write the numbers without their unit"}));
}

TEST_F(RecognitionDemoLearning, ClassesThatNobodyRecognisesAreNamed) {
  std::string text = "colour,kind\n";
  for (int k = 0; k < 40; ++k) text += k % 10 == 9 ? "\"red, dark\",rare\n" : "\"red, dark\",usual\nblue,other\n";
  const auto data = directory.write("trees.csv", text);
  const std::string never = "Not one row was recognised of rare (4 rows) by any classifier";
  EXPECT_TRUE(says(recognition_demo_succeeds({"evaluate", data, "--label", "kind", "--folds", "2"}).output, {never}));
  train(text);
  const std::string said = classify(text + "blue,\n", {"--rows", "1", "--explain"});
  EXPECT_TRUE(says(said, {never, "whose class is known", "(Without --misread a reading is the feature itself"}));
  EXPECT_EQ(said.find("sigma-max, ratio scale: "), std::string::npos) << said;  // explained once
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

/// A table of numbers with many digits, some with few, and words.
std::filesystem::path long_table(const TemporaryDirectory& directory, std::size_t rows) {
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  const auto path = directory.path() / std::to_string(rows);
  std::ofstream file(path);
  file << "kind,size,weight,colour\n" << std::setprecision(17);
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t kind = engine() % 3;
    file << classes[kind] << ',' << normal(engine) + static_cast<double>(kind) << ',' << engine() % 50 << ','
         << "rgb"[engine() % (kind + 1)] << '\n';
  }
  return path;
}

class RecognitionDemo : public RecognitionDemoLearning {};

TEST_F(RecognitionDemo, MemoryDoesNotGrowWithTheTable) {
  const auto small = long_table(directory, 20'000), large = long_table(directory, 300'000);
  const auto growth = [&](std::vector<std::string> arguments) {
    const auto peak = [&](const std::filesystem::path& table) {
      arguments[1] = table.native();
      return program::peak_memory(SIGMAX_RECOGNITION_DEMO, arguments);
    };
    const long before = peak(small);
    return peak(large) - before;
  };
  // In KiB; the numbers of the large table alone are 4700 of them.
  EXPECT_LT(growth({"train", "", "--label", "kind", "--quiet", "--model", model}), 4096);  // as below
  EXPECT_LT(growth({"evaluate", "", "--label", "kind", "--quiet", "--foldings", "1", "--folds", "2", "--threads", "1"}),
            6144);  // of them 3000 for the part of the rows that is shuffled
}

/// Of a table that is not held in memory: the cuts that a plain sort gives, and what lies between them.
TEST_F(RecognitionDemo, LearnsFromALongTableWhatASortOfAllRowsGives) {
  const auto table = long_table(directory, 60'000);
  recognition_demo_succeeds({"train", table, "--label", "kind", "--model", model});
  const auto learned = nlohmann::json::parse(contents(model));
  const auto rows = rows_of(table);
  for (const std::size_t feature : {0U, 1U}) {
    const std::string name = learned["features"][feature]["name"];
    std::vector<double> numbers;
    for (const auto& row : rows) numbers.push_back(std::stod(row.at(name)));
    std::sort(numbers.begin(), numbers.end());
    Numbers cuts;
    for (std::size_t j = 1; j < 8; ++j) cuts.push_back(numbers[j * numbers.size() / 8]);
    ASSERT_EQ(learned["features"][feature]["cuts"], nlohmann::json(cuts)) << name;
    Matrix counts(classes.size(), Numbers(8, 0.0));
    for (const auto& row : rows) {
      const auto kind = std::find(classes.begin(), classes.end(), row.at("kind")) - classes.begin();
      const auto bin = std::upper_bound(cuts.begin(), cuts.end(), std::stod(row.at(name))) - cuts.begin();
      ++counts[static_cast<std::size_t>(kind)][static_cast<std::size_t>(bin)];
    }
    EXPECT_EQ(learned["features"][feature]["counts"], nlohmann::json(counts)) << name;
  }
}

}  // namespace recognition_demo_learning_test
