#include "known_bank.hpp"

namespace sigmax {

template InnovationOf<detail::KnownSensor> update(const detail::KnownModel&, const EstimateOf<detail::KnownModel>&,
                                                  const MeasurementOf<detail::KnownSensor>&, const detail::KnownSensor&,
                                                  EstimateOf<detail::KnownModel>&);

}  // namespace sigmax
