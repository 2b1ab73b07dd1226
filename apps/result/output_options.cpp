#include "result/output_options.hpp"

#include "result/pictures.hpp"
#include "support/options.hpp"

namespace sigmax::apps {

void add_quiet(CLI::App& app, bool& quiet) { Subcommand(app).flag("--quiet", quiet, "No progress bar"); }

void add_wide(CLI::App& app, bool& wide) {
  Subcommand(app).flag("--wide", wide,
                       "Tables with one line a row, however long, for terminals of more than 80 columns");
}

void add_output(CLI::App& app, OutputOptions& options) {
  Subcommand(app).option("--out", options.out, "Directory for the result files").type("DIR");
  add_quiet(app, options.quiet);
  add_wide(app, options.wide);
}

void add_report(CLI::App& app, OutputOptions& options) {
  Subcommand(app)
      .option("--report", options.report, "File for the charts, a page for a browser [report.html in DIR]")
      .type("FILE");
  const auto needs_gnuplot = [](const std::string&) {
    need_gnuplot();  // throws, before any work
    return std::string();
  };
  Subcommand(app)
      .option("--plots", options.plots, "Directory for the same charts as SVG and PDF, drawn by gnuplot")
      .type("DIR")
      .check(needs_gnuplot);
}

void add_no_chart(CLI::App& app, bool& no_chart) {
  Subcommand(app).flag("--no-chart", no_chart,
                       "No charts at the end, where the output is a terminal of 80 columns or more");
}

}  // namespace sigmax::apps
