#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Cholesky>

#include <sigmax/estimation/dense.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>
#include <sigmax/hybrid/motion_choice.hpp>

namespace sigmax::support {

/// What a soak saw; nothing is wrong if `failure` is empty.
struct SoakReport {
  std::uint64_t steps = 0;
  std::uint64_t missed = 0;
  std::uint64_t outliers = 0;
  std::uint64_t covariances = 0;  ///< checked
  double largest_variance = 0.0;
  std::string failure;
};

/// Whether a covariance is symmetric to the bit and, scaled to a unit diagonal, has no eigenvalue below −1e-9 of its
/// trace. It must be scaled since variances of 1e-9 and of 1e28 stand in one matrix, the one in (m/s²)², the other in
/// m². Below 1e-290, where numbers have fewer digits, a variance counts as 1e-290.
inline bool symmetric_and_semi_definite(const Eigen::Ref<const Eigen::MatrixXd>& P) {
  if (!P.allFinite() || !(P == P.transpose()) || !(P.diagonal().array() >= 0.0).all()) return false;
  const Eigen::VectorXd scale = P.diagonal().array().max(1e-290).rsqrt();
  Eigen::MatrixXd scaled = scale.asDiagonal() * P * scale.asDiagonal();
  scaled.diagonal().array() += 1e-9 * static_cast<double>(P.rows());
  return Eigen::LLT<Eigen::MatrixXd>(scaled).info() == Eigen::Success;
}

/// Random models, transitions, options, steps and measurements: all that a soak draws.
class SoakDraws {
 public:
  explicit SoakDraws(std::uint64_t seed) : generator_(seed) {}

  double uniform() { return std::uniform_real_distribution<double>{}(generator_); }
  double normal() { return normal_(generator_); }
  bool happens(double probability) { return uniform() < probability; }
  double log_uniform(double low, double high) { return low * std::pow(high / low, uniform()); }
  std::size_t below(std::size_t count) { return std::uniform_int_distribution<std::size_t>{0, count - 1}(generator_); }

  /// Motions along independent axes, half of them by discrete noise.
  MotionChoice motion() {
    MotionChoice motion;
    motion[MotionParameter::sigma_w] = log_uniform(1e-2, 1e2);
    if (happens(0.5)) {
      motion.name = happens(0.5) ? "dwna" : "dwpa";
      return motion;
    }
    motion[MotionParameter::tau] = 1.0 / log_uniform(1e-4, 10.0);
    motion.name = std::vector{"cwna", "cwpa", "ou_position", "ou_velocity", "singer"}[below(5)];
    return motion;
  }
  std::vector<AnyModel> models(int axes) {
    std::vector<AnyModel> models;
    for (std::size_t count = 2 + below(3); count > 0; --count) models.push_back(known_model(motion(), axes));
    return models;
  }

  /// Rows that sum to one, or whose maximum is one; a quarter of the moves is impossible.
  template <Uncertainty Kind>
  Relation<Kind, Kind> transition(std::size_t modes) {
    std::vector<std::vector<double>> rows(modes, std::vector<double>(modes));
    for (std::size_t i = 0; i < modes; ++i) {
      for (std::size_t j = 0; j < modes; ++j) rows[i][j] = happens(0.25) ? 0.0 : log_uniform(1e-6, 1.0);
      rows[i][i] = 1.0;
      double total = 0.0;
      for (const double weight : rows[i]) total = AlgebraOf<Kind>::plus(total, weight);
      for (double& weight : rows[i]) weight /= total;
    }
    const Variable<Kind> mode{"mode", modes};
    return {mode, mode, rows};
  }

  /// The released mixing, whose weights do not sum to one, is not drawn for a bank with a model that holds the target
  /// where it is not: it multiplies the disagreement at every step, in one target of thousands beyond all
  /// numbers.
  template <Uncertainty Kind>
  Interaction<Kind> interaction(bool holds_the_position) {
    Interaction<Kind> interaction;
    interaction.augmentation = static_cast<StateAugmentation>(below(3));
    interaction.output_tie = static_cast<Tie>(below(3));
    if constexpr (SelectiveAlgebra<AlgebraOf<Kind>>)
      interaction.collapse = {static_cast<MixedCovariance>(below(4)), static_cast<Tie>(below(3))};
    else
      interaction.collapse = {static_cast<MixingWeights>(below(holds_the_position ? 1 : 2))};
    return interaction;
  }

