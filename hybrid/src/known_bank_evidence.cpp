#include "known_bank.hpp"

namespace sigmax {

template struct FutureEvidence<detail::KnownModel::max_state_size>;
template class EvidenceCollapse<detail::KnownModel::max_state_size>;

}  // namespace sigmax
