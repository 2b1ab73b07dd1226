#include <sigmax/hybrid/second_order_multiple_model.hpp>

#include "chosen_target_of.hpp"

namespace sigmax::detail {

std::unique_ptr<ChosenTarget> chosen_viterbi(const TargetChoice& choice) {
  return std::make_unique<ChosenTargetOf<SecondOrderMultipleModel<KnownBank, Fuzzy>>>(choice);
}

}  // namespace sigmax::detail
