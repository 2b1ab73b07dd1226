// Any bytes are a finite time or none; a time agrees with the C library's, and reads the same when written out again. A
// time of day is that time on 1970-01-01.
#include <cctype>
#include <ctime>

#include <fmt/format.h>

#include "fuzz/require.hpp"
#include "table/timestamp.hpp"

namespace {

/// A date and time as the C library has it, without a fraction; nothing beyond four digits of the year.
std::optional<std::string> written(std::time_t seconds) {
  std::tm parts{};
  if (!::gmtime_r(&seconds, &parts) || parts.tm_year < -1900 || parts.tm_year > 9999 - 1900) return std::nullopt;
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}", parts.tm_year + 1900, parts.tm_mon + 1, parts.tm_mday,
                     parts.tm_hour, parts.tm_min, parts.tm_sec);
}

/// Its seconds since 1970 without fraction and offset, by the C library.
double by_the_c_library(const std::string& date_and_time) {
  const auto digits = [&](std::size_t begin, std::size_t count) {
    return std::stoi(date_and_time.substr(begin, count));
  };
  std::tm parts{};
  parts.tm_year = digits(0, 4) - 1900;
  parts.tm_mon = digits(5, 2) - 1;
  parts.tm_mday = digits(8, 2);
  parts.tm_hour = digits(11, 2);
  parts.tm_min = digits(14, 2);
  parts.tm_sec = digits(17, 2);
  return static_cast<double>(::timegm(&parts));
}

void check_date_and_time(const std::string& text, double seconds) {
  require(text.size() >= 19 && text[4] == '-' && text[7] == '-' && text[13] == ':' && text[16] == ':',
          "what is no number is a date and a time");
  std::size_t end = 19;
  double fraction = 0.0;
  if (end < text.size() && (text[end] == '.' || text[end] == ',')) {
    const std::size_t begin = ++end;
    while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end])) != 0) ++end;
    fraction = std::strtod(("0." + text.substr(begin, end - begin)).c_str(), nullptr);
  }
  double offset = 0.0;
  end = std::min(text.find_first_not_of(" \t", end), text.size());
  if (end < text.size() && text[end] != 'Z' && text[end] != 'U') {
    std::string digits = text.substr(end + 1);
    digits.resize(std::min(digits.find_first_of(" \t"), digits.size()));  // UTC may follow, as Go writes it
    std::erase(digits, ':');
    require(digits.size() == 2 || digits.size() == 4, "a zone is hours, or hours and minutes");
    digits.resize(4, '0');
    offset = (text[end] == '-' ? -60.0 : 60.0) * (60.0 * std::stoi(digits.substr(0, 2)) + std::stoi(digits.substr(2)));
  }
  require(std::abs(seconds - (by_the_c_library(text) - offset + fraction)) <= 1e-4, "the C library has the same time");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text{data, data + size};
  const auto seconds = parse_timestamp(text);
  require(parse_timestamp(" \t" + text + " ") == seconds, "blanks around a time do not matter");
  if (!seconds) return 0;
  require(std::isfinite(*seconds), "a time is finite");

  const std::size_t first = text.find_first_not_of(" \t");
  const std::string bare = text.substr(first, text.find_last_not_of(" \t") + 1 - first);
  char* end = nullptr;
  if (const double number = std::strtod(bare.c_str(), &end); *end == '\0')
    require(number == *seconds, "a plain number is itself");
  else if (is_time_of_day(text))
    check_date_and_time("1970-01-01T" + bare, *seconds);
  else
    check_date_and_time(bare, *seconds);

  if (std::abs(*seconds) > 1e12) return 0;
  const auto whole = static_cast<std::time_t>(std::floor(*seconds));
  if (const auto again = written(whole)) {
    require(parse_timestamp(*again) == static_cast<double>(whole), "a time reads the same when written out again");
    require(parse_timestamp(*again + "Z") == static_cast<double>(whole), "without an offset a time is UTC");
    require(parse_timestamp(*again + ".5") == static_cast<double>(whole) + 0.5, "half a second later is later");
    require(parse_timestamp(*again + "-01:00") == static_cast<double>(whole) + 3600.0,
            "an hour behind UTC it is an hour later");
  }
  return 0;
}
