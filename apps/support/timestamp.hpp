#pragma once

#include <optional>
#include <string_view>

namespace sigmax::apps {

/// A time in seconds: a plain number, or an ISO 8601 date and time as seconds since 1970-01-01 UTC.
///
/// The latter is YYYY-MM-DD, 'T' or a blank, hh:mm:ss, a fraction after '.' or ',' if any, and 'Z' or ±hh:mm, without
/// which it is UTC. As in POSIX time a leap second, ss = 60, is the first second of the next minute. Blanks around it
/// are allowed and nothing else.
std::optional<double> parse_timestamp(std::string_view text);

}  // namespace sigmax::apps
