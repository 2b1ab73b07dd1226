#pragma once

#include <string>

namespace CLI {
class App;
}

namespace sigmax::apps {

/// `himm_demo reproduce`: what sections VI.D and VI.E of the paper say, sentence by sentence, against what the runs
/// show.
void add_reproduce(CLI::App& program, const std::string& command);

}  // namespace sigmax::apps
