/// The interacting filter over random models, steps and measurements. Usage: soak [STEPS [SEED]], default 10000000 1.

#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "support/soak.hpp"

namespace {

template <sigmax::Uncertainty Kind>
bool soaks(const char* name, std::uint64_t steps, std::uint64_t seed) {
  const auto report = sigmax::support::soak<Kind>(steps, seed);
  std::printf("%-5s %" PRIu64 " steps, %" PRIu64 " missed, %" PRIu64 " outliers, %" PRIu64
              " covariances, variances up to %.1e: %s\n",
              name, report.steps, report.missed, report.outliers, report.covariances, report.largest_variance,
              report.failure.empty() ? "no failure" : report.failure.c_str());
  std::fflush(stdout);
  return report.failure.empty();
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t steps = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 10'000'000;
  const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  const bool imm = soaks<sigmax::Random>("IMM", steps, seed);
  const bool himm = soaks<sigmax::Fuzzy>("HIMM", steps, seed);
  return imm && himm ? EXIT_SUCCESS : EXIT_FAILURE;
}
