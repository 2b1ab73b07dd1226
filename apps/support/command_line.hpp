#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace sigmax::apps {

/// --seed, which refuses what is no whole number below 2^64.
void add_seed(CLI::App& app, std::uint64_t& seed, const std::string& of_what = "of the random numbers");

/// --threads; zero stands for all of them.
void add_threads(CLI::App& app, int& threads);

/// Adds one subcommand with its options to the program; its callback does the work. `command` is the whole command as
/// typed.
using AddSubcommand = void (*)(CLI::App& program, const std::string& command);

struct ProgramOutline {
  std::string name;
  std::string description;
  std::vector<AddSubcommand> subcommands;
  std::string default_subcommand;  ///< what runs without a subcommand, with all options
};

/// Reads the command line, runs the subcommand under `run_program` and returns the exit code. An option or a subcommand
/// that does not exist is refused first, with the name that it resembles. Help fits a terminal of 80 columns.
int run_command_line(const ProgramOutline& outline, int argc, char** argv);

}  // namespace sigmax::apps
