#include <sigmax/hybrid/interacting_multiple_model.hpp>

#include "chosen_target_of.hpp"

namespace sigmax::detail {

std::unique_ptr<ChosenTarget> chosen_imm(const TargetChoice& choice) {
  return std::make_unique<ChosenTargetOf<InteractingMultipleModel<KnownBank, Random>>>(choice);
}

}  // namespace sigmax::detail
