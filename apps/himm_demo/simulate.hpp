#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "himm_demo/scenario.hpp"
#include "support/command_line.hpp"

namespace sigmax::apps {

/// The options of `himm_demo simulate`.
struct SimulateOptions {
  int scenario = 1;
  int group = 1;
  Preset preset = Preset::paper_text;
  std::optional<int> runs;
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: as many as the machine has
  std::string config;
  std::vector<std::string> sets;
  bool print_config = false;
  OutputOptions output;
};

/// `himm_demo simulate`, section VI: simulated targets through every filter, and what came of it.
void add_simulate(CLI::App& program, const std::string& command);

}  // namespace sigmax::apps
