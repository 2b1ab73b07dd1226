#pragma once

#include <exception>
#include <functional>
#include <string_view>

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

/// Prints a line to standard error, broken to the width of the tables if that is a terminal.
void complain(std::string_view text);

/// What happened, after the name of the program that runs.
void complain(const std::exception& error);

/// The exit code of a program that ends by this exception: exit_usage after a UsageError, else exit_input.
int exit_code(const std::exception& error);

}  // namespace sigmax::apps
