#pragma once

// What most fuzz targets include.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace sigmax::fuzz {

/// Ends the program, which is what a fuzzer calls a finding, unless a fact holds.
inline void require(bool holds, const char* fact) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", fact);
  std::abort();
}

}  // namespace sigmax::fuzz

namespace sigmax::apps {}

using namespace sigmax;  // as in the tests
using namespace sigmax::apps;
using namespace sigmax::fuzz;
