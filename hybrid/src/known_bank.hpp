#pragma once

#include <vector>

#include <sigmax/estimation/any_member.hpp>
#include <sigmax/hybrid/any_target.hpp>

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
extern template StateMatrixOf<detail::KnownModel> prediction_covariance(const detail::KnownModel&,
                                                                        const EstimateOf<detail::KnownModel>&, double);
extern template InnovationOf<detail::KnownSensor> update(const detail::KnownModel&,
                                                         const EstimateOf<detail::KnownModel>&,
                                                         const MeasurementOf<detail::KnownSensor>&,
                                                         const detail::KnownSensor&, EstimateOf<detail::KnownModel>&);

}  // namespace sigmax
