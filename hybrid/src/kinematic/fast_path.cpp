#include <sigmax/hybrid/fast_path.hpp>

#include <algorithm>

#include "kinematic/kernels.hpp"

namespace sigmax::detail {
namespace kinematic {
namespace {

const Kernels*& chosen() {
  static const Kernels* kernels = available().back();
  return kernels;
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

}  // namespace kinematic

std::size_t lane_bytes() { return kinematic::chosen()->lane_bytes; }

template <ScalableUncertainty Kind>
FastPath<Kind>::FastPath(const std::vector<AnyModel>& models, const Interaction<Kind>& interaction) {
  constexpr bool selects = SelectiveAlgebra<AlgebraOf<Kind>>;
  plan_.augmentation = interaction.augmentation;
  plan_.output_tie = interaction.output_tie;
  plan_.likelihood = interaction.likelihood;
  bool fits = plan_.augmentation != StateAugmentation::prior;
  steps_ = interaction.mixed_start == MixedStart::of_each_mode;
  if constexpr (selects) {
    plan_.mixing_tie = interaction.collapse.mixing_tie;
    plan_.mixed_covariance = interaction.collapse.mixed_covariance;
    fits = fits && plan_.mixed_covariance != MixedCovariance::envelope;
    outputs_ = true;
    steps_ = steps_ && plan_.mixed_covariance != MixedCovariance::released;
  } else {
    outputs_ = interaction.collapse.output_spread == OutputSpread::included;
    steps_ = steps_ && interaction.collapse.mixing_weights == MixingWeights::correct;
  }
  plan_.modes = static_cast<int>(models.size());
  plan_.axes = models.size() <= plan_.order.size() ? models[0].ref().table->axes : 0;
  for (std::size_t j = 0; plan_.axes > 0 && j < models.size(); ++j) {
    const ModelRef& ref = models[j].ref();
    plan_.order[j] = ref.size() / plan_.axes;
    fits = fits && plan_.order[j] >= 2;
    if (!ref.table->law || ref.table->axes != plan_.axes) plan_.axes = 0;
  }
  fits = fits && plan_.axes > 0;
  steps_ = steps_ && fits;
  outputs_ = outputs_ && fits;
  if (!fits) return;
  functions_ = &kinematic::chosen()->by_axes[plan_.axes - 1].of[selects][plan_.modes == 2];
  blocks_.resize(2);
}

template <ScalableUncertainty Kind>
bool FastPath<Kind>::prepare(const std::vector<AxisLaw>& laws, const double* transition) {
  plan_.law = laws.data();
  plan_.transition = transition;
  return steps_;
}

template <ScalableUncertainty Kind>
void FastPath<Kind>::write(const State& state, Block& block) const {
  ConstView estimates[StepPlan::max_modes];
  for (std::size_t j = 0; j < state.estimates.size(); ++j) estimates[j] = state.estimates.view(j);
  double* const weights = functions_->write(plan_, estimates, block.numbers);
  for (std::size_t j = 0; j < state.belief.size(); ++j) weights[j] = kinematic::kept_weight(state.belief[j]);
}

template <ScalableUncertainty Kind>
bool FastPath<Kind>::step(const State& now, std::size_t version, const ConstView* z, State& next, Belief<Kind>& prior,
                          Estimates& predicted, std::vector<AnyInnovation>& innovations) {
  const bool second = blocks_[1].version == version;
  Block &from = blocks_[second], &to = blocks_[!second];
  if (from.version != version) write(now, from);
  from.version = version;
  to.version = 0;
  kinematic::Result result;
  for (std::size_t j = 0; j < innovations.size(); ++j) {
    result.estimate[j] = next.estimates.view(j);
    result.predicted[j] = predicted.view(j).mean;
    result.innovation[j] = {innovations[j].residual_numbers.data(), innovations[j].covariance_numbers.data()};
  }
  result.log_prior = prior.logs(ByLaw{}).data();
  result.log_posterior = next.belief.logs(ByLaw{}).data();
  if (!functions_->step(plan_, from.numbers, now.most_likely_mode, to.numbers, z, result)) return false;
  for (std::size_t j = 0; z && j < innovations.size(); ++j) {
    innovations[j].size = z->n;
    innovations[j].squared_distance = result.innovation[j].squared_distance;
    innovations[j].log_likelihood = result.innovation[j].log_likelihood;
  }
  next.most_likely_mode = result.most_likely;
  to.version = version + 1;
  return true;
}

template <ScalableUncertainty Kind>
unsigned FastPath<Kind>::step_block(double* block, const double* measurements) const {
  return functions_->step_block(plan_, block, measurements);
}
template <ScalableUncertainty Kind>
unsigned FastPath<Kind>::step_block(float* block, const float* measurements) const {
  return functions_->step_block_of_floats(plan_, block, measurements);
}

template <ScalableUncertainty Kind>
bool FastPath<Kind>::output(const State& state, std::size_t version, View result) const {
  if (!outputs_) return false;
  Block own;
  const Block* block = &own;
  for (const Block& kept : blocks_)
    if (version > 0 && kept.version == version) block = &kept;
  if (block == &own) write(state, own);
  functions_->output(plan_, block->numbers, state.most_likely_mode, result);
  return true;
}

template class FastPath<Random>;
template class FastPath<Fuzzy>;

}  // namespace sigmax::detail
