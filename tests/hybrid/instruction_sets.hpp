#pragma once

#include "kinematic/kernels.hpp"
#include "support/sigmax.hpp"

namespace sigmax::support {

/// Does it with the fast path as compiled for each instruction set that this processor has, the best one last.
template <class Action>
void under_each_instruction_set(const Action& action) {
  for (const auto* kernels : detail::kinematic::available()) {
    SCOPED_TRACE(testing::Message() << "by vectors of " << kernels->lane_bytes << " bytes");
    detail::kinematic::choose(*kernels);
    action();
  }
}

}  // namespace sigmax::support
