#include "shell/command_line.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <memory>
#include <sstream>
#include <system_error>

#include "shell/files.hpp"
#include "shell/text.hpp"
#include "version.hpp"

namespace sigmax::apps {
namespace {

constexpr int exit_signal = 128;

const char* running = "";

// Made before a signal can come: a handler may not allocate.
std::array<char, 5000> interrupted{};
std::atomic<std::size_t> interrupted_size = 0;

extern "C" void end_interrupted(int signal) {
  remove_unfinished_files();
  if (signal != SIGPIPE && ::write(STDERR_FILENO, interrupted.data(), interrupted_size) < 0) {
    // Nobody is left to be told.
  }
  ::_exit(exit_signal + signal);
}

void handle_signals() {
  report_interruption("");
  struct sigaction action = {};
  action.sa_handler = end_interrupted;
  ::sigfillset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
    struct sigaction before = {};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

/// Throws InputError unless all that was printed has left.
void flush_output() {
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0;
  const int error_number = errno;
  if (flushed && std::ferror(stdout) == 0) return;
  throw InputError("standard output: cannot be written: {}; make room there, or choose another place",
                   reason(error_number != 0 ? error_number : EIO));
}

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

/// What a text has after a line [NAME], up to the next such line.
std::string section(std::string_view text, const std::string& name) {
  const std::string head = "[" + name + "]\n";
  const auto begin = text.find(head);
  if (begin == std::string_view::npos) return "";
  text.remove_prefix(begin + head.size());
  return std::string(text.substr(0, text.find("\n[")));
}

bool is_option(const std::string& argument) { return argument.size() > 1 && argument.front() == '-'; }

/// The arguments with the default subcommand put in where there is none.
Arguments with_subcommand(const CLI::App& app, const std::string& default_subcommand, Arguments arguments) {
  const bool asks_about_the_program =
      !arguments.empty() && (arguments[0] == "--help" || arguments[0] == "-h" || arguments[0] == "--version");
  if (asks_about_the_program) return arguments;
  if (arguments.empty() || is_option(arguments.front())) {
    if (!default_subcommand.empty()) arguments.insert(arguments.begin(), default_subcommand);
    return arguments;
  }
  const auto names = each(app.get_subcommands({}), [](const CLI::App* one) { return one->get_name(); });
  if (std::ranges::find(names, arguments.front()) == names.end())
    throw UsageError({.what = fmt::format("there is no subcommand {}", in_quotes(arguments.front())),
                      .remedy = suggestion(arguments.front(), names)});
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
    if (std::ranges::find(known, name) != known.end()) continue;
    const std::string nearest = nearest_word(name, known, "--");
    throw UsageError({.what = fmt::format("{} has no option {}", subcommand->get_name(), in_quotes("--" + name)),
                      .remedy = nearest.empty()
                                    ? fmt::format("see {} {} --help", app.get_name(), subcommand->get_name())
                                    : nearest});
  }
}

}  // namespace

void report_interruption(std::string_view what_stays) {
  const char* const wipe = ::isatty(STDERR_FILENO) != 0 ? "\r\x1B[K" : "";  // a progress bar
  const std::string text = fmt::format("{}{}: interrupted; unfinished output was removed{}{}\n", wipe, running,
                                       what_stays.empty() ? "" : "; ", what_stays);
  interrupted_size = 0;
  interrupted_size = text.copy(interrupted.data(), interrupted.size());
}

void complain(std::string_view text) {
  const bool terminal = ::isatty(STDERR_FILENO) != 0;
  std::fputs(wrapped(text, terminal ? terminal_width : any_width).c_str(), stderr);  // print would throw without one
}

int exit_code(const std::exception& error) {
  return dynamic_cast<const UsageError*>(&error) != nullptr ? exit_usage : exit_input;
}

void complain(const std::exception& error) { complain(fmt::format("{}: {}", running, error.what())); }

int run_program(const char* name, const std::function<void()>& work) {
  running = name;
  try {
    handle_signals();
    work();
    flush_output();
  } catch (const std::exception& error) {
    complain(error);
    return exit_code(error);
  }
  return 0;
}

Option& Option::in(int least, int greatest) { return option_->check(CLI::Range(least, greatest)), *this; }

Option& Option::number_in(double least, double greatest) {
  const std::string range = fmt::format("[{} - {}]", least, greatest);
  const auto check = [=](const std::string& text) -> std::string {
    const auto number = parse_number(text);
    if (number && *number >= least && *number <= greatest) return "";
    return fmt::format("found {}, expected a number in {}", in_quotes(text), range);
  };
  return option_->check(CLI::Validator(check, "FLOAT in " + range)), *this;
}

Option& Option::in(const std::vector<int>& values) { return option_->check(CLI::IsMember(values)), *this; }

Option& Option::one_of(const std::vector<std::string>& values) { return option_->check(CLI::IsMember(values)), *this; }

Option& Option::check(const std::function<std::string(const std::string&)>& complaint) {
  return option_->check(CLI::Validator(complaint, "")), *this;
}

Option& Option::text(const std::string& text) { return option_->option_text(text), *this; }

Option& Option::type(const std::string& name) { return option_->type_name(name), *this; }

Option& Option::list() { return option_->delimiter(',')->allow_extra_args(false), *this; }

Option& Option::repeated() {
  return option_->expected(1)->allow_extra_args(false)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll), *this;
}

Option& Option::required() { return option_->required(), *this; }

bool Option::given() const { return option_->count() > 0; }

Subcommand::Subcommand(CLI::App& program, const std::string& name, const std::string& meaning)
    : app_(*program.add_subcommand(name, meaning)) {}

