#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "himm_demo/sweep_world.hpp"
#include "support/campaign.hpp"

namespace sigmax::apps {

/// The options of `himm_demo sweep`.
struct SweepOptions {
  SweepChoice choice;
  Shard shard;
  int threads = 0;  ///< 0: as many as the machine has
  OutputOptions output;
};

/// `himm_demo sweep`: every filter at its best settings, in many conditions.
void add_sweep(CLI::App& program, const std::string& command);

/// Prints the map, and with --out writes map.csv, tuned.csv and summary.json.
void report(const SweepOptions& options, const SweepWorld& world, const CellRows& rows);

}  // namespace sigmax::apps
