#pragma once

#include <string>

namespace CLI {
class App;
}

namespace sigmax::apps {

/// `himm_demo track`: each target of a recording through every filter.
void add_track(CLI::App& program, const std::string& command);

}  // namespace sigmax::apps
