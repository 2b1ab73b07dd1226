#include "support/result_files.hpp"

#include <filesystem>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "support/error.hpp"
#include "support/pictures.hpp"
#include "version.hpp"

namespace sigmax::apps {
namespace {

void refuse_input(const std::string& option, const std::string& given, const std::filesystem::path& file,
                  const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    std::error_code ignored;
    if (std::filesystem::equivalent(file, input == "-" ? "/dev/stdin" : input, ignored))
      throw UsageError(message({.what = fmt::format("{} {} would write over the input {}", option, given, input),
                                .remedy = "choose another place"}));
  }
}

}  // namespace

void refuse_to_overwrite(const std::string& option, const std::string& file, const std::vector<std::string>& inputs) {
  refuse_input(option, file, file, inputs);
}

void refuse_to_overwrite(const OutputOptions& options, const std::vector<std::string>& inputs,
                         std::vector<std::string> names) {
  names.insert(names.end(), {"summary.json", report_data_name, report_name});
  if (!options.out.empty())
    for (const std::string& name : names)
      refuse_input("--out", options.out, std::filesystem::path(options.out) / name, inputs);
  refuse_to_overwrite("--report", options.report, inputs);
  std::error_code ignored;
  for (const auto& chart : std::filesystem::directory_iterator(options.plots, ignored))
    if (chart.path().extension() == ".svg" || chart.path().extension() == ".pdf")
      refuse_input("--plots", options.plots, chart.path(), inputs);
}

ResultFiles::ResultFiles(const OutputOptions& options) {
  if (!options.report.empty() && !has_reports())
    throw UsageError(message({.what = "--report: this program was built without charts",
                              .remedy = "install libjs-dygraphs and node-d3, and build again"}));
  if (!options.plots.empty()) gnuplot_.emplace();
  if (!options.out.empty()) directory_.emplace(options.out);
  if (!options.report.empty()) report_.emplace(options.report);
  if (!options.plots.empty()) plots_.emplace(options.plots);
}

AtomicFile* ResultFiles::open(const std::string& name) {
  if (!wanted()) return nullptr;
  names_.push_back(name);
  return &files_.emplace_back(directory_->file(name));
}

void ResultFiles::write(const std::string& name, std::string_view text) {
  if (AtomicFile* const file = open(name)) file->write(text);
}

void ResultFiles::write_json(const std::string& name, const nlohmann::ordered_json& json) {
  if (wanted()) write(name, json.dump(2) + "\n");
}

bool ResultFiles::report_wanted() const { return report_ || plots_ || (wanted() && has_reports()); }

void ResultFiles::write_report(const Report& report) {
  write(report_data_name, data_of(report).dump() + "\n");
  if (report_)
    report_->write(html(report));
  else if (has_reports())
    write(report_name, html(report));
  if (!plots_) return;
  for (const Picture& picture : pictures_of(report)) {
    pictures_.emplace_back(picture.name + ".svg", gnuplot_->svg(picture));
    pictures_.emplace_back(picture.name + ".pdf", gnuplot_->pdf(picture));
  }
}

void ResultFiles::commit() {
  if (files_.empty() && !report_ && !plots_) return;
  for (AtomicFile& file : files_) file.store();
  if (report_) report_->store();
  for (AtomicFile& file : files_) file.commit();
  if (report_) report_->commit();
  for (const auto& [name, document] : pictures_) {
    AtomicFile file = plots_->file(name);
    file.write(document);
    file.commit();
  }
  std::vector<std::string> written;
  if (!names_.empty())
    written.push_back(fmt::format("{}{}{} to {}", fmt::join(names_.begin(), names_.end() - 1, ", "),
                                  names_.size() > 1 ? " and " : "", names_.back(), directory_->path().native()));
  if (report_) written.push_back(report_->path().native());
  if (plots_)
    written.push_back(fmt::format("{} charts as SVG and PDF to {}", pictures_.size() / 2, plots_->path().native()));
  fmt::print("\nWrote {}\n", printable(fmt::format("{}", fmt::join(written, ", and "))));
}

nlohmann::ordered_json summary_of(const OutputOptions& options) {
  return {{"version", version}, {"command", options.command}};
}

}  // namespace sigmax::apps
