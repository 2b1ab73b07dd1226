#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/packed.hpp"

namespace sigmax::apps {
namespace {

struct Report {
  std::string name;
  std::optional<double> found;
  std::vector<std::string> words;
};

template <class Pack>
void members(Pack& pack, Report& report) {
  pack(report.name, report.found, report.words);
}

TEST(Packed, ValuesComeOutAsTheyWentIn) {
  std::vector<Report> reports = {{"a, \n\"b\"", -0.0, {}}, {std::string("\0x", 2), std::nullopt, {"", "two"}}};
  double unknown = std::numeric_limits<double>::quiet_NaN();
  int last = -7;
  Packer packer;
  packer(reports, unknown, last);

  std::vector<Report> found = {{"what was there before", 1.0, {"gone"}}};
  double number = 0.0;
  int end = 0;
  Unpacker unpacker(packer.bytes);
  unpacker(found, number);
  EXPECT_FALSE(unpacker.empty());
  unpacker(end);
  EXPECT_TRUE(unpacker.empty());
  ASSERT_EQ(found.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(found[i].name, reports[i].name);
    EXPECT_EQ(found[i].found, reports[i].found);
    EXPECT_EQ(found[i].words, reports[i].words);
  }
  EXPECT_NE(number, number);
  EXPECT_EQ(end, -7);
}

TEST(Packed, WhatIsCutOffIsRefused) {
  std::string text = "sixteen letters.";
  Packer packer;
  packer(text);
  for (std::size_t size = 0; size < packer.bytes.size(); ++size)
    EXPECT_THROW(Unpacker(packer.bytes.substr(0, size))(text), std::out_of_range) << size;
}

}  // namespace
}  // namespace sigmax::apps
