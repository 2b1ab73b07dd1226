#include <sigmax/hybrid/interacting_multiple_model.hpp>

#include "chosen_target_of.hpp"

namespace sigmax::detail {

std::unique_ptr<ChosenTarget> chosen_himm(const TargetChoice& choice) {
  return std::make_unique<ChosenTargetOf<InteractingMultipleModel<KnownBank, Fuzzy>>>(choice);
}

}  // namespace sigmax::detail
