#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include <sigmax/hybrid/bank.hpp>
#include <sigmax/hybrid/interaction.hpp>
#include <sigmax/hybrid/kinematic_plan.hpp>

/// Which filters may take the short step of kinematic_plan.hpp, and when.
namespace sigmax::detail::kinematic {

/// The short step and output of a bank, where it has them: of up to four models along the same independent axes.
class Shortcut {
 public:
  template <ScalableUncertainty Kind>
  Shortcut(const std::vector<AnyModel>& models, const Interaction<Kind>& interaction);

  /// Whether the step may be short, with a measurement of the position along all axes or none; see `prepare`.
  bool takes(const SensorOfModels* sensor, int m) const {
    return steps_ && (!sensor || (sensor->tables[0]->leading && m == plan_.axes));
  }

  /// Makes ready for a step by these laws and this transition, in rows; false if it must be the general one.
  bool prepare(const std::vector<AxisLaw>& laws, double dt, const double* transition);

  /// One step with the measurement z and its R, or none; `weights` are of the modes. False if it must be the general
  /// one.
  bool step(const Estimates& now, const double* weights, std::size_t most_likely, const double* z, const double* R,
            Told& told) const;

  /// @{
  /// One step of a block of tracks, see Kernels.
  unsigned step_block(double* block, const double* measurements) const;
  unsigned step_block(float* block, const float* measurements) const;
  /// @}

  /// The output of a state by selection or by moment matching; false if it must be the general one.
  bool output(bool selects, const Estimates& estimates, const double* weights, std::size_t most_likely,
              View result) const;

  int axes() const { return plan_.axes; }

 private:
  Plan plan_;
  double dt_ = std::numeric_limits<double>::quiet_NaN();
  bool selects_ = false;
  bool steps_ = false;
  bool outputs_ = false;
  bool described_ = false;
};

/// How many bytes a vector of this processor has; a block has as many tracks as it has numbers.
std::size_t lane_bytes();

}  // namespace sigmax::detail::kinematic
