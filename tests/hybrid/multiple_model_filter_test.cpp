// What is asked of every multiple-model filter.

#include "hybrid/banks.hpp"
#include "hybrid/instruction_sets.hpp"

namespace multiple_model_filter_test {

/// H = [I 0] by another sensor than that of the position: such a step has no short form.
const LinearSensor<2, 2> both{SquareMatrix<2>::Identity()};

void equals_the_restatement(const TargetChoice& choice, std::size_t scans) {
  AnyFilter filter(choice), general = filter;
  auto expected = restated(choice, starts());
  for (const Scan& scan : manoeuvring_target(scans)) {
    filter.step(scan);
    scan.z ? general.step(scan.dt, *scan.z, both) : general.step(scan.dt);
    step(expected, scan);
    ASSERT_TRUE(agrees(filter, expected));
    ASSERT_TRUE(agrees(general, expected));
  }
}

TEST(MultipleModelFilter, EqualsItsRestatementByEveryRule) {
  for_each(every_rule(), [](const TargetChoice& choice) {
    equals_the_restatement(choice, choice.mixed_covariance == MixedCovariance::envelope ? 60 : 140);
  });
}

TEST(MultipleModelFilter, EqualsItsRestatementByEachInstructionSet) {
  under_each_instruction_set(
      [] { for_each(every_reading(), [](const TargetChoice& choice) { equals_the_restatement(choice, 40); }); });
}

/// One to four generated models with a generated transition, whose equal entries make ties, over a few scans.
PROPERTY(MultipleModelFilter, OfAnyModelsEqualsItsRestatement) {
  TargetChoice choice = *rc::gen::elementOf(every_rule());
  const auto modes = *rc::gen::inRange<std::size_t>(1, 5);
  std::vector<MotionChoice> motions;
  Rows rows(modes, std::vector<double>(modes));
  for (std::size_t i = 0; i < modes; ++i) {
    const double sigma_w = *rc::gen::element(0.5, 3.0);
    motions.push_back(*rc::gen::arbitrary<bool>() ? calm(sigma_w) : turning(sigma_w));
    for (double& value : rows[i]) value = *rc::gen::element(0.0, 0.25, 0.5, 1.0);
    rows[i][i] = 1.0;
    const double sum = choice.fuzzy ? 1.0 : std::accumulate(rows[i].begin(), rows[i].end(), 0.0);
    for (double& value : rows[i]) value /= sum;
  }
  choice = with(choice, motions, rows);
  auto start = starts(choice);
  for (State& each : start)
    each = {each.mean.array() + number_between(-20.0, 20.0), number_between(0.1, 9.0) * each.covariance};
  AnyFilter filter(choice, start);
  auto expected = restated(choice, start);
  for (const Scan& scan : manoeuvring_target(6)) {
    filter.step(scan);
    step(expected, scan);
    if (const auto result = agrees(filter, expected); !result) RC_FAIL(std::string(result.message()));
  }
}

/// Equal rows for so many modes.
Rows equal_rows(bool fuzzy, std::size_t modes) {
  return Rows(modes, std::vector<double>(modes, fuzzy ? 1.0 : 1.0 / static_cast<double>(modes)));
}

TEST(MultipleModelFilter, OfOneModelOrOfEqualModelsIsTheKalmanFilter) {
  auto choices = every_reading();
  for (const bool fuzzy : {false, true}) choices.push_back(chosen(fuzzy, Scheme::histories));
  for (const std::size_t modes : {1U, 3U})
    for_each(choices, [&](const TargetChoice& choice) {
      AnyFilter filter(with(choice, std::vector(modes, turning()), equal_rows(choice.fuzzy, modes)));
      AnyFilter expected = alone(turning(), starts()[2]);
      for (const Scan& scan : manoeuvring_target(40)) {
        filter.step(scan);
        expected.step(scan);
        ASSERT_CLOSE(filter.estimate, expected.estimate, 1e-9);
      }
    });
}

bool positive(const Eigen::MatrixXd& covariance) {
  const Eigen::VectorXd scale = covariance.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd correlation = scale.asDiagonal() * covariance * scale.asDiagonal();
  correlation.diagonal().array() += 1e-12;
  return covariance == covariance.transpose() && Eigen::LLT<Eigen::MatrixXd>(correlation).info() == Eigen::Success;
}

TEST(MultipleModelFilter, AtEveryStepIsNormalizedAndPositiveAndItsMostLikelyEstimateIsOneModels) {
  for_each(every_reading(), [](const TargetChoice& choice) {
    AnyFilter filter(choice);
    for (const Scan& scan : manoeuvring_target(110)) {
      filter.step(scan);
      const double greatest = *std::max_element(filter.logs.begin(), filter.logs.end());
      double sum = 0.0;
      for (const double log : filter.logs) sum += std::exp(log);
      ASSERT_CLOSE(choice.fuzzy ? std::exp(greatest) : sum, 1.0, choice.fuzzy ? 0.0 : 1e-14);
      ASSERT_EQ(filter.logs[filter.winner], greatest);

      for (std::size_t j = 0; j < 3; ++j) ASSERT_TRUE(positive(filter.estimates[j].covariance));
      ASSERT_TRUE(positive(filter.estimate.covariance));

      const auto winner = filter.estimates[filter.winner];
      const auto n = winner.size();
      ASSERT_EQ(filter.most_likely_estimate.mean.head(n), winner.mean);
      ASSERT_EQ(filter.most_likely_estimate.covariance.topLeftCorner(n, n), winner.covariance);
      if (choice.fuzzy) ASSERT_EQ(filter.estimate.covariance, filter.most_likely_estimate.covariance);
    }
  });
}

/// A measurement of a target at rest at the origin, that many standard deviations off.
Scan off(double deviations) {
  return {1.0, Gaussian<2>{Vector<2>::Constant(10.0 * deviations), 100.0 * SquareMatrix<2>::Identity()}};
}

TEST(MultipleModelFilter, SurvivesAnOutlierAMillionDeviationsAway) {
  for_each(every_filter(), [](const TargetChoice& choice) {
    if (choice.scheme == Scheme::histories) return;
    std::vector<State> zero = starts();
    for (State& each : zero) {
      each.mean.setZero();
      each.covariance = 100.0 * Eigen::MatrixXd::Identity(each.size(), each.size());
    }
    AnyFilter filter(choice, zero);
    std::mt19937_64 generator(3);
    std::normal_distribution<double> normal;
    for (int k = 0; k < 30; ++k) filter.step(off(normal(generator)));
    auto spared = filter;

    filter.step(off(1e6));
    for (const double log : filter.logs) ASSERT_TRUE(std::isfinite(log));
    // Of three models surprised beyond all measure, the one with the widest S is surprised least.
    const auto widest =
        std::max_element(filter.innovations.begin(), filter.innovations.end(),
                         [](const auto& a, const auto& b) { return a.covariance()(0, 0) < b.covariance()(0, 0); });
    EXPECT_EQ(filter.winner, static_cast<std::size_t>(widest - filter.innovations.begin()));
    EXPECT_TRUE(filter.estimate.mean.allFinite() && filter.estimate.covariance.allFinite());
    EXPECT_TRUE(std::isfinite(filter.nis));

    spared.step(1.0);
    std::size_t steps = 0;
    double distance = 1e300;
    while (distance > 3.0 && steps < 200) {  // until the position is within 3 σ of a filter's that was spared it
      const Scan scan = off(normal(generator));
      filter.step(scan);
      spared.step(scan);
      ++steps;
      distance =
          ((filter.estimate.mean - spared.estimate.mean).array() / spared.estimate.covariance.diagonal().array().sqrt())
              .head<2>()
              .abs()
              .maxCoeff();
    }
    EXPECT_LE(steps, 40U);
  });
}

TEST(MultipleModelFilter, LeavesAModeThatNothingReachesItsOwnStateWithTheWeightZero) {
  for_each(every_reading(), [](const TargetChoice& any) {
    if (any.imm_mixing == MixingWeights::released) return;  // its weights are then 0/0
    const TargetChoice choice = with(any, {calm(), turning()}, {{1.0, 0.0}, {1.0, 0.0}});
    AnyFilter filter(choice);
    auto expected = restated(choice, starts(choice));
    AnyFilter unreached = alone(turning(), starts()[2]);
    for (const Scan& scan : manoeuvring_target(40)) {
      filter.step(scan);
      step(expected, scan);
      unreached.step(scan);
      ASSERT_TRUE(agrees(filter, expected));
      ASSERT_EQ(filter.logs[0], 0.0);
      ASSERT_EQ(filter.logs[1], log_zero);
      ASSERT_CLOSE(filter.estimates[1], unreached.estimate, 1e-11);
    }
  });
}

/// Measures the position, so often.
struct Failing {
  static constexpr int seen_size = 2;
  static constexpr int measurement_size = 2;
  int* left;
  Vector<2> measure(const Vector<2>& x) const {
    if (--*left < 0) throw std::domain_error("the sensor failed");
    return x;
  }
  SquareMatrix<2> measurement_jacobian(const Vector<2>&) const { return SquareMatrix<2>::Identity(); }
};

TEST(MultipleModelFilter, SaysWhichStepFailedAndOfWhichModelAndIsThenUnchanged) {
  for_each(every_filter(), [](const TargetChoice& choice) {
    AnyFilter filter(choice);
    for (const Scan& scan : manoeuvring_target(4)) filter.step(scan);
    auto before = filter;
    const Gaussian<2> good = *manoeuvring_target(1)[0].z;
    const auto refuses = [&](double dt, const std::optional<Gaussian<2>>& z,
                             std::initializer_list<std::string_view> words) {
      EXPECT_TRUE(throws<std::invalid_argument>([&] { filter.step({dt, z}); }, words));
    };
    for (const double bad : {not_a_number, infinity, -infinity}) {
      refuses(0.2, Gaussian<2>{Vector<2>(0.0, bad), good.covariance}, {"step 5", "0.2", "measurement", "not finite"});
      refuses(0.2, Gaussian<2>{good.mean, bad * good.covariance}, {"step 5", "0.2", "covariance", "not finite"});
      refuses(bad, good, {"step 5", "finite"});
      refuses(bad, std::nullopt, {"step 5", "finite"});
    }
    refuses(-0.25, good, {"step 5", "-0.25", "not negative"});
    refuses(-0.25, std::nullopt, {"step 5", "-0.25", "not negative"});
    for (int calls = 0; calls < 3; ++calls) {
      int left = calls;
      EXPECT_REFUSED(std::domain_error, ("step 5", "0.25", "sensor failed"), filter.step(0.25, good, Failing{&left}));
    }
    const Gaussian<2> indefinite{good.mean, -1e6 * good.covariance};
    EXPECT_REFUSED(std::domain_error, ("step 5", "0.25", "model 'dw", "not positive"), filter.step({0.25, indefinite}));
    for (const Scan& scan : manoeuvring_target(4)) {  // and goes on as if nothing had been
      filter.step(scan);
      before.step(scan);
      EXPECT_PRED_FORMAT3(same_state, filter, before, 0.0);
    }
  });
}

TEST(MultipleModelFilter, ThatLostDefinitenessIsRefused) {
  AnyFilter filter(chosen(false));
  filter.do_with([](auto& one) {
    auto lost = one.state();
    for (std::size_t j = 0; j < lost.estimates.size(); ++j) lost.estimates[j].covariance *= -1.0;
    one.restore(lost);
  });
  EXPECT_REFUSED(std::domain_error, ("step 1", "model", "not positive"),
                 filter.step({0.0, manoeuvring_target(1)[0].z}));
}

TEST(MultipleModelFilter, AGateMakesAMissOfAMeasurementOutsideIt) {
  for_each(every_filter(), [](const TargetChoice& choice) {
    AnyFilter gated(choice);
    std::size_t taken = 0, missed = 0;
    for (const Scan& scan : manoeuvring_target()) {
      if (!scan.z) continue;
      auto taking = gated, missing = gated;
      taking.step(scan);
      missing.step(scan.dt);
      for (const double gate : {1.0, taking.gate_distance}) {
        auto same = gated;
        same.step(scan, Gate::squared_distance(gate));
        ASSERT_EQ(same.gate_distance, taking.gate_distance);
        ASSERT_EQ(same.log_score, taking.log_score) << "also where it is not taken";
        ASSERT_EQ(same.measured, taking.gate_distance <= gate);
        same.do_with([&](const auto& filter) { ASSERT_EQ(filter.nis(), taking.nis); });
        ASSERT_PRED_FORMAT3(same_state, same, same.measured ? taking : missing, 0.0);
        ++(same.measured ? taken : missed);
      }
      if (choice.scheme == Scheme::interacting)  // no mode is worse than its weight makes it
        for (std::size_t j = 0; j < 3; ++j)
          ASSERT_LE(taking.gate_distance, taking.innovations[j].squared_distance - 2.0 * missing.logs[j] + 1e-9);
      gated = taking;
    }
    EXPECT_GT(taken, 20U);
    EXPECT_GT(missed, 20U);
  });
}

TEST(MultipleModelFilter, GoesOnFromARestoredStateToTheBitAndStartsAgainAsIfNew) {
  for_each(every_filter(), [](const TargetChoice& choice) {
    AnyFilter filter(choice), other = filter;
    const AnyFilter fresh = filter;
    std::size_t k = 0;
    for (const Scan& scan : manoeuvring_target(60)) {
      filter.step(scan);
      if (++k == 30) {
        other.restore(filter);
        EXPECT_FALSE(other.measured);
      }
      if (k <= 30) continue;
      other.step(scan);
      ASSERT_PRED_FORMAT3(same_state, filter, other, 0.0);
      ASSERT_EQ(filter.estimate.covariance, other.estimate.covariance);
    }
    filter.restart(starts());
    EXPECT_FALSE(filter.measured);
    EXPECT_PRED_FORMAT3(same_state, filter, fresh, 0.0);
    filter.step(0.2);
    filter.restart(starts()[2]);  // each model its share
    EXPECT_PRED_FORMAT3(same_state, filter, AnyFilter(choice, starts()[2]), 0.0);
  });
}

TEST(MultipleModelFilter, RefusesAStateOrAStartThatDoesNotFitAndIsThenUnchanged) {
  AnyFilter filter(chosen(false));
  for (const Scan& scan : manoeuvring_target(5)) filter.step(scan);
  const auto before = filter;
  const auto all = starts();
  const auto refuses = [&](const auto& start, std::initializer_list<std::string_view> words) {
    EXPECT_TRUE(throws<std::invalid_argument>([&] { filter.restart(start); }, words));
    EXPECT_TRUE(throws<std::invalid_argument>([&] { AnyFilter(chosen(true), start); }, words));
  };
  refuses(std::vector{all[0]}, {"3 models", "1 starts"});
  refuses(std::vector{all[0], all[2], all[2]}, {"start of model 'dwna'", "6", "expected 4"});
  refuses(all[0], {"start has 4", "6"});
  auto bad = all;
  bad[1].covariance(2, 2) = not_a_number;
  refuses(bad, {"start of model 'dwna'", "not finite"});
  EXPECT_INVALID(("not finite"), bad[2].mean(3) = not_a_number; filter.restart(bad[2]));
  InteractingMultipleModel one{models_of(chosen(false)), transition_of<Random>(chosen(false)), all};
  auto misfit = one.state();
  misfit.estimates = std::vector{all[2], all[1], all[2]};
  EXPECT_INVALID(("model 'dwna'", "6", "expected 4"), one.restore(misfit));
  EXPECT_PRED_FORMAT3(same_state, filter, before, 0.0);
}

TEST(MultipleModelFilter, AFunctionOfTheStepGivesTheTransition) {
  for_each(every_filter(), [](const TargetChoice& choice) {
    TargetChoice timed = choice;
    timed.sojourn_s = {20.0, 5.0, 3.0};
    AnyFilter filter(timed);
    for (const Scan& scan : manoeuvring_target(60)) {
      TargetChoice of_step = choice;
      const auto write = [&](auto relation) {
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j) of_step.transition[i][j] = relation(i, j);
      };
      choice.fuzzy ? write(transition_of<Fuzzy>(timed).over(scan.dt))
                   : write(transition_of<Random>(timed).over(scan.dt));
      AnyFilter expected(of_step);
      expected.restore(filter);
      expected.step(scan);
      filter.step(scan);
      ASSERT_PRED_FORMAT3(same_state, filter, expected, 1e-12);
    }
  });
}

