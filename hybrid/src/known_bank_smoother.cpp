#include "known_bank.hpp"

namespace sigmax {

template class FixedIntervalSmoother<detail::KnownBank, Random>;
template class FixedIntervalSmoother<detail::KnownBank, Fuzzy>;

}  // namespace sigmax
