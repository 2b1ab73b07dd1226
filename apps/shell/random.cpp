#include "shell/random.hpp"

#include <Random123/philox.h>

namespace sigmax::apps {

void RandomStream::refill() {
  const r123::Philox4x64::ctr_type random = r123::Philox4x64{}({{blocks_++, stream_, 0, 0}}, {{seed_, 0}});
  block_ = {random[0], random[1], random[2], random[3]};
  used_ = 0;
}

}  // namespace sigmax::apps
