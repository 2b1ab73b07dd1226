#pragma once

#include <nlohmann/json.hpp>

#include "apps/temporary_directory.hpp"
#include "support/program.hpp"

namespace sigmax::apps {

/// The data that a page holds.
inline nlohmann::ordered_json data_in(const std::filesystem::path& page) {
  const std::string text = contents(page), begin = "<script type=\"application/json\" id=\"data\">";
  const auto from = text.find(begin) + begin.size();
  return nlohmann::ordered_json::parse(text.substr(from, text.find("</script>", from) - from));
}

/// Uses a page in headless Chromium (report_browser.py): it is drawn, nothing complains, zoom, hover, legend and
/// selector work, and the numbers of its tables are those of the summary. Skips without Chromium or python3-websocket.
inline void expect_drawn(const std::filesystem::path& page, const std::filesystem::path& summary = {}) {
  std::vector<std::string> arguments = {SIGMAX_SOURCE "/tests/apps/report_browser.py", page};
  if (!summary.empty()) arguments.push_back(summary);
  // The system's Python: that is where the Debian package python3-websocket is.
  const auto ending = program::run("/usr/bin/python3", arguments);
  if (ending.status == 77 || ending.status == 127) GTEST_SKIP() << "no browser: chromium and python3-websocket";
  EXPECT_EQ(ending.status, 0) << ending.output;
}

}  // namespace sigmax::apps
