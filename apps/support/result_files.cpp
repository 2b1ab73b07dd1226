#include "support/result_files.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "version.hpp"

namespace sigmax::apps {

ResultFiles::ResultFiles(const OutputOptions& options) {
  if (!options.out.empty()) directory_.emplace(options.out);
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

void ResultFiles::commit() {
  if (files_.empty()) return;
  for (AtomicFile& file : files_) file.store();
  for (AtomicFile& file : files_) file.commit();
  std::string list = names_.front();
  for (std::size_t i = 1; i < names_.size(); ++i) list += (i + 1 == names_.size() ? " and " : ", ") + names_[i];
  fmt::print("\nWrote {} to {}\n", list, directory_->path().native());
}

nlohmann::ordered_json summary_of(const OutputOptions& options) {
  return {{"version", version}, {"command", options.command}};
}

}  // namespace sigmax::apps
