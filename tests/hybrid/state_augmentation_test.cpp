#include "support/sigmax.hpp"

namespace lift_test {

using detail::Correspondence, detail::Mixture;
using Names = std::vector<std::string>;

constexpr auto augmentations = {StateAugmentation::zero, StateAugmentation::borrowed_variance,
                                StateAugmentation::unbiased, StateAugmentation::prior};

/// The estimate of `source` in the receiver's components.
template <int N, int SourceN>
Gaussian<N> augmented(const Gaussian<N>& receiver, const Names& receivers, const Gaussian<SourceN>& source,
                      const Names& sources, StateAugmentation rule) {
  const Correspondence map(receivers, sources);
  const Mixture::Part part{detail::view(source), &map};
  Gaussian<N> result;
  Mixture{detail::view(receiver), {&part, 1}, rule}.read(part, detail::view(result));
  return result;
}

// A source {x, vx} in a receiver {x, vx, ax, jx}, by hand.
const Gaussian<4> receiver{Vector<4>{1, 2, 3, 4},
                           SquareMatrix<4>{{10, 1, 2, 3}, {1, 20, 4, 5}, {2, 4, 30, 6}, {3, 5, 6, 40}}};
const Gaussian<2> source{Vector<2>{-1, -2}, SquareMatrix<2>{{7, 0.5}, {0.5, 8}}};

TEST(StateAugmentation, FindsEachComponentByItsName) {
  EXPECT_EQ((Correspondence{{"x", "vx", "ax"}, {"x", "vx"}}.in_source), (std::vector<int>{0, 1, -1}));
  EXPECT_EQ((Correspondence{{"x", "vx"}, {"ax", "vx", "x"}}.in_source), (std::vector<int>{2, 1}));
}

TEST(StateAugmentation, OfComponentsThatASourceLacksIsWhatTheRuleSays) {
  const auto at = [](StateAugmentation rule) {
    return augmented(receiver, {"x", "vx", "ax", "jx"}, source, {"x", "vx"}, rule);
  };
  EXPECT_EQ(at(StateAugmentation::zero).mean, (Vector<4>{-1, -2, 0, 0}));
  EXPECT_EQ(at(StateAugmentation::zero).covariance,
            (SquareMatrix<4>{{7, 0.5, 0, 0}, {0.5, 8, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}));
  for (const StateAugmentation rule : {StateAugmentation::borrowed_variance,
                                       StateAugmentation::prior}) {  // of the receiver, or of what is thought before
    EXPECT_EQ(at(rule).mean, (Vector<4>{-1, -2, 0, 0}));
    EXPECT_EQ(at(rule).covariance, (SquareMatrix<4>{{7, 0.5, 0, 0}, {0.5, 8, 0, 0}, {0, 0, 30, 0}, {0, 0, 0, 40}}));
  }
  EXPECT_EQ(at(StateAugmentation::unbiased).mean, (Vector<4>{-1, -2, 3, 4}));
  EXPECT_EQ(at(StateAugmentation::unbiased).covariance,
            (SquareMatrix<4>{{7, 0.5, 0, 0}, {0.5, 8, 0, 0}, {0, 0, 30, 6}, {0, 0, 6, 40}}));
}

TEST(StateAugmentation, AnEntryPriorIsNarrowerAlongTheVerticalAndHasItsOwnTurnRate) {
  const EntryPrior prior{{3.0, 4.0}, 0.5, 0.1};
  EXPECT_EQ(prior.variance("ax", 4.0), 16.0);
  EXPECT_EQ(prior.variance("az", 4.0), 4.0);
  EXPECT_EQ(prior.variance("omega", 4.0), 0.1 * 0.1);
  EXPECT_DOUBLE_EQ(prior.root_mean_square(), std::sqrt(12.5));
}

TEST(StateAugmentation, ComponentsThatAreNotNestedFollowTheSameRules) {
  const Names receivers{"ax", "x", "jx", "vx"};
  const auto at = [&](StateAugmentation rule) { return augmented(receiver, receivers, source, {"vx", "x"}, rule); };
  EXPECT_EQ(at(StateAugmentation::zero).mean, (Vector<4>{0, -2, 0, -1}));
  EXPECT_EQ(at(StateAugmentation::zero).covariance,
            (SquareMatrix<4>{{0, 0, 0, 0}, {0, 8, 0, 0.5}, {0, 0, 0, 0}, {0, 0.5, 0, 7}}));
  EXPECT_EQ(at(StateAugmentation::borrowed_variance).mean, (Vector<4>{0, -2, 0, -1}));
  EXPECT_EQ(at(StateAugmentation::borrowed_variance).covariance,
            (SquareMatrix<4>{{10, 0, 0, 0}, {0, 8, 0, 0.5}, {0, 0, 30, 0}, {0, 0.5, 0, 7}}));
  EXPECT_EQ(at(StateAugmentation::unbiased).mean, (Vector<4>{1, -2, 3, -1}));
  EXPECT_EQ(at(StateAugmentation::unbiased).covariance,
            (SquareMatrix<4>{{10, 0, 2, 0}, {0, 8, 0, 0.5}, {2, 0, 30, 0}, {0, 0.5, 0, 7}}));
}

TEST(StateAugmentation, GoingDownDropsComponents) {
  for (const StateAugmentation rule : augmentations) {
    const auto found = augmented(source, {"x", "vx"}, receiver, {"x", "vx", "ax", "jx"}, rule);
    EXPECT_EQ(found.mean, (Vector<2>{1, 2}));
    EXPECT_EQ(found.covariance, (SquareMatrix<2>{{10, 1}, {1, 20}}));
  }
}

TEST(StateAugmentation, ItsOwnEstimateIsUnchanged) {
  for (const StateAugmentation rule : augmentations) {
    const auto found = augmented(receiver, {"a", "b", "c", "d"}, receiver, {"a", "b", "c", "d"}, rule);
    EXPECT_EQ(found.mean, receiver.mean);
    EXPECT_EQ(found.covariance, receiver.covariance);
  }
}

TEST(StateAugmentation, CovariancesAreAddedByTheirWeight) {
  const Correspondence map({"x", "vx", "ax", "jx"}, {"x", "vx"});
  const Mixture::Part part{detail::view(source), &map};
  SquareMatrix<4> sum = SquareMatrix<4>::Ones();
  Mixture{detail::view(receiver), {&part, 1}, StateAugmentation::unbiased}.add_covariance(part, 2.0, sum.data());
  detail::mirror_lower(sum.data(), 4);  // they are added on and below the diagonal
  EXPECT_EQ(sum, (SquareMatrix<4>{{15, 2, 1, 1}, {2, 17, 1, 1}, {1, 1, 61, 13}, {1, 1, 13, 81}}));
}

}  // namespace lift_test
