#pragma once

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include <sigmax/estimation/view.hpp>

namespace sigmax {

/// One estimate of several, where it lies: Eigen's view of numbers that belong to another.
template <class Number>
struct EstimateAt {
  template <class Matrix>
  using Map = Eigen::Map<std::conditional_t<std::is_const_v<Number>, const Matrix, Matrix>>;

  Map<Eigen::VectorXd> mean;
  Map<Eigen::MatrixXd> covariance;

  template <class View>
  EstimateAt(const View& at) : mean(at.mean, at.n), covariance(at.covariance, at.n, at.n) {}

  Eigen::Index size() const { return mean.size(); }

  /// A copy. Throws std::invalid_argument unless its size is one of the type's.
  template <int N, int MaxN>
  operator Gaussian<N, MaxN>() const {
    if (size() > MaxN || (N != Eigen::Dynamic && size() != N))
      throw std::invalid_argument("an estimate has " + std::to_string(size()) + " components; expected " +
                                  std::to_string(MaxN));
    return {mean, covariance};
  }
};

/// The estimates of the models of a bank, one each, of their own sizes: numbers in one row.
///
///     filter.estimates()[0].mean(1);
///     const Gaussian<6> first = filter.estimates()[0];
class Estimates {
 public:
  Estimates() = default;
  template <int N, int MaxN>
  Estimates(const std::vector<Gaussian<N, MaxN>>& estimates) {
    for (const auto& each : estimates) add(each);
  }

  std::size_t size() const { return sizes_.size(); }

  EstimateAt<const double> operator[](std::size_t j) const { return view(j); }
  EstimateAt<double> operator[](std::size_t j) { return view(j); }

  /// One more, of n components, all zero.
  void add(int n) {
    sizes_.push_back(n);
    places_.push_back(numbers_.size());
    numbers_.resize(numbers_.size() + static_cast<std::size_t>(n) * static_cast<std::size_t>(n + 1));
  }
  template <int N, int MaxN>
  void add(const Gaussian<N, MaxN>& estimate) {
    add(static_cast<int>(estimate.mean.size()));
    (*this)[size() - 1].mean = estimate.mean;
    (*this)[size() - 1].covariance = estimate.covariance;
  }

  detail::ConstView view(std::size_t j) const { return {at(j), at(j) + sizes_[j], sizes_[j]}; }
  detail::View view(std::size_t j) { return {at(j), at(j) + sizes_[j], sizes_[j]}; }

 private:
  const double* at(std::size_t j) const { return numbers_.data() + places_[j]; }
  double* at(std::size_t j) { return numbers_.data() + places_[j]; }

  std::vector<int> sizes_;
  std::vector<std::size_t> places_;
  std::vector<double> numbers_;
};

namespace detail {

/// Of at most so many components, without memory of its own.
inline constexpr int small_size = 32;
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, small_size, small_size>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, small_size, 1>;

/// Copies an estimate to another place of its size.
inline void copy(ConstView from, View to) {
  std::copy_n(from.mean, from.n, to.mean);
  std::copy_n(from.covariance, from.n * from.n, to.covariance);
}

}  // namespace detail

}  // namespace sigmax
