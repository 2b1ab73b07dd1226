#pragma once

#include <cstddef>
#include <vector>

#include <sigmax/hybrid/multiple_model_filter.hpp>
#include <sigmax/hybrid/step_plan.hpp>

namespace sigmax::detail {

namespace kinematic {
struct Functions;
}

/// The fast path of an InteractingFilter, if its bank has one: steps with measured positions, and outputs, of up to
/// four models that move along the same independent axes. It is compiled for each instruction set in
/// `hybrid/src/kinematic`, and keeps the state that it wrote last in an order of its own, beside the estimates that all
/// see.
template <ScalableUncertainty Kind>
class FastPath {
 public:
  using State = HybridEstimate<Kind>;

  FastPath(const std::vector<AnyModel>& models, const Interaction<Kind>& interaction);

  /// The axes along which all models move; 0 if there are none, or too many models.
  int axes() const { return plan_.axes; }

  /// Whether a step may be fast, with a measurement of the position along all axes or none.
  bool takes(const Seen* seen) const {
    return steps_ && (!seen || (seen->sensor.tables[0]->leading && seen->z.n == plan_.axes));
  }

  /// Makes ready for steps by these laws and this transition, in rows, which are to outlive them; false if steps must
  /// be the general ones.
  bool prepare(const std::vector<AxisLaw>& laws, const double* transition);

  /// One step, with the measurement z or none, from a state, which has a number. False if it must be the general one.
  bool step(const State& now, std::size_t version, const ConstView* z, State& next, Belief<Kind>& prior,
            Estimates& predicted, std::vector<AnyInnovation>& innovations);

  /// @{
  /// One step of a block of tracks, see Functions.
  unsigned step_block(double* block, const double* measurements) const;
  unsigned step_block(float* block, const float* measurements) const;
  /// @}

  /// The output of a state, with its number or 0; false if it must be the general one.
  bool output(const State& state, std::size_t version, View result) const;

 private:
  struct alignas(64) Block {
    double numbers[StepPlan::max_modes * 88 + 8];
    std::size_t version = 0;  ///< of the state that it holds
  };

  void write(const State& state, Block& block) const;

  StepPlan plan_;
  const kinematic::Functions* functions_ = nullptr;
  bool steps_ = false;
  bool outputs_ = false;
  std::vector<Block> blocks_;  ///< two, if there are fast steps
};

extern template class FastPath<Random>;
extern template class FastPath<Fuzzy>;

/// How many bytes a vector of this processor has; a block has as many tracks as it has numbers.
std::size_t lane_bytes();

}  // namespace sigmax::detail
