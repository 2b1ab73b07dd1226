#include <sigmax/hybrid/envelope.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>

#include <sigmax/estimation/chi_square.hpp>
#include <sigmax/estimation/dense.hpp>

namespace sigmax {
namespace {

constexpr int points = 128;
using OfPoints = Eigen::Array<double, 1, points>;
using Points = Eigen::Matrix<double, Eigen::Dynamic, points, 0, Envelope::max_size, points>;

/// L⁻¹ of each column, in its place.
template <class Columns>
void solve_lower(const detail::SmallMatrix& L, Columns& columns) {
  for (auto column : columns.colwise()) detail::lower_solve(L.data(), static_cast<int>(L.rows()), column.data());
}

/// Points of n components that look like a standard normal variable, a column each: a lattice of irrational steps (the
/// powers of the root of x^{n+1} = x + 1), each point with its mirror image, straightened so that mean and covariance
/// are exact. Made once for each n.
Eigen::Map<const Points> normal_points(Eigen::Index n) {
  static std::array<Eigen::MatrixXd, Envelope::max_size + 1> all;
  static std::array<std::once_flag, Envelope::max_size + 1> made;
  const auto at = static_cast<std::size_t>(n);
  std::call_once(made[at], [&] {
    double ratio = 2.0;
    for (int i = 0; i < 64; ++i) ratio = std::pow(1.0 + ratio, 1.0 / static_cast<double>(n + 1));
    Eigen::MatrixXd lattice(n, points);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double step = std::pow(ratio, -static_cast<double>(i + 1));
      for (int k = 0; k < points / 2; ++k) {
        const double u = std::fmod(0.5 + (k + 1) * step, 1.0);
        const double x = std::copysign(std::sqrt(chi_square_quantile(std::abs(2.0 * u - 1.0), 1.0)), u - 0.5);
        lattice(i, k) = x;
        lattice(i, points / 2 + k) = -x;
      }
    }
    detail::SmallMatrix root(n, n), spread = lattice.lazyProduct(lattice.transpose()) / points;
    detail::cholesky_factor(spread.data(), static_cast<int>(n), root.data());
    solve_lower(root, lattice);
    all[at] = std::move(lattice);
  });
  return {all[at].data(), n, points};
}

}  // namespace

void Envelope::clear(int n) {
  if (n < 1 || n > max_size)
    throw std::invalid_argument("an envelope of " + std::to_string(n) + " components; expected 1 to " +
                                std::to_string(max_size));
  size_ = n;
  count_ = 0;
}

void Envelope::add(double weight, detail::ConstView estimate) {
  if (!(weight > 0.0)) return;
  if (count_ == parts_.size()) parts_.emplace_back();
  Part& part = parts_[count_];
  const Eigen::Map<const Square> covariance(estimate.covariance, size_, size_);
  part.weight = weight;
  part.mean = Eigen::Map<const Column>(estimate.mean, size_);
  part.varies.resize((covariance.diagonal().array() != 0.0).count());
  for (int i = 0, k = 0; i < size_; ++i)
    if (covariance(i, i) != 0.0) part.varies[k++] = i;
  const Square varying = covariance(part.varies, part.varies);
  part.root.resizeLike(varying);
  if (!detail::cholesky_factor(varying.data(), static_cast<int>(varying.rows()), part.root.data()))
    throw std::domain_error(
        "a covariance in an envelope is certain of a combination of components that each have a variance (it is not "
        "positive definite); expected only single components to be certain");
  part.log_scale = std::log(weight) - part.root.diagonal().array().log().sum();
  ++count_;
}

bool Envelope::Part::comparable(const Part& other) const {
  if (varies.size() != other.varies.size() || varies != other.varies) return false;
  Column apart = mean - other.mean;
  for (const int i : varies) apart[i] = 0.0;
  return (apart.array() == 0.0).all();
}

/// How much of a part the envelope keeps, and the moments of what it keeps.
void Envelope::weigh(Part& part) {
  const Eigen::Map<const Points> deviations = normal_points(part.root.rows());
  OfPoints greatest = OfPoints::Constant(-std::numeric_limits<double>::infinity()), sum = OfPoints::Zero();
  for (std::size_t l = 0; l < count_; ++l) {
    const Part& other = parts_[l];
    if (!part.comparable(other)) continue;
    // A point x = m_l + L_l ξ is L_m⁻¹(x − m_m) = step ξ + apart in the other's own deviations.
    Square step = part.root;
    Column apart = (part.mean - other.mean)(part.varies);
    solve_lower(other.root, step);
    solve_lower(other.root, apart);
    Points whitened = step.lazyProduct(deviations);
    whitened.colwise() += apart;
    const OfPoints log_density = other.log_scale - 0.5 * whitened.colwise().squaredNorm().array();
    const OfPoints before = greatest;
    greatest = greatest.max(log_density);
    sum = sum * (before - greatest).exp() + (log_density - greatest).exp();
  }
  const OfPoints masses = part.weight / points / sum;
  part.mass = masses.sum();
  // E ξ and E ξξᵀ under these masses, in the components.
  const Points weighted = deviations * masses.matrix().asDiagonal();
  const Square second = weighted.lazyProduct(deviations.transpose()), half = part.root.lazyProduct(second);
  part.shift = part.root.lazyProduct(Column(weighted.rowwise().sum()));
  part.second = half.lazyProduct(part.root.transpose());
}

double Envelope::match(detail::View result) {
  if (count_ == 0) throw std::logic_error("an envelope without a part of positive weight");
  Eigen::Map<Column> mean(result.mean, size_);
  Eigen::Map<Square> covariance(result.covariance, size_, size_);
  double mass = 0.0, greatest = 0.0, total = 0.0;
  mean.setZero();
  covariance.setZero();
  for (std::size_t l = 0; l < count_; ++l) {
    Part& part = parts_[l];
    weigh(part);
    mass += part.mass;
    greatest = std::max(greatest, part.weight);
    total += part.weight;
    mean += part.mass * part.mean;
    mean(part.varies) += part.shift;
  }
  mean /= mass;
  for (std::size_t l = 0; l < count_; ++l) {
    const Part& part = parts_[l];
    const Column apart = part.mean - mean;
    covariance += part.mass * apart.lazyProduct(apart.transpose());
    covariance(Eigen::all, part.varies) += apart.lazyProduct(part.shift.transpose());
    covariance(part.varies, Eigen::all) += part.shift.lazyProduct(apart.transpose());
    covariance(part.varies, part.varies) += part.second;
  }
  covariance /= mass;
  return std::clamp(mass, greatest, total);  // which sampling may miss by a little
}

}  // namespace sigmax
