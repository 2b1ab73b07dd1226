#pragma once

#include <string>

namespace CLI {
class App;
}

namespace sigmax::apps {

/// `himm_demo merge`: the results of a campaign out of the journals of its shards.
void add_merge(CLI::App& program, const std::string& command);

}  // namespace sigmax::apps
