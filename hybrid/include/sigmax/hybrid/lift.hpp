#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <sigmax/estimation/gaussian.hpp>

namespace sigmax {

/// What stands for a component that a model lacks when it is mixed into one that has it. Going down drops components.
enum class Lift {
  zero,               ///< value 0, variance 0
  borrowed_variance,  ///< value 0, the receiving model's variance, no cross terms (the authors' program)
  unbiased,           ///< value and covariance of the receiving model, uncorrelated with the rest (Yuan, Bar-Shalom,
                      ///< Willett 2012)
  prior               ///< value 0, the variance of EntryPrior, no cross terms: what a component can be that begins
};

/// What is thought of a component before anything was seen of it: its value is 0, give or take a standard deviation.
struct EntryPrior {
  /// The standard deviations that it may have, in its own unit: of accelerations m/s². A filter that keeps histories
  /// tries each of them; one that merges has their root mean square.
  std::vector<double> scales = {25.0};
  double vertical = 0.3;                       ///< so much of it along z: an aircraft turns harder than it climbs
  double turn_rate = std::numbers::pi / 60.0;  ///< that of a rate of turn, omega, in rad/s: 3°/s

  double variance(const std::string& component, double scale) const {
    const double sigma = component == "omega" ? turn_rate : component.back() == 'z' ? vertical * scale : scale;
    return sigma * sigma;
  }
  double root_mean_square() const {
    double sum = 0.0;
    for (const double scale : scales) sum += scale * scale;
    return std::sqrt(sum / static_cast<double>(scales.size()));
  }
};

/// Where each component of a receiving model stands in a source model, by name.
struct Correspondence {
  std::vector<Eigen::Index> in_source;  ///< for each component of the receiver; −1 if the source lacks it
  bool nested;                          ///< one model's components are the leading ones of the other's

  Correspondence(const std::vector<std::string>& receiver, const std::vector<std::string>& source) : nested(true) {
    for (std::size_t i = 0; i < receiver.size(); ++i) {
      const auto found = std::find(source.begin(), source.end(), receiver[i]);
      in_source.push_back(found == source.end() ? -1 : found - source.begin());
      nested = nested && in_source.back() == (i < source.size() ? static_cast<Eigen::Index>(i) : -1);
    }
  }
};

/// An estimate read in the components of another model: dropped, lifted, or as it is. A view: nothing is copied.
template <int N, int MaxN, int SourceN, int MaxSourceN>
class Lifted {
 public:
  using Receiver = Gaussian<N, MaxN>;
  using Source = Gaussian<SourceN, MaxSourceN>;

  Lifted(const Receiver& receiver, const Source& source, const Correspondence& map, Lift rule)
      : receiver_(receiver), source_(source), map_(map), rule_(rule) {}

  Vector<N, MaxN> mean() const {
    Vector<N, MaxN> mean(size());
    if (map_.nested) {
      mean.head(shared()) = source_.mean.head(shared());
      if (rule_ == Lift::unbiased)
        mean.tail(missing()) = receiver_.mean.tail(missing());
      else
        mean.tail(missing()).setZero();
    } else {
      for (Eigen::Index i = 0; i < size(); ++i)
        mean(i) = in_source(i) >= 0 ? source_.mean(in_source(i)) : rule_ == Lift::unbiased ? receiver_.mean(i) : 0.0;
    }
    return mean;
  }

  /// covariance += weight · the lifted covariance.
  void add_covariance(double weight, SquareMatrix<N, MaxN>& covariance) const {
    if (map_.nested) {
      const Eigen::Index both = shared();  // plain loops: Eigen's expressions of all these blocks are slow to compile
      for (Eigen::Index k = 0; k < both; ++k)
        for (Eigen::Index i = 0; i < both; ++i) covariance(i, k) += weight * source_.covariance(i, k);
      if (rule_ == Lift::zero) return;
      for (Eigen::Index k = both; k < size(); ++k)
        for (Eigen::Index i = both; i < size(); ++i)
          if (rule_ == Lift::unbiased || i == k) covariance(i, k) += weight * receiver_.covariance(i, k);
    } else {
      for (Eigen::Index i = 0; i < size(); ++i)
        for (Eigen::Index k = 0; k < size(); ++k) covariance(i, k) += weight * entry(i, k);
    }
  }

 private:
  static constexpr bool fixed = N != Eigen::Dynamic && SourceN != Eigen::Dynamic;
  static constexpr int fixed_shared = fixed ? std::min(N, SourceN) : Eigen::Dynamic;
  static constexpr int fixed_missing = fixed ? N - std::min(N, SourceN) : Eigen::Dynamic;

  Eigen::Index size() const { return receiver_.size(); }
  Eigen::Index in_source(Eigen::Index i) const { return map_.in_source[static_cast<std::size_t>(i)]; }
  auto shared() const { return extent<fixed_shared>(std::min(size(), source_.size())); }
  auto missing() const { return extent<fixed_missing>(size() - std::min(size(), source_.size())); }

  double entry(Eigen::Index i, Eigen::Index k) const {
    const Eigen::Index row = in_source(i);
    const Eigen::Index column = in_source(k);
    if (row >= 0 && column >= 0) return source_.covariance(row, column);
    if (row >= 0 || column >= 0 || rule_ == Lift::zero) return 0.0;
    return rule_ == Lift::unbiased || i == k ? receiver_.covariance(i, k) : 0.0;
  }

  const Receiver& receiver_;
  const Source& source_;
  const Correspondence& map_;
  Lift rule_;
};

}  // namespace sigmax
