#include <algorithm>

#include <sigmax/hybrid/kinematic_step.hpp>

#include "kinematic/kernels.hpp"

namespace sigmax::detail::kinematic {
namespace {

const Kernels*& chosen() {
  static const Kernels* kernels = available().back();
  return kernels;
}

/// Whether F_s is made of shears and a scale, and the law in those terms.
bool written(const AxisLaw& from, int axes, Law& law) {
  const int order = from.order;
  if (order < 2 || order > max_order) return false;
  const auto F = [&](int a, int b) { return from.F[a + b * order]; };
  for (int a = 0; a + 1 < order; ++a)
    if (F(a, a) != 1.0) return false;
  law.shears = {};
  if (order == 2) law.shears[0] = F(0, 1);
  if (order == 3) {
    if (F(1, 2) == 0.0 && F(0, 2) != 0.0) return false;
    const double last = F(1, 2) == 0.0 ? 0.0 : F(0, 2) / F(1, 2);
    law.shears = {F(0, 1) - last, F(1, 2), last};
  }
  law.scale = F(order - 1, order - 1);
  for (int a = 0; a < order; ++a)
    for (int b = 0; b <= a; ++b) {
      const auto at = static_cast<std::size_t>(triangle(a) + b);
      law.squared[at] = F(b, a) * F(b, a);
      law.Q[at] = from.Q[a + b * order];
    }
  std::copy_n(from.input, order * axes, law.u.begin());
  return true;
}

Track track_of(const Estimates& estimates, const double* weights, std::size_t most_likely) {
  Track track;
  for (std::size_t j = 0; j < estimates.size(); ++j) {
    const ConstView estimate = estimates.view(j);
    track.mean[j] = estimate.mean;
    track.covariance[j] = estimate.covariance;
  }
  track.weight = weights;
  track.most_likely = most_likely;
  return track;
}

}  // namespace

std::span<const Kernels* const> available() {
  static const Kernels* const all[]{&baseline(),
#ifdef SIGMAX_X86_KERNELS
                                    &avx2(), &avx512()
#endif
  };
#ifdef SIGMAX_X86_KERNELS
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return {all, 1};
  if (!__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512vl") || !__builtin_cpu_supports("avx512dq"))
    return {all, 2};
#endif
  return all;
}

void choose(const Kernels& kernels) { chosen() = &kernels; }

std::size_t lane_bytes() { return chosen()->lane_bytes; }

template <ScalableUncertainty Kind>
Shortcut::Shortcut(const std::vector<AnyModel>& models, const Interaction<Kind>& interaction)
    : selects_(SelectiveAlgebra<AlgebraOf<Kind>>) {
  plan_.augmentation = interaction.augmentation;
  plan_.output_tie = interaction.output_tie;
  plan_.likelihood = interaction.likelihood;
  steps_ = interaction.mixed_start == MixedStart::of_each_mode;
  if constexpr (SelectiveAlgebra<AlgebraOf<Kind>>) {
    plan_.mixing_tie = interaction.collapse.mixing_tie;
    plan_.mixed_covariance = interaction.collapse.mixed_covariance;
    steps_ = steps_ && plan_.mixed_covariance != MixedCovariance::released;
  } else {
    steps_ = steps_ && interaction.collapse.mixing_weights == MixingWeights::correct;
  }
  outputs_ = models.size() <= static_cast<std::size_t>(max_modes) && plan_.augmentation != StateAugmentation::prior &&
             plan_.mixed_covariance != MixedCovariance::envelope;
  for (std::size_t j = 0; outputs_ && j < models.size(); ++j) {
    const ModelRef& ref = models[j].ref();
    AxisLaw law;
    Law unused;
    outputs_ = ref.table->law != nullptr;
    if (!outputs_) break;
    ref.table->law(ref.motion, 1.0, law);
    if (j == 0) plan_.axes = ref.table->axes;
    plan_.order[j] = law.order;
    outputs_ = ref.table->axes == plan_.axes && written(law, plan_.axes, unused);
  }
  plan_.modes = static_cast<int>(models.size());
  steps_ = steps_ && outputs_;
}

bool Shortcut::prepare(const std::vector<AxisLaw>& laws, double dt, const double* transition) {
  if (!steps_) return false;
  std::copy_n(transition, plan_.modes * plan_.modes, plan_.transition.begin());
  if (dt != dt_) {
    dt_ = dt;
    described_ = true;
    for (std::size_t j = 0; described_ && j < laws.size(); ++j) described_ = written(laws[j], plan_.axes, plan_.law[j]);
  }
  return described_;
}

bool Shortcut::step(const Estimates& now, const double* weights, std::size_t most_likely, const double* z,
                    const double* R, Told& told) const {
  const Track track = track_of(now, weights, most_likely);
  return chosen()->step[plan_.axes - 1][selects_](plan_, track, z, R, told);
}

unsigned Shortcut::step_block(double* block, const double* measurements) const {
  return chosen()->step_block[plan_.axes - 1][selects_](plan_, block, measurements);
}
unsigned Shortcut::step_block(float* block, const float* measurements) const {
  return chosen()->step_block_of_floats[plan_.axes - 1][selects_](plan_, block, measurements);
}

bool Shortcut::output(bool selects, const Estimates& estimates, const double* weights, std::size_t most_likely,
                      View result) const {
  if (!outputs_) return false;
  chosen()->output[plan_.axes - 1][selects](plan_, track_of(estimates, weights, most_likely), result.mean,
                                            result.covariance);
  return true;
}

template Shortcut::Shortcut(const std::vector<AnyModel>&, const Interaction<Random>&);
template Shortcut::Shortcut(const std::vector<AnyModel>&, const Interaction<Fuzzy>&);

}  // namespace sigmax::detail::kinematic
