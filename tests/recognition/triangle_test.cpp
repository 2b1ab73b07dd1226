#include "laws/generate.hpp"
#include "support/sigmax.hpp"

namespace triangle_test {

TEST(Triangle, RisesToItsOptimumAndFalls) {
  const Triangle speed{10.0, 20.0, 60.0};
  EXPECT_EQ(speed(9.0), 0.0);
  EXPECT_EQ(speed(10.0), 0.0);
  EXPECT_EQ(speed(15.0), 0.5);
  EXPECT_EQ(speed(20.0), 1.0);
  EXPECT_EQ(speed(30.0), 0.75);
  EXPECT_EQ(speed(60.0), 0.0);
  EXPECT_EQ(speed(61.0), 0.0);
}

TEST(Triangle, MayHaveVerticalSidesOrNone) {
  EXPECT_EQ((Triangle{2.0, 2.0, 4.0}(2.0)), 1.0);
  EXPECT_EQ((Triangle{2.0, 2.0, 4.0}(1.999)), 0.0);
  EXPECT_EQ((Triangle{2.0, 2.0, 4.0}(3.0)), 0.5);
  EXPECT_EQ((Triangle{2.0, 2.0, 2.0}(2.0)), 1.0);
  EXPECT_EQ((Triangle{2.0, 2.0, 2.0}(2.001)), 0.0);
}

TEST(Triangle, HasASupremumOverAnInterval) {
  const Triangle speed{10.0, 20.0, 60.0};
  EXPECT_EQ(speed.supremum(0.0, 5.0), 0.0);
  EXPECT_EQ(speed.supremum(0.0, 15.0), 0.5);
  EXPECT_EQ(speed.supremum(10.0, 20.0), 1.0);  // not attained, but the limit counts
  EXPECT_EQ(speed.supremum(20.0, 21.0), 1.0);
  EXPECT_EQ(speed.supremum(15.0, 40.0), 1.0);
  EXPECT_EQ(speed.supremum(30.0, infinity), 0.75);
  EXPECT_EQ(speed.supremum(-infinity, 12.0), 0.2);
  EXPECT_EQ((Triangle{2.0, 2.0, 4.0}.supremum(0.0, 2.0)), 0.0);  // a vertical side has no limit from there
  EXPECT_EQ((Triangle{2.0, 4.0, 4.0}.supremum(4.0, 5.0)), 1.0);
}

TEST(Triangular, GivesABinItsMostPossibleValue) {
  const Discretization bins{{10.0, 15.0, 30.0, 50.0}};
  const FuzzyVariable speed = bins.variable<Fuzzy>("speed");
  const Triangle triangle{10.0, 20.0, 60.0};
  EXPECT_CLOSE(triangular(speed, bins, triangle).values(), (Numbers{0.0, 0.5, 1.0, 0.75, 0.25}), 1e-15);
  EXPECT_CLOSE(triangular(speed, bins, triangle, 0.3).values(), (Numbers{0.3, 0.5, 1.0, 0.75, 0.3}), 1e-15);
}

TEST(Triangle, RefusesCornersOutOfOrder) {
  EXPECT_INVALID(("minimum", "2.0", "1.0", "3.0"), Triangle(2.0, 1.0, 3.0));
  EXPECT_THROW(Triangle(0.0, not_a_number, 1.0), std::invalid_argument);
  EXPECT_THROW(Triangle(0.0, 1.0, infinity), std::invalid_argument);
  EXPECT_THROW(Triangle(-infinity, 0.0, 1.0), std::invalid_argument);
  const Discretization bins{{10.0}};
  EXPECT_INVALID(("'speed'", "3", "2 values"), triangular(FuzzyVariable{"speed", 3}, bins, Triangle{0, 1, 2}));
  EXPECT_INVALID(("[0, 1]", "1.5"), triangular(bins.variable<Fuzzy>("speed"), bins, Triangle{0, 1, 2}, 1.5));
}

}  // namespace triangle_test
