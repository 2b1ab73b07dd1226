#include "hybrid/bare_imm.hpp"

namespace sigmax::bench {

template struct BareImm<PlainUpdate>;
template struct BareImm<UpdateByBlocks>;

}  // namespace sigmax::bench
