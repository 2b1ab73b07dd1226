#include <sigmax/core/route.hpp>

#include <algorithm>
#include <utility>

namespace sigmax::detail {

struct History::Step {
  kernels::Winners winners;
  std::shared_ptr<Step> before;

  /// The winner of number k: of its attempts the first at no less than the value of the way; 0 if there is none.
  std::size_t winner(std::size_t k, double value) const {
    if (!winners.first.empty()) return winners.first[k];
    for (const auto& attempt : winners.attempts[k])
      if (value > 0.0 && attempt.value >= value) return attempt.index;
    return 0;
  }
};

History& History::operator=(History other) noexcept {
  std::swap(last_, other.last_);
  return *this;
}

History::~History() {  // one after the other: a long chain is too deep for recursion
  while (last_ && last_.use_count() == 1) last_ = std::exchange(last_->before, nullptr);
}

void History::append(kernels::Winners winners) {
  last_ = std::make_shared<Step>(Step{std::move(winners), std::move(last_)});
}

std::vector<std::size_t> History::path_to(std::size_t last, double value) const {
  std::vector<std::size_t> outcomes{last};
  for (const Step* step = last_.get(); step; step = step->before.get())
    outcomes.push_back(step->winner(outcomes.back(), value));
  std::reverse(outcomes.begin(), outcomes.end());
  return outcomes;
}

}  // namespace sigmax::detail
