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

constexpr int max_size = 32;
constexpr int points = 128;

/// Points of n components that look like a standard normal variable, a column each: a lattice of irrational steps (the
/// powers of the root of x^{n+1} = x + 1), each point with its mirror image, straightened so that mean and covariance
/// are exact. Made once for each n.
const double* normal_points(int n) {
  static std::array<std::vector<double>, max_size + 1> all;
  static std::array<std::once_flag, max_size + 1> made;
  const auto at = static_cast<std::size_t>(n);
  std::call_once(made[at], [&] {
    double ratio = 2.0;
    for (int i = 0; i < 64; ++i) ratio = std::pow(1.0 + ratio, 1.0 / (n + 1));
    std::vector<double> lattice(static_cast<std::size_t>(n * points)), spread(static_cast<std::size_t>(n * n)),
        root(spread.size());
    for (int i = 0; i < n; ++i) {
      const double step = std::pow(ratio, -(i + 1));
      for (int k = 0; k < points / 2; ++k) {
        const double u = std::fmod(0.5 + (k + 1) * step, 1.0);
        const double x = std::copysign(std::sqrt(chi_square_quantile(std::abs(2.0 * u - 1.0), 1.0)), u - 0.5);
        lattice[static_cast<std::size_t>(i + k * n)] = x;
        lattice[static_cast<std::size_t>(i + (points / 2 + k) * n)] = -x;
      }
    }
    detail::multiply(lattice.data(), n, detail::transposed(lattice.data(), n), spread.data(), n, n, points, n);
    for (double& each : spread) each /= points;
    detail::cholesky_factor(spread.data(), n, root.data());
    for (int k = 0; k < points; ++k) detail::lower_solve(root.data(), n, lattice.data() + k * n);
    all[at] = std::move(lattice);
  });
  return all[at].data();
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
  if (count_ == parts_.size()) {
    Part& part = parts_.emplace_back();
    part.varies.reserve(max_size);
    for (auto* room : {&part.mean, &part.shift}) room->reserve(max_size);
    for (auto* room : {&part.root, &part.second}) room->reserve(max_size * max_size);
  }
  Part& part = parts_[count_];
  part.weight = weight;
  part.mean.assign(estimate.mean, estimate.mean + size_);
  part.varies.clear();
  for (int i = 0; i < size_; ++i)
    if (estimate.covariance[i + i * size_] != 0.0) part.varies.push_back(i);
  const auto n = static_cast<int>(part.varies.size());
  detail::Scratch<1024> varying(n * n);
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < n; ++i)
      varying[i + k * n] =
          estimate
              .covariance[part.varies[static_cast<std::size_t>(i)] + part.varies[static_cast<std::size_t>(k)] * size_];
  part.root.resize(static_cast<std::size_t>(n * n));
  if (!detail::cholesky_factor(varying, n, part.root.data()))
    throw std::domain_error(
        "a covariance in an envelope is certain of a combination of components that each have a variance (it is not "
        "positive definite); expected only single components to be certain");
  part.log_scale = std::log(weight);
  for (int i = 0; i < n; ++i) part.log_scale -= std::log(part.root[static_cast<std::size_t>(i + i * n)]);
  ++count_;
}

bool Envelope::Part::comparable(const Part& other) const {
  if (varies != other.varies) return false;
  auto free = varies.begin();
  for (std::size_t i = 0; i < mean.size(); ++i) {
    if (free != varies.end() && *free == static_cast<int>(i))
      ++free;
    else if (mean[i] != other.mean[i])
      return false;
  }
  return true;
}

