#include "support/core.hpp"

namespace scaled_number_test {

constexpr double least = std::numeric_limits<double>::min();
constexpr double greatest = std::numeric_limits<double>::max();

TEST(ScaledNumber, GivesBackEveryDouble) {
  for (const double value : {0.0, least_subnormal, 3 * least_subnormal, least, 1e-200, 0.1, 1.0, 7.0, 1e200, greatest})
    EXPECT_EQ(ScaledNumber{value}.value(), value);
  EXPECT_EQ(ScaledNumber(3 * least_subnormal, 1000).value(), std::ldexp(3 * least_subnormal, 1000));
  EXPECT_EQ(ScaledNumber(0.1, -7).value(), std::ldexp(0.1, -7));
  EXPECT_EQ(ScaledNumber{-0.0}, ScaledNumber{});
  EXPECT_EQ(ScaledNumber{least_subnormal}.exponent(), -1073);
}

TEST(ScaledNumber, IsMultipliedWithoutUnderflow) {
  ScaledNumber product{1.0};
  for (int i = 0; i < 1000; ++i) product = product * ScaledNumber{least_subnormal};
  EXPECT_FALSE(product.is_zero());
  EXPECT_EQ(product.value(), 0.0);
  EXPECT_CLOSE(product.log(), -1074e3 * std::log(2.0), 1e-14);
  for (int i = 0; i < 1000; ++i) product = product * ScaledNumber{0x1p1023} * ScaledNumber{0x1p51};
  EXPECT_EQ(product.value(), 1.0);
}

TEST(ScaledNumber, OfZeroTimesAnythingIsZero) {
  const ScaledNumber zero, tiny = ScaledNumber{least_subnormal} * ScaledNumber{least_subnormal};
  EXPECT_TRUE((zero * tiny).is_zero());
  EXPECT_EQ(zero * tiny, zero);
  EXPECT_TRUE((zero * zero * zero * zero * tiny).is_zero());
  EXPECT_EQ(zero.log(), -infinity);
  EXPECT_EQ(zero.over(tiny), 0.0);
}

TEST(ScaledNumber, AddsByTheAlgebraAtAnyScale) {
  const ScaledNumber scale = ScaledNumber{least_subnormal} * ScaledNumber{least_subnormal};
  for (const double a : {0.0, least_subnormal, 1e-170, 1e-70, 0.5, 3.0, 1e75, 1e80, 1e200})
    for (const double b : {0.0, least_subnormal, 1e-169, 1e-75, 0.25, 2.0, 1e77, 1e79, 1e201}) {
      const ScaledNumber sum = ScaledNumber::plus<Sigma>(scale * ScaledNumber{a}, scale * ScaledNumber{b});
      const ScaledNumber max = ScaledNumber::plus<Max>(scale * ScaledNumber{a}, scale * ScaledNumber{b});
      EXPECT_EQ(sum.over(scale), a + b);
      EXPECT_EQ(max.over(scale), std::max(a, b));
    }
}

TEST(ScaledNumber, IsOrderedAsItsValue) {
  const ScaledNumber tiny = ScaledNumber{least_subnormal} * ScaledNumber{least_subnormal};
  EXPECT_LT(ScaledNumber{}, tiny);
  EXPECT_LT(tiny, ScaledNumber{least_subnormal});
  EXPECT_LT(tiny * ScaledNumber{0.5}, tiny);
  EXPECT_LT(ScaledNumber{1e76}, ScaledNumber{1e78});  // across a step of the exponent
  EXPECT_EQ(ScaledNumber{0.5} * ScaledNumber{4.0}, ScaledNumber{2.0});
}

TEST(ScaledNumber, TurnsIntoALogarithmAndBack) {
  for (const double log : {-1e6, -800.0, -3.0, 0.0, 2.0, 900.0}) {
    EXPECT_CLOSE(ScaledNumber::exp(log).log(), log, 1e-14);
  }
  EXPECT_TRUE(ScaledNumber::exp(-infinity).is_zero());
  EXPECT_FALSE(ScaledNumber::exp(-greatest).is_zero());
  EXPECT_LT(ScaledNumber::exp(-greatest) * ScaledNumber::exp(-greatest), ScaledNumber::exp(-greatest));
  EXPECT_LT(ScaledNumber{greatest}, ScaledNumber::exp(greatest));
  EXPECT_EQ(ScaledNumber::exp(-3.0).value(), std::exp(-3.0));
}

TEST(ScaledNumber, IsADoubleInUnitsOfAPowerOfTwo) {
  const ScaledNumber number(0.75, -5000);
  EXPECT_EQ(number.value_in_units_of(-5000), 0.75);
  EXPECT_EQ(number.normal_value_in_units_of(-5100), 0.75 * 0x1p100);
  EXPECT_EQ(number.value_in_units_of(-3930), 0.75 * 0x1p-1070);
  EXPECT_EQ(number.value_in_units_of(0), 0.0);
  EXPECT_EQ(ScaledNumber{}.normal_value_in_units_of(-5000), 0.0);
}

TEST(ScaledNumber, DividesAsFarAsADoubleGoes) {
  const ScaledNumber tiny = ScaledNumber{least_subnormal} * ScaledNumber{least_subnormal};
  EXPECT_EQ((tiny * ScaledNumber{6.0}).over(tiny * ScaledNumber{2.0}), 3.0);
  EXPECT_EQ(ScaledNumber{1.0}.over(tiny), infinity);
  EXPECT_EQ(tiny.over(ScaledNumber{1.0}), 0.0);
  EXPECT_EQ(ScaledNumber{greatest}.over(ScaledNumber{1.0}), greatest);
}

TEST(ScaledNumber, OfFarLogarithmsKeepsTheirDifference) {
  for (const double log : {-1e6, -1e10, 3e12}) {
    const double ratio = ScaledNumber::exp(log + 1.0).over(ScaledNumber::exp(log));
    EXPECT_NEAR(ratio, std::exp(1.0), 1e-14);
  }
}

TEST(ScaledNumber, HasTheLogarithmOfTheDoubleThatItIs) {
  for (const double value : {0.1, 0.125, 1e-300, 1e300, 3.0}) EXPECT_EQ(ScaledNumber{value}.log(), std::log(value));
}

TEST(ScaledNumber, PrintsAlsoWhereNoDoubleCanSayIt) {
  const auto printed = [](ScaledNumber number) {
    std::ostringstream out;
    out << number;
    return out.str();
  };
  EXPECT_EQ(printed(ScaledNumber{}), "0");
  EXPECT_EQ(printed(ScaledNumber{0.125}), "0.125");
  EXPECT_EQ(printed(ScaledNumber{2.0, -20000}), "5.02478e-6021");  // 2⁻¹⁹⁹⁹⁹
  EXPECT_EQ(printed(ScaledNumber{1.0, 20000}), "3.98028e6020");
}

}  // namespace scaled_number_test
