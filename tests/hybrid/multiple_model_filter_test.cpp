#include <sigmax/hybrid/multiple_model_filter.hpp>

#include <gtest/gtest.h>

#include "hybrid/laws.hpp"

namespace sigmax {
namespace {

using namespace support;

static_assert(Filter<Interacting, Random>::axes == 2);
static_assert(std::is_same_v<Filter<Interacting, Random>::Measurement, Gaussian<2>>);

template <class Order, Uncertainty Kind>
void starts_again() {
  auto filter = vector_filter<Order, Kind>();
  const auto fresh = filter;
  const auto scans = manoeuvring_target(30);
  for (const Scan& scan : scans) step(filter, scan);
  filter.restart(starts());
  EXPECT_FALSE(filter.measured());
  require_same<Order, Kind>(filter, fresh);
  for (const Scan& scan : scans) step(filter, scan);
  filter.restart(starts()[2]);  // each model its share
  const Filter<Order, Kind> shared{fresh.system().models(), transition_of<Kind>(), starts()[2]};
  require_same<Order, Kind>(filter, shared);
}

TEST(MultipleModelFilter, StartsAgainAsIfNewFromEstimatesOrFromOne) {
  starts_again<Interacting, Random>();
  starts_again<SecondOrder, Fuzzy>();
}

TEST(MultipleModelFilter, RefusesAStartThatDoesNotFitAndIsThenUnchanged) {
  auto filter = vector_filter<Interacting, Random>();
  for (const Scan& scan : manoeuvring_target(5)) step(filter, scan);
  const auto before = filter;
  EXPECT_TRUE(throws<std::invalid_argument>([&] { filter.restart(std::vector<State>{starts()[0]}); },
                                            {"3 models", "1 starts"}));
  EXPECT_TRUE(throws<std::invalid_argument>(
      [&] {
        filter.restart(std::vector<State>{starts()[0], starts()[2], starts()[2]});
      },
      {"dwna", "6", "4"}));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { filter.restart(starts()[0]); }, {"4", "6"}));
  auto bad = starts()[2];
  bad.mean(3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(throws<std::invalid_argument>([&] { filter.restart(bad); }, {"not finite"}));
  require_same<Interacting, Random>(filter, before);
}

/// A turn of the axes, whose lengths it leaves, and a new origin.
const SquareMatrix<2> turned{{0.8, -0.6}, {0.6, 0.8}};
const Vector<2> moved(5000.0, -3000.0);

template <class Order, Uncertainty Kind>
void is_the_filter_of_transformed_measurements() {
  const auto told = [](const Scan& scan) {
    Scan result = scan;
    if (scan.z) result.z = Gaussian<2>{turned * scan.z->mean + moved, turned * scan.z->covariance * turned.transpose()};
    return result;
  };
  const auto transformed = [](State state) {
    const Eigen::Index n = state.size();  // by hand, the position and each derivative
    for (Eigen::Index d = 0; d < n; d += 2) {
      const double x = state.mean(d), y = state.mean(d + 1);
      state.mean(d) = 0.8 * x - 0.6 * y + (d == 0 ? 5000.0 : 0.0);
      state.mean(d + 1) = 0.6 * x + 0.8 * y + (d == 0 ? -3000.0 : 0.0);
    }
    const auto A = restatement::kronecker(restatement::identity(static_cast<std::size_t>(n / 2)),
                                          restatement::Matrix(2, 2, {0.8, -0.6, 0.6, 0.8}));
    const auto P = A * dense(state.covariance) * restatement::transposed(A);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index k = 0; k < n; ++k)
        state.covariance(i, k) = P(static_cast<std::size_t>(i), static_cast<std::size_t>(k));
    return state;
  };
  auto filter = vector_filter<Order, Kind>();
  std::vector<State> start;
  for (const State& each : starts()) start.push_back(transformed(each));
  Filter<Order, Kind> expected{filter.system().models(), transition_of<Kind>(), start};
  bool there = false;
  for (const Scan& scan : manoeuvring_target(120)) {
    if (scan.dt == 0.0 && !there) {
      filter.transform(turned, moved);
      there = true;
    }
    step(filter, there ? told(scan) : scan);
    step(expected, told(scan));
    for (std::size_t j = 0; j < 3; ++j) {
      const State& shown = filter.estimates()[j];
      const State now = there ? shown : transformed(shown);
      ASSERT_PRED_FORMAT3(near_matrix, now.mean, expected.estimates()[j].mean, 1e-9);
      ASSERT_PRED_FORMAT3(near_matrix, now.covariance, expected.estimates()[j].covariance, 1e-8);
    }
    ASSERT_PRED_FORMAT3(near, filter.belief().logs(), expected.belief().logs(), 1e-7);
  }
  EXPECT_TRUE(there);
}

TEST(MultipleModelFilter, InOtherCoordinatesIsTheFilterOfMeasurementsInThem) {
  is_the_filter_of_transformed_measurements<Interacting, Random>();
  is_the_filter_of_transformed_measurements<Interacting, Fuzzy>();
  is_the_filter_of_transformed_measurements<SecondOrder, Random>();
  is_the_filter_of_transformed_measurements<SecondOrder, Fuzzy>();
}

}  // namespace
}  // namespace sigmax
