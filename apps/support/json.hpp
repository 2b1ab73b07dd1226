#pragma once

#include <nlohmann/json.hpp>

namespace sigmax::apps {

/// With its keys in the order in which they were written.
using Json = nlohmann::ordered_json;

}  // namespace sigmax::apps
