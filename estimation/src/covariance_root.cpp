#include <sigmax/estimation/covariance_root.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace sigmax::detail {

int covariance_root(const double* P, int n, double* L) {
  const double negligible = 4.0 * n * std::numeric_limits<double>::epsilon();
  constexpr double accumulated = 1e-10;  // of earlier rounding, relative to the variance
  std::fill_n(L, n * n, 0.0);
  for (int k = 0; k < n; ++k) {
    const double variance = P[k + k * n];
    double pivot = variance;
    for (int j = 0; j < k; ++j) pivot -= L[k + j * n] * L[k + j * n];
    if (!(pivot >= -accumulated * variance && pivot < std::numeric_limits<double>::infinity())) return k + 1;
    const bool zero = pivot <= negligible * variance;
    if (!zero) L[k + k * n] = std::sqrt(pivot);
    for (int i = k + 1; i < n; ++i) {
      double entry = P[i + k * n];
      for (int j = 0; j < k; ++j) entry -= L[i + j * n] * L[k + j * n];
      if (!zero)
        L[i + k * n] = entry / L[k + k * n];
      else if (!(entry * entry <= accumulated * variance * P[i + i * n]))  // no covariance without variance
        return i + 1;
    }
  }
  return 0;
}

void solve_by_root(const double* L, int n, double* z) {
  for (int k = 0; k < n; ++k) {
    const double pivot = L[k + k * n];
    z[k] = pivot == 0.0 ? 0.0 : z[k] / pivot;
    for (int i = k + 1; i < n; ++i) z[i] -= L[i + k * n] * z[k];
  }
  for (int k = n; k-- > 0;) {
    for (int i = k + 1; i < n; ++i) z[k] -= L[i + k * n] * z[i];
    z[k] = L[k + k * n] == 0.0 ? 0.0 : z[k] / L[k + k * n];
  }
}

void refuse_covariance(std::string_view model, int component) {
  throw std::domain_error("the covariance of model '" + std::string(model) +
                          "' is not positive semi-definite, as its component " + std::to_string(component) + " shows");
}

}  // namespace sigmax::detail
