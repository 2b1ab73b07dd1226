#pragma once

#include <array>
#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace sigmax::apps {

/// The exit codes of what is wrong with the command line and with the input.
inline constexpr int exit_usage = 2, exit_input = 3;

/// Does a program's work and returns its exit code: 0, that of an exception, or exit_input if standard output cannot be
/// written. The message goes to standard error, after the program's name.
///
/// On SIGINT, SIGTERM, SIGHUP or SIGPIPE the program ends at once with 128 and the signal's number, 130 for SIGINT, and
/// removes its unfinished files; signals that are ignored stay so. What a limit on file sizes refuses is a failed
/// write.
int run_program(const char* name, const std::function<void()>& work);

/// What such a signal leaves besides, for the message.
void report_interruption(std::string_view what_stays);

/// Prints a line to standard error, broken to the width of the tables if that is a terminal.
void complain(std::string_view text);

/// What happened, after the name of the program that runs.
void complain(const std::exception& error);

/// The exit code of a program that ends by this exception: exit_usage after a UsageError, else exit_input.
int exit_code(const std::exception& error);

/// An option that was added, for what else there is to say of it.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  /// @{
  /// What it may be: a whole number or a number in a range, or one of some. (CLI::Range lets NaN pass.)
  Option& in(int least, int greatest);
  Option& in(const std::vector<int>& values);
  Option& number_in(double least, double greatest);
  Option& one_of(const std::vector<std::string>& values);
  /// @}
  /// A check of one's own, which returns what is wrong, or nothing.
  Option& check(const std::function<std::string(const std::string&)>& complaint);

  Option& text(const std::string& text);  ///< instead of type, default and range in the help
  Option& type(const std::string& name);  ///< instead of the type alone
  Option& list();                         ///< its values have commas between; what follows after a blank is none
  Option& repeated();                     ///< it takes one value, and may be given again
  Option& required();

  bool given() const;

 private:
  CLI::Option* option_;
};

/// A subcommand and its options, which CLI11 reads; it takes seconds to include, and so only what implements this does.
///
///     Subcommand app(program, "simulate", "Simulated targets.");
///     app.option("--runs", options->runs, "Monte Carlo runs").in(1, 1000);
///     app.run([options] { … });
class Subcommand {
 public:
  Subcommand(CLI::App& program, const std::string& name, const std::string& meaning);
  /// One that is there.
  Subcommand(CLI::App& app) : app_(app) {}

  /// An option, or an argument if its name has no dashes, whose value is an int, a size_t, a double, a string, one of
  /// these that may be missing (std::optional), or a vector. What a number or a string is now, the help shows as its
  /// default.
  template <class Value>
  Option option(const std::string& name, Value& value, const std::string& meaning);

  /// One whose text is read by a function, which throws what is wrong.
  Option option(const std::string& name, const std::function<void(const std::string&)>& read,
                const std::string& meaning);

  /// One out of names, which is told by its place among them.
  Option choice(const std::string& name, const std::vector<std::string>& names, const std::function<void(int)>& chosen,
                const std::string& meaning);

  Option flag(const std::string& name, bool& value, const std::string& meaning);

  /// Words with commas between; those that have a comma are in double quotes. What follows after a blank is none of
  /// them.
  Option list(const std::string& name, std::vector<std::string>& words, const std::string& meaning);

  /// Three numbers with commas between.
  Option triple(const std::string& name, std::optional<std::array<double, 3>>& values, const std::string& meaning);

  void run(const std::function<void()>& work);

 private:
  CLI::App& app_;
};

/// Adds one subcommand with its options to the program; its callback does the work. `command` is the whole command as
/// typed.
using AddSubcommand = void(CLI::App& program, const std::string& command);

/// --seed, which refuses what is no whole number below 2^64.
void add_seed(Subcommand app, std::uint64_t& seed, const std::string& of_what = "of the random numbers");

/// --threads; zero stands for all of them.
void add_threads(Subcommand app, int& threads);

struct ProgramOutline {
  std::string name, description;
  std::vector<AddSubcommand*> subcommands;
  std::string default_subcommand;  ///< what runs without a subcommand, with all options
  std::string_view usage = {};     ///< what help says below the options: after a line [NAME] that of a subcommand
};

/// Reads the command line, runs the subcommand under `run_program` and returns the exit code. An option or a subcommand
/// that does not exist is refused first, with the name that it resembles. Help fits a terminal of 80 columns.
int run_command_line(const ProgramOutline& outline, int argc, char** argv);

}  // namespace sigmax::apps
