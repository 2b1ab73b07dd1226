#pragma once

#include "shell/command_line.hpp"

namespace sigmax::apps {

// One subcommand a file: each adds its options, and does its work when it was asked for.

void add_esm(CLI::App& program, const std::string& command);
void add_train(CLI::App& program, const std::string& command);
void add_classify(CLI::App& program, const std::string& command);
void add_evaluate(CLI::App& program, const std::string& command);

}  // namespace sigmax::apps
