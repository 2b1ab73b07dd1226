#include "support/timestamp.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "support/input.hpp"

namespace sigmax::apps {
namespace {

bool is_digit(char byte) { return byte >= '0' && byte <= '9'; }

/// Takes text apart from the left; every call says whether it found what it wants.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : rest_(text) {}

  bool at_end() const { return rest_.empty(); }

  bool take(char wanted) {
    if (!rest_.starts_with(wanted)) return false;
    rest_.remove_prefix(1);
    return true;
  }

  /// A number of exactly so many digits that is at most `greatest`.
  std::optional<int> number(std::size_t digits, int greatest) {
    if (rest_.size() < digits ||
        !std::all_of(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(digits), is_digit))
      return std::nullopt;
    int value = 0;
    for (std::size_t i = 0; i < digits; ++i) value = 10 * value + (rest_[i] - '0');
    if (value > greatest) return std::nullopt;
    rest_.remove_prefix(digits);
    return value;
  }

  /// Digits after the decimal sign, at least one.
  std::optional<double> fraction() {
    const auto end = std::find_if_not(rest_.begin(), rest_.end(), is_digit);
    if (end == rest_.begin()) return std::nullopt;
    const auto size = static_cast<std::size_t>(end - rest_.begin());
    const auto value = parse_number("0." + std::string{rest_.substr(0, size)});
    rest_.remove_prefix(size);
    return value;
  }

 private:
  std::string_view rest_;
};

struct TimeOfDay {
  std::int64_t whole_s;
  double fraction_s;
};

/// hh:mm:ss, and a fraction if any.
std::optional<TimeOfDay> time_of_day(Scanner& scan) {
  const auto hour = scan.number(2, 23);
  if (!hour || !scan.take(':')) return std::nullopt;
  const auto minute = scan.number(2, 59);
  if (!minute || !scan.take(':')) return std::nullopt;
  const auto second = scan.number(2, 60);
  if (!second) return std::nullopt;
  TimeOfDay time{(*hour * 60 + *minute) * 60 + *second, 0.0};
  if (scan.take('.') || scan.take(',')) {
    const auto fraction = scan.fraction();
    if (!fraction) return std::nullopt;
    time.fraction_s = *fraction;
  }
  return time;
}

std::optional<double> parse_time_of_day(std::string_view text) {
  Scanner scan(text);
  const auto time = time_of_day(scan);
  if (!time || !scan.at_end()) return std::nullopt;
  return static_cast<double>(time->whole_s) + time->fraction_s;
}

std::optional<double> parse_date_and_time(std::string_view text) {
  using namespace std::chrono;
  Scanner scan(text);
  const auto year_number = scan.number(4, 9999);
  if (!year_number || !scan.take('-')) return std::nullopt;
  const auto month_number = scan.number(2, 12);
  if (!month_number || !scan.take('-')) return std::nullopt;
  const auto day_number = scan.number(2, 31);
  if (!day_number || !(scan.take('T') || scan.take(' '))) return std::nullopt;
  const year_month_day date{year{*year_number}, month{static_cast<unsigned>(*month_number)},
                            day{static_cast<unsigned>(*day_number)}};
  if (!date.ok()) return std::nullopt;
  const auto time = time_of_day(scan);
  if (!time) return std::nullopt;
  const std::int64_t days = sys_days{date}.time_since_epoch().count();
  std::int64_t whole = days * 86400 + time->whole_s;

  if (!scan.take('Z') && !scan.at_end()) {
    const bool ahead = scan.take('+');
    if (!ahead && !scan.take('-')) return std::nullopt;
    const auto hours = scan.number(2, 23);
    if (!hours || !scan.take(':')) return std::nullopt;
    const auto minutes = scan.number(2, 59);
    if (!minutes) return std::nullopt;
    whole -= (ahead ? 60 : -60) * (*hours * 60 + *minutes);
  }
  if (!scan.at_end()) return std::nullopt;
  return static_cast<double>(whole) + time->fraction_s;
}

}  // namespace

std::optional<double> parse_timestamp(std::string_view text) {
  text = trimmed(text);
  if (const auto seconds = parse_number(text)) return seconds;
  if (const auto seconds = parse_time_of_day(text)) return seconds;
  return parse_date_and_time(text);
}

bool is_time_of_day(std::string_view text) { return parse_time_of_day(trimmed(text)).has_value(); }

double midnight_before(double time) { return std::floor(time / day_s) * day_s; }

double time_of_day_after(double before, double time_of_day) {
  const double time = midnight_before(before) + time_of_day;
  return before - time > day_s / 2.0 ? time + day_s : time;
}

std::string iso_time(double seconds) {
  using namespace std::chrono;
  if (!(seconds >= -62167219200.0 && seconds < 253402300800.0)) throw std::out_of_range("iso_time: no year 0 to 9999");
  const microseconds total{std::llround(seconds * 1e6)};
  const auto day = floor<days>(total);
  const year_month_day date{sys_days{day}};
  const hh_mm_ss time{total - day};
  std::string text = fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}", static_cast<int>(date.year()),
                                 static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                                 time.hours().count(), time.minutes().count(), time.seconds().count());
  if (time.subseconds().count() != 0) {
    text += fmt::format(".{:06}", time.subseconds().count());
    text.erase(text.find_last_not_of('0') + 1);
  }
  return text + "Z";
}

}  // namespace sigmax::apps
