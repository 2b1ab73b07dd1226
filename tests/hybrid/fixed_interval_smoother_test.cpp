#include "hybrid/flights.hpp"

namespace fixed_interval_smoother_test {

/// One model alone, filtered and smoothed.
std::vector<State> smoothed_alone(const MotionChoice& motion, const State& start, const std::vector<Scan>& scans) {
  AnyFilter filter = alone(motion, start);
  std::vector<FilteredStep<State>> record{{0.0, start}};
  for (const Scan& scan : scans) {
    filter.step(scan);
    record.push_back({scan.dt, filter.estimate});
  }
  return smooth(model_of(motion), record);
}

TEST(FixedIntervalSmoother, OfOneModelOrEqualModelsIsTheRtsSmoother) {
  const auto scans = manoeuvring_target(60);
  const auto expected = smoothed_alone(turning(), starts()[2], scans);
  for (const std::size_t modes : {1U, 3U})
    for_each(every_filter(), [&](const TargetChoice& choice) {
      const Rows rows(modes, std::vector<double>(modes, choice.fuzzy ? 1.0 : 1.0 / static_cast<double>(modes)));
      const TargetChoice equal = with(choice, std::vector(modes, turning()), rows);
      const Flight flight = flown(equal, starts(equal), rows_of(scans));
      ASSERT_EQ(flight.smoothed.size(), expected.size());
      for (std::size_t k = 0; k < expected.size(); ++k) {
        ASSERT_CLOSE(flight.smoothed[k].output.mean, expected[k].mean, 1e-9) << "scan " << k;
        ASSERT_CLOSE(flight.smoothed[k].output.covariance, expected[k].covariance, 1e-9);
      }
    });
}

TEST(FixedIntervalSmoother, EndsAsTheFilterAndStaysNormalized) {
  for_each(every_filter(), [](const TargetChoice& choice) {
    const Flight flight = flown(choice, starts(), rows_of(manoeuvring_target()));
    EXPECT_EQ(flight.smoothed.back().output.covariance, flight.filtered.back().output.covariance);
    EXPECT_EQ(flight.smoothed.back().logs, flight.filtered.back().logs);
    for (const Moment& moment : flight.smoothed) {
      double total = 0.0;
      for (const double log : moment.logs)
        total = choice.fuzzy ? std::max(total, std::exp(log)) : total + std::exp(log);
      ASSERT_CLOSE(total, 1.0, 1e-14);
      ASSERT_TRUE(moment.output.mean.allFinite() && moment.output.covariance.allFinite());
    }
  });
}

TYPED_SUITE(FixedIntervalSmootherOf, Random, Fuzzy);

/// From one start for all models, one scan: here smoothing is exact, and must know what all pairs of modes know.
TYPED_PROPERTY(FixedIntervalSmootherOf, KnowsWhatAllPairsOfModesKnowOfOneScan) {
  constexpr bool fuzzy = std::is_same_v<TypeParam, Fuzzy>;
  Models models;
  std::vector<double> F, Q;
  const double x0 = 1.0, P0 = number_between(0.5, 4.0), R = 0.5, z = number_between(-5.0, 5.0);
  for (std::size_t j = 0; j < 2; ++j) {
    F.push_back(number_between(-1.5, 1.5));
    Q.push_back(number_between(0.1, 4.0));
    models.push_back(FixedStepMotion<1>{"any", {"x"}, 1.0, SquareMatrix<1>{F[j]}, SquareMatrix<1>{Q[j]}});
  }
  const Variable<TypeParam> mode{"mode", 2};
  const Relation<TypeParam, TypeParam> transition{
      mode, mode, fuzzy ? Rows{{1.0, 0.25}, {0.125, 1.0}} : Rows{{0.75, 0.25}, {0.125, 0.875}}};
  const std::vector start(2, Gaussian<1>{Vector<1>{x0}, SquareMatrix<1>{P0}});

  std::vector<double> belief(2, 0.0), mean(2, 0.0), square(2, 0.0);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {  // the start meets the measurement through F of j
      const double S = F[j] * P0 * F[j] + Q[j] + R, W = P0 * F[j] / S, nu = z - F[j] * x0;
      const double weight = transition(i, j) * std::exp(-0.5 * nu * nu / S) / std::sqrt(S);
      const double x = x0 + W * nu, P = P0 - W * S * W;
      if (fuzzy && weight <= belief[i]) continue;
      const double kept = fuzzy ? 0.0 : 1.0;
      belief[i] = kept * belief[i] + weight;
      mean[i] = kept * mean[i] + weight * x;
      square[i] = kept * square[i] + weight * (P + x * x);
    }
    mean[i] /= belief[i];
    square[i] /= belief[i];
  }
  const double total = fuzzy ? std::max(belief[0], belief[1]) : belief[0] + belief[1];
  const auto check = [&](auto filter) {
    const Gaussian<Eigen::Dynamic, 3> seen{Vector<1>{z}, SquareMatrix<1>{R}};
    const Moment smoothed = flown(filter, {{1.0, seen}}, PositionSensor<1>{}).smoothed[0];
    for (std::size_t i = 0; i < 2; ++i) {
      require_near(std::exp(smoothed.logs[i]), belief[i] / total, 1e-9);
      require_near(smoothed.estimates[i].mean(0), mean[i], 1e-9);
      require_near(smoothed.estimates[i].covariance(0, 0), square[i] - mean[i] * mean[i], 1e-9);
    }
  };
  check(InteractingMultipleModel{models, transition, start});
  check(SecondOrderMultipleModel{models, transition, start});
}

TEST(FixedIntervalSmoother, AModeThatLeadsNowhereKeepsItsFilteredEstimate) {
  const TargetChoice choice = with(chosen(true), chosen(true).motions, {{1, 0, 0}, {1, 0, 0}, {1, 0, 0}});
  const Flight flight = flown(choice, starts(), rows_of(manoeuvring_target(20)));
  for (std::size_t k = 1; k < flight.smoothed.size(); ++k) {
    EXPECT_EQ(flight.smoothed[k].logs[1], log_zero);
    EXPECT_EQ(flight.smoothed[k].estimates[1].mean, flight.filtered[k].estimates[1].mean);
  }
}

TEST(FixedIntervalSmoother, NamesTheModelWhoseEstimateLostDefiniteness) {
  const TargetChoice choice = chosen(false);
  InteractingMultipleModel filter{models_of(choice), transition_of<Random>(choice), starts()};
  std::vector record{filter.recorded(0.0)};
  for (int k = 0; k < 3; ++k) {
    filter.step(0.2);
    record.push_back(filter.recorded(0.2));
  }
  record[2].state.estimates[0].covariance *= -1.0;
  EXPECT_REFUSED(std::domain_error, ("'dwna'", "not positive semi-definite"), smooth(filter, record));
  EXPECT_TRUE(smooth(filter, {}).empty());
}

}  // namespace fixed_interval_smoother_test
