#include "table/csv.hpp"

#include <streambuf>

#include "apps/temporary_directory.hpp"

namespace csv_test {

using Records = std::vector<std::vector<std::string>>;

Records records(const std::string& text) {
  std::istringstream stream{text};
  CsvReader reader{stream, "f.csv"};
  Records all{{reader.names().begin(), reader.names().end()}};
  for (CsvRow row; reader.next(row);) {
    auto& fields = all.emplace_back();
    for (std::size_t i = 0; i < row.size(); ++i) fields.emplace_back(row[i]);
  }
  return all;
}

/// A reader of a text, at its first row.
struct Read {
  explicit Read(const std::string& text) : stream{text} { at_end = !reader.next(row); }

  std::istringstream stream;
  CsvReader reader{stream, "f.csv"};
  CsvRow row;
  bool at_end;
};

std::string refusal(const std::string& text) {
  return message_of<InputError>([&] { records(text); });
}

TEST(Csv, ReadsRecordsBelowTheHeader) {
  EXPECT_EQ(records("a,b\n1,2\n3,4\n"), (Records{{"a", "b"}, {"1", "2"}, {"3", "4"}}));
  EXPECT_EQ(records("a,b\n1,"), (Records{{"a", "b"}, {"1", ""}}));
  EXPECT_EQ(records("a,b"), (Records{{"a", "b"}}));
}

TEST(Csv, TakesEveryLineEndAlike) {
  const Records expected{{"a", "b"}, {"1", "2"}, {"3", "4"}};
  EXPECT_EQ(records("a,b\r\n1,2\r\n3,4\r\n"), expected);
  EXPECT_EQ(records("a,b\r1,2\r3,4"), expected);
  EXPECT_EQ(records("a,b\n1,2\r\n3,4"), expected);
}

TEST(Csv, SkipsBlankLinesAndCountsThem) {
  std::istringstream stream{"\n\na\n \n1\r\n\r\n\t\n2\n\"\"\n\n"};
  CsvReader reader{stream, "f.csv"};
  std::vector<std::pair<std::size_t, std::string>> rows;
  for (CsvRow row; reader.next(row);) rows.emplace_back(row.line(), row[0]);
  EXPECT_EQ(rows, (std::vector<std::pair<std::size_t, std::string>>{{5, "1"}, {8, "2"}, {9, ""}}));
}

TEST(Csv, TheSeparatorIsThatOfTheHeaderOutsideQuotes) {
  EXPECT_EQ(records(" \n\"a,b\"\tc\n1,5\t2"), (Records{{"a,b", "c"}, {"1,5", "2"}}));
  EXPECT_EQ(records("\"a\tx\ny\",b\n1,2"), (Records{{"a\tx\ny", "b"}, {"1", "2"}}));
  EXPECT_EQ(records(" \n\"a\tb\"\n1\n"), (Records{{"a\tb"}, {"1"}}));
  EXPECT_EQ(records("a;\"b,c\";d\n1,5;2;x"), (Records{{"a", "b,c", "d"}, {"1,5", "2", "x"}}));
  EXPECT_EQ(records("a;b\tc\n1;2\t3"), (Records{{"a;b", "c"}, {"1;2", "3"}}));
  EXPECT_EQ(records("sep=;\na;b\n1;2"), (Records{{"a", "b"}, {"1", "2"}}));
  EXPECT_EQ(records("\"3\"\";\",A\n1,2"), (Records{{"3\";", "A"}, {"1", "2"}}));
  EXPECT_EQ(records("\"sep=\",\n1,2"), (Records{{"sep=", ""}, {"1", "2"}}));
}

TEST(Csv, TrimsTheHeaderOnly) { EXPECT_EQ(records(" a ,\tb\n 1 , 2"), (Records{{"a", "b"}, {" 1 ", " 2"}})); }

TEST(Csv, DropsTheByteOrderMark) {
  EXPECT_EQ(records("\xEF\xBB\xBF"
                    "a,b\n1,2"),
            (Records{{"a", "b"}, {"1", "2"}}));
}

TEST(Csv, ReadsQuotedFields) {
  EXPECT_EQ(records("\"a\",b\n\"x, y\",\"say \"\"hi\"\"\"\n"), (Records{{"a", "b"}, {"x, y", "say \"hi\""}}));
  EXPECT_EQ(records("a,b\n \"1\" ,\t\"\"\n"), (Records{{"a", "b"}, {"1", ""}}));
  EXPECT_EQ(records("a,b\n5\" gun,2\n"), (Records{{"a", "b"}, {"5\" gun", "2"}}));
}

TEST(Csv, CountsTheLinesInsideQuotes) {
  Read read{"a,b\n\"1\n2\r\n3\r4\",x\n5,6\n"};
  auto& row = read.row;
  EXPECT_EQ(row[0], "1\n2\r\n3\r4");
  EXPECT_EQ(row.line(), 2U);
  ASSERT_TRUE(read.reader.next(row));
  EXPECT_EQ(row.line(), 6U);
  EXPECT_FALSE(read.reader.next(row));
}

TEST(Csv, RefusesWhatHasNoHeader) {
  for (const char* text : {"", "\n", " \r\n\t\n", "\xEF\xBB\xBF"})
    EXPECT_EQ(refusal(text),
              "f.csv: is empty: expected a line with the names of the columns; see whether it was written whole");
}

TEST(Csv, RefusesTwoColumnsOfOneName) {
  EXPECT_EQ(refusal("a,b, a\n"),
            "f.csv:1: two columns are named 'a'; rename one of them, or, if the first row is of "
            "data, put a row of names above it");
  EXPECT_EQ(records("a,,\n1,2,3"), (Records{{"a", "", ""}, {"1", "2", "3"}}));
}

TEST(Csv, RefusesRaggedRecordsWithLineAndCounts) {
  const std::string told = " as in the header; add or drop commas; text with commas stands in quotes";
  EXPECT_EQ(refusal("a,b,c\n1,2,3\n\n4,5\n"), "f.csv:4: found 2 fields, expected 3" + told);
  EXPECT_EQ(refusal("a\n1,\n"), "f.csv:2: found 2 fields, expected 1" + told);
}

TEST(Csv, SaysThatAFileMayBeCutOff) {
  const std::string told = " as in the header; the file ends within this line: see whether it is whole";
  EXPECT_EQ(refusal("a,b,c\n1,2,3\n4,5"), "f.csv:3: found 2 fields, expected 3" + told);
}

TEST(CsvField, StandsInQuotesWhereItNeedsThem) {
  EXPECT_EQ(csv_field("plain text"), "plain text");
  EXPECT_EQ(csv_field(""), "");
  for (const std::string text : {"a,b", "say \"a\"", "two\nlines", " blank", "blank\t", "\r"})
    EXPECT_EQ(records("h\n" + csv_field(text) + "\n"), (Records{{"h"}, {text}}));
}

TEST(Csv, RefusesAnOpenQuote) {
  const std::string whole = "; see whether the file is whole, and write a quote inside quotes twice";
  EXPECT_EQ(refusal("a,b\n1,2\n\n3,\"4\n5,6\n"),
            "f.csv:4: the quote opened here is not closed at the end of the file" + whole);
  EXPECT_EQ(refusal("\"a"), "f.csv:1: the quote opened here is not closed at the end of the file" + whole);
  EXPECT_EQ(refusal("a\n1\n\"" + std::string(2 << 20, '\n')),
            "f.csv:3: the record that starts here is longer than 1 MiB; look for a quote that is left open");
}

TEST(Csv, RefusesTextAfterAClosingQuote) {
  EXPECT_EQ(
      refusal("a,b\n\"1\"2,3\n"),
      "f.csv:2: found '2' after a closing quote, expected the next field or the end of the line; write a quote inside "
      "quotes twice");
}

TEST(Csv, RefusesWhatIsNotText) {
  EXPECT_EQ(refusal(std::string{"a,b\n1,\0\n", 8}), "f.csv:2: found a zero byte, expected UTF-8 text");
  EXPECT_EQ(refusal(std::string{"\xFF\xFE"
                                "a\0",
                                4}),
            "f.csv: found UTF-16 text, expected UTF-8; convert it");
  EXPECT_EQ(refusal("a\n" + std::string(2 << 20, ',')),
            "f.csv:2: the record that starts here is longer than 1 MiB; look for a quote that is left open");
}

TEST(Csv, FindsColumnsByName) {
  const Read read{"time_s,\"altitude (m)\",\n1,2,3"};
  EXPECT_EQ(read.reader.column("altitude (m)"), 1U);
  EXPECT_EQ(read.reader.find("time_s"), 0U);
  EXPECT_EQ(read.reader.find("Time_s"), std::nullopt);
  EXPECT_EQ(read.reader.find(""), std::nullopt);
  EXPECT_EQ(message_of<InputError>([&] { read.reader.column("x_m"); }),
            "f.csv: there is no column 'x_m'; the columns are time_s, altitude (m), ");
}

TEST(Csv, SkipsLinesOfWords) {
  EXPECT_EQ(records("# 1\n\n#\na;b\n1;2\n# low\n#;3\n"), (Records{{"a", "b"}, {"1", "2"}, {"#", "3"}}));
  EXPECT_EQ(records("# a,b\n1,2\n"), (Records{{"# a", "b"}, {"1", "2"}}));  // a header
}

TEST(Csv, ReadsNumbers) {
  Read read{"a,b,c\n +1.5 ,-2e3,\"7\"\n"};
  auto& row = read.row;
  EXPECT_EQ(row.number(0), 1.5);
  EXPECT_EQ(row.number(1), -2000.0);
  EXPECT_EQ(row.number(2), 7.0);
}

TEST(Csv, RefusesWhatIsNoNumberWithFileLineAndColumn) {
  std::istringstream stream{"t,x_m\n\n1,2\n3,4m\n5,nan\n6,-inf\n7, \n8,\"1,5\"\n"};
  CsvReader reader{stream, "f.csv"};
  CsvRow row;
  const auto refused = [&] {
    EXPECT_TRUE(reader.next(row));
    return message_of<InputError>([&] { row.number(1); });
  };
  EXPECT_EQ(refused(), "nothing was thrown");
  const std::string expected = ", expected a finite number with a decimal point; correct the cell or drop the row";
  EXPECT_EQ(refused(), "f.csv:4: column 'x_m': found '4m'" + expected);
  EXPECT_EQ(refused(), "f.csv:5: column 'x_m': found 'nan'" + expected);
  EXPECT_EQ(refused(), "f.csv:6: column 'x_m': found '-inf'" + expected);
  EXPECT_EQ(refused(), "f.csv:7: column 'x_m': found an empty cell" + expected);
  EXPECT_EQ(refused(), "f.csv:8: column 'x_m': found '1,5'" + expected);
}

TEST(Csv, AnOptionalNumberMayBeAbsentButNotWrong) {
  Read read{"x,y,z\n, 2 ,two\n"};
  auto& row = read.row;
  EXPECT_EQ(row.optional_number(0), std::nullopt);
  EXPECT_EQ(row.optional_number(1), 2.0);
  EXPECT_EQ(
      message_of<InputError>([&] { row.optional_number(2); }),
      "f.csv:2: column 'z': found 'two', expected a finite number with a decimal point; leave the cell empty where "
      "there is none");
}

TEST(Csv, LetsTheCallerRefuseAField) {
  Read read{"range_m\n-1\n"};
  auto& row = read.row;
  EXPECT_EQ(std::string{row.error(0, "a range above zero", "drop the row").what()},
            "f.csv:2: column 'range_m': found '-1', expected a range above zero; drop the row");
}

TEST(Csv, KnowsHowFarItIs) {
  const TemporaryDirectory directory;
  const std::string text =
      "\xEF\xBB\xBF"
      "a,b\r\n1,2\r\n3,4\r\n";
  CsvReader reader{directory.write("f.csv", text)};
  CsvRow row;
  EXPECT_EQ(reader.bytes_total(), text.size());
  EXPECT_EQ(reader.bytes_read(), 8U);
  ASSERT_TRUE(reader.next(row));
  EXPECT_EQ(reader.bytes_read(), 13U);
  ASSERT_TRUE(reader.next(row));
  EXPECT_FALSE(reader.next(row));
  EXPECT_EQ(reader.bytes_read(), text.size());

  std::istringstream stream{"a\n1\n"};
  EXPECT_EQ((CsvReader{stream, "f.csv"}.bytes_total()), std::nullopt);
}

TEST(Csv, SaysThatReadingFailed) {
  struct Broken : std::streambuf {
    int_type underflow() override { throw 1; }
  } broken;
  std::istream stream{&broken};
  EXPECT_TRUE(message_of<InputError>([&] { CsvReader{stream, "f.csv"}; }).starts_with("f.csv: cannot be read: "));
}

TEST(Csv, CanBeMovedBetweenRecords) {
  const TemporaryDirectory directory;
  CsvReader first{directory.write("f.csv", "a\n1\n2\n")};
  CsvRow row;
  ASSERT_TRUE(first.next(row));
  CsvReader second = std::move(first);
  EXPECT_EQ(row.number(0), 1.0);
  ASSERT_TRUE(second.next(row));
  EXPECT_EQ(row.number(0), 2.0);
}

/// Makes rows "i,…" as they are asked for, so that the whole never exists.
class Endless : public std::streambuf {
 public:
  explicit Endless(std::uint64_t rows) : rows_(rows), text_("i,x,name\n") { reset(); }

 private:
  int_type underflow() override {
    if (row_ == rows_) return traits_type::eof();
    text_ = std::to_string(row_) + "," + std::to_string(0.5 * static_cast<double>(row_)) + ",\"a, b\"\n";
    ++row_;
    reset();
    return traits_type::to_int_type(text_[0]);
  }
  void reset() { setg(text_.data(), text_.data(), text_.data() + text_.size()); }

  std::uint64_t rows_;
  std::uint64_t row_ = 0;
  std::string text_;
};

TEST(Csv, StreamsAMillionRows) {
  Endless rows{1'000'000};
  std::istream stream{&rows};
  CsvReader reader{stream, "f.csv"};
  const std::size_t i = reader.column("i");
  const std::size_t x = reader.column("x");
  double sum_i = 0.0;
  double sum_x = 0.0;
  CsvRow row;
  while (reader.next(row)) {
    sum_i += row.number(i);
    sum_x += row.number(x);
  }
  EXPECT_EQ(row.line(), 1'000'002U);
  EXPECT_EQ(sum_i, 499'999'500'000.0);
  EXPECT_EQ(sum_x, 249'999'750'000.0);
}

}  // namespace csv_test
