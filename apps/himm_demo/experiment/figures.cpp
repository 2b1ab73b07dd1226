#include "himm_demo/experiment/figures.hpp"

namespace sigmax::apps {

TracedRun Experiment::traced(std::uint64_t number) const {
  return trace_run(scenario, group.data, filters, seed, number);
}

std::optional<std::size_t> Experiment::mode_sample(std::size_t sample) const {
  const int source = static_cast<int>(sample) - mode_sample_shift;
  return source >= 0 && source < scenario.samples ? std::optional(static_cast<std::size_t>(source)) : std::nullopt;
}

void add_squares(const Scenario& scenario, const std::vector<std::array<double, 3>>& error, double* sums) {
  for (std::size_t i = 0; i < squares; ++i)
    sums[i] += phase_mean(scenario.phases[i / 3], [&](std::size_t k) { return error[k][i % 3] * error[k][i % 3]; });
}

}  // namespace sigmax::apps
