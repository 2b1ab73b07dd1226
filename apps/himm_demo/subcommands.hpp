#pragma once

#include "shell/command_line.hpp"

namespace sigmax::apps {

/// Section VI: simulated targets through every filter, and what came of it.
void add_simulate(CLI::App& program, const std::string& command);

/// What sections VI.D and VI.E of the paper say, sentence by sentence, against what the runs show.
void add_reproduce(CLI::App& program, const std::string& command);

/// Every filter at its best settings, in many conditions.
void add_sweep(CLI::App& program, const std::string& command);

/// Each target of a recording through every filter.
void add_track(CLI::App& program, const std::string& command);

/// The settings that suit recordings.
void add_tune(CLI::App& program, const std::string& command);

/// The keys of --config and --set.
void add_keys(CLI::App& program, const std::string& command);

/// All of them, as the help lists them.
inline const std::vector<AddSubcommand> subcommands = {add_simulate, add_reproduce, add_sweep,
                                                       add_track,    add_tune,      add_keys};

}  // namespace sigmax::apps
