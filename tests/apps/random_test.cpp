#include "shell/random.hpp"
#include "support/test.hpp"

#include <Random123/philox.h>

namespace random_test {

constexpr std::size_t draws = 1'000'000;

std::vector<double> drawn(double (RandomStream::*draw)(), std::uint64_t seed, std::uint64_t stream) {
  RandomStream random{seed, stream};
  std::vector<double> values(draws);
  for (double& value : values) value = (random.*draw)();
  return values;
}
std::vector<double> normals(std::uint64_t seed, std::uint64_t stream) {
  return drawn(&RandomStream::normal, seed, stream);
}
std::vector<double> uniforms(std::uint64_t seed, std::uint64_t stream) {
  return drawn(&RandomStream::uniform, seed, stream);
}

double mean_power(const std::vector<double>& values, int power) {
  double sum = 0.0;
  for (const double value : values) sum += std::pow(value, power);
  return sum / static_cast<double>(values.size());
}

/// Sample correlation of two samples of known mean zero and variance one; its standard error is 1/√n.
double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum / static_cast<double>(a.size());
}

/// √n times the greatest distance between the sample's distribution function and the given one.
template <class Cdf>
double kolmogorov_smirnov(std::vector<double> values, Cdf cdf) {
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double greatest = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double expected = cdf(values[i]);
    greatest = std::max({greatest, expected - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - expected});
  }
  return std::sqrt(n) * greatest;
}

// Exceeded by a true sample with probability 2 exp(−2·1.95²) = 0.1 %.
constexpr double ks_bound = 1.95;

TEST(Philox, GivesThePublishedAnswers) {
  // philox4x64, 10 rounds, from Random123's tests/kat_vectors.
  struct Answer {
    std::array<std::uint64_t, 4> counter;
    std::array<std::uint64_t, 2> key;
    std::array<std::uint64_t, 4> block;
  };
  constexpr std::uint64_t ones = ~std::uint64_t{0};
  const Answer answers[] = {
      {{0, 0, 0, 0}, {0, 0}, {0x16554d9eca36314c, 0xdb20fe9d672d0fdc, 0xd7e772cee186176b, 0x7e68b68aec7ba23b}},
      {{ones, ones, ones, ones},
       {ones, ones},
       {0x87b092c3013fe90b, 0x438c3c67be8d0224, 0x9cc7d7c69cd777b6, 0xa09caebf594f0ba0}},
      {{0x243f6a8885a308d3, 0x13198a2e03707344, 0xa4093822299f31d0, 0x082efa98ec4e6c89},
       {0x452821e638d01377, 0xbe5466cf34e90c6c},
       {0xa528f45403e61d95, 0x38c72dbd566e9788, 0xa5a1610e72fd18b5, 0x57bd43b5e52b7fe6}}};
  for (const Answer& answer : answers) {
    const r123::Philox4x64::ctr_type counter{
        {answer.counter[0], answer.counter[1], answer.counter[2], answer.counter[3]}};
    const auto block = r123::Philox4x64{}(counter, {{answer.key[0], answer.key[1]}});
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(block[i], answer.block[i]);
  }
}

TEST(RandomStream, IsPhiloxCountedFromZero) {
  RandomStream random{0, 0};
  for (const std::uint64_t word : {0x16554d9eca36314cU, 0xdb20fe9d672d0fdcU, 0xd7e772cee186176bU, 0x7e68b68aec7ba23bU})
    EXPECT_EQ(random.uniform(), std::ldexp(static_cast<double>(word >> 11U), -53));
}

TEST(RandomStream, SeedIsTheKeyAndStreamTheCounter) {
  RandomStream random{7, 9};
  for (std::uint64_t block = 0; block < 3; ++block)
    for (const std::uint64_t word : r123::Philox4x64{}({{block, 9, 0, 0}}, {{7, 0}}))
      EXPECT_EQ(random.uniform(), std::ldexp(static_cast<double>(word >> 11U), -53));
}

TEST(RandomStream, NormalIsTheTransformOfBoxAndMuller) {
  RandomStream uniform{3, 1};
  RandomStream normal{3, 1};
  for (int i = 0; i < 100; ++i) {
    const double first = uniform.uniform();
    const double second = uniform.uniform();
    const double x = normal.normal();
    const double y = normal.normal();
    EXPECT_NEAR(std::exp(-0.5 * (x * x + y * y)), first, 1e-14);
    EXPECT_NEAR(std::remainder(std::atan2(y, x) / (2.0 * std::numbers::pi) - second, 1.0), 0.0, 1e-15);
  }
}

TEST(RandomStream, StreamsAndSeedsAreUncorrelated) {
  const double bound = 4.0 / std::sqrt(static_cast<double>(draws));
  const auto base = normals(42, 5);
  EXPECT_NEAR(correlation(base, normals(42, 6)), 0.0, bound);
  EXPECT_NEAR(correlation(base, normals(43, 5)), 0.0, bound);
  EXPECT_NEAR(correlation(base, normals(5, 42)), 0.0, bound);
}

TEST(RandomStream, SuccessiveNormalsAreUncorrelated) {
  const double bound = 4.0 / std::sqrt(static_cast<double>(draws));
  const auto values = normals(1, 0);
  auto squares = values;
  for (double& value : squares) value = (value * value - 1.0) / std::sqrt(2.0);
  for (const std::ptrdiff_t lag : {1, 2, 3, 4}) {
    EXPECT_NEAR(correlation({values.begin() + lag, values.end()}, {values.begin(), values.end() - lag}), 0.0, bound);
    EXPECT_NEAR(correlation({squares.begin() + lag, squares.end()}, {squares.begin(), squares.end() - lag}), 0.0,
                bound);
  }
}

TEST(RandomStream, NormalMomentsAreInTheirFourSigmaBands) {
  // The standard errors of a normal sample's raw moments: √(E x²ᵏ − (E xᵏ)²)/√n.
  const auto n = static_cast<double>(draws);
  const auto values = normals(1, 0);
  EXPECT_NEAR(mean_power(values, 1), 0.0, 4.0 * std::sqrt(1.0 / n));
  EXPECT_NEAR(mean_power(values, 2), 1.0, 4.0 * std::sqrt(2.0 / n));
  EXPECT_NEAR(mean_power(values, 3), 0.0, 4.0 * std::sqrt(15.0 / n));
  EXPECT_NEAR(mean_power(values, 4), 3.0, 4.0 * std::sqrt(96.0 / n));
}

TEST(RandomStream, UniformMomentsAreInTheirFourSigmaBands) {
  const auto n = static_cast<double>(draws);
  const auto values = uniforms(1, 0);
  EXPECT_NEAR(mean_power(values, 1), 1.0 / 2.0, 4.0 * std::sqrt(1.0 / 12.0 / n));
  EXPECT_NEAR(mean_power(values, 2), 1.0 / 3.0, 4.0 * std::sqrt(4.0 / 45.0 / n));
  EXPECT_GT(*std::min_element(values.begin(), values.end()), 0.0);
  EXPECT_LT(*std::max_element(values.begin(), values.end()), 1.0);
}

TEST(RandomStream, PassesKolmogorovAndSmirnov) {
  EXPECT_LT(kolmogorov_smirnov(normals(1, 0), [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }), ks_bound);
  EXPECT_LT(kolmogorov_smirnov(uniforms(1, 1), [](double x) { return x; }), ks_bound);
}

}  // namespace random_test
