#pragma once

#include <nlohmann/json.hpp>

namespace sigmax::apps {

/// With its keys in the order in which they were written.
using Json = nlohmann::ordered_json;

/// As text; of what is no UTF-8, a name in Latin-1, each byte stands as U+FFFD. Indented by so many blanks, or one
/// line.
inline std::string dumped(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace sigmax::apps
