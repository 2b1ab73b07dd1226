#pragma once

#include <cstdio>
#include <cstdlib>

namespace sigmax::fuzz {

/// Ends the program, which is what a fuzzer calls a finding, unless a fact holds.
inline void require(bool holds, const char* fact) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", fact);
  std::abort();
}

}  // namespace sigmax::fuzz