/// A turn of the axes, whose lengths it leaves, and a new origin.
TEST(MultipleModelFilter, InOtherCoordinatesIsTheFilterOfMeasurementsInThem) {
  const SquareMatrix<2> turned{{0.8, -0.6}, {0.6, 0.8}};
  const Vector<2> moved(5000.0, -3000.0);
  const auto told = [&](Scan scan) {
    if (scan.z) scan.z = Gaussian<2>{turned * scan.z->mean + moved, turned * scan.z->covariance * turned.transpose()};
    return scan;
  };
  const auto transformed = [&](State state) {  // by hand, the position and each derivative
    const auto n = state.size();
    SquareMatrix<Eigen::Dynamic, 6> A = SquareMatrix<Eigen::Dynamic, 6>::Zero(n, n);
    for (Eigen::Index d = 0; d < n; d += 2) A.block<2, 2>(d, d) = turned;
    state.mean = (A * state.mean).eval();
    state.mean.head<2>() += moved;
    state.covariance = (A * state.covariance * A.transpose()).eval();
    return state;
  };
  for_each(every_filter(), [&](const TargetChoice& any) {
    if (any.scheme == Scheme::histories) return;
    const TargetChoice choice = with(any, StateAugmentation::unbiased);  // borrowing variances alone knows of axes
    std::vector<State> start;
    for (const State& each : starts()) start.push_back(transformed(each));
    AnyFilter filter(choice), expected(choice, start);
    bool there = false;
    for (const Scan& scan : manoeuvring_target(120)) {
      if (scan.dt == 0.0 && !there) {
        filter.do_with([&](auto& one) { one.transform(turned, moved); });
        there = true;
      }
      filter.step(there ? told(scan) : scan);
      expected.step(told(scan));
      for (std::size_t j = 0; j < 3; ++j) {
        const State shown = filter.estimates[j], now = there ? shown : transformed(shown);
        ASSERT_CLOSE(now.mean, expected.estimates[j].mean, 1e-9);
        ASSERT_CLOSE(now.covariance, expected.estimates[j].covariance, 1e-7);
      }
      ASSERT_CLOSE(filter.logs, expected.logs, 1e-7);
    }
    EXPECT_TRUE(there);
  });
}

TEST(MultipleModelFilter, ThereIsNoNisWithoutAMeasurement) {
  with_every_filter([](auto& filter) {
    EXPECT_REFUSED(std::logic_error, ("without a measurement"), filter.nis());
    filter.step(0.2, *manoeuvring_target(1)[0].z, PositionSensor<2>{});
    EXPECT_CLOSE(filter.normalized_innovation().squaredNorm(), filter.nis(), 1e-12);
    filter.step(0.2);
    EXPECT_FALSE(filter.accepted());
    EXPECT_REFUSED(std::logic_error, ("without a measurement"), filter.normalized_innovation());
  });
}

}  // namespace multiple_model_filter_test
