#include "laws/generate.hpp"
#include "support/sigmax.hpp"

namespace evaluation_test {

TEST(ConfusionMatrix, ScoresByHand) {
  ConfusionMatrix confusion{4};  // pattern 3 never occurs
  for (const auto& [truth, decision] :
       std::vector<std::pair<std::size_t, std::size_t>>{{0, 0}, {0, 0}, {0, 1}, {1, 1}, {1, 0}, {2, 1}})
    confusion.add(truth, decision);
  EXPECT_EQ(confusion(0, 1), 1.0);
  EXPECT_CLOSE(confusion.accuracy(), 0.5, 1e-15);
  EXPECT_CLOSE(confusion.f1(0), 4.0 / 6.0, 1e-15);  // TP 2, FP 1, FN 1
  EXPECT_CLOSE(confusion.f1(1), 2.0 / 5.0, 1e-15);  // TP 1, FP 2, FN 1
  EXPECT_EQ(confusion.f1(2), 0.0);
  EXPECT_EQ(confusion.f1(3), 0.0);
  EXPECT_CLOSE(confusion.macro_f1(), (4.0 / 6.0 + 2.0 / 5.0) / 3.0, 1e-15);
}

TEST(ConfusionMatrix, OfNoCaseHasNoScore) {
  const ConfusionMatrix empty{2};
  EXPECT_THROW(empty.accuracy(), std::domain_error);
  EXPECT_THROW(empty.macro_f1(), std::domain_error);
}

const RandomVariable animal{"animal", {"cat", "hen", "cow"}};
const FuzzyVariable target{"target", {"T1", "T2", "T3"}};

TEST(Evaluation, ScoresProbabilities) {
  Evaluation<Random> evaluation{animal};
  EXPECT_EQ(evaluation.add(0, Belief{Distribution{animal, {0.5, 0.25, 0.25}}}), 1.0);
  EXPECT_EQ(evaluation.add(2, Belief{Distribution{animal, {0.5, 0.5, 0.0}}}), 0.0);
  EXPECT_EQ(evaluation.size(), 2U);
  EXPECT_EQ(evaluation.ties(), 1U);
  EXPECT_CLOSE(evaluation.log_loss(), 0.5 * (std::log(2.0) - std::log(1e-15)), 1e-14);
  EXPECT_CLOSE(evaluation.brier(), 0.5 * (0.375 + 1.5), 1e-15);
  EXPECT_CLOSE(evaluation.confusion().accuracy(), 0.5, 0.0);
  EXPECT_EQ(evaluation.confusion()(2, 0), 1.0);  // the tie went to the first
}

TEST(Evaluation, ScoresPossibilities) {
  Evaluation<Fuzzy> evaluation{target, 0.6};
  EXPECT_EQ(evaluation.add(0, Belief{Distribution{target, {1.0, 0.25, 0.625}}}), 1.0);
  EXPECT_EQ(evaluation.add(2, Belief{Distribution{target, {1.0, 0.25, 0.625}}}), 0.0);
  EXPECT_EQ(evaluation.add(1, Belief{Distribution{target, {1.0, 0.25, 0.625}}}), 0.0);
  EXPECT_CLOSE(evaluation.necessity(), 0.375 / 3.0, 1e-15);
  EXPECT_CLOSE(evaluation.coverage(), 2.0 / 3.0, 1e-15);
  EXPECT_CLOSE(evaluation.cut_size(), 2.0, 0.0);
}

TEST(Evaluation, AddsUpPartsOfTheData) {
  const Belief<Fuzzy> belief{Distribution{target, {1.0, 0.25, 0.625}}};
  Evaluation<Fuzzy> whole{target}, first{target}, second{target};
  for (const std::size_t truth : {0U, 1U, 2U, 2U, 0U}) {
    whole.add(truth, belief);
    (truth == 2 ? first : second).add(truth, belief);
  }
  first.add(second);
  EXPECT_EQ(first.size(), 5U);
  EXPECT_EQ(first.ties(), whole.ties());
  EXPECT_EQ(first.confusion()(2, 0), 2.0);
  EXPECT_CLOSE(first.necessity(), whole.necessity(), 1e-15);
  EXPECT_CLOSE(first.coverage(), whole.coverage(), 1e-15);
  EXPECT_INVALID(("'target'", "'x'"), first.add(Evaluation<Fuzzy>{FuzzyVariable{"x", 3}}));
  ConfusionMatrix two{2};
  EXPECT_THROW(two.add(first.confusion()), std::invalid_argument);
}

TEST(Evaluation, OfNoCaseHasNoScore) {
  EXPECT_THROW(Evaluation<Fuzzy>{target}.necessity(), std::domain_error);
  EXPECT_THROW(Evaluation<Random>{animal}.log_loss(), std::domain_error);
}

template <class E>
concept HasLogLoss = requires(const E& evaluation) {
  evaluation.log_loss();
};
template <class E>
concept HasNecessity = requires(const E& evaluation) {
  evaluation.necessity();
};
static_assert(HasLogLoss<Evaluation<Random>> && !HasNecessity<Evaluation<Random>>);
static_assert(HasNecessity<Evaluation<Fuzzy>> && !HasLogLoss<Evaluation<Fuzzy>>);

// Of a temporary a copy is returned, so that the reference in the loop does not dangle.
static_assert(std::is_same_v<decltype(std::declval<Evaluation<Random>>().confusion()), ConfusionMatrix>);

TEST(Evaluation, RefusesABeliefOfAnotherVariable) {
  Evaluation<Fuzzy> evaluation{target};
  EXPECT_INVALID(("'target'", "'x'"), evaluation.add(0, Belief{uninformative(FuzzyVariable{"x", 3})}));
  EXPECT_INVALID(("'target'", "3"), evaluation.add(3, Belief{uninformative(target)}));
  EXPECT_INVALID(("cut", "0.0"), Evaluation<Fuzzy>(target, 0.0));
  EXPECT_EQ(evaluation.size(), 0U);
}

}  // namespace evaluation_test
