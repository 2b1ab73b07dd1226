#pragma once

#include <string>

namespace CLI {
class App;
}

namespace sigmax::apps {

/// `himm_demo tune`: the settings that suit recordings.
void add_tune(CLI::App& program, const std::string& command);

}  // namespace sigmax::apps
