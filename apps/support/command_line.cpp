#include "support/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <iostream>
#include <memory>
#include <sstream>
#include <system_error>

#include <fmt/format.h>

#include "support/error.hpp"
#include "support/input.hpp"
#include "support/run.hpp"
#include "support/spelling.hpp"
#include "support/text.hpp"
#include "version.hpp"

namespace sigmax::apps {
namespace {

using Arguments = std::vector<std::string>;

/// Help as CLI11 writes it, broken to the width of a terminal.
class Help : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    std::string text;
    for (const std::string& line : lines_of(CLI::Formatter::make_help(app, std::move(name), mode), any_width))
      text += broken(line);
    text.pop_back();  // the text ended its last line itself
    return text;
  }

 private:
  /// A description goes on below its own beginning.
  std::string broken(const std::string& line) const {
    const std::size_t column = get_column_width();
    const bool described = line.starts_with("  ") && line.size() > column && line[column - 1] == ' ';
    if (!described) return wrapped(line);
    std::string text;
    for (const std::string& part : lines_of(line.substr(column), terminal_width - column))
      text += (text.empty() ? line.substr(0, column) : std::string(column, ' ')) + part + "\n";
    return text;
  }
};

bool is_option(const std::string& argument) { return argument.size() > 1 && argument.front() == '-'; }

std::vector<std::string> names_of_subcommands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* subcommand : app.get_subcommands({})) names.push_back(subcommand->get_name());
  return names;
}

/// The arguments with the default subcommand put in where there is none.
Arguments with_subcommand(const CLI::App& app, const std::string& default_subcommand, Arguments arguments) {
  const bool asks_about_the_program =
      !arguments.empty() && (arguments[0] == "--help" || arguments[0] == "-h" || arguments[0] == "--version");
  if (asks_about_the_program) return arguments;
  if (arguments.empty() || is_option(arguments.front())) {
    if (!default_subcommand.empty()) arguments.insert(arguments.begin(), default_subcommand);
    return arguments;
  }
  const auto names = names_of_subcommands(app);
  if (std::find(names.begin(), names.end(), arguments.front()) == names.end())
    throw UsageError(message({.what = fmt::format("there is no subcommand {}", in_quotes(arguments.front())),
                              .remedy = suggestion(arguments.front(), names)}));
  return arguments;
}

/// CLI11 would first complain of an option that is missing, because it was misspelt.
void refuse_unknown_options(const CLI::App& app, const Arguments& arguments) {
  if (arguments.empty() || is_option(arguments.front())) return;
  const CLI::App* const subcommand = app.get_subcommand(arguments.front());
  std::vector<std::string> known;
  for (const CLI::Option* option : subcommand->get_options())
    known.insert(known.end(), option->get_lnames().begin(), option->get_lnames().end());
  for (const std::string& argument : arguments) {
    if (argument == "--") return;
    if (!argument.starts_with("--")) continue;
    const std::string name = argument.substr(2, argument.find('=') - 2);
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string nearest = nearest_word(name, known, "--");
    throw UsageError(
        message({.what = fmt::format("{} has no option {}", subcommand->get_name(), in_quotes("--" + name)),
                 .remedy = nearest.empty() ? fmt::format("see {} {} --help", app.get_name(), subcommand->get_name())
                                           : nearest}));
  }
}

}  // namespace

void add_seed(CLI::App& app, std::uint64_t& seed, const std::string& of_what) {
  const auto check = [](const std::string& text) -> std::string {
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc{} && end == text.data() + text.size()) return "";
    return fmt::format("found {}, expected a whole number from 0 to 18446744073709551615", in_quotes(text));
  };
  app.add_option("--seed", seed, "Seed " + of_what)->check(CLI::Validator(check, ""))->capture_default_str();
}

void add_threads(CLI::App& app, int& threads) {
  app.add_option("--threads", threads, "Threads; the results do not depend on it [all]")->check(CLI::Range(1, 4096));
}

int run_command_line(const ProgramOutline& outline, int argc, char** argv) {
  std::ios::sync_with_stdio(false);  // so that a failure to read the standard input shows
  Arguments arguments(argv + 1, argv + argc);
  std::string command = outline.name;
  for (const std::string& argument : arguments) command += " " + argument;

  std::string description = outline.description;
  if (!outline.default_subcommand.empty())
    description += fmt::format(" Without a subcommand it runs {}.", outline.default_subcommand);
  CLI::App app{description, outline.name};
  app.formatter(std::make_shared<Help>());
  app.set_version_flag("--version", fmt::format("{} {}", outline.name, version));
  app.require_subcommand(outline.default_subcommand.empty() ? 1 : 0, 1);
  app.footer(fmt::format("{} SUBCOMMAND --help lists the options of a subcommand, with examples.", outline.name));
  for (const AddSubcommand add : outline.subcommands) add(app, command);

  int code = 0;
  const int ended = run_program(outline.name.c_str(), [&] {
    try {
      arguments = with_subcommand(app, outline.default_subcommand, std::move(arguments));
      refuse_unknown_options(app, arguments);
      std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
      app.parse(arguments);
    } catch (const CLI::ParseError& error) {
      std::ostringstream out, complaint;
      code = app.exit(error, out, complaint) == 0 ? 0 : exit_usage;
      std::fputs(out.str().c_str(), stdout);
      if (!complaint.str().empty()) complain(complaint.str());
    }
  });
  return ended != 0 ? ended : code;
}

}  // namespace sigmax::apps
