#include "laws/generate.hpp"
#include "support/sigmax.hpp"

namespace table_classifier_test {

using Words = std::vector<std::string>;

/// A drawn column, once as the library takes it and once as plain readings: of each row an index, or nothing.
struct Drawn {
  TableColumn column;
  std::vector<std::optional<std::size_t>> readings;
  std::size_t size;

  TableCell cell(std::size_t row) const {
    const double cell = column.cells[row];
    if (column.numeric() || std::isnan(cell)) return cell;
    return column.words[static_cast<std::size_t>(cell)];
  }
};

/// Which values cut a column of numbers, of which none or few are alike.
Numbers cuts_of(Numbers numbers, const TableOptions& options) {
  std::sort(numbers.begin(), numbers.end());
  const std::set<double> different(numbers.begin(), numbers.end());
  Numbers cuts;
  if (options.equal_width)
    for (std::size_t j = 1; j < options.bins; ++j)
      cuts.push_back(numbers.front() +
                     static_cast<double>(j) * (numbers.back() - numbers.front()) / static_cast<double>(options.bins));
  else if (different.size() <= options.bins)
    cuts.assign(std::next(different.begin()), different.end());
  else
    for (std::size_t j = 1; j < options.bins; ++j) cuts.push_back(numbers[j * numbers.size() / options.bins]);
  return cuts;
}

Drawn numbers(std::mt19937_64& engine, std::size_t rows, bool few, const TableOptions& options) {
  Numbers cells(rows), there;
  for (double& cell : cells) {
    cell = few ? 1.5 * static_cast<double>(engine() % 3) : std::uniform_real_distribution<>(-1.0, 1.0)(engine);
    if (engine() % 7 == 0) cell = not_a_number;
    if (!std::isnan(cell)) there.push_back(cell);
  }
  const Numbers cuts = cuts_of(there, options);
  Drawn drawn{{few ? "few" : "many", cells}, {}, cuts.size() + 1};
  for (const double cell : cells) {
    std::size_t bin = 0;
    for (const double cut : cuts) bin += cell >= cut ? 1U : 0U;
    drawn.readings.push_back(std::isnan(cell) ? std::nullopt : std::optional(bin));
  }
  return drawn;
}

Drawn words(std::mt19937_64& engine, std::size_t rows) {
  const Words in_order = {"2", "10", "blue", "red"};  // numbers first, by their value
  Words cells = {"10", "red", "2", "blue"};
  std::vector<std::optional<std::size_t>> readings = {1, 3, 0, 2};
  while (cells.size() < rows) {
    const std::size_t word = engine() % 5;
    cells.push_back(word == 4 ? "" : in_order[word]);
    readings.push_back(word == 4 ? std::nullopt : std::optional(word));
  }
  return {{"colour", cells}, readings, in_order.size()};
}

Numbers divided(Numbers numbers, double by) {
  for (double& number : numbers) number /= by;
  return numbers;
}
double sum(const Numbers& numbers) { return std::accumulate(numbers.begin(), numbers.end(), 0.0); }
double greatest(const Numbers& numbers) { return *std::max_element(numbers.begin(), numbers.end()); }

/// π ∝ p, or π_i = Σ of the p_j that are not above p_i.
Numbers possible(const Numbers& p, bool ratio) {
  if (ratio) return divided(p, greatest(p));
  Numbers pi(p.size(), 0.0);
  for (std::size_t i = 0; i < p.size(); ++i)
    for (const double other : p)
      if (other <= p[i] * (1.0 + 1e-12)) pi[i] += other;
  return divided(pi, greatest(pi));
}

/// What is believed of a row, by plain counting.
Numbers with_sensor_noise(const std::vector<Drawn>& table, const std::vector<std::size_t>& labels,
                          const TableOptions& options, TableInference inference, std::size_t row) {
  const bool sigma = inference == TableInference::sigma;
  const bool ratio = inference == TableInference::max_by_ratio || inference == TableInference::sigma_max_by_ratio;
  const bool fuzzy_sensor =
      inference == TableInference::max_by_ratio || inference == TableInference::max_by_dubois_prade;
  const std::size_t classes = 3;
  Numbers belief(classes, options.equal_prior ? 1.0 : 0.0);
  if (!options.equal_prior)
    for (const std::size_t label : labels) belief[label] += 1.0;
  belief = divided(belief, sum(belief));
  if (!sigma) belief = possible(belief, ratio);
  for (const Drawn& drawn : table) {
    const std::size_t size = drawn.size;
    if (!drawn.readings[row]) continue;
    for (std::size_t c = 0; c < classes; ++c) {
      Numbers p(size, options.smoothing);
      for (std::size_t other = 0; other < labels.size(); ++other)
        if (labels[other] == c && drawn.readings[other]) p[*drawn.readings[other]] += 1.0;
      p = divided(p, sum(p));
      if (!sigma) p = possible(p, ratio);
      double likelihood = 0.0;
      for (std::size_t value = 0; value < size; ++value) {
        Numbers sensor(size, options.misread / static_cast<double>(size - 1));
        sensor[value] = 1.0 - options.misread;
        if (fuzzy_sensor) sensor = possible(sensor, ratio);
        const double term = sensor[*drawn.readings[row]] * p[value];
        likelihood = sigma ? likelihood + term : std::max(likelihood, term);
      }
      belief[c] *= likelihood;
    }
  }
  return divided(belief, sigma ? sum(belief) : greatest(belief));
}

PROPERTY(TableClassifier, OfAllColumnsAndInferencesIsPlainCounting) {
  std::mt19937_64 engine(*rc::gen::arbitrary<std::uint64_t>());
  const auto coin = [&] { return engine() % 2 == 0; };
  const TableOptions options{.bins = 3 + engine() % 3,
                             .equal_width = coin(),
                             .smoothing = coin() ? 1.0 : 0.5,
                             .misread = coin() ? 0.0 : 0.2,
                             .equal_prior = coin()};
  const std::size_t rows = 40;
  std::vector<Drawn> table = {numbers(engine, rows, false, options), numbers(engine, rows, true, options),
                              words(engine, rows)};
  for (Drawn& drawn : table)
    if (coin()) {  // then a missing cell is one more value
      drawn.column.missing_is_value = true;
      for (auto& reading : drawn.readings) reading = reading.value_or(drawn.size);
      ++drawn.size;
    }
  const Words names = {"ash", "elm", "oak"};
  std::vector<std::size_t> labels = {0, 1, 2};
  while (labels.size() < rows) labels.push_back(engine() % 3);
  Words kinds;
  for (const std::size_t label : labels) kinds.push_back(names[label]);
  std::vector<TableColumn> columns;
  for (const Drawn& drawn : table) columns.push_back(drawn.column);

  const TableClassifier fitted = TableClassifier::fit(columns, {"kind", kinds}, options);
  using enum TableInference;
  for (const auto inference :
       {sigma, max_by_ratio, max_by_dubois_prade, sigma_max_by_ratio, sigma_max_by_dubois_prade}) {
    const TableClassifier classifier = fitted.by(inference);
    for (std::size_t row = 0; row < rows; row += 7) {
      std::vector<TableCell> cells;
      for (const Drawn& drawn : table) cells.push_back(drawn.cell(row));
      RC_ASSERT(classifier.readings(cells) == classifier.readings(columns, row));
      const TablePrediction found = classifier.predict(cells);
      const Numbers expected = with_sensor_noise(table, labels, options, inference, row);
      Numbers belief;
      for (std::size_t c = 0; c < 3; ++c)
        belief.push_back(std::visit([&](const auto& one) { return one[c]; }, found.belief));
      require_near(belief, expected);
      RC_ASSERT(expected[found.pattern] >= greatest(expected) * (1.0 - 1e-9));
      RC_ASSERT(found.label == names[found.pattern]);
      const PatternExplanation why = classifier.explain(cells);
      RC_ASSERT(why.pattern == found.pattern);
      require_near(why.log_ratio(), std::log(expected[why.pattern]) - std::log(expected[why.rival]));
    }
  }
}

const std::vector<TableColumn> trees{{"height", {12, 31, 9, 28, not_a_number}},
                                     {"leaf", {"broad", "needle", "broad", "needle", ""}}};
const TableColumn kind{"tree", {"oak", "pine", "oak", "pine", ""}};

TEST(TableClassifier, SkipsWhatItDoesNotKnow) {
  const TableClassifier classifier = TableClassifier::fit(trees, kind, {.bins = 2});
  EXPECT_EQ(classifier.model().counts.rows(0), 2.0) << "a row without a label teaches nothing";
  EXPECT_EQ(classifier.readings({not_a_number, "palm"}), (std::vector<std::size_t>{missing, missing}));
  EXPECT_EQ(classifier.predict({not_a_number, ""}).tied, 2U);
  EXPECT_EQ(classifier.name(), "sigma");
  EXPECT_EQ(classifier.by(TableInference::sigma_max_by_dubois_prade).name(), "sigma-max, Dubois-Prade");
}

TEST(TableClassifier, TakesAWordThatNoTrainingRowHadForMissing) {
  const std::vector<std::size_t> classes{0, 1, 0, 1, 0};
  const auto without_pines = [](std::size_t row) { return row != 1 && row != 3; };
  const TableClassifier classifier{TableModel::fit(trees, {"tree", {"oak", "pine"}}, classes, {}, without_pines)};
  EXPECT_EQ(classifier.readings({9.0, "needle"})[1], missing);
  EXPECT_EQ(classifier.readings({9.0, "broad"})[1], 0U);
}

TEST(TableClassifier, OfARowThatExcludesEveryClassSaysThePrior) {
  const TableClassifier classifier = TableClassifier::fit(trees, kind, {.bins = 2, .smoothing = 0.0});
  const TablePrediction found = classifier.predict({30.0, "broad"});
  EXPECT_TRUE(found.excluded);
  EXPECT_EQ(std::get<Belief<Random>>(found.belief)[0], 0.5);
  EXPECT_FALSE(classifier.predict({30.0, "needle"}).excluded);
}

TEST(TableClassifier, RefusesWhatDoesNotFit) {
  const TableClassifier classifier = TableClassifier::fit(trees, kind);
  EXPECT_INVALID(("1 cells", "2 columns"), classifier.predict({30.0}));
  EXPECT_INVALID(("'height'", "numbers, not 'tall'"), classifier.predict({"tall", "broad"}));
  EXPECT_INVALID(("'leaf'", "words, not 2"), classifier.predict({30.0, 2.0}));
  EXPECT_INVALID(("'height'", "5 rows", "2 labels"), TableClassifier::fit(trees, {"tree", {"oak", "pine"}}));
}

}  // namespace table_classifier_test
