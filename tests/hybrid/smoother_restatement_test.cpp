// The smoother against its restatement: of flights, and at a hundred digits over gaps, missed runs, starts without
// variance and very fine measurements.

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "hybrid/flights.hpp"
#include "hybrid/named_sensor.hpp"
#include "support/history_restatement.hpp"

namespace smoother_restatement_test {

using HundredDigits = boost::multiprecision::cpp_bin_float_100;

/// Weights and estimates of all steps are those of the restatement, which takes what the filter recorded as exact;
/// means within so much of their deviations, covariances likewise.
template <class Real>
void is_restated(const Flight& flight, const TargetChoice& choice,
                 const std::vector<restatement::ModelOf<Real>>& models, double tolerance) {
  const auto options = restate(choice);
  const auto exact = restatement::smoothing::smoothed<Real>(
      models, {options.kind, options.augmentation, restate(choice.transition)}, flight.steps);
  std::size_t winner = flight.filtered.back().winner;
  for (std::size_t k = exact.size(); k-- > 0;) {
    SCOPED_TRACE("row " + std::to_string(k));
    const Moment& found = flight.smoothed[k];
    restatement::Vector logs;
    for (std::size_t j = 0; j < models.size(); ++j) {
      logs.push_back(static_cast<double>(exact[k].log_weights[j]));
      ASSERT_NEAR(std::exp(found.logs[j]), std::exp(logs[j]), 1e-8);
      const auto estimate = found.estimates[j];
      const auto variance = [&](std::size_t a, std::size_t b) {
        return static_cast<double>(exact[k].covariances[j](a, b));
      };
      for (std::size_t a = 0; a < models[j].components.size(); ++a) {
        const auto i = static_cast<Eigen::Index>(a);
        const Real error = estimate.mean(i) - exact[k].means[j](a, 0);
        ASSERT_LE(std::abs(static_cast<double>(error)), tolerance * std::sqrt(variance(a, a)) + 1e-12);
        for (std::size_t b = 0; b <= a; ++b)
          ASSERT_NEAR(estimate.covariance(i, static_cast<Eigen::Index>(b)), variance(a, b),
                      tolerance * std::sqrt(variance(a, a) * variance(b, b)) + 1e-24);
      }
    }
    if (k + 1 < exact.size()) winner = restatement::largest(logs, options.output_tie, winner);
    ASSERT_EQ(found.winner, winner);
  }
}

void smooths(const TargetChoice& choice, const std::vector<State>& start) {
  const Flight flight = flown(choice, start, rows_of(manoeuvring_target(110)));
  is_restated<long double>(flight, choice, restated_models<long double>(choice), 1e-8);
  std::set<std::size_t> winners;
  for (const Moment& moment : flight.smoothed) winners.insert(moment.winner);
  EXPECT_GT(winners.size(), 1U) << "one mode is the most likely all the time";
}

/// Turns of less noise than these are worse conditioned: of σ_w = 0.5 the log weights would differ by some 3e-9.
TEST(SmootherRestatement, OfFlights) {
  const auto from = starts();
  for_each(every_filter(), [&](const TargetChoice& choice) {
    if (choice.scheme == Scheme::histories) return;
    for (const StateAugmentation augmentation : augmentations) smooths(with(choice, augmentation), from);
    smooths(with(choice, {calm(0.5), calm(5.0), calm(40.0)}, choice.transition), {from[0], from[1], from[1]});
    smooths(with(choice, {turning(3.0), turning(8.0), turning(25.0)}, choice.transition), {from[2], from[2], from[2]});
    // Nothing comes to the first mode: it may be the start, and then has no weight.
    const double stay = choice.fuzzy ? 1.0 : 0.75;
    smooths(with(choice, choice.motions, {{0.0, stay, 0.25}, {0.0, stay, 0.25}, {0.0, 0.25, stay}}), from);
  });
}

/// Each model lacks a component of the other, and they are ordered differently.
TEST(SmootherRestatement, OfModelsThatAreNotNested) {
  using Fixed = FixedStepMotion<3>;
  const NamedSensor<2> sees_both{{"x", "y"}};
  const std::vector<Fixed> models{{"drifting",
                                   {"x", "y", "drift"},
                                   1.0,
                                   SquareMatrix<3>{{1, 0, 1}, {0.1, 0.9, 0.2}, {0, 0, 0.95}},
                                   SquareMatrix<3>{{0.5, 0.1, 0}, {0.1, 0.4, 0.1}, {0, 0.1, 0.2}}},
                                  {"swinging",
                                   {"swing", "y", "x"},
                                   1.0,
                                   SquareMatrix<3>{{0.9, 0, 0.1}, {0.8, 1, 0}, {-0.3, 0.1, 0.9}},
                                   SquareMatrix<3>{{0.6, 0, 0}, {0, 0.5, 0.2}, {0, 0.2, 0.7}}}};
  const Estimates start(
      std::vector{Gaussian<3>{Vector<3>{1, 2, 0.5}, SquareMatrix<3>{{4, 1, 0.5}, {1, 3, 1}, {0.5, 1, 2}}},
                  Gaussian<3>{Vector<3>{0, 1, 2}, SquareMatrix<3>{{1, 0.2, 0.1}, {0.2, 5, 1}, {0.1, 1, 4}}}});
  std::vector<restatement::ModelOf<long double>> restated;
  for (const Fixed& model : models)
    restated.push_back({model.components(),
                        [&](double dt) { return restatement::as<long double>(dense(model.transition(dt))); },
                        [&](double dt) { return restatement::as<long double>(dense(model.process_covariance(dt))); },
                        restated_matrix(sees_both.names, model.components())});
  std::mt19937_64 generator(5);
  std::normal_distribution<double> normal;
  std::vector<Row> rows;
  for (int k = 0; k < 100; ++k) {
    rows.push_back({1.0, std::nullopt});
    const Vector<2> z{8.0 * std::sin(0.1 * k) + normal(generator), 8.0 * std::sin(0.4 * k) + normal(generator)};
    if (k % 5 != 3) rows.back().z = Gaussian<Eigen::Dynamic, 3>{z, SquareMatrix<2>{{2.0, 0.5}, {0.5, 1.0}}};
  }
  for (const StateAugmentation augmentation : augmentations)
    for_each(every_filter(), [&](TargetChoice choice) {
      if (choice.scheme == Scheme::histories) return;
      const double stay = choice.fuzzy ? 1.0 : 0.75;
      choice = with(with(choice, augmentation), {calm(), calm()}, {{stay, 0.25}, {0.25, stay}});
      const Models any(models.begin(), models.end());
      const auto follow = [&](auto filter) {
        is_restated<long double>(flown(filter, rows, sees_both), choice, restated, 1e-8);
      };
      const auto both_orders = [&]<class Kind>(Kind) {
        if (choice.scheme == Scheme::second_order)
          follow(SecondOrderMultipleModel{any, transition_of<Kind>(choice), start, interaction_of<Kind>(choice)});
        else
          follow(InteractingMultipleModel{any, transition_of<Kind>(choice), start, interaction_of<Kind>(choice)});
      };
      choice.fuzzy ? both_orders(Fuzzy{}) : both_orders(Random{});
    });
}

/// Rows of a target at 100 m/s on a line.
class Rows1 {
 public:
  explicit Rows1(double sigma) : sigma_(sigma) {}

