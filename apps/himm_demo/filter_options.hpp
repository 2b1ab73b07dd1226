#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace sigmax::apps {

/// --config, --set and --print-config.
void add_filter_options(CLI::App& app, std::string& config, std::vector<std::string>& sets, bool& print_config);

/// `himm_demo keys`: the keys of the first two.
void add_keys(CLI::App& program, const std::string& command);

}  // namespace sigmax::apps
