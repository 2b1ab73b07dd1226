// Smoothing over gaps, missed runs, starts without variance and very fine measurements: against the restatement at a
// hundred digits, and of one model against the smoother of Rauch, Tung and Striebel.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <sigmax/estimation/any_member.hpp>
#include <sigmax/estimation/any_motion.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/rts_smoother.hpp>
#include <sigmax/estimation/sensors.hpp>
#include <sigmax/hybrid/fixed_interval_smoother.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>
#include <sigmax/hybrid/second_order_multiple_model.hpp>

#include "support/matrices.hpp"
#include "support/smoother_restatement.hpp"

namespace sigmax {
namespace {

using Moves = AnyMotion<3, IndependentAxes<1, DiscreteWhiteNoise<2>>, IndependentAxes<1, DiscreteWhiteNoise<3>>>;
using Model = AnyMember<Moves>;
using Models = std::vector<Model>;
using Estimate = Gaussian<Eigen::Dynamic, 3>;
using Real = boost::multiprecision::cpp_bin_float_100;

struct Row {
  double dt;
  std::optional<double> z;
};

/// Rows of a target at 100 m/s.
class Rows {
 public:
  explicit Rows(double sigma) : sigma_(sigma) {}

  Rows& seen(double dt, std::size_t count = 1) {
    for (std::size_t k = 0; k < count; ++k) {
      time_ += dt;
      rows_.push_back({dt, 100.0 * time_ + sigma_ * normal_(generator_)});
    }
    return *this;
  }
  Rows& missed(double dt, std::size_t count) {
    time_ += dt * static_cast<double>(count);
    rows_.insert(rows_.end(), count, {dt, std::nullopt});
    return *this;
  }

  const std::vector<Row>& rows() const { return rows_; }
  double variance() const { return sigma_ * sigma_; }

