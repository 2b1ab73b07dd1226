#include "report/result.hpp"

#include <cstdio>
#include <system_error>

#include <nlohmann/json.hpp>

#include "shell/progress.hpp"
#include "version.hpp"

namespace sigmax::apps {
namespace {

void refuse_input(const std::string& option, const std::string& given, const std::filesystem::path& file,
                  const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    std::error_code ignored;
    if (std::filesystem::equivalent(file, input == "-" ? "/dev/stdin" : input, ignored))
      throw UsageError("{} {} would write over the input {}; choose another place", option, given, input);
  }
}

void refuse_standard_output(const std::string& option, const std::string& file) {
  if (file == "-")
    throw UsageError("{}: the standard output takes only what is printed: found '-'; give a name, or /dev/stdout",
                     option);
}

}  // namespace

std::size_t OutputOptions::width() const {
  return wide ? any_width : std::max(terminal_width, columns_of(STDOUT_FILENO));
}

void add_quiet(Subcommand app, bool& quiet) { app.flag("--quiet", quiet, "No progress bar"); }

void add_wide(Subcommand app, bool& wide) {
  app.flag("--wide", wide, "Tables with one line a row, however long; else they take the columns of the terminal");
}

void add_results(Subcommand app, OutputOptions& options, const std::string& command) {
  options.command = command;
  app.option("--out", options.out, "Directory for the result files").type("DIR");
  add_quiet(app, options.quiet);
  add_wide(app, options.wide);
  app.option("--report", options.report, "File for the charts, a page for a browser [report.html in DIR]").type("FILE");
}

void refuse_to_overwrite(const std::string& option, const std::string& file, const std::vector<std::string>& inputs) {
  refuse_standard_output(option, file);
  refuse_input(option, file, file, inputs);
}

void refuse_to_overwrite(const OutputOptions& options, const std::vector<std::string>& inputs,
                         std::vector<std::string> names) {
  names.insert(names.end(), {"summary.json", report_data_name, report_name});
  if (!options.out.empty())
    for (const std::string& name : names)
      refuse_input("--out", options.out, std::filesystem::path(options.out) / name, inputs);
  refuse_to_overwrite("--report", options.report, inputs);
  refuse_to_overwrite("--summary", options.summary, inputs);
}

ResultFiles::ResultFiles(const OutputOptions& options) : wide_(options.wide) {
  if (!options.report.empty() && !has_reports())
    throw UsageError(
        "--report: this program was built without charts; install libjs-dygraphs and node-d3, and build again");
  refuse_standard_output("--out", options.out);
  refuse_standard_output("--report", options.report);
  if (!options.out.empty()) directory_ = output_directory(options.out);
  if (!options.report.empty()) report_.emplace(options.report);
  if (!options.summary.empty()) summary_.emplace(options.summary);
}

AtomicFile* ResultFiles::open(const std::string& name) {
  if (!wanted()) return nullptr;
  names_.push_back(name);
  return &files_.emplace_back(directory_ / name);
}

void ResultFiles::write(const std::string& name, std::string_view text) {
  if (AtomicFile* const file = open(name)) file->write(text);
}

bool ResultFiles::report_wanted() const { return report_ || (wanted() && has_reports()); }

void ResultFiles::write_summary(std::string_view text) {
  if (summary_)
    summary_->write(text);
  else
    write("summary.json", text);
}

void ResultFiles::write_report(const Report& report) {
  write(report_data_name, dumped(data_of(report)) + "\n");
  if (report_)
    report_->write(html(report));
  else if (has_reports())
    write(report_name, html(report));
}

void ResultFiles::commit() {
  std::vector<AtomicFile*> all;
  for (AtomicFile& file : files_) all.push_back(&file);
  std::vector<std::string> written;
  if (!names_.empty())
    written.push_back(fmt::format("{}{}{} to {}", fmt::join(names_.begin(), names_.end() - 1, ", "),
                                  names_.size() > 1 ? " and " : "", names_.back(), directory_.native()));
  for (auto* const file : {&summary_, &report_}) {
    if (!*file) continue;
    all.push_back(&**file);
    written.push_back((*file)->path().native());
  }
  if (all.empty()) return;
  for (AtomicFile* const file : all) file->store();
  for (AtomicFile* const file : all) file->commit();
  const std::string words = fmt::format("Wrote {}", fmt::join(written, ", and "));
  fmt::print("\n{}", wrapped(printable(words), wide_ ? any_width : terminal_width));
}

RowFile::RowFile(ResultFiles& files, const std::string& name, const std::vector<std::string>& keys)
    : table_(ResultTable::of_keys(keys)), file_(files.open(name)) {
  if (file_) file_->write(table_.csv_header());
}

Result::Result(const OutputOptions& options)
    : words_width(options.wide ? any_width : terminal_width),
      options_(options),
      summary_(std::make_shared<Json>(Json{{"version", version}, {"command", options.command}})) {
  page.command = options.command;
}

void Result::say(std::string_view words) { text += wrapped(words, words_width); }

void Result::say(const std::vector<std::pair<bool, std::string>>& notes) {
  for (const auto& [holds, words] : notes)
    if (holds) say(words);
}

void Result::add(const ResultTable& table, const Places& places) {
  if (places.printed && !places.heading.empty()) text += "\n" + places.heading;
  if (places.printed) text += "\n" + table.text(options_.width());
  if (!places.csv.empty()) tables_.emplace_back(places.csv, table.csv());
  if (!places.summary.empty()) at(places.summary) = table.json();
  if (!places.title.empty()) page.last.emplace_back(ReportTable{places.title, table, places.note});
}

Json& Result::at(const Path& path) {
  Json* value = summary_.get();
  for (const auto& step : path) value = std::visit([&](const auto& key) { return &(*value)[key]; }, step);
  return *value;
}

void Result::fact(const Path& path, const Cell& value) { at(path) = as_json(value); }

void Result::fact(const Path& path, const std::vector<std::string>& words) { at(path) = words; }

void Result::publish(ResultFiles& files) {
  std::fputs(text.c_str(), stdout);
  for (const auto& [name, rows] : tables_) files.write(name, rows);
  if (files.wanted() && files.report_wanted()) fact({"report_data"}, report_data_name);
  files.write_summary(dumped(*summary_, 2) + "\n");
  if (files.report_wanted()) files.write_report(page);
  files.commit();
}

}  // namespace sigmax::apps