template <class Value>
Option Subcommand::option(const std::string& name, Value& value, const std::string& meaning) {
  CLI::Option* const option = app_.add_option(name, value, meaning);
  constexpr bool is_text = std::is_same_v<Value, std::string>;
  if constexpr (std::is_arithmetic_v<Value> || is_text) option->capture_default_str();
  Option added(option);
  if constexpr (is_text)  // CLI11 takes what follows, whatever it is
    added.check([app = &app_](const std::string& text) -> std::string {
      const bool is_option = text.starts_with("--") && app->get_option_no_throw(text) != nullptr;
      if (text.empty()) return "found nothing, expected a value";  // as of an unset variable of the shell
      return is_option ? fmt::format("found the option {}, expected a value", text) : "";
    });
  return added;
}

template Option Subcommand::option(const std::string&, int&, const std::string&);
template Option Subcommand::option(const std::string&, std::size_t&, const std::string&);
template Option Subcommand::option(const std::string&, double&, const std::string&);
template Option Subcommand::option(const std::string&, std::string&, const std::string&);
template Option Subcommand::option(const std::string&, std::optional<int>&, const std::string&);
template Option Subcommand::option(const std::string&, std::optional<double>&, const std::string&);
template Option Subcommand::option(const std::string&, std::vector<int>&, const std::string&);
template Option Subcommand::option(const std::string&, std::vector<double>&, const std::string&);
template Option Subcommand::option(const std::string&, std::vector<std::string>&, const std::string&);

Option Subcommand::option(const std::string& name, const std::function<void(const std::string&)>& read,
                          const std::string& meaning) {
  const auto refused = [=](const std::string& text) {
    try {
      read(text);
    } catch (const std::invalid_argument& error) {
      throw CLI::ValidationError(name, error.what());
    }
  };
  return Option(app_.add_option_function<std::string>(name, refused, meaning));
}

Option Subcommand::choice(const std::string& name, const std::vector<std::string>& names,
                          const std::function<void(int)>& chosen, const std::string& meaning) {
  const std::function<void(const std::string&)> read = [=](const std::string& given) {
    chosen(static_cast<int>(std::ranges::find(names, given) - names.begin()));
  };
  return option(name, read, meaning).one_of(names);
}

Option Subcommand::flag(const std::string& name, bool& value, const std::string& meaning) {
  return Option(app_.add_flag(name, value, meaning));
}

Option Subcommand::list(const std::string& name, std::vector<std::string>& words, const std::string& meaning) {
  const auto take = [&words](const std::vector<std::string>& given) {
    for (const std::string& text : given)
      for (std::string& word : CLI::detail::split_up(text, ','))
        if (!word.empty()) words.push_back(std::move(word));
  };
  return Option(app_.add_option_function<std::vector<std::string>>(name, take, meaning)->allow_extra_args(false));
}

Option Subcommand::triple(const std::string& name, std::optional<std::array<double, 3>>& values,
                          const std::string& meaning) {
  const auto take = [&values](const std::vector<double>& given) { values = {given[0], given[1], given[2]}; };
  return Option(app_.add_option_function<std::vector<double>>(name, take, meaning)->delimiter(',')->expected(3));
}

void Subcommand::run(const std::function<void()>& work) { app_.callback(work); }

void add_seed(Subcommand app, std::uint64_t& seed, const std::string& of_what) {
  const auto check = [](const std::string& text) -> std::string {
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc{} && end == text.data() + text.size()) return "";
    return fmt::format("found {}, expected a whole number from 0 to 18446744073709551615", in_quotes(text));
  };
  app.option("--seed", seed, "Seed " + of_what).check(check);
}

void add_threads(Subcommand app, int& threads) {
  app.option("--threads", threads, "Threads; the results do not depend on it [all]")
      .in(1, 4096)
      .text("INT:INT in [1 - 4096]");
}

int run_command_line(const ProgramOutline& outline, int argc, char** argv) {
  std::ios::sync_with_stdio(false);  // so that a failure to read the standard input shows
  Arguments arguments(argv + 1, argv + argc);
  std::string command = outline.name;
  for (const std::string& argument : arguments) command += " " + in_shell(argument);

  std::string description = outline.description;
  if (!outline.default_subcommand.empty())
    description += fmt::format(" Without a subcommand it runs {}.", outline.default_subcommand);
  CLI::App app{description, outline.name};
  app.formatter(std::make_shared<Help>());
  app.set_version_flag("--version", fmt::format("{} {}", outline.name, version));
  app.require_subcommand(outline.default_subcommand.empty() ? 1 : 0, 1);
  app.footer(fmt::format("{} SUBCOMMAND --help lists the options of a subcommand, with examples.", outline.name));
  for (AddSubcommand* const add : outline.subcommands) add(app, command);
  for (CLI::App* const subcommand : app.get_subcommands({}))
    subcommand->footer(section(outline.usage, subcommand->get_name()));

  int code = 0;
  const int ended = run_program(outline.name.c_str(), [&] {
    try {
      arguments = with_subcommand(app, outline.default_subcommand, std::move(arguments));
      refuse_unknown_options(app, arguments);
      std::ranges::reverse(arguments);  // as CLI11 wants them
      app.parse(arguments);
    } catch (const CLI::ParseError& error) {
      std::ostringstream out, complaint;
      code = app.exit(error, out, complaint) == 0 ? 0 : exit_usage;
      std::fputs(out.str().c_str(), stdout);
      if (!complaint.str().empty()) complain(fmt::format("{}: {}", outline.name, complaint.str()));
    }
  });
  return ended != 0 ? ended : code;
}

}  // namespace sigmax::apps
