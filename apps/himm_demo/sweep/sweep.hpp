#pragma once

#include <string>

namespace CLI {
class App;
}

namespace sigmax::apps {

/// `himm_demo sweep`: every filter at its best settings, in many conditions.
void add_sweep(CLI::App& program, const std::string& command);

}  // namespace sigmax::apps
