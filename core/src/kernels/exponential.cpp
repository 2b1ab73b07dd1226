// Sums of exponentials, compiled once for every instruction set.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/exponential.cpp"
#include "kernels/targets.hpp"
// The order of these matters.
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include <hwy/contrib/math/math-inl.h>

#include <cmath>
#include <cstddef>

#include "kernels/exponential.hpp"

HWY_BEFORE_NAMESPACE();
namespace sigmax::kernels::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

double sum(const double* logs, std::size_t size) {
  const hn::ScalableTag<double> all;
  const std::size_t lanes = hn::Lanes(all);
  const auto lowest = hn::Set(all, -1000.0);  // whose exponential is zero; Highway's is not defined for −∞
  auto a = hn::Zero(all), b = hn::Zero(all);
  std::size_t i = 0;
  for (; i + 2 * lanes <= size; i += 2 * lanes) {
    a = hn::Add(a, hn::Exp(all, hn::Max(hn::LoadU(all, logs + i), lowest)));
    b = hn::Add(b, hn::Exp(all, hn::Max(hn::LoadU(all, logs + i + lanes), lowest)));
  }
  double rest = 0.0;
  for (; i < size; ++i) rest += std::exp(logs[i]);
  return hn::GetLane(hn::SumOfLanes(all, hn::Add(a, b))) + rest;
}

}  // namespace
}  // namespace sigmax::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sigmax::kernels {
HWY_EXPORT(sum);
double tiled_sum_of_exponentials(const double* logs, std::size_t size) { return HWY_DYNAMIC_DISPATCH(sum)(logs, size); }
}  // namespace sigmax::kernels
#endif
