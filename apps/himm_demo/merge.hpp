#pragma once

#include <CLI/App.hpp>
#include <string>

namespace sigmax::apps {

/// `himm_demo merge`: the results of a campaign out of the journals of its shards.
void add_merge(CLI::App& program, const std::string& command);

}  // namespace sigmax::apps
