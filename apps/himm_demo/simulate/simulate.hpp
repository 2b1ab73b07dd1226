#pragma once

#include <string>

namespace CLI {
class App;
}

namespace sigmax::apps {

/// `himm_demo simulate`, section VI: simulated targets through every filter, and what came of it.
void add_simulate(CLI::App& program, const std::string& command);

}  // namespace sigmax::apps
