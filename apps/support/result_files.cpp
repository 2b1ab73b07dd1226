#include "support/result_files.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "support/error.hpp"
#include "version.hpp"

namespace sigmax::apps {

ResultFiles::ResultFiles(const OutputOptions& options) {
  if (!options.report.empty() && !has_reports())
    throw UsageError(message({.what = "--report: this program was built without charts",
                              .remedy = "install libjs-dygraphs and node-d3, and build again"}));
  if (!options.out.empty()) directory_.emplace(options.out);
  if (!options.report.empty()) report_.emplace(options.report);
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

bool ResultFiles::report_wanted() const { return report_ || (wanted() && has_reports()); }

void ResultFiles::write_report(const Report& report) {
  write(report_data_name, data_of(report).dump() + "\n");
  if (report_)
    report_->write(html(report));
  else
    write(report_name, html(report));
}

void ResultFiles::commit() {
  if (files_.empty() && !report_) return;
  for (AtomicFile& file : files_) file.store();
  if (report_) report_->store();
  for (AtomicFile& file : files_) file.commit();
  if (report_) report_->commit();
  std::vector<std::string> written;
  if (!names_.empty())
    written.push_back(fmt::format("{}{}{} to {}", fmt::join(names_.begin(), names_.end() - 1, ", "),
                                  names_.size() > 1 ? " and " : "", names_.back(), directory_->path().native()));
  if (report_) written.push_back(report_->path().native());
  fmt::print("\nWrote {}\n", fmt::join(written, ", and "));
}

nlohmann::ordered_json summary_of(const OutputOptions& options) {
  return {{"version", version}, {"command", options.command}};
}

}  // namespace sigmax::apps
