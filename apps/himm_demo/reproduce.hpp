#pragma once

#include "himm_demo/reproduce_world.hpp"
#include "support/campaign.hpp"

namespace sigmax::apps {

/// The options of `himm_demo reproduce`.
struct ReproduceOptions {
  ReproduceChoice choice;
  Shard shard;
  int threads = 0;  ///< 0: as many as the machine has
  OutputOptions output;
};

/// `himm_demo reproduce`: what sections VI.D and VI.E of the paper say, sentence by sentence, against what the runs
/// show.
void add_reproduce(CLI::App& program, const std::string& command);

/// Prints the tables, and with --out writes claims.csv, figures.csv, filters.csv and summary.json.
void report(const ReproduceOptions& options, const std::vector<Condition>& conditions);

}  // namespace sigmax::apps
