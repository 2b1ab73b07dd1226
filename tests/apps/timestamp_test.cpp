#include "table/timestamp.hpp"
#include "support/test.hpp"

#include <rapidcheck/gtest.h>

#include <fmt/format.h>

namespace timestamp_test {

TEST(Timestamp, APlainNumberIsSeconds) {
  EXPECT_EQ(parse_timestamp("12.5"), 12.5);
  EXPECT_EQ(parse_timestamp(" -3e2\t"), -300.0);
  EXPECT_EQ(parse_timestamp("2016"), 2016.0);
}

TEST(Timestamp, AnIsoDateAndTimeIsSecondsSince1970) {
  EXPECT_EQ(parse_timestamp("1970-01-01T00:00:00Z"), 0.0);
  EXPECT_EQ(parse_timestamp("1970-01-01 00:00:00"), 0.0);
  EXPECT_EQ(parse_timestamp("2001-09-09T01:46:40Z"), 1e9);
  EXPECT_EQ(parse_timestamp("2038-01-19T03:14:08"), 2147483648.0);
  EXPECT_EQ(parse_timestamp("1969-12-31T23:59:59.25Z"), -0.75);
  EXPECT_EQ(parse_timestamp(" 2016-01-12 13:02:11.218 "), 1452603731.218);
  EXPECT_EQ(parse_timestamp("2016-01-12T13:02:11,218Z"), 1452603731.218);
  EXPECT_EQ(parse_timestamp("2000-02-29T12:00:00"), 951825600.0);
  EXPECT_EQ(parse_timestamp("0000-01-01T00:00:00Z"), -62167219200.0);
  EXPECT_EQ(parse_timestamp("9999-12-31T23:59:59Z"), 253402300799.0);
}

TEST(Timestamp, AnOffsetIsTakenOff) {
  EXPECT_EQ(parse_timestamp("2016-01-12T14:02:11+01:00"), parse_timestamp("2016-01-12T13:02:11Z"));
  EXPECT_EQ(parse_timestamp("2016-01-12T07:32:11-05:30"), parse_timestamp("2016-01-12T13:02:11Z"));
  EXPECT_EQ(parse_timestamp("1970-01-01T00:30:00.5+00:30"), 0.5);
  for (const char* zone : {"+01", "+0100", " +01:00", " +01", "\t+0100"})
    EXPECT_EQ(parse_timestamp("2016-01-12 14:02:11" + std::string(zone)), parse_timestamp("2016-01-12T13:02:11Z"))
        << zone;
  EXPECT_EQ(parse_timestamp("2016-01-12T07:32:11-0530"), parse_timestamp("2016-01-12T13:02:11 Z"));
  EXPECT_EQ(parse_timestamp("2024-07-30 08:17:43.375540658 +0200 UTC"),
            parse_timestamp("2024-07-30T06:17:43.375540658"));
}

TEST(Timestamp, ALeapSecondIsTheFirstOfTheNextMinute) {
  EXPECT_EQ(parse_timestamp("2016-12-31T23:59:60Z"), parse_timestamp("2017-01-01T00:00:00Z"));
}

TEST(Timestamp, ATimeOfDayIsSecondsSinceMidnight) {
  EXPECT_EQ(parse_timestamp("00:00:00"), 0.0);
  EXPECT_EQ(parse_timestamp(" 10:15:08.5 "), 36908.5);
  EXPECT_EQ(parse_timestamp("23:51:59.9999999"), 85919.9999999);
  EXPECT_TRUE(is_time_of_day(" 10:15:08.5 "));
  for (const char* text : {"36908.5", "2016-01-12T10:15:08Z", "24:00:00"}) EXPECT_FALSE(is_time_of_day(text)) << text;
  EXPECT_FALSE(parse_timestamp("24:00:00"));
  EXPECT_FALSE(parse_timestamp("10:15"));
  EXPECT_FALSE(parse_timestamp("10:15:08Z"));
}

TEST(Timestamp, AnotherFormIsReadByDirectives) {
  bool of_day = true;
  const auto danish = [&](const std::string& text) { return parse_timestamp(text, "%d/%m/%Y %H:%M:%S", of_day); };
  EXPECT_EQ(danish(" 12/01/2016 13:02:11 "), parse_timestamp("2016-01-12T13:02:11Z"));
  EXPECT_EQ(danish("12/01/2016 13:02:11,218+01"), parse_timestamp("2016-01-12T12:02:11.218Z"));
  EXPECT_FALSE(of_day);
  for (const char* text : {"30/02/2016 13:02:11", "12/01/2016", "12/01/2016 13:02:11.", "12/01/2016 13:02:11 PM", "7"})
    EXPECT_FALSE(danish(text)) << text;
  EXPECT_EQ(parse_timestamp("2016-01-12 13:02 +0200", "%Y-%m-%d %H:%M %z", of_day),
            parse_timestamp("2016-01-12T11:02:00Z"));
  EXPECT_EQ(parse_timestamp("10.15.08,5", "%H.%M.%S", of_day), 36908.5);
  EXPECT_TRUE(of_day);
}

TEST(Timestamp, NothingElseIsATime) {
  std::istringstream texts(
      "| |now|nan|inf|2016-01-12|2016-1-12T13:02:11|2016-01-12T13:02|2016-01-12T13:02:11.|"
      "2016-01-12T13:02:11.Z|2016-01-12T13:02:11z|2016-01-12t13:02:11|2016-01-12  13:02:11|2016-01-12T24:00:00|"
      "2016-01-12T13:60:00|2016-01-12T13:02:61|2016-13-12T13:02:11|2016-00-12T13:02:11|2016-01-32T13:02:11|"
      "2016-01-00T13:02:11|2015-02-29T13:02:11|1900-02-29T13:02:11|2016-01-12T13:02:11+010|"
      "2016-01-12T13:02:11+1|2016-01-12T13:02:11+|2016-01-12T13:02:11+01:|2016-01-12T13:02:11+01000|"
      "2016-01-12T13:02:11+2400|2016-01-12T13:02:11-0160|2016-01-12T13:02:11 + 01:00|2016-01-12T13:02:11+24:00|"
      "2016-01-12T13:02:11+01:60|2016-01-12T13:02:11ZZ|2016-01-12T13:02:11Z+01:00|+2016-01-12T13:02:11|"
      "-2016-01-12T13:02:11|12016-01-12T13:02:11|2016-01-12T13:02:-1");
  std::size_t count = 0;
  for (std::string text; std::getline(texts, text, '|'); ++count)
    EXPECT_EQ(parse_timestamp(text), std::nullopt) << text;
  EXPECT_EQ(count, 38U);
}

TEST(Timestamp, ATimeOfDayThatFallsByMoreThanHalfADayIsOfTheNext) {
  EXPECT_EQ(time_of_day_after(86399.0, 1.0), 86401.0);
  EXPECT_EQ(time_of_day_after(43200.0, 0.0), 0.0);
  EXPECT_EQ(time_of_day_after(43200.5, 0.0), 86400.0);
  EXPECT_EQ(time_of_day_after(86401.0, 86399.0), 172799.0);
  EXPECT_EQ(time_of_day_after(5.0, 70000.0), 70000.0);
  EXPECT_EQ(midnight_before(172799.5), 86400.0);
}

RC_GTEST_PROP(Timestamp, AgreesWithTheCalendarOfTheCLibrary, ()) {
  const auto seconds = *rc::gen::inRange<std::int64_t>(-2208988800, 4102444800);
  const auto milliseconds = *rc::gen::inRange(0, 1000);
  const auto time = static_cast<std::time_t>(seconds);
  std::tm parts{};
  RC_ASSERT(::gmtime_r(&time, &parts) != nullptr);
  const std::string text =
      fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", parts.tm_year + 1900, parts.tm_mon + 1, parts.tm_mday,
                  parts.tm_hour, parts.tm_min, parts.tm_sec, milliseconds);
  RC_ASSERT(parse_timestamp(text) == static_cast<double>(seconds) + milliseconds / 1000.0);
}

}  // namespace timestamp_test