 private:
  double sigma_;
  double time_ = 0.0;
  std::vector<Row> rows_;
  std::mt19937_64 generator_{1};
  std::normal_distribution<double> normal_;
};

template <class Filter>
auto flown(Filter& filter, const Rows& rows) {
  std::vector record{filter.recorded(0.0)};
  for (const auto& [dt, position] : rows.rows()) {
    if (position) {
      const Gaussian<1> z{Vector<1>{*position}, SquareMatrix<1>{rows.variance()}};
      filter.step(dt, z);
      record.push_back(filter.recorded(dt, z));
    } else {
      filter.step(dt);
      record.push_back(filter.recorded(dt));
    }
  }
  return record;
}

restatement::State restate(const Estimate& estimate) {
  return {support::entries(estimate.mean), support::dense(estimate.covariance)};
}

/// Weights and estimates of all steps are those of the restatement, which takes what the filter recorded as exact.
template <class Filter>
void smooths_as_restated(Filter filter, const Rows& rows, double tolerance) {
  const auto record = flown(filter, rows);
  const auto smoothed = smooth(filter, record);

  using Kind = typename std::decay_t<decltype(filter.belief())>::kind;
  constexpr bool fuzzy = std::is_same_v<Kind, Fuzzy>;
  std::vector<restatement::smoothing::Model<Real>> models;
  for (const Model& model : filter.system().models())
    model.motion().visit([&](const auto& motion) {
      models.push_back(restatement::smoothing::discrete_noise<Real>(1, static_cast<std::size_t>(motion.order),
                                                                    motion.law().sigma_w()));
    });
  restatement::Matrix transition(models.size(), models.size());
  for (std::size_t i = 0; i < models.size(); ++i)
    for (std::size_t j = 0; j < models.size(); ++j) transition(i, j) = filter.system().transition()(i, j);
  std::vector<restatement::smoothing::Step> steps;
  for (std::size_t k = 0; k < record.size(); ++k) {
    auto& step = steps.emplace_back(restatement::smoothing::Step{record[k].dt, {}, {}, std::nullopt});
    for (std::size_t j = 0; j < models.size(); ++j) {
      step.states.push_back(restate(record[k].state.estimates[j]));
      step.log_weights.push_back(record[k].state.belief.log(j));
    }
    if (k > 0 && rows.rows()[k - 1].z)
      step.seen = {{*rows.rows()[k - 1].z}, restatement::Matrix(1, 1, {rows.variance()})};
  }
  const auto exact =
      restatement::smoothing::smoothed<Real>(models,
                                             {fuzzy ? restatement::Kind::himm : restatement::Kind::imm,
                                              static_cast<restatement::Lift>(filter.interaction().lift), transition},
                                             steps);

  for (std::size_t k = 0; k < exact.size(); ++k)
    for (std::size_t j = 0; j < models.size(); ++j) {
      ASSERT_NEAR(smoothed[k].belief[j], std::exp(static_cast<double>(exact[k].log_weights[j])), 1e-8) << "row " << k;
      const auto& found = smoothed[k].estimates[j];
      for (Eigen::Index a = 0; a < found.size(); ++a) {
        const auto at = static_cast<std::size_t>(a);
        const Real error = found.mean(a) - exact[k].means[j](at, 0);
        const double variance = static_cast<double>(exact[k].covariances[j](at, at));
        ASSERT_LE(std::abs(static_cast<double>(error)), tolerance * std::sqrt(variance) + 1e-12) << "row " << k;
        ASSERT_NEAR(found.covariance(a, a), variance, tolerance * variance + 1e-24) << "row " << k;
      }
    }
}

/// IMM, HIMM, GPB2 and Viterbi.
void all_smooth_as_restated(const Models& motions, const std::vector<Estimate>& start, const Rows& rows,
                            double tolerance = 1e-6) {
  const RandomVariable random{"mode", motions.size()};
  const FuzzyVariable fuzzy{"mode", motions.size()};
  const Relation probable{random, random, {{0.95, 0.05}, {0.05, 0.95}}};
  const Relation possible{fuzzy, fuzzy, {{1.0, 0.5}, {0.5, 1.0}}};
  smooths_as_restated(InteractingMultipleModel{motions, probable, start}, rows, tolerance);
  smooths_as_restated(InteractingMultipleModel{motions, possible, start}, rows, tolerance);
  smooths_as_restated(SecondOrderMultipleModel{motions, probable, start}, rows, tolerance);
  smooths_as_restated(SecondOrderMultipleModel{motions, possible, start}, rows, tolerance);
}

const Models calm_and_turning{Extended<Moves>{dwna<1>(3.0)}, Extended<Moves>{dwpa<1>(3.0)}};
const Estimate narrow{Vector<2>{0.0, 100.0}, SquareMatrix<2>{{100.0, 0.0}, {0.0, 100.0}}};
const Estimate wide{Vector<3>{0.0, 100.0, 0.0},
                    SquareMatrix<3>{{100.0, 0.0, 0.0}, {0.0, 100.0, 0.0}, {0.0, 0.0, 10.0}}};

TEST(SmoothingGaps, OfAnyLengthAreExact) {
  for (const double gap : {1.0, 1e3, 1e5}) {
    SCOPED_TRACE(gap);
    all_smooth_as_restated(calm_and_turning, {narrow, wide}, Rows(10.0).seen(1.0, 10).seen(gap).seen(1.0, 9));
  }
}

TEST(SmoothingGaps, BetweenBurstsHoursApartAreExact) {
  Rows rows(10.0);
  for (int burst = 0; burst < 3; ++burst) rows.seen(7200.0).seen(1.0, 4);
  all_smooth_as_restated(calm_and_turning, {narrow, wide}, rows);
}

TEST(SmoothingGaps, InEveryRowAreExact) {
  all_smooth_as_restated(calm_and_turning, {narrow, wide}, Rows(10.0).seen(36000.0, 8));
}

TEST(SmoothingGaps, OfMissedRowsAreExact) {
  all_smooth_as_restated(calm_and_turning, {narrow, wide}, Rows(10.0).seen(1.0, 5).missed(1.0, 60).seen(1.0, 5));
  const Models calm_and_rough{Extended<Moves>{dwna<1>(0.5)}, Extended<Moves>{dwna<1>(5.0)}};
  const FuzzyVariable mode{"mode", 2};
  smooths_as_restated(SecondOrderMultipleModel{calm_and_rough, Relation{mode, mode, {{1.0, 0.5}, {0.5, 1.0}}},
                                               std::vector{narrow, narrow}},
                      Rows(10.0).seen(1.0, 5).missed(1.0, 300).seen(1.0, 5), 1e-6);
}

TEST(SmoothingGaps, AfterAStartWithoutVarianceAreExact) {
  Estimate exact = wide;
  exact.covariance.setZero();
  Estimate half = narrow;
  half.covariance(1, 1) = 0.0;
  all_smooth_as_restated(calm_and_turning, {half, exact}, Rows(10.0).seen(1.0, 4).seen(100.0).seen(1.0, 4));
}

/// The position itself, a number of 1 km, has digits of 1e-13 m.
TEST(SmoothingGaps, OfMeasurementsToANanometreAreExactToTheDigitsOfAPosition) {
  all_smooth_as_restated(calm_and_turning, {narrow, wide}, Rows(1e-9).seen(1.0, 12), 1e-3);
}

TEST(SmoothingGaps, OfOneModelAreThoseOfTheRtsSmoother) {
  const RandomVariable mode{"mode", 1};
  const auto compare = [&](const Rows& rows, double tolerance) {
    InteractingMultipleModel filter{Models{calm_and_turning[1]}, Relation{mode, mode, {{1.0}}}, std::vector{wide}};
    const auto record = flown(filter, rows);
    const auto smoothed = smooth(filter, record);
    std::vector<FilteredStep<Estimate>> filtered;
    for (const auto& step : record) filtered.push_back({step.dt, step.state.estimates[0]});
    const auto expected = smooth(calm_and_turning[1], filtered);
    for (std::size_t k = 0; k < expected.size(); ++k)
      for (Eigen::Index a = 0; a < 3; ++a)
        ASSERT_NEAR(smoothed[k].estimates[0].mean(a), expected[k].mean(a),
                    tolerance * std::sqrt(expected[k].covariance(a, a)))
            << "row " << k;
  };
  compare(Rows(10.0).seen(1.0, 20), 1e-10);
  compare(Rows(10.0).seen(1.0, 10).seen(100.0).seen(1.0, 9), 1e-6);
  compare(Rows(10.0).seen(1.0, 10).missed(1.0, 10000).seen(1.0, 9), 1e-4);
}

/// A sensor may measure more quantities than a model has components: two of each alike are one of half the variance.
TEST(SmoothingGaps, OfMoreQuantitiesThanComponentsAreThoseOfTheirMeans) {
  RectangularMatrix<4, 2> both_twice;
  both_twice << 1, 0, 0, 1, 1, 0, 0, 1;
  const LinearSensor<4, 2> twice{both_twice};
  const LinearSensor<2, 2> once{SquareMatrix<2>::Identity()};
  const SquareMatrix<4> R = Vector<4>{4.0, 2.0, 4.0, 2.0}.asDiagonal();
  const SquareMatrix<2> half = Vector<2>{2.0, 1.0}.asDiagonal();

  const RandomVariable mode{"mode", 2};
  const std::tuple models{dwna<1>(0.5), dwna<1>(5.0)};
  const Gaussian<2> start{Vector<2>::Zero(), SquareMatrix<2>{{100.0, 0.0}, {0.0, 100.0}}};
  InteractingMultipleModel seen_twice{models, Relation{mode, mode, {{0.9, 0.1}, {0.2, 0.8}}}, std::tuple{start, start}};
  auto seen_once = seen_twice;
  std::vector record_twice{seen_twice.recorded(0.0)};
  std::vector record_once{seen_once.recorded(0.0)};
  for (int k = 0; k < 8; ++k) {
    const double x = k * k;
    const double v = 2.0 * k;
    const Gaussian<4> z{Vector<4>{x + 1.0, v - 0.5, x - 2.0, v + 1.5}, R};
    const Gaussian<2> mean{Vector<2>{x - 0.5, v + 0.5}, half};
    seen_twice.step(1.0, z, twice);
    record_twice.push_back(seen_twice.recorded(1.0, z, twice));
    seen_once.step(1.0, mean, once);
    record_once.push_back(seen_once.recorded(1.0, mean, once));
  }
  const auto found = smooth(seen_twice, record_twice);
  const auto expected = smooth(seen_once, record_once);
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_NEAR(found[k].belief[0], expected[k].belief[0], 1e-12) << "row " << k;
    const auto one = seen_twice.estimate(found[k]);
    const auto other = seen_once.estimate(expected[k]);
    EXPECT_LT((one.mean - other.mean).norm(), 1e-10) << "row " << k;
    EXPECT_LT((one.covariance - other.covariance).norm(), 1e-10) << "row " << k;
  }
}

/// The weight of the second mode at every row by all 2^(n+1) histories of calm (0) and turning (1), each with a Kalman
/// filter of its own, written out for one axis: what an IMM and its smoother approximate.
class AllHistories {
 public:
  AllHistories(const Rows& rows, double stay) : rows_(rows), stay_(stay), turning_(rows.rows().size() + 1) {
    for (const int first : {0, 1})
      go_on(0, first, {0.0, 100.0, 0.0}, {100.0, 0.0, 0.0, 100.0, 0.0, first == 1 ? 10.0 : 0.0}, 0.5);
    for (double& weight : turning_) weight /= all_;
  }
  const std::vector<double>& weights() const { return turning_; }

