#include "support/allocations.hpp"
#include "support/core.hpp"

namespace allocation_test {

/// The verbs that write into an existing result, for tables stored inline and on the heap.
class InPlace : public testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Sizes, InPlace, testing::Values(1U, 2U, 4U, 5U, 40U), testing::PrintToStringParamName());

TEST(Allocations, AreCounted) {
  EXPECT_EQ(allocations_of([] { const std::vector<double> some(100); }), 1U);
  EXPECT_EQ(allocations_of([] { const Table small(4, 4); }), 0U);
  EXPECT_EQ(allocations_of([] { const Table large(5, 4); }), 1U);
}

TEST_P(InPlace, VerbsAllocateNothing) {
  const std::size_t n = GetParam();
  const FuzzyVariable mode{"mode", n};
  const Relation<Fuzzy, Fuzzy> transition{mode, mode, std::vector(n, std::vector<double>(n, 1.0))};
  const Belief prior{uninformative(mode)};
  const Likelihood likelihood{mode, std::vector<double>(n, 0.5)};
  Relation<Fuzzy, Fuzzy> composed = transition;
  Belief predicted = prior, posterior = prior;
  auto inverse = invert(transition, prior);

  EXPECT_EQ(allocations_of([&] { compose(transition, transition, composed); }), 0U);
  EXPECT_EQ(allocations_of([&] { compose(transition, prior, predicted); }), 0U);
  EXPECT_EQ(allocations_of([&] { update(prior, likelihood, posterior); }), 0U);
  EXPECT_EQ(allocations_of([&] { update(posterior, likelihood, posterior); }), 0U);
  EXPECT_EQ(allocations_of([&] { invert(transition, prior, inverse); }), 0U);
}

TEST(Allocations, AChainThatIsUnderWayAllocatesNothing) {
  const RandomVariable s{"s", 50};
  const Relation step{s, s, std::vector(50, std::vector<double>(50, 0.02))};
  const Likelihood report{s, std::vector<double>(50, 0.5)};
  Chain chain{uninformative(s)};
  const auto advance = [&] { chain = update(compose(step, std::move(chain)), report); };
  for (int k = 0; k < 3; ++k) advance();
  EXPECT_EQ(allocations_of(advance), 0U);
}

}  // namespace allocation_test
