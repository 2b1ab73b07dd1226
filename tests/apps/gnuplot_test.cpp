#include "support/gnuplot.hpp"

#include <gtest/gtest.h>

#include "apps/temporary_directory.hpp"
#include "support/error.hpp"
#include "support/program.hpp"
#include "support/throws.hpp"

namespace sigmax::apps {
namespace {

using sigmax::support::throws;

/// Tests of gnuplot itself skip, visibly, where it is not installed.
class InstalledGnuplot : public testing::Test {
 protected:
  void SetUp() override {
    try {
      gnuplot_.emplace();
    } catch (const UsageError& error) {
      GTEST_SKIP() << error.what();
    }
  }
  std::optional<Gnuplot> gnuplot_;
};

TEST(Gnuplot, TextsAreQuotedAndOnOneLine) {
  EXPECT_EQ(in_gnuplot("it's"), "'it''s'");
  EXPECT_EQ(in_gnuplot("a\nb\tc\x7F"), "'a b c '");
  EXPECT_EQ(in_gnuplot("\\n"), "'\\n'");
  EXPECT_EQ(in_gnuplot("a\xFF π"), "'a\xEF\xBF\xBD π'");
}

TEST_F(InstalledGnuplot, ShowsEachLetterAsItIs) {
  const TemporaryDirectory directory;
  const std::string file = directory.path() / "made";
  const std::string title = "a_b^2 {/Bold x} @y ~z \\n \"q\" 'r' `touch " + file + "` %d </text><b> & π";
  const std::string svg = gnuplot_->svg({"", "set title " + in_gnuplot(title) + "\nplot x title " + in_gnuplot(title)});
  std::string escaped;
  for (const char letter : title)
    escaped += letter == '<' ? std::string("&lt;") : letter == '&' ? std::string("&amp;") : std::string(1, letter);
  const std::string shown = "<text>" + escaped + "</text>";
  const auto first = svg.find(shown);
  ASSERT_NE(first, std::string::npos) << svg;
  EXPECT_NE(svg.find(shown, first + 1), std::string::npos) << "as title and in the legend";
  EXPECT_EQ(svg.find("<b>"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(InstalledGnuplot, WritesDocumentsWithoutTheTimeOfDay) {
  const Picture picture{"", "plot sin(x)", 8.0, 5.0};
  const std::string svg = gnuplot_->svg(picture), pdf = gnuplot_->pdf(picture);
  EXPECT_NE(svg.find("width=\"336\" height=\"210\""), std::string::npos);
  EXPECT_TRUE(pdf.starts_with("%PDF-"));
  EXPECT_EQ(pdf.find("CreationDate"), std::string::npos);
  EXPECT_EQ(pdf, gnuplot_->pdf(picture));
  // The table of places is where the document says.
  const auto place = pdf.rfind("startxref\n") + 10;
  EXPECT_EQ(pdf.compare(std::stoul(pdf.substr(place)), 4, "xref"), 0);
}

TEST_F(InstalledGnuplot, HandsOnWhatGnuplotComplainsOf) {
  EXPECT_TRUE(throws<std::runtime_error>([&] { gnuplot_->svg({"", "plot nothing\n"}); }, {"gnuplot", "undefined"}));
}

}  // namespace
}  // namespace sigmax::apps
