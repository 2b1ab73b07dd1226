#include <sigmax/hybrid/fixed_interval_smoother.hpp>

#include <gtest/gtest.h>

#include <sigmax/estimation/fixed_step_motion.hpp>
#include <sigmax/estimation/metrics.hpp>

#include "hybrid/laws.hpp"

namespace sigmax {
namespace {

using namespace support;

/// The record of a flight.
template <class Filter>
auto flown(Filter& filter, const std::vector<Scan>& scans) {
  std::vector record{filter.recorded(0.0)};
  for (const Scan& scan : scans) {
    step(filter, scan);
    record.push_back(recorded(filter, scan));
  }
  return record;
}

/// One model alone, filtered and smoothed.
std::vector<State> smoothed_alone(const Planar& model, const State& start, const std::vector<Scan>& scans) {
  Alone alone{model, start};
  std::vector<FilteredStep<State>> record{{0.0, start}};
  for (const Scan& scan : scans) {
    alone.step(scan);
    record.push_back({scan.dt, alone.state});
  }
  return smooth(model, record);
}

template <class Order, Uncertainty Kind>
void is_the_rts_smoother(std::size_t modes) {
  std::vector<std::vector<double>> rows(
      modes, std::vector<double>(modes, std::is_same_v<Kind, Random> ? 0.3 / static_cast<double>(modes) : 0.3));
  for (std::size_t i = 0; i < modes; ++i) rows[i][i] += 0.7;
  support::Filter<Order, Kind> filter{VectorBank(modes, turning()), transition_by<Kind>(rows),
                                      std::vector<State>(modes, starts()[2])};
  const auto scans = manoeuvring_target(60);
  const auto smoothed = smooth(filter, flown(filter, scans));
  const auto expected = smoothed_alone(turning(), starts()[2], scans);
  ASSERT_EQ(smoothed.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    ASSERT_PRED_FORMAT3(near_matrix, filter.estimate(smoothed[k]).mean, expected[k].mean, 1e-9) << "scan " << k;
    ASSERT_PRED_FORMAT3(near_matrix, filter.estimate(smoothed[k]).covariance, expected[k].covariance, 1e-9);
  }
}

TEST(FixedIntervalSmoother, OfOneModelOrEqualModelsIsTheRtsSmoother) {
  for (const std::size_t modes : {1U, 3U}) {
    is_the_rts_smoother<Interacting, Random>(modes);
    is_the_rts_smoother<Interacting, Fuzzy>(modes);
    is_the_rts_smoother<SecondOrder, Random>(modes);
    is_the_rts_smoother<SecondOrder, Fuzzy>(modes);
  }
}

template <class Order, Uncertainty Kind>
void smooths_each_model_alone() {
  const Variable<Kind> motion{"motion", 2};
  support::Filter<Order, Kind> filter{VectorBank{calm(), turning()}, identity(motion),
                                      std::vector<State>{starts()[0], starts()[2]}};
  const auto scans = manoeuvring_target(60);
  const auto smoothed = smooth(filter, flown(filter, scans));
  const std::vector expected{smoothed_alone(calm(), starts()[0], scans), smoothed_alone(turning(), starts()[2], scans)};
  for (std::size_t k = 0; k < smoothed.size(); ++k)
    for (std::size_t j = 0; j < 2; ++j) {
      ASSERT_PRED_FORMAT3(near_matrix, smoothed[k].estimates[j].mean, expected[j][k].mean, 1e-9);
      ASSERT_PRED_FORMAT3(near_matrix, smoothed[k].estimates[j].covariance, expected[j][k].covariance, 1e-9);
      ASSERT_PRED_FORMAT3(near, smoothed[k].belief.log(j), filter.belief().log(j), 1e-9);
    }
}

TEST(FixedIntervalSmoother, OfAStaticBankSmoothsEachModelAloneAndBelievesTheSameAllTheTime) {
  smooths_each_model_alone<Interacting, Random>();
  smooths_each_model_alone<Interacting, Fuzzy>();
  smooths_each_model_alone<SecondOrder, Random>();
  smooths_each_model_alone<SecondOrder, Fuzzy>();
}

template <class Order, Uncertainty Kind>
void ends_as_filtered_and_stays_normalized() {
  auto filter = vector_filter<Order, Kind>();
  const auto record = flown(filter, manoeuvring_target());
  const auto smoothed = smooth(filter, record);
  ASSERT_EQ(smoothed.size(), record.size());
  EXPECT_EQ(filter.estimate(smoothed.back()).mean, filter.estimate().mean);
  EXPECT_EQ(filter.estimate(smoothed.back()).covariance, filter.estimate().covariance);
  for (std::size_t j = 0; j < 3; ++j) EXPECT_EQ(smoothed.back().belief.log(j), filter.belief().log(j));
  for (const auto& state : smoothed) {
    double total = AlgebraOf<Kind>::zero();
    for (const double log : state.belief.logs()) total = AlgebraOf<Kind>::plus(total, std::exp(log));
    ASSERT_PRED_FORMAT3(near, total, 1.0, 1e-14);
    ASSERT_TRUE(detail::all_finite(filter.estimate(state)));
  }
}

TEST(FixedIntervalSmoother, EndsAsTheFilterAndStaysNormalized) {
  ends_as_filtered_and_stays_normalized<Interacting, Random>();
  ends_as_filtered_and_stays_normalized<Interacting, Fuzzy>();
  ends_as_filtered_and_stays_normalized<SecondOrder, Random>();
  ends_as_filtered_and_stays_normalized<SecondOrder, Fuzzy>();
}

TEST(FixedIntervalSmoother, SmoothsATupleAsItDoesAVector) {
  const auto scans = manoeuvring_target(110);
  const auto compare = [&](auto tuple, auto vector) {
    const auto of_tuple = smooth(tuple, flown(tuple, scans));
    const auto of_vector = smooth(vector, flown(vector, scans));
    for (std::size_t k = 0; k < of_tuple.size(); ++k) {
      ASSERT_PRED_FORMAT3(near_matrix, tuple.estimate(of_tuple[k]).mean, vector.estimate(of_vector[k]).mean, 1e-9);
      ASSERT_PRED_FORMAT3(near, of_tuple[k].belief.logs(), of_vector[k].belief.logs(), 1e-9);
    }
  };
  compare(tuple_filter<Interacting, Fuzzy>(), vector_filter<Interacting, Fuzzy>());
}

/// Models that forget their state, F = 0, so that measurements are of the mode alone: then the smoothed weights are
/// those of all paths through a mode at a time, by sum or maximum, and the smoothed states the filtered ones.
template <class Order, Uncertainty Kind>
void weighs_as_all_paths_through_a_mode() {
  using Forgetful = FixedStepMotion<1>;
  holds([] {
    constexpr std::size_t modes = 3, scans = 4;
    std::vector<Forgetful> models;
    std::vector<double> means, variances;
    std::vector<std::vector<double>> rows(modes);
    for (std::size_t j = 0; j < modes; ++j) {
      means.push_back(number_between(-3.0, 3.0));
      variances.push_back(number_between(0.5, 4.0));
      models.push_back(
          {"forgetful", {"x"}, 1.0, SquareMatrix<1>{0.0}, SquareMatrix<1>{variances[j]}, Vector<1>{means[j]}});
      for (std::size_t i = 0; i < modes; ++i) rows[j].push_back(i == j ? 1.0 : *rc::gen::element(0.0, 0.25, 0.5, 1.0));
      if constexpr (std::is_same_v<Kind, Random>) {
        const double sum = rows[j][0] + rows[j][1] + rows[j][2];
        for (double& value : rows[j]) value /= sum;
      }
    }
    typename Order::template Filter<std::vector<Forgetful>, Kind> filter{
        models, transition_by<Kind>(rows), std::vector<Gaussian<1>>(modes, {Vector<1>{1.0}, SquareMatrix<1>{2.0}})};
    const double R = 0.5;
    std::vector<double> z;
    std::vector record{filter.recorded(0.0)};
    for (std::size_t k = 0; k < scans; ++k) {
      z.push_back(number_between(-4.0, 4.0));
      const Gaussian<1> seen{Vector<1>{z[k]}, SquareMatrix<1>{R}};
      filter.step(1.0, seen, PositionSensor<1>{});
      record.push_back(filter.recorded(1.0, seen, PositionSensor<1>{}));
    }
    const auto smoothed = smooth(filter, record);

    std::vector<std::vector<double>> through(scans + 1, std::vector<double>(modes, 0.0));
    std::size_t paths = modes;
    for (std::size_t k = 0; k < scans; ++k) paths *= modes;
    for (std::size_t path = 0; path < paths; ++path) {  // its digits in base 3 are r_0 … r_k
      std::vector<std::size_t> modes_of;
      for (std::size_t rest = path, k = 0; k <= scans; ++k, rest /= modes) modes_of.push_back(rest % modes);
      double weight = 1.0;
      for (std::size_t k = 0; k < scans; ++k) {
        const std::size_t j = modes_of[k + 1];
        const double S = variances[j] + R;
        weight *= rows[modes_of[k]][j] * std::exp(-0.5 * (z[k] - means[j]) * (z[k] - means[j]) / S) / std::sqrt(S);
      }
      for (std::size_t k = 0; k <= scans; ++k) {
        double& sum = through[k][modes_of[k]];
        sum = std::is_same_v<Kind, Random> ? sum + weight : std::max(sum, weight);
      }
    }
    for (std::size_t k = 0; k <= scans; ++k) {
      double total = 0.0;
      for (const double weight : through[k])
        total = std::is_same_v<Kind, Random> ? total + weight : std::max(total, weight);
      for (std::size_t j = 0; j < modes; ++j) {
        require_near(smoothed[k].belief[j], through[k][j] / total, 1e-9);
        require_near_matrix(smoothed[k].estimates[j].mean, record[k].state.estimates[j].mean, 1e-9);
        require_near_matrix(smoothed[k].estimates[j].covariance, record[k].state.estimates[j].covariance, 1e-9);
      }
    }
  });
}

TEST(FixedIntervalSmoother, WithoutMemoryWeightsOfARandomModeAreForwardBackwardOverAllPaths) {
  weighs_as_all_paths_through_a_mode<Interacting, Random>();
  weighs_as_all_paths_through_a_mode<SecondOrder, Random>();
}
TEST(FixedIntervalSmoother, WithoutMemoryWeightsOfAFuzzyModeAreMaxMarginalsOverAllPaths) {
  weighs_as_all_paths_through_a_mode<Interacting, Fuzzy>();
  weighs_as_all_paths_through_a_mode<SecondOrder, Fuzzy>();
}

/// From one start for all models, one scan: here smoothing is exact, and must know what all pairs of modes know.
template <class Order, Uncertainty Kind>
void knows_what_all_pairs_know() {
  holds([] {
    constexpr std::size_t modes = 2;
    std::vector<FixedStepMotion<1>> models;
    std::vector<double> F, Q;
    const double x0 = 1.0, P0 = number_between(0.5, 4.0), R = 0.5, z = number_between(-5.0, 5.0);
    for (std::size_t j = 0; j < modes; ++j) {
      F.push_back(number_between(-1.5, 1.5));
      Q.push_back(number_between(0.1, 4.0));
      models.push_back({"any", {"x"}, 1.0, SquareMatrix<1>{F[j]}, SquareMatrix<1>{Q[j]}});
    }
    const auto transition = std::is_same_v<Kind, Random> ? transition_by<Kind>({{0.75, 0.25}, {0.125, 0.875}})
                                                         : transition_by<Kind>({{1.0, 0.25}, {0.125, 1.0}});
    typename Order::template Filter<std::vector<FixedStepMotion<1>>, Kind> filter{
        models, transition, std::vector<Gaussian<1>>(modes, {Vector<1>{x0}, SquareMatrix<1>{P0}})};
    std::vector record{filter.recorded(0.0)};
    const Gaussian<1> seen{Vector<1>{z}, SquareMatrix<1>{R}};
    filter.step(1.0, seen, PositionSensor<1>{});
    record.push_back(filter.recorded(1.0, seen, PositionSensor<1>{}));
    const auto smoothed = smooth(filter, record)[0];

    std::vector<double> belief(modes, 0.0), mean(modes, 0.0), square(modes, 0.0);
    double total = 0.0;
    for (std::size_t i = 0; i < modes; ++i) {
      for (std::size_t j = 0; j < modes; ++j) {  // the start meets the measurement through F of j
        const double S = F[j] * P0 * F[j] + Q[j] + R, W = P0 * F[j] / S, nu = z - F[j] * x0;
        const double weight = transition(i, j) * std::exp(-0.5 * nu * nu / S) / std::sqrt(S);
        const double x = x0 + W * nu, P = P0 - W * S * W;
        if constexpr (std::is_same_v<Kind, Random>) {
          belief[i] += weight;
          mean[i] += weight * x;
          square[i] += weight * (P + x * x);
        } else if (weight > belief[i]) {
          belief[i] = weight;
          mean[i] = weight * x;
          square[i] = weight * (P + x * x);
        }
      }
      mean[i] /= belief[i];
      square[i] /= belief[i];
      total = std::is_same_v<Kind, Random> ? total + belief[i] : std::max(total, belief[i]);
    }
    for (std::size_t i = 0; i < modes; ++i) {
      require_near(smoothed.belief[i], belief[i] / total, 1e-9);
      require_near(smoothed.estimates[i].mean(0), mean[i], 1e-9);
      require_near(smoothed.estimates[i].covariance(0, 0), square[i] - mean[i] * mean[i], 1e-9);
    }
  });
}

TEST(FixedIntervalSmoother, KnowsWhatAllPairsOfModesKnowOfOneScan) {
  knows_what_all_pairs_know<Interacting, Random>();
  knows_what_all_pairs_know<Interacting, Fuzzy>();
  knows_what_all_pairs_know<SecondOrder, Random>();
  knows_what_all_pairs_know<SecondOrder, Fuzzy>();
}

TEST(FixedIntervalSmoother, AModeThatLeadsNowhereKeepsItsFilteredEstimate) {
  auto filter = vector_filter<Interacting, Fuzzy>();
  Filter<Interacting, Fuzzy> absorbed{filter.system().models(), transition_by<Fuzzy>({{1, 0, 0}, {1, 0, 0}, {1, 0, 0}}),
                                      starts()};
  const auto record = flown(absorbed, manoeuvring_target(20));
  const auto smoothed = smooth(absorbed, record);
  for (std::size_t k = 1; k < record.size(); ++k) {
    EXPECT_EQ(smoothed[k].belief.log(1), log_zero);
    EXPECT_EQ(smoothed[k].estimates[1].mean, record[k].state.estimates[1].mean);
  }
}

TEST(FixedIntervalSmoother, NamesTheModelWhoseEstimateLostDefiniteness) {
  auto filter = vector_filter<Interacting, Random>();
  auto record = flown(filter, manoeuvring_target(3));
  record[2].state.estimates[0].covariance *= -1.0;
  EXPECT_TRUE(throws<std::domain_error>([&] { smooth(filter, record); }, {"'dwna'", "not positive semi-definite"}));
}

}  // namespace
}  // namespace sigmax