  /// A symmetric positive definite matrix whose standard deviations are `sigma` and up to ten times that.
  SquareMatrix<Eigen::Dynamic, 3> covariance(int axes, double sigma) {
    SquareMatrix<Eigen::Dynamic, 3> root = SquareMatrix<Eigen::Dynamic, 3>::Zero(axes, axes);
    for (int i = 0; i < axes; ++i) {
      for (int j = 0; j < i; ++j) root(i, j) = sigma * normal();
      root(i, i) = sigma * log_uniform(1.0, 10.0);
    }
    SquareMatrix<Eigen::Dynamic, 3> R = root * root.transpose();
    detail::mirror_lower(R.data(), axes);
    return R;
  }

 private:
  std::mt19937_64 generator_;
  std::normal_distribution<double> normal_;
};

template <Uncertainty Kind>
void soak_one_target(int axes, SoakDraws& draw, std::uint64_t steps, SoakReport& report) {
  const auto models = draw.models(axes);
  const double sigma = draw.log_uniform(0.1, 100.0);
  Estimates starts;
  bool holds_the_position = false;
  for (const AnyModel& model : models) {
    starts.add(static_cast<int>(model.size()));
    starts[starts.size() - 1].covariance.diagonal().setConstant(sigma * sigma);
    holds_the_position = holds_the_position || model.name() == "ou_position";
  }
  const auto transition = draw.transition<Kind>(models.size());
  InteractingMultipleModel<std::vector<AnyModel>, Kind> filter{models, transition, starts,
                                                               draw.interaction<Kind>(holds_the_position)};

  Vector<Eigen::Dynamic, 3> position = Vector<Eigen::Dynamic, 3>::Zero(axes), velocity(axes);
  for (double& each : velocity) each = 100.0 * draw.normal();
  const auto check = [&](const char* what, const auto& estimate) {
    ++report.covariances;
    report.largest_variance = std::max(report.largest_variance, estimate.covariance.diagonal().maxCoeff());
    if (!estimate.mean.allFinite()) report.failure = std::string(what) + " is not finite";
    if (!symmetric_and_semi_definite(estimate.covariance))
      report.failure = std::string("the covariance of ") + what + " is not symmetric and semi-definite";
  };
  for (std::uint64_t k = 0; k < steps && report.failure.empty(); ++k) {
    ++report.steps;
    const double dt = draw.log_uniform(1e-3, 3600.0);
    position += dt * velocity;
    if (draw.happens(0.2)) {
      ++report.missed;
      filter.step(dt);
    } else {
      const bool outlying = draw.happens(0.05);
      if (outlying) ++report.outliers;
      const double error = sigma * (outlying ? draw.log_uniform(10.0, 1e6) : 1.0);
      Gaussian<Eigen::Dynamic, 3> z{position, draw.covariance(axes, sigma)};
      for (double& each : z.mean) each += error * draw.normal();
      filter.step(dt, z);
      if (!std::isfinite(filter.nis())) report.failure = "the NIS is not finite";
    }
    for (std::size_t j = 0; j < filter.modes(); ++j) check("a model's estimate", filter.estimates()[j]);
    check("the output", filter.estimate());
    double total = AlgebraOf<Kind>::zero();
    for (std::size_t j = 0; j < filter.modes(); ++j) total = AlgebraOf<Kind>::plus(total, filter.belief()[j]);
    if (!(std::abs(total - 1.0) <= 1e-9)) report.failure = "the weights are not normalised";
  }
}

/// Runs filters over random targets, a thousand steps each of 1 ms to 1 h: 2 to 4 models of 1 to 3 axes with noise
/// of 0.01 to 100 in their units, a fifth of the measurements missed, a twentieth outlying by 10 to 10⁶ σ. The same
/// seed gives the same soak. Stops at the first failure.
template <Uncertainty Kind>
SoakReport soak(std::uint64_t steps, std::uint64_t seed) {
  constexpr std::uint64_t steps_of_a_target = 1000;
  SoakDraws draw(seed);
  SoakReport report;
  for (int target = 0; report.steps < steps && report.failure.empty(); ++target) {
    try {
      soak_one_target<Kind>(1 + target % 3, draw, std::min(steps_of_a_target, steps - report.steps), report);
    } catch (const std::exception& error) {
      report.failure = error.what();
    }
    if (!report.failure.empty())
      report.failure += " (seed " + std::to_string(seed) + ", step " + std::to_string(report.steps) + ")";
  }
  return report;
}

}  // namespace sigmax::support
