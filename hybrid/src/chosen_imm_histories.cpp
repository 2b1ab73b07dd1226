#include <sigmax/hybrid/history_filter.hpp>

#include "chosen_target_of.hpp"

namespace sigmax::detail {

std::unique_ptr<ChosenTarget> chosen_imm_histories(const TargetChoice& choice) {
  return std::make_unique<ChosenTargetOf<HistoryFilter<KnownBank, Random>>>(choice);
}

}  // namespace sigmax::detail
