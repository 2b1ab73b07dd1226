#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numbers>
#include <stdexcept>
#include <string>

#include <Eigen/Cholesky>
#include <boost/math/special_functions/erf.hpp>

#include <sigmax/hybrid/envelope.hpp>

namespace sigmax {

/// Points of n components that look like a standard normal variable: a lattice of irrational steps (the powers of the
/// root of x^{n+1} = x + 1), each point with its mirror image, straightened so that mean and covariance are exact. Made
/// once for each n.
const Envelope::AtPoints& Envelope::normal_points(Eigen::Index n) {
  static std::array<AtPoints, max_size + 1> all;
  static std::array<std::once_flag, max_size + 1> made;
  const auto at = static_cast<std::size_t>(n);
  std::call_once(made[at], [&] {
    double ratio = 2.0;
    for (int i = 0; i < 64; ++i) ratio = std::pow(1.0 + ratio, 1.0 / static_cast<double>(n + 1));
    AtPoints lattice(n, points);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double step = std::pow(ratio, -static_cast<double>(i + 1));
      for (Eigen::Index k = 0; k < points / 2; ++k) {
        const double u = std::fmod(0.5 + static_cast<double>(k + 1) * step, 1.0);
        lattice(i, k) = std::numbers::sqrt2 * boost::math::erf_inv(2.0 * u - 1.0);
        lattice(i, points / 2 + k) = -lattice(i, k);
      }
    }
    const Square spread = lattice * lattice.transpose() / static_cast<double>(points);
    all[at] = Eigen::LLT<Square>(spread).matrixL().solve(lattice);
  });
  return all[at];
}

Envelope& Envelope::of_this_thread() {
  thread_local Envelope envelope;
  return envelope;
}

void Envelope::clear(Eigen::Index n) {
  if (n < 1 || n > max_size)
    throw std::invalid_argument("an envelope of " + std::to_string(n) + " components; expected 1 to " +
                                std::to_string(max_size));
  size_ = n;
  count_ = 0;
}

void Envelope::add(double weight, const Eigen::Ref<const Eigen::VectorXd>& mean,
                   const Eigen::Ref<const Eigen::MatrixXd>& covariance) {
  if (!(weight > 0.0)) return;
  if (count_ == parts_.size()) parts_.emplace_back().varies.reserve(max_size);
  Part& part = parts_[count_];
  part.weight = weight;
  part.mean = mean;
  part.varies.clear();
  for (Eigen::Index i = 0; i < size_; ++i)
    if (covariance(i, i) != 0.0) part.varies.push_back(i);
  const auto n = static_cast<Eigen::Index>(part.varies.size());
  part.root.resize(n, n);
  for (Eigen::Index k = 0; k < n; ++k)
    for (Eigen::Index i = 0; i < n; ++i)
      part.root(i, k) =
          i < k ? 0.0 : covariance(part.varies[static_cast<std::size_t>(i)], part.varies[static_cast<std::size_t>(k)]);
  if (Eigen::LLT<Eigen::Ref<Square>>(part.root).info() != Eigen::Success)
    throw std::domain_error(
        "a covariance in an envelope is certain of a combination of components that each have a variance (it is not "
        "positive definite); expected only single components to be certain");
  part.log_scale = std::log(weight) - part.root.diagonal().array().log().sum();
  ++count_;
}

bool Envelope::Part::comparable(const Part& other) const {
  if (varies != other.varies) return false;
  auto free = varies.begin();
  for (Eigen::Index i = 0; i < mean.size(); ++i) {
    if (free != varies.end() && *free == i)
      ++free;
    else if (mean(i) != other.mean(i))
      return false;
  }
  return true;
}

/// How much of a part the envelope keeps, and the moments of what it keeps.
void Envelope::weigh(Part& part) {
  const auto n = static_cast<Eigen::Index>(part.varies.size());
  const AtPoints& deviations = normal_points(n);
  log_densities_.clear();
  for (const Part& other : *this) {
    if (!part.comparable(other)) continue;
    step_ = part.root;  // a point x = m_l + L_l ξ is L_m⁻¹(x − m_m) = step ξ + apart in the other's own deviations
    apart_.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::Index at = part.varies[static_cast<std::size_t>(i)];
      apart_(i) = part.mean(at) - other.mean(at);
    }
    other.root.triangularView<Eigen::Lower>().solveInPlace(step_);
    other.root.triangularView<Eigen::Lower>().solveInPlace(apart_);
    whitened_.noalias() = step_ * deviations;
    whitened_.colwise() += apart_;
    log_densities_.emplace_back(
        (other.log_scale - 0.5 * whitened_.colwise().squaredNorm().array()).matrix().transpose());
  }
  Vector<points> greatest = log_densities_.front(), sum = Vector<points>::Zero();
  for (const auto& one : log_densities_) greatest = greatest.cwiseMax(one);
  for (const auto& one : log_densities_) sum.array() += (one - greatest).array().exp();
  const Vector<points> masses = part.weight / points * sum.cwiseInverse();
  part.mass = masses.sum();
  apart_.noalias() = deviations * masses;
  part.shift.noalias() = part.root * apart_;
  whitened_ = deviations * masses.asDiagonal();
  step_.noalias() = whitened_ * deviations.transpose();
  part.second.noalias() = part.root * step_;
  step_.noalias() = part.second * part.root.transpose();
  part.second = step_;
}

double Envelope::match(Eigen::Ref<Eigen::VectorXd> mean, Eigen::Ref<Eigen::MatrixXd> covariance) {
  if (count_ == 0) throw std::logic_error("an envelope without a part of positive weight");
  double mass = 0.0, greatest = 0.0, total = 0.0;
  mean.setZero();
  for (std::size_t l = 0; l < count_; ++l) {
    Part& part = parts_[l];
    weigh(part);
    mass += part.mass;
    greatest = std::max(greatest, part.weight);
    total += part.weight;
    mean += part.mass * part.mean;
    for (std::size_t i = 0; i < part.varies.size(); ++i)
      mean(part.varies[i]) += part.shift(static_cast<Eigen::Index>(i));
  }
  mean /= mass;
  covariance.setZero();
  for (const Part& part : *this) {
    apart_ = part.mean - mean;
    covariance.noalias() += part.mass * apart_ * apart_.transpose();
    for (std::size_t k = 0; k < part.varies.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      covariance.col(part.varies[k]) += part.shift(column) * apart_;
      covariance.row(part.varies[k]) += part.shift(column) * apart_.transpose();
      for (std::size_t i = 0; i < part.varies.size(); ++i)
        covariance(part.varies[i], part.varies[k]) += part.second(static_cast<Eigen::Index>(i), column);
    }
  }
  covariance /= mass;
  return std::clamp(mass, greatest, total);  // which sampling may miss by a little
}

}  // namespace sigmax
