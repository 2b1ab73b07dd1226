#pragma once

#include <cstdint>
#include <vector>

namespace sigmax::kernels {

/// Which index won; 32 bits, because routes through long chains store many.
using Winner = std::uint32_t;

/// For every number that a result stores, in its order, the first index that attains it; 0 if none does.
using FirstWinners = std::vector<Winner>;

/// The winners of one relation of a chain. Where ⊗ selects it takes, for every number, all indices that attained more
/// than those before them, and what they attained: a later minimum may make any of them a tie.
struct Winners {
  struct Attempt {
    Winner index;
    double value;
  };
  FirstWinners first;
  std::vector<std::vector<Attempt>> attempts;
};

}  // namespace sigmax::kernels
