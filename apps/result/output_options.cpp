#include "result/output_options.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "result/pictures.hpp"

namespace sigmax::apps {

void print_text(const OutputOptions& options, std::string_view text) {
  constexpr std::size_t wide_text = 120;  // longer lines are hard to read
  std::fputs(wrapped(text, options.wide ? wide_text : terminal_width).c_str(), stdout);
}

void add_quiet(CLI::App& app, bool& quiet) { app.add_flag("--quiet", quiet, "No progress bar"); }

void add_wide(CLI::App& app, bool& wide) {
  app.add_flag("--wide", wide, "Tables with one line a row, however long, for terminals of more than 80 columns");
}

void add_output(CLI::App& app, OutputOptions& options) {
  app.add_option("--out", options.out, "Directory for the result files")->type_name("DIR");
  add_quiet(app, options.quiet);
  add_wide(app, options.wide);
}

void add_report(CLI::App& app, OutputOptions& options) {
  app.add_option("--report", options.report, "File for the charts, a page for a browser [report.html in DIR]")
      ->type_name("FILE");
  const auto needs_gnuplot = [](const std::string&) {
    need_gnuplot();  // throws, before any work
    return std::string();
  };
  app.add_option("--plots", options.plots, "Directory for the same charts as SVG and PDF, drawn by gnuplot")
      ->type_name("DIR")
      ->check(CLI::Validator(needs_gnuplot, ""));
}

void add_no_chart(CLI::App& app, bool& no_chart) {
  app.add_flag("--no-chart", no_chart, "No charts at the end, where the output is a terminal of 80 columns or more");
}

}  // namespace sigmax::apps
