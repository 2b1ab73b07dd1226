#include "hybrid/bare_imm.hpp"

template struct sigmax::bench::BareImm<sigmax::bench::UpdateByBlocks>;
