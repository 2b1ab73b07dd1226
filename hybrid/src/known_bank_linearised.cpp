#include "known_bank.hpp"

namespace sigmax {

template LinearisedStepOf<detail::KnownModel> linearised_step(const detail::KnownModel&,
                                                              const EstimateOf<detail::KnownModel>&, double);
template LinearisedMeasurementOf<detail::KnownModel, detail::KnownSensor> linearised_measurement(
    const detail::KnownModel&, const EstimateOf<detail::KnownModel>&, const MeasurementOf<detail::KnownSensor>&,
    const detail::KnownSensor&);
template struct FutureEvidence<detail::KnownModel::max_state_size>;
template class EvidenceCollapse<detail::KnownModel::max_state_size>;

}  // namespace sigmax
