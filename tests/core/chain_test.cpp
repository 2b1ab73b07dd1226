#include <boost/multiprecision/cpp_int.hpp>

#include "laws/generate.hpp"

namespace chain_test {

using boost::multiprecision::cpp_int;
using boost::multiprecision::cpp_rational;

const RandomVariable weather{"weather", {"dry", "wet", "snow"}};

const FuzzyVariable mood{"mood", {"calm", "wild"}};

static_assert(std::same_as<decltype(compose(std::declval<Relation<Random, Fuzzy>>(), std::declval<Chain<Fuzzy>>())),
                           Chain<Random>>);
template <class Left, class Right>
concept Composes = requires(const Left& left, Right right) {
  compose(left, std::move(right));
};
static_assert(!Composes<Relation<Random, Fuzzy>, Chain<Random>>);

/// log of an exact number: its leading 64 bits and its power of two.
long double exact_log(const cpp_int& number) {
  const auto bits = static_cast<std::int64_t>(msb(number));
  const std::int64_t shift = bits > 63 ? bits - 63 : 0;
  return std::log(static_cast<long double>(static_cast<std::uint64_t>(number >> static_cast<unsigned>(shift)))) +
         static_cast<long double>(shift) * std::log(2.0L);
}
long double exact_log(const cpp_rational& number) {
  return exact_log(numerator(number)) - exact_log(denominator(number));
}

/// The same in exact rational arithmetic, every double taken at its word.
using ExactRow = std::vector<cpp_rational>;
ExactRow exact(std::span<const double> values) { return {values.begin(), values.end()}; }
template <class Kind>
cpp_rational exact_total(const ExactRow& row) {
  cpp_rational sum = 0;
  for (const auto& value : row)
    sum = by_kind<Kind> == plain::By::sum ? cpp_rational(sum + value) : std::max(sum, value);
  return sum;
}
template <class Eliminated>
ExactRow exact_compose(const Rows& left, const ExactRow& right) {
  ExactRow result;
  for (std::size_t to = 0; to < left.front().size(); ++to) {
    ExactRow terms;
    for (std::size_t m = 0; m < right.size(); ++m) terms.push_back(cpp_rational(left[m][to]) * right[m]);
    result.push_back(exact_total<Eliminated>(terms));
  }
  return result;
}

TEST(Chain, OfNothingIsItsStart) {
  const Chain chain{Distribution{weather, {0.25, 0.5, 0.25}}};
  EXPECT_EQ(chain.variable(), weather);
  EXPECT_EQ(Chain{chain}.variable(), weather);
  EXPECT_EQ(chain.log_total(), 0.0);
  EXPECT_EQ(chain.log(1), std::log(0.5));
  EXPECT_EQ(most_likely(chain), "wet");
  EXPECT_CLOSE(chain.normalized().values(), (std::vector{0.25, 0.5, 0.25}), 0.0);
}

TEST(Chain, RefusesWhatDoesNotFit) {
  const RandomVariable sky{"sky", {"dry", "wet", "snow"}};
  const Relation next{sky, sky, {{1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}};
  const Chain chain{uninformative(weather)};
  EXPECT_INVALID(("compose", "'sky'", "'weather'"), compose(next, chain));
  EXPECT_INVALID(("update", "'weather'", "'sky'"), update(chain, Likelihood{sky}));
  EXPECT_REFUSED(std::domain_error, ("evidence", "'weather'"), update(chain, Likelihood{weather, {0.0, 0.0, 0.0}}));
}

TEST(Chain, StaysAsItWasWhereEvidenceExcludesAll) {
  for (const std::size_t size : {std::size_t{2}, std::size_t{100}}) {
    const RandomVariable s{"s", size};
    std::vector<double> start(size, 0.0), other(size, 1.0);
    start[0] = 1.0;
    other[0] = 0.0;
    std::vector<std::vector<double>> identity(size, std::vector<double>(size, 0.0));
    for (std::size_t i = 0; i < size; ++i) identity[i][i] = 1.0;
    const Relation stay{s, s, identity};
    const Likelihood half{s, std::vector<double>(size, 0.5)}, impossible{s, other};

    Chain chain{Distribution{s, start}};
    for (int step = 0; step < 3; ++step) {
      const auto bad = [&] { chain = update(compose(stay, std::move(chain)), impossible); };
      EXPECT_TRUE(throws<std::domain_error>(bad, {"evidence", "'s'"}));
      EXPECT_REFUSED(std::domain_error, ("'s'"), chain = update(std::move(chain), impossible));
      EXPECT_EQ(most_likely(chain), "0");
      EXPECT_EQ(chain.log_total(), step * std::log(0.5));
      chain = update(compose(stay, std::move(chain)), half);
    }
    EXPECT_CLOSE(chain.log_total(), 3 * std::log(0.5), 1e-15);
  }
}

TEST(Chain, MultipliesByTheNumbersOfALikelihoodToTheBit) {
  const FuzzyVariable s{"s", 1}, f{"f", 2};
  const Chain chain =
      update(compose(Relation{f, s, {{0.5, 1.0}}}, Chain{uninformative(s)}), Likelihood{f, {0.25, 0.125}});
  EXPECT_EQ(chain.row()[0].value(), 0.125);
  EXPECT_EQ(chain.row()[1].value(), 0.125);
  EXPECT_EQ(most_likely(chain), "0");  // a tie
}

// The log evidence and the winner, checked in exact rational arithmetic.

TYPED_SUITE(ChainOf, Random, Fuzzy);

TYPED_PROPERTY(ChainOf, EvidenceIsExactInRationalArithmetic) {
  auto x = laws::any_variable<TypeParam>("x");
  const auto prior = laws::any_distribution(x);
  Chain chain{prior};
  ExactRow row = exact(prior.values());
  const std::size_t length = *rc::gen::inRange<std::size_t>(1, 7);
  for (std::size_t step = 0; step < length; ++step) {
    const auto y = laws::any_variable<TypeParam>("y" + std::to_string(step));
    const Rows rows = any_normalized_rows(by_kind<TypeParam>, x.size(), y.size());
    chain = compose(Relation<TypeParam, TypeParam>{y, x, rows}, std::move(chain));
    row = exact_compose<TypeParam>(rows, row);
    x = y;
    const Numbers evidence = any_unit_numbers(y.size());
    ExactRow next = row;
    for (std::size_t i = 0; i < next.size(); ++i) next[i] *= cpp_rational(evidence[i]);
    if (exact_total<TypeParam>(next) == 0) {
      RC_ASSERT_THROWS_AS(update(chain, Likelihood{y, evidence}), std::domain_error);
      continue;
    }
    row = next;
    chain = update(std::move(chain), Likelihood{y, evidence});
  }
  require_near(chain.log_total(), static_cast<double>(exact_log(exact_total<TypeParam>(row))), 1e-13);
  for (std::size_t i = 0; i < row.size(); ++i)
    require_near(chain.log(i), row[i] == 0 ? log_zero : static_cast<double>(exact_log(row[i])), 1e-13);
  // The winner is the greatest, but for those that rounding makes equal.
  const cpp_rational best = *std::max_element(row.begin(), row.end());
  RC_ASSERT(row[chain.winner()] * cpp_rational(1.0 + 1e-12) >= best);
}

// Scaling by powers of two is exact: plain doubles give the same bits as long as they do not underflow.

TYPED_PROPERTY(ChainOf, HasTheBitsOfPlainArithmetic) {
  const auto x = laws::any_variable<TypeParam>("x");
  const auto draw = [&](std::size_t rows) {  // numbers far above underflow
    Rows result = any_normalized_rows(by_kind<TypeParam>, rows, x.size());
    for (Numbers& row : result)
      for (double& value : row) value = value < 1e-12 ? 0.0 : value;
    return result;
  };
  const Distribution<TypeParam> prior{x, draw(1).front()};
  Table plain_row = prior.table(), next(1, x.size());
  Chain chain{prior};
  for (int step = 0; step < 20; ++step) {
    const Relation<TypeParam, TypeParam> relation{x, x, draw(x.size())};
    chain = compose(relation, std::move(chain));
    kernels::compose<AlgebraOf<TypeParam>>(relation.table(), plain_row, next);
    std::swap(plain_row, next);
  }
  for (std::size_t i = 0; i < x.size(); ++i) RC_ASSERT(chain.row()[i].value() == plain_row(0, i));
}

// A million relations, checked against closed forms.

constexpr int million = 1000000;

TEST(Chain, ThroughAMillionSubnormalNumbersLosesNothing) {
  const FuzzyVariable state{"state", {"on", "off"}};
  const Relation next{state, state, {{least_subnormal, 1.0}, {1.0, least_subnormal}}};
  const Likelihood report{state, {least_subnormal, 1.0}};
  Chain chain{Distribution{state, {1.0, least_subnormal}}};
  for (int step = 0; step < million; ++step) chain = update(compose(next, std::move(chain)), report);
  // The route on, off, on, … passes each second step through 2^−1074; 5·10⁵ such reports.
  EXPECT_CLOSE(chain.log_total(), -1074.0 * 500000.0 * std::log(2.0), 1e-13);
}

TEST(Chain, BringsBackAnOutcomeThatIsFarBelowAnyDouble) {
  const RandomVariable state{"state", {"on", "off"}};
  const Relation stays{state, state, {{1.0, 0.0}, {0.0, 1.0}}};
  Chain chain{uninformative(state)};
  Likelihood against{state}, decisive{state, {0.0, 1.0}};
  against.set_log(1, -1e5);
  for (int step = 0; step < 1000; ++step) chain = update(compose(stays, std::move(chain)), against);
  EXPECT_CLOSE(chain.log_total(), std::log(0.5), 1e-14);
  chain = update(compose(stays, std::move(chain)), decisive);
  EXPECT_CLOSE(chain.log_total(), -1e8 + std::log(0.5), 1e-15);
  EXPECT_EQ(most_likely(chain), "off");
  EXPECT_CLOSE(chain.normalized().values(), (std::vector{0.0, 1.0}), 0.0);
}

}  // namespace chain_test