 private:
  using Mean = std::array<double, 3>;
  using Covariance = std::array<double, 6>;  ///< xx, xv, xa, vv, va, aa

  void go_on(std::size_t k, int mode, const Mean& m, const Covariance& P, double weight) {
    path_.push_back(mode);
    if (k == rows_.rows().size()) {
      all_ += weight;
      for (std::size_t row = 0; row < path_.size(); ++row) turning_[row] += path_[row] * weight;
    } else {
      for (const int next : {0, 1}) step(k, mode, next, m, P, weight * (next == mode ? stay_ : 1.0 - stay_));
    }
    path_.pop_back();
  }

  void step(std::size_t k, int mode, int next, Mean m, Covariance P, double weight) {
    if (mode == 0 || next == 0) m[2] = P[2] = P[4] = P[5] = 0.0;
    const double T = rows_.rows()[k].dt;
    const double h = 0.5 * T * T;
    m = {m[0] + T * m[1] + h * m[2], m[1] + T * m[2], m[2]};
    const double xv =
        P[1] + T * P[3] + h * P[4];  // of the predicted position with the velocity and acceleration before
    const double xa = P[2] + T * P[4] + h * P[5];
    P = {P[0] + T * P[1] + h * P[2] + T * xv + h * xa, xv + T * xa,     xa,
         P[3] + 2.0 * T * P[4] + T * T * P[5],         P[4] + T * P[5], P[5]};
    const double g[] = {h, T, next == 1 ? 1.0 : 0.0};
    for (std::size_t a = 0, i = 0; a < 3; ++a)
      for (std::size_t b = a; b < 3; ++b, ++i) P[i] += 9.0 * g[a] * g[b];
    const double S = P[0] + rows_.variance();
    const double residual = *rows_.rows()[k].z - m[0];
    const double K[] = {P[0] / S, P[1] / S, P[2] / S};
    for (std::size_t a = 0, i = 0; a < 3; ++a) {
      m[a] += K[a] * residual;
      for (std::size_t b = a; b < 3; ++b, ++i) P[i] -= K[a] * K[b] * S;
    }
    go_on(k + 1, next, m, P, weight * std::exp(-0.5 * residual * residual / S) / std::sqrt(S));
  }

  Rows rows_;
  double stay_;
  double all_ = 0.0;
  std::vector<int> path_;
  std::vector<double> turning_;
};

/// The weights of an IMM are off at the last row by up to 0.06, before any smoothing; a gap must not add to that.
TEST(SmoothingGaps, LeaveTheWeightsNearThoseOfAllHistories) {
  const RandomVariable mode{"mode", 2};
  for (const double gap : {1.0, 200.0, 1e3, 1e5}) {
    const Rows rows = Rows(10.0).seen(1.0, 6).seen(gap).seen(1.0, 5);
    InteractingMultipleModel filter{calm_and_turning, Relation{mode, mode, {{0.95, 0.05}, {0.05, 0.95}}},
                                    std::vector{narrow, wide}};
    const auto record = flown(filter, rows);
    const auto smoothed = smooth(filter, record);
    const std::vector<double> exact = AllHistories(rows, 0.95).weights();
    for (std::size_t k = 0; k < exact.size(); ++k)
      EXPECT_NEAR(smoothed[k].belief[1], exact[k], 0.06) << "gap of " << gap << " s, row " << k;
  }
}

}  // namespace
}  // namespace sigmax
