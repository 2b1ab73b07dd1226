#pragma once

#include <sigmax/estimation/gaussian.hpp>
#include <sigmax/estimation/refs.hpp>

namespace sigmax::detail {

template <int N, int MaxN>
ConstView view(const Gaussian<N, MaxN>& gaussian) {
  return {gaussian.mean.data(), gaussian.covariance.data(), static_cast<int>(gaussian.mean.size())};
}
template <int N, int MaxN>
View view(Gaussian<N, MaxN>& gaussian) {
  return {gaussian.mean.data(), gaussian.covariance.data(), static_cast<int>(gaussian.mean.size())};
}

/// A Gaussian of n components to be written, of a type that allows as many.
template <int N, int MaxN>
View sized_view(Gaussian<N, MaxN>& gaussian, Eigen::Index n) {
  gaussian.mean.resize(n);
  gaussian.covariance.resize(n, n);
  return view(gaussian);
}

}  // namespace sigmax::detail
