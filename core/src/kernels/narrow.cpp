#include <algorithm>
#include <array>
#include <cstddef>

#include <sigmax/core/kernels/tiled.hpp>

namespace sigmax::kernels {
namespace {

template <class A, std::size_t Columns>
void compose_columns(const DenseParts& parts) {
  double* out = parts.result;
  const double* weights = parts.right;
  for (std::size_t i = 0; i < parts.rows; ++i, weights += parts.inner, out += Columns) {
    std::array<double, Columns> sums{};
    const double* values = parts.left;
    for (std::size_t j = 0; j < parts.inner; ++j, values += Columns)
      for (std::size_t k = 0; k < Columns; ++k) sums[k] = A::plus(sums[k], A::times(weights[j], values[k]));
    std::copy(sums.begin(), sums.end(), out);
  }
}

template <class A>
void compose(const DenseParts& parts) {
  using Compose = void (*)(const DenseParts&);
  static constexpr Compose by_columns[narrow_columns + 1] = {
      [](const DenseParts&) {}, compose_columns<A, 1>, compose_columns<A, 2>,
      compose_columns<A, 3>,    compose_columns<A, 4>, compose_columns<A, 5>,
      compose_columns<A, 6>,    compose_columns<A, 7>, compose_columns<A, 8>};
  by_columns[parts.columns](parts);
}

}  // namespace

void compose_narrow(Sigma, const DenseParts& parts) { compose<Sigma>(parts); }
void compose_narrow(Max, const DenseParts& parts) { compose<Max>(parts); }
void compose_narrow(MaxMin, const DenseParts& parts) { compose<MaxMin>(parts); }

}  // namespace sigmax::kernels
