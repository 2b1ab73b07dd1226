#pragma once

#include <vector>

#include <sigmax/estimation/any_member.hpp>
#include <sigmax/estimation/linearised.hpp>
#include <sigmax/hybrid/any_target.hpp>
#include <sigmax/hybrid/fixed_interval_smoother.hpp>

#include "known_motions.hpp"
#include "known_sensors.hpp"

/// The bank of known motions and the sensors that can see them. Its Kalman filter is compiled once for all schemes and
/// kinds of mode, in known_bank_*.cpp.
namespace sigmax {
namespace detail {

using KnownModel = AnyMember<AnyKnownMotion>;
using KnownBank = std::vector<KnownModel>;

/// Throws std::invalid_argument for a motion that is not known.
KnownBank known_bank(const TargetChoice& choice);

}  // namespace detail

extern template void predict(const detail::KnownModel&, const EstimateOf<detail::KnownModel>&, double,
                             EstimateOf<detail::KnownModel>&);
extern template LinearisedStepOf<detail::KnownModel> linearised_step(const detail::KnownModel&,
                                                                     const EstimateOf<detail::KnownModel>&, double);
extern template InnovationOf<detail::KnownSensor> update(const detail::KnownModel&,
                                                         const EstimateOf<detail::KnownModel>&,
                                                         const MeasurementOf<detail::KnownSensor>&,
                                                         const detail::KnownSensor&, EstimateOf<detail::KnownModel>&);

extern template LinearisedMeasurementOf<detail::KnownModel, detail::KnownSensor> linearised_measurement(
    const detail::KnownModel&, const EstimateOf<detail::KnownModel>&, const MeasurementOf<detail::KnownSensor>&,
    const detail::KnownSensor&);
extern template struct FutureEvidence<detail::KnownModel::max_state_size>;
extern template class EvidenceCollapse<detail::KnownModel::max_state_size>;
extern template class FixedIntervalSmoother<detail::KnownBank, Random>;
extern template class FixedIntervalSmoother<detail::KnownBank, Fuzzy>;

}  // namespace sigmax
