#include "support/core.hpp"

namespace distribution_test {

constexpr double greatest_double = std::numeric_limits<double>::max();

const RandomVariable weather{"weather", {"dry", "wet", "snow"}};
const FuzzyVariable mood{"mood", {"calm", "wild"}};

static_assert(std::same_as<Distribution<Random>::kind, Random>);
static_assert(!std::constructible_from<Distribution<Random>, FuzzyVariable, std::vector<double>>);
static_assert(!std::convertible_to<Distribution<Random>, Distribution<Fuzzy>>);
static_assert(std::copyable<Distribution<Random>>);

TEST(Distribution, IsReadByIndexAndByLabel) {
  const Distribution p{weather, {0.5, 0.25, 0.25}};
  EXPECT_EQ(p[0], 0.5);
  EXPECT_EQ(p["snow"], 0.25);
  EXPECT_EQ(p.size(), 3U);
  EXPECT_EQ(p.variable(), weather);
  EXPECT_INVALID(("'weather'", "'hail'"), p["hail"]);
}

TEST(Distribution, ToleratesATotalWithinOneBillionthAndStoresTheValuesUnchanged) {
  for (const double off : {-0.9e-9, 0.9e-9}) {
    const Distribution p{weather, {0.5, 0.25, 0.25 + off}};
    EXPECT_EQ(p["snow"], 0.25 + off);
    EXPECT_EQ(p["dry"], 0.5);
    const Distribution pi{mood, {1.0 + off, 0.5}};
    EXPECT_EQ(pi["calm"], 1.0 + off);
  }
  for (const double off : {-1.1e-9, 1.1e-9}) {
    EXPECT_INVALID(("sum", "'weather'", off < 0 ? "0.9999999989" : "1.0000000011"),
                   Distribution(weather, {0.5, 0.25, 0.25 + off}));
    EXPECT_INVALID(("'mood'", off < 0 ? "0.9999999989" : "1.0000000011"), Distribution(mood, {1.0 + off, 0.5}));
  }
}

TEST(Distribution, TakesAsManyValuesAsThereAreOutcomes) {
  EXPECT_INVALID(("'mood'", "2 outcomes", "3 values"), Distribution(mood, {1.0, 1.0, 1.0}));
  EXPECT_INVALID(("'mood'", "2 outcomes", "0 values"), Distribution(mood, std::vector<double>{}));
}

TEST(Uninformative, IsUniformForRandomAndOneForFuzzy) {
  EXPECT_CLOSE(uninformative(weather).values(), std::vector(3, 1.0 / 3.0), 1e-15);
  EXPECT_CLOSE(uninformative(mood).values(), std::vector(2, 1.0), 0.0);
  EXPECT_EQ(uninformative(RandomVariable("single", 1))[0], 1.0);
  const auto cell = uninformative(RandomVariable("cell", 100000));
  EXPECT_CLOSE(cell[99999], 1e-5, 1e-15);
  EXPECT_CLOSE(total<Random>(cell.values()), 1.0, 1e-9);
}

TEST(Normalized, NeitherOverflowsNorUnderflows) {
  const std::vector<double> huge{greatest_double, greatest_double, 0.0};
  EXPECT_CLOSE(normalized(weather, huge).values(), (std::vector{0.5, 0.5, 0.0}), 1e-15);
  const std::vector<double> tiny{least_subnormal, least_subnormal, 0.0};
  EXPECT_CLOSE(normalized(weather, tiny).values(), (std::vector{0.5, 0.5, 0.0}), 1e-15);
  const std::vector<double> lone{least_subnormal, 0.0};
  EXPECT_EQ(normalized(mood, lone)["calm"], 1.0);
}

TEST(Normalized, RefusesWhatHasNoProportion) {
  const std::vector<double> zero{0.0, 0.0}, negative{1.0, -1.0}, short_of_one{1.0};
  const std::vector<double> missing{1.0, not_a_number};
  const std::vector<double> infinite{infinity, 1.0};
  EXPECT_INVALID(("'mood'", "zero"), normalized(mood, zero));
  EXPECT_INVALID(("'mood'", "'wild'", "-1"), normalized(mood, negative));
  EXPECT_INVALID(("'mood'", "1 values"), normalized(mood, short_of_one));
  EXPECT_INVALID(("'mood'", "'wild'", "nan", "finite"), normalized(mood, missing));
  EXPECT_INVALID(("'mood'", "'calm'", "inf"), normalized(mood, infinite));
}

TEST(Distribution, NormalizedIsItself) {
  const Distribution forecast{weather, {0.25, 0.5, 0.25}};
  EXPECT_EQ(&forecast.normalized(), &forecast);
  const auto& outlives = Distribution{weather, {0.25, 0.5, 0.25}}.normalized();  // of a temporary it is a value
  EXPECT_EQ(outlives["wet"], 0.5);
}

TEST(MostLikely, IsTheFirstDeclaredOnATie) {
  EXPECT_EQ(most_likely(Distribution{weather, {0.25, 0.5, 0.25}}), "wet");
  EXPECT_EQ(most_likely(Distribution{weather, {0.25, 0.375, 0.375}}), "wet");
  EXPECT_EQ(most_likely(uninformative(mood)), "calm");
}

}  // namespace distribution_test
