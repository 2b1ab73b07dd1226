#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sigmax::apps {

/// A time in seconds: a plain number, an ISO 8601 date and time as seconds since 1970-01-01 UTC, or a time of day,
/// hh:mm:ss with a fraction if any, as seconds since midnight.
///
/// A date and time is YYYY-MM-DD, 'T' or a blank, hh:mm:ss, a fraction after '.' or ',' if any, and 'Z', ±hh:mm,
/// ±hhmm or ±hh, after a blank if any, without which it is UTC; " UTC" may follow, as Go writes "+0000 UTC". As in
/// POSIX time a leap second, ss = 60, is the first second of the next minute. Blanks around it are allowed and nothing
/// else.
std::optional<double> parse_timestamp(std::string_view text);

/// The same of a text as `format` says by the directives of strptime, as %d/%m/%Y %H:%M:%S; a fraction of a second and
/// a zone may follow. `of_day` tells whether it is a time of day.
std::optional<double> parse_timestamp(std::string_view text, const std::string& format, bool& of_day);

/// What is wrong with such a format, if it is: zones by name, halves of a day that do not count, or what tells of a day
/// but not which; or nothing.
std::string_view time_format_warning(std::string_view format);

/// Whether that is a time of day, which tells no date.
bool is_time_of_day(std::string_view text);

inline constexpr double day_s = 86400.0;

/// The midnight before a time, both in seconds since some midnight.
double midnight_before(double time);

/// A time of day on the day of an earlier time, in seconds since some midnight; on the next day where it would fall by
/// more than 12 hours.
double time_of_day_after(double before, double time_of_day);

}  // namespace sigmax::apps
