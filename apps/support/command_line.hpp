#pragma once

#include <CLI/App.hpp>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "support/table.hpp"

namespace sigmax::apps {

/// Where results go, and how they look; the same for every subcommand.
struct OutputOptions {
  std::string out;        ///< a directory for files, or empty
  std::string report;     ///< the file of the report, or empty: that of the directory, if there is one
  std::string plots;      ///< a directory for the report's pictures as SVG and PDF, or empty
  bool quiet = false;     ///< no progress bar
  bool wide = false;      ///< rows of tables are not broken
  bool no_chart = false;  ///< on the terminal
  std::string command;    ///< as typed, for the record

  std::size_t width() const { return wide ? any_width : terminal_width; }
};

/// Prints a paragraph, broken to the width of the tables.
void print_text(const OutputOptions& options, std::string_view text);

/// --out, --quiet and --wide; --report and --plots; --no-chart.
void add_output(CLI::App& app, OutputOptions& options);
void add_report(CLI::App& app, OutputOptions& options);
void add_no_chart(CLI::App& app, bool& no_chart);
void add_quiet(CLI::App& app, bool& quiet);
void add_wide(CLI::App& app, bool& wide);

/// --seed, which refuses what is no whole number below 2^64.
void add_seed(CLI::App& app, std::uint64_t& seed, const std::string& of_what = "of the random numbers");

/// --threads; zero stands for all of them.
void add_threads(CLI::App& app, int& threads);

/// Refuses what is no finite number in [least, greatest]. (CLI::Range lets NaN pass.)
CLI::Validator number_in(double least, double greatest);

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