  Rows1& seen(double dt, std::size_t count = 1) {
    for (std::size_t k = 0; k < count; ++k) {
      time_ += dt;
      rows_.push_back({dt, Gaussian<Eigen::Dynamic, 3>{Vector<1>{100.0 * time_ + sigma_ * normal_(generator_)},
                                                       SquareMatrix<1>{sigma_ * sigma_}}});
    }
    return *this;
  }
  Rows1& missed(double dt, std::size_t count) {
    time_ += dt * static_cast<double>(count);
    rows_.insert(rows_.end(), count, {dt, std::nullopt});
    return *this;
  }
  operator const std::vector<Row>&() const { return rows_; }

 private:
  double sigma_;
  double time_ = 0.0;
  std::vector<Row> rows_;
  std::mt19937_64 generator_{1};
  std::normal_distribution<double> normal_;
};

const Gaussian<2> narrow{Vector<2>{0.0, 100.0}, SquareMatrix<2>{{100.0, 0.0}, {0.0, 100.0}}};
const Gaussian<3> wide{Vector<3>{0.0, 100.0, 0.0},
                       SquareMatrix<3>{{100.0, 0.0, 0.0}, {0.0, 100.0, 0.0}, {0.0, 0.0, 10.0}}};
Estimates both(const Gaussian<2>& first, const Gaussian<3>& second) {
  Estimates result;
  result.add(first);
  result.add(second);
  return result;
}

TargetChoice on_a_line(bool fuzzy, Scheme scheme = Scheme::interacting) {
  TargetChoice choice = with(chosen(fuzzy, scheme), {calm(3.0), turning(3.0)},
                             fuzzy ? Rows{{1.0, 0.5}, {0.5, 1.0}} : Rows{{0.95, 0.05}, {0.05, 0.95}});
  choice.axes = 1;
  return choice;
}

/// Of IMM, HIMM, GPB2 and Viterbi.
void all_are_exact(const std::vector<Row>& rows, const Estimates& start = both(narrow, wide), double tolerance = 1e-6) {
  for (const bool fuzzy : {false, true})
    for (const Scheme scheme : {Scheme::interacting, Scheme::second_order}) {
      const TargetChoice choice = on_a_line(fuzzy, scheme);
      SCOPED_TRACE(name_of(choice));
      is_restated(flown(choice, start, rows), choice, restated_models<HundredDigits>(choice), tolerance);
    }
}

TEST(SmoothingGaps, OfAnyLengthAreExact) {
  for (const double gap : {1.0, 1e3, 1e5}) all_are_exact(Rows1(10.0).seen(1.0, 10).seen(gap).seen(1.0, 9));
}

TEST(SmoothingGaps, BetweenBurstsHoursApartAreExact) {
  all_are_exact(Rows1(10.0).seen(7200.0).seen(1.0, 4).seen(7200.0).seen(1.0, 4).seen(7200.0).seen(1.0, 4));
}

TEST(SmoothingGaps, InEveryRowAreExact) { all_are_exact(Rows1(10.0).seen(36000.0, 8)); }

TEST(SmoothingGaps, OfMissedRowsAreExact) {
  all_are_exact(Rows1(10.0).seen(1.0, 5).missed(1.0, 60).seen(1.0, 5));
  TargetChoice viterbi = on_a_line(true, Scheme::second_order);
  viterbi.motions = {calm(0.5), calm(5.0)};
  is_restated(flown(viterbi, std::vector{narrow, narrow}, Rows1(10.0).seen(1.0, 5).missed(1.0, 300).seen(1.0, 5)),
              viterbi, restated_models<HundredDigits>(viterbi), 1e-6);
}

TEST(SmoothingGaps, AfterAStartWithoutVarianceAreExact) {
  Gaussian<3> exact = wide;
  exact.covariance.setZero();
  Gaussian<2> half = narrow;
  half.covariance(1, 1) = 0.0;
  all_are_exact(Rows1(10.0).seen(1.0, 4).seen(100.0).seen(1.0, 4), both(half, exact));
}

/// The position itself, a number of 1 km, has digits of 1e-13 m.
TEST(SmoothingGaps, OfMeasurementsToANanometreAreExactToTheDigitsOfAPosition) {
  all_are_exact(Rows1(1e-9).seen(1.0, 12), both(narrow, wide), 1e-3);
}

TEST(SmoothingGaps, OfOneModelAreThoseOfTheRtsSmoother) {
  TargetChoice choice = with(on_a_line(false), {turning(3.0)}, {{1.0}});
  const auto compare = [&](const std::vector<Row>& rows, double tolerance) {
    const Flight flight = flown(choice, std::vector{wide}, rows);
    std::vector<FilteredStep<State>> filtered;
    for (std::size_t k = 0; k < flight.filtered.size(); ++k)
      filtered.push_back({flight.steps[k].dt, flight.filtered[k].estimates[0]});
    const auto expected = smooth(model_of(turning(3.0), 1), filtered);
    for (std::size_t k = 0; k < expected.size(); ++k)
      for (Eigen::Index a = 0; a < 3; ++a)
        ASSERT_NEAR(flight.smoothed[k].estimates[0].mean(a), expected[k].mean(a),
                    tolerance * std::sqrt(expected[k].covariance(a, a)))
            << "row " << k;
  };
  compare(Rows1(10.0).seen(1.0, 20), 1e-10);
  compare(Rows1(10.0).seen(1.0, 10).seen(100.0).seen(1.0, 9), 1e-6);
  compare(Rows1(10.0).seen(1.0, 10).missed(1.0, 10000).seen(1.0, 9), 1e-4);
}

/// The weights of an IMM are off at the last row by up to 0.06, before any smoothing; a gap must not add to that.
TEST(SmoothingGaps, LeaveTheWeightsNearThoseOfAllHistories) {
  const TargetChoice choice = on_a_line(false);
  for (const double gap : {1.0, 200.0, 1e3, 1e5}) {
    const std::vector<Row> rows = Rows1(10.0).seen(1.0, 6).seen(gap).seen(1.0, 5);
    const Flight flight = flown(choice, both(narrow, wide), rows);
    restatement::HistoryFilter all{restated_models(choice),
                                   restate(choice.transition),
                                   restate(both(narrow, wide)),
                                   {.kind = restatement::Kind::imm, .scales = {0.0}}};
    for (const Row& row : rows) all.step(row.dt, entries(row.z->mean), dense(row.z->covariance));
    for (std::size_t k = 0; k < flight.smoothed.size(); ++k)
      EXPECT_NEAR(std::exp(flight.smoothed[k].logs[1]), std::exp(all.log_weights(k)[1]), 0.06)
          << "gap of " << gap << " s, row " << k;
  }
}

/// A sensor may measure more quantities than a model has components: two of each alike are one of half the variance.
TEST(SmoothingGaps, OfMoreQuantitiesThanComponentsAreThoseOfTheirMeans) {
  const RandomVariable mode{"mode", 2};
  InteractingMultipleModel seen_twice{std::tuple{dwna<1>(0.5), dwna<1>(5.0)},
                                      Relation{mode, mode, {{0.9, 0.1}, {0.2, 0.8}}}, narrow};
  auto seen_once = seen_twice;
  const LinearSensor<4, 2> twice{RectangularMatrix<4, 2>{{1, 0}, {0, 1}, {1, 0}, {0, 1}}};
  const LinearSensor<2, 2> once{SquareMatrix<2>::Identity()};
  const SquareMatrix<4> R = Vector<4>{4.0, 2.0, 4.0, 2.0}.asDiagonal();
  const SquareMatrix<2> half = Vector<2>{2.0, 1.0}.asDiagonal();
  std::vector record_twice{seen_twice.recorded(0.0)}, record_once{seen_once.recorded(0.0)};
  for (int k = 0; k < 8; ++k) {
    const double x = k * k, v = 2.0 * k;
    const Gaussian<4> z{Vector<4>{x + 1.0, v - 0.5, x - 2.0, v + 1.5}, R};
    const Gaussian<2> mean{Vector<2>{x - 0.5, v + 0.5}, half};
    seen_twice.step(1.0, z, twice);
    record_twice.push_back(seen_twice.recorded(1.0, z, twice));
    seen_once.step(1.0, mean, once);
    record_once.push_back(seen_once.recorded(1.0, mean, once));
  }
  const auto found = smooth(seen_twice, record_twice), expected = smooth(seen_once, record_once);
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_NEAR(found[k].belief[0], expected[k].belief[0], 1e-12) << "row " << k;
    EXPECT_CLOSE(seen_twice.estimate(found[k]), seen_once.estimate(expected[k]), 1e-10);
  }
}

}  // namespace smoother_restatement_test