/// How much of a part the envelope keeps, and the moments of what it keeps.
void Envelope::weigh(Part& part) {
  const auto n = static_cast<int>(part.varies.size());
  const double* const deviations = normal_points(n);
  detail::Scratch<1024> step(n * n), second(n * n);
  detail::Scratch<max_size> apart(n), whitened(n);
  log_densities_.clear();
  for (std::size_t l = 0; l < count_; ++l) {
    const Part& other = parts_[l];
    if (!part.comparable(other)) continue;
    // A point x = m_l + L_l ξ is L_m⁻¹(x − m_m) = step ξ + apart in the other's own deviations.
    std::copy(part.root.begin(), part.root.end(), step.data());
    for (int i = 0; i < n; ++i) {
      const auto at = static_cast<std::size_t>(part.varies[static_cast<std::size_t>(i)]);
      apart[i] = part.mean[at] - other.mean[at];
    }
    for (int k = 0; k < n; ++k) detail::lower_solve(other.root.data(), n, step + k * n);
    detail::lower_solve(other.root.data(), n, apart);
    for (int k = 0; k < points; ++k) {
      std::copy_n(apart.data(), n, whitened.data());
      detail::multiply(step, n, detail::columns_of(deviations + k * n, n), whitened, n, n, n, 1, detail::Into::plus);
      double squared = 0.0;
      for (int i = 0; i < n; ++i) squared += whitened[i] * whitened[i];
      log_densities_.push_back(other.log_scale - 0.5 * squared);
    }
  }
  double masses[points];
  part.mass = 0.0;
  for (std::size_t k = 0; k < points; ++k) {
    double greatest = -std::numeric_limits<double>::infinity(), sum = 0.0;
    for (std::size_t at = k; at < log_densities_.size(); at += points)
      greatest = std::max(greatest, log_densities_[at]);
    for (std::size_t at = k; at < log_densities_.size(); at += points) sum += std::exp(log_densities_[at] - greatest);
    masses[k] = part.weight / points / sum;
    part.mass += masses[k];
  }
  // E ξ and E ξξᵀ under these masses, in the components.
  std::fill_n(apart.data(), n, 0.0);
  std::fill_n(second.data(), n * n, 0.0);
  for (int k = 0; k < points; ++k)
    for (int i = 0; i < n; ++i) {
      const double scaled = masses[k] * deviations[i + k * n];
      apart[i] += scaled;
      for (int j = 0; j < n; ++j) second[j + i * n] += scaled * deviations[j + k * n];
    }
  const double* const root = part.root.data();
  part.shift.resize(static_cast<std::size_t>(n));
  part.second.resize(static_cast<std::size_t>(n * n));
  detail::multiply(root, n, detail::columns_of(apart, n), part.shift.data(), n, n, n, 1);
  detail::multiply(root, n, detail::columns_of(second, n), step, n, n, n, n);
  detail::multiply(step, n, detail::transposed(root, n), part.second.data(), n, n, n, n);
}

double Envelope::match(detail::View result) {
  if (count_ == 0) throw std::logic_error("an envelope without a part of positive weight");
  const int n = size_;
  double mass = 0.0, greatest = 0.0, total = 0.0;
  std::fill_n(result.mean, n, 0.0);
  std::fill_n(result.covariance, n * n, 0.0);
  for (std::size_t l = 0; l < count_; ++l) {
    Part& part = parts_[l];
    weigh(part);
    mass += part.mass;
    greatest = std::max(greatest, part.weight);
    total += part.weight;
    for (int i = 0; i < n; ++i) result.mean[i] += part.mass * part.mean[static_cast<std::size_t>(i)];
    for (std::size_t i = 0; i < part.varies.size(); ++i) result.mean[part.varies[i]] += part.shift[i];
  }
  for (int i = 0; i < n; ++i) result.mean[i] /= mass;
  double apart[max_size];
  for (std::size_t l = 0; l < count_; ++l) {
    const Part& part = parts_[l];
    for (int i = 0; i < n; ++i) apart[i] = part.mean[static_cast<std::size_t>(i)] - result.mean[i];
    for (int k = 0; k < n; ++k)
      for (int i = 0; i < n; ++i) result.covariance[i + k * n] += part.mass * apart[i] * apart[k];
    for (std::size_t k = 0; k < part.varies.size(); ++k) {
      const int column = part.varies[k];
      for (int i = 0; i < n; ++i) {
        result.covariance[i + column * n] += part.shift[k] * apart[i];
        result.covariance[column + i * n] += part.shift[k] * apart[i];
      }
      for (std::size_t i = 0; i < part.varies.size(); ++i)
        result.covariance[part.varies[i] + column * n] += part.second[i + k * part.varies.size()];
    }
  }
  for (int i = 0; i < n * n; ++i) result.covariance[i] /= mass;
  return std::clamp(mass, greatest, total);  // which sampling may miss by a little
}

}  // namespace sigmax
