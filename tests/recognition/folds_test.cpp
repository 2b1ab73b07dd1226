#include "laws/generate.hpp"
#include "support/sigmax.hpp"

namespace folds_test {

using Labels = std::vector<std::size_t>;

std::size_t spread(const Labels& sizes) {
  return *std::max_element(sizes.begin(), sizes.end()) - *std::min_element(sizes.begin(), sizes.end());
}

PROPERTY(StratifiedFolds, AreLevelOverAllAndWithinEveryLabel) {
  const auto n = *rc::gen::inRange<std::size_t>(2, 60);
  const auto folds = *rc::gen::inRange<std::size_t>(2, n + 1);
  Labels labels(n);
  for (auto& label : labels) label = *rc::gen::inRange<std::size_t>(0, 4);
  std::mt19937_64 generator(n);
  const auto fold_of = stratified_folds(labels, folds, generator);
  RC_ASSERT(fold_of.size() == n);
  Labels all(folds, 0);
  std::vector<Labels> within(4, Labels(folds, 0));
  for (std::size_t row = 0; row < n; ++row) {
    RC_ASSERT(fold_of[row] < folds);
    ++all[fold_of[row]];
    ++within[labels[row]][fold_of[row]];
  }
  RC_ASSERT(spread(all) <= 1U);
  for (const Labels& sizes : within) RC_ASSERT(spread(sizes) <= 1U);
}

/// Fisher–Yates from the last row of a label to the first, by the remainders of the raw draws; then dealt like cards.
TEST(StratifiedFolds, AreDealtByTheRawDrawsOfTheGenerator) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    Labels labels(50);
    for (std::size_t row = 0; row < labels.size(); ++row) labels[row] = (row * row) % 7;
    Labels expected(labels.size());
    std::mt19937_64 raw(seed), generator(seed);
    std::size_t dealt = 0;
    for (std::size_t label = 0; label < 7; ++label) {
      Labels rows;
      for (std::size_t row = 0; row < labels.size(); ++row)
        if (labels[row] == label) rows.push_back(row);
      for (std::size_t left = rows.size(); left >= 2; --left) {
        const std::size_t other = raw() % left;  // a draw beyond the last whole multiple is too rare to meet here
        const std::size_t kept = rows[left - 1];
        rows[left - 1] = rows[other];
        rows[other] = kept;
      }
      for (const std::size_t row : rows) expected[row] = dealt++ % 4;
    }
    EXPECT_EQ(stratified_folds(labels, 4, generator), expected) << seed;
    EXPECT_EQ(generator(), raw()) << "another number of draws was taken";
  }
}

TEST(StratifiedFolds, RefuseAnImpossibleNumber) {
  std::mt19937_64 generator(1);
  const Labels labels{0, 1, 0};
  for (const std::size_t folds : {0U, 1U, 4U})
    EXPECT_INVALID(("3 rows", std::to_string(folds), "folds"), stratified_folds(labels, folds, generator));
}

PROPERTY(GroupedFolds, KeepGroupsWholeAndPartEveryLabel) {
  const auto n = *rc::gen::inRange<std::size_t>(6, 20);
  std::mt19937_64 generator(n);
  Labels labels, groups;
  for (std::size_t group = 0; group < n; ++group)
    for (std::size_t row = 0; row <= generator() % 4; ++row) labels.push_back(group % 2), groups.push_back(group);
  const auto fold_of = grouped_folds(labels, groups, 3, generator);
  std::map<std::size_t, std::set<std::size_t>> of_group, of_label;
  for (std::size_t row = 0; row < labels.size(); ++row) {
    RC_ASSERT(fold_of[row] < 3U);
    of_group[groups[row]].insert(fold_of[row]);
    of_label[labels[row]].insert(fold_of[row]);
  }
  for (const auto& [group, folds] : of_group) RC_ASSERT(folds.size() == 1U);
  for (const auto& [label, folds] : of_label) RC_ASSERT(folds.size() > 1U);
}

TEST(GroupedFolds, RefuseWhatCannotBe) {
  std::mt19937_64 generator(1);
  EXPECT_INVALID(("2 groups", "3 folds"), grouped_folds(Labels{0, 0, 1}, Labels{0, 1, 1}, 3, generator));
  EXPECT_INVALID(("one fold"), grouped_folds(Labels{0, 0, 1, 1}, Labels{0, 0, 1, 2}, 2, generator));
}

}  // namespace folds_test
