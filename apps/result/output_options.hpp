#pragma once

#include <cstddef>
#include <string>

#include "support/text.hpp"

namespace CLI {
class App;
}

namespace sigmax::apps {

/// Where results go, and how they look; the same for every subcommand.
struct OutputOptions {
  std::string out;        ///< a directory for files, or empty
  std::string report;     ///< the file of the report, or empty: that of the directory, if there is one
  std::string plots;      ///< a directory for the report's pictures as SVG and PDF, or empty
  bool quiet = false;     ///< no progress bar
  bool wide = false;      ///< rows of tables are not broken
  bool no_chart = false;  ///< on the terminal
  std::string command;    ///< as typed, for the record

  std::size_t width() const { return wide ? any_width : terminal_width; }
};

/// --out, --quiet and --wide; --report and --plots; --no-chart.
void add_output(CLI::App& app, OutputOptions& options);
void add_report(CLI::App& app, OutputOptions& options);
void add_no_chart(CLI::App& app, bool& no_chart);
void add_quiet(CLI::App& app, bool& quiet);
void add_wide(CLI::App& app, bool& wide);

}  // namespace sigmax::apps
