#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include <sigmax/core/relation.hpp>
#include <sigmax/hybrid/bank.hpp>
#include <sigmax/hybrid/interaction.hpp>
#include <sigmax/hybrid/kinematic_plan.hpp>

/// Which filters may take the short step of kinematic_plan.hpp, and when.
namespace sigmax::detail::kinematic {

/// The short step and output of a bank, where it has them: of up to four models along the same independent axes.
class Shortcut {
 public:
  Shortcut(const std::vector<AnyModel>& models, const Interaction<Random>& interaction);
  Shortcut(const std::vector<AnyModel>& models, const Interaction<Fuzzy>& interaction);

  /// Whether the step may be short, with a measurement of the position along all axes or none; see `prepare`.
  bool takes(const SensorOfModels* sensor, int m) const {
    return steps_ && (!sensor || (sensor->tables[0]->leading && m == plan_.axes));
  }

  /// Makes ready for a step by these laws; false if it must be the general one.
  template <ScalableUncertainty Kind>
  bool prepare(const std::vector<AxisLaw>& laws, double dt, const Relation<Kind, Kind>& transition) {
    const Table* const table = std::get_if<Table>(&transition.rows());
    return steps_ && table && prepare(laws, dt, table->data());
  }

  /// One step with the measurement z and its R, or none; `weights` are of the modes. False if it must be the general
  /// one.
  bool step(const Estimates& now, const double* weights, std::size_t most_likely, const double* z, const double* R,
            Told& told) const;

  /// One step of a block of tracks; see the function of this name.
  template <class Number>
  unsigned step_block(Number* block, const Number* measurements) const {
    return kinematic::step_block(plan_, selects_, block, measurements);
  }

  /// The output of a state by selection or by moment matching; false if it must be the general one.
  bool output(const Selection& rule, const Estimates& estimates, const double* weights, std::size_t most_likely,
              View result) const;
  bool output(const MomentMatching& rule, const Estimates& estimates, const double* weights, std::size_t most_likely,
              View result) const;

  int axes() const { return plan_.axes; }
  /// Whether there is a short step at all.
  bool possible() const { return steps_; }

 private:
  void describe(const std::vector<AnyModel>& models);
  bool prepare(const std::vector<AxisLaw>& laws, double dt, const double* transition);

  Plan plan_;
  double dt_ = std::numeric_limits<double>::quiet_NaN();
  bool selects_ = false;
  bool steps_ = false;
  bool outputs_ = false;
  bool described_ = false;
};

}  // namespace sigmax::detail::kinematic
