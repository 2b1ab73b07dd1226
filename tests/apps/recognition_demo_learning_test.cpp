#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <set>

#include "apps/recognition_demo_support.hpp"
#include "apps/temporary_directory.hpp"
#include "support/near.hpp"

namespace sigmax::apps {
namespace {

using support::near;

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
void compare(const NamedRow& row, const Restatement& learned, const Tree& tree) {
  const std::map<std::string, Numbers> expected = {
      {"sigma", learned.sigma(tree)},
      {"max, ratio scale", learned.fuzzy(tree, by_ratio, false)},
      {"max, Dubois-Prade", learned.fuzzy(tree, by_dubois_prade, false)},
      {"sigma-max, ratio scale", learned.fuzzy(tree, by_ratio, true)},
      {"sigma-max, Dubois-Prade", learned.fuzzy(tree, by_dubois_prade, true)}};
  Numbers found;
  for (const auto& name : classes) found.push_back(std::stod(row.at(name)));
  const Numbers& belief = expected.at(row.at("classifier"));
  EXPECT_PRED_FORMAT3(near, found, belief, 1e-9) << row.at("classifier") << ", line " << row.at("line");
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

const std::vector<std::string> columns = {"--label", "kind", "--ignore", "id", "--categorical", "rings"};

std::vector<std::string> with_columns(std::vector<std::string> arguments, std::vector<std::string> more) {
  arguments.insert(arguments.end(), columns.begin(), columns.end());
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

class Learning : public testing::TestWithParam<std::string> {};

TEST_P(Learning, AModelSavedAndReadBackEqualsPlainCounting) {
  const TemporaryDirectory directory;
  const auto trees = forest(120);
  const auto data = directory.write("forest.csv", csv(trees));
  const auto model = directory.path() / "forest.json";
  const auto train =
      recognition_demo(with_columns({"train", data}, {"--model", model, "--bins", "4", "--misread", GetParam()}));
  ASSERT_EQ(train.status, 0) << train.output;
  const auto classify = recognition_demo({"classify", model, data, "--quiet", "--out", directory.path() / "out"});
  ASSERT_EQ(classify.status, 0) << classify.output;
  const Restatement learned(trees, all_rows(trees.size()), 4, std::stod(GetParam()));
  const auto rows = rows_of(directory.path() / "out" / "predictions.csv");
  ASSERT_EQ(rows.size(), 5 * trees.size());
  for (const auto& row : rows) {
    const Tree& tree = trees[std::stoul(row.at("line")) - 2];
    compare(row, learned, tree);
    EXPECT_EQ(row.at("truth"), classes[tree.kind]);
  }
}

TEST_P(Learning, EveryFoldIsClassifiedByWhatTheOthersTeach) {
  const TemporaryDirectory directory;
  const auto trees = forest(90);
  const auto data = directory.write("forest.csv", csv(trees));
  const auto ending =
      recognition_demo(with_columns({"evaluate", data}, {"--folds", "4", "--bins", "3", "--misread", GetParam(),
                                                         "--quiet", "--out", directory.path() / "out"}));
  ASSERT_EQ(ending.status, 0) << ending.output;
  const auto rows = rows_of(directory.path() / "out" / "predictions.csv");
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
  const auto summary = nlohmann::json::parse(contents(directory.path() / "out" / "summary.json"));
  for (const auto& [name, accuracy] : right)
    EXPECT_PRED_FORMAT3(near, summary.at("classifiers").at(name).at("accuracy").get<double>(), accuracy, 1e-9) << name;
}

INSTANTIATE_TEST_SUITE_P(RecognitionDemo, Learning, testing::Values("0", "0.2"));

TEST(RecognitionDemoLearning, TheNumberOfThreadsChangesNoByte) {
  const TemporaryDirectory directory;
  const auto data = directory.write("forest.csv", csv(forest(60)));
  for (const std::string threads : {"1", "3"})
    ASSERT_EQ(
        recognition_demo(with_columns({"evaluate", data}, {"--threads", threads, "--out", directory.path() / threads}))
            .status,
        0);
  for (const char* file : {"predictions.csv", "confusion.csv"})
    EXPECT_EQ(contents(directory.path() / "1" / file), contents(directory.path() / "3" / file)) << file;
}

TEST(RecognitionDemoLearning, AModelHoldsOnlyTheKindsAskedFor) {
  const TemporaryDirectory directory;
  const auto data = directory.write("forest.csv", csv(forest(60)));
  const auto model = directory.path() / "forest.json";
  ASSERT_EQ(recognition_demo(with_columns({"train", data}, {"--model", model, "--kinds", "sigma"})).status, 0);
  ASSERT_EQ(recognition_demo({"classify", model, data, "--out", directory.path() / "out"}).status, 0);
  EXPECT_EQ(rows_of(directory.path() / "out" / "predictions.csv").size(), 60U);
}

TEST(RecognitionDemoLearning, ALowMarginIsRejected) {
  const TemporaryDirectory directory;
  const auto data = directory.write("forest.csv", csv(forest(60)));
  const auto model = directory.path() / "forest.json";
  ASSERT_EQ(recognition_demo(with_columns({"train", data}, {"--model", model})).status, 0);
  ASSERT_EQ(
      recognition_demo({"classify", model, data, "--least-margin", "0.5", "--out", directory.path() / "out"}).status,
      0);
  std::size_t rejected = 0;
  for (const auto& row : rows_of(directory.path() / "out" / "predictions.csv")) {
    EXPECT_EQ(row.at("decision").empty(), std::stod(row.at("margin")) < 0.5) << row.at("line");
    rejected += row.at("decision").empty() ? 1U : 0U;
  }
  EXPECT_GT(rejected, 0U);
  EXPECT_LT(rejected, 300U);
}

TEST(RecognitionDemoLearning, AnExplanationShowsTheWinningValuesAndTheirProduct) {
  const TemporaryDirectory directory;
  const auto data = directory.write("coins.csv",
                                    "side,weight,coin\nheads,light,fair\ntails,light,fair\nheads,heavy,false\n"
                                    "heads,heavy,false\n");
  const auto model = directory.path() / "coins.json";
  ASSERT_EQ(recognition_demo({"train", data, "--label", "coin", "--model", model, "--kinds", "sigma,max"}).status, 0);
  const auto ending = recognition_demo({"classify", model, data, "--explain", "--rows", "1"});
  ASSERT_EQ(ending.status, 0) << ending.output;
  // Laplace's rule on two values: 2/4 and 3/4 of fair, 3/4 and 1/4 of false.
  for (const char* line : {"p(side = heads|coin = fair) = 0.5", "p(weight = light|coin = fair) = 0.75",
                           "π(side = heads|coin = fair) = 1", "π(weight = light|coin = fair) = 1"})
    EXPECT_NE(ending.output.find(line), std::string::npos) << line << "\n" << ending.output;
  // ½ ½ ¾ against ½ ¾ ¼: 2/3, and the logarithm of 2; and 1 against 1 · ⅓.
  EXPECT_NE(ending.output.find("fair = 0.6667"), std::string::npos) << ending.output;
  EXPECT_NE(ending.output.find("0.693"), std::string::npos) << ending.output;
  EXPECT_NE(ending.output.find("1.1"), std::string::npos) << ending.output;
}

}  // namespace
}  // namespace sigmax::apps
