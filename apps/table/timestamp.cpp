#include "table/timestamp.hpp"

#include <cmath>
#include <ctime>

#include "shell/text.hpp"

namespace sigmax::apps {
namespace {

/// Takes text apart from the left, as a form says in which 0 stands for a digit, and T for itself or a blank; the
/// numbers are those that its digits make one after another. Nothing is taken of a text that does not begin so.
bool take(std::string_view& text, std::string_view form, std::initializer_list<int*> numbers = {}) {
  const auto fits = [](char wanted, char found) {
    if (wanted == '0') return found >= '0' && found <= '9';
    return found == wanted || (wanted == 'T' && found == ' ');
  };
  if (text.size() < form.size() || !std::equal(form.begin(), form.end(), text.begin(), fits)) return false;
  std::size_t at = 0;
  for (int* const number : numbers)
    for (at = form.find('0', at); at < form.size() && form[at] == '0'; ++at) *number = 10 * *number + (text[at] - '0');
  text.remove_prefix(form.size());
  return true;
}

/// Takes a fraction of a second, if any; nothing of a point without digits.
std::optional<double> take_fraction(std::string_view& text) {
  if (!take(text, ".") && !take(text, ",")) return 0.0;
  std::string fraction = "0.";
  for (std::string_view left = text; take(text, "0"); left = text) fraction += left[0];
  return fraction.size() == 2 ? std::nullopt : parse_number(fraction);
}

/// Minutes ahead of UTC of "+hh:mm", "+hhmm" or "+hh"; none of "Z" or nothing. As Go writes them, "UTC" may follow.
std::optional<int> offset_minutes(std::string_view zone) {
  if (zone.ends_with(" UTC") || zone == "UTC") zone = trimmed(zone.substr(0, zone.size() - 3));
  if (zone.empty() || zone == "Z") return 0;
  const bool ahead = take(zone, "+");
  if (!ahead && !take(zone, "-")) return std::nullopt;
  int hours = 0, minutes = 0;
  if (!take(zone, "00", {&hours})) return std::nullopt;
  if (!take(zone, ":00", {&minutes})) take(zone, "00", {&minutes});
  if (!zone.empty() || hours > 23 || minutes > 59) return std::nullopt;
  return (ahead ? 1 : -1) * (60 * hours + minutes);
}

}  // namespace

std::optional<double> parse_timestamp(std::string_view text) {
  text = trimmed(text);
  if (const auto seconds = parse_number(text)) return seconds;
  std::string cell(text);
  bool of_day = false;
  if (is_time_of_day(text)) return parse_timestamp(text, "%H:%M:%S", of_day);
  if (!take(text, "0000-00-00T00:00:00")) return std::nullopt;
  cell[std::string_view("0000-00-00").size()] = ' ';
  return parse_timestamp(cell, "%Y-%m-%d %H:%M:%S", of_day);
}

std::optional<double> parse_timestamp(std::string_view text, const std::string& format, bool& of_day) {
  const std::string cell(trimmed(text));
  std::tm parsed{};
  const char* const end = ::strptime(cell.c_str(), format.c_str(), &parsed);
  if (end == nullptr) return std::nullopt;
  std::string_view rest = std::string_view(cell).substr(static_cast<std::size_t>(end - cell.c_str()));
  const auto fraction = take_fraction(rest);
  const auto zone = offset_minutes(trimmed(rest));
  of_day = parsed.tm_mday == 0;
  if (of_day) {
    parsed.tm_mday = 1;
    parsed.tm_year = 70;
  }
  std::tm date = parsed;
  date.tm_sec = 0;  // a leap second is of the next minute
  const std::time_t minute = ::timegm(&date);
  if (!fraction || !zone || parsed.tm_sec > 60 || date.tm_mday != parsed.tm_mday)
    return std::nullopt;  // strptime takes the 31st of any month
  return static_cast<double>(minute + parsed.tm_sec - parsed.tm_gmtoff - 60 * *zone) + *fraction;
}

std::string_view time_format_warning(std::string_view format) {
  const bool names_zone = format.find("%Z") != format.npos, has_half = format.find("%p") != format.npos;
  if (names_zone) return "names of zones are not read: add a column of UTC, or zones as +02:00, which %z reads";
  return has_half && format.find("%I") == format.npos ? "%p goes with hours up to 12, %I" : "";
}

bool is_time_of_day(std::string_view text) {
  text = trimmed(text);
  bool of_day = false;
  const bool is_bare =
      text.find_first_not_of("0123456789:.,") == text.npos && parse_timestamp(text, "%H:%M:%S", of_day);
  return is_bare && take(text, "00:00:00");
}

double midnight_before(double time) { return std::floor(time / day_s) * day_s; }

double time_of_day_after(double before, double time_of_day) {
  const double time = midnight_before(before) + time_of_day;
  return before - time > day_s / 2.0 ? time + day_s : time;
}

}  // namespace sigmax::apps
