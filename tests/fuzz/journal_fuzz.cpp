// Any bytes are a journal or an error that names the file. A journal that was cut off holds some of the same cells;
// after it was opened, appended to, and torn off again, it holds the old cells and the new one, and finished it reads
// the same. The bytes behind the first zero are a --shard.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

#include "fuzz/memory_file.hpp"
#include "fuzz/require.hpp"
#include "study/journal.hpp"
#include "study/study.hpp"
#include "support/error.hpp"
#include "support/input.hpp"

namespace {

using namespace sigmax::apps;
using sigmax::fuzz::MemoryFile;
using sigmax::fuzz::require;

/// A journal of these cells in their order; numbers that are none equal each other here.
std::string text_of(const std::string& study, const CellRows& rows) {
  std::string text = study + "\n";
  for (const auto& [cell, row] : rows) text += journal_line(cell, row);
  return text;
}

void check_cut(const Journaled& whole, std::string_view text, const MemoryFile& file) {
  const auto end_of_first = text.find('\n') + 1;
  const Journaled cut = read_journal(file.holding(text.substr(0, std::max(end_of_first, text.size() / 2))));
  require(cut.study == whole.study, "a journal cut off is of the same study");
  for (const auto& [cell, row] : cut.rows) require(whole.rows.contains(cell), "a journal cut off has no other cells");
}

void check_opened(const Journaled& journal, std::string_view text, const MemoryFile& file) {
  CellRows rows = journal.rows;
  const std::size_t cell = rows.empty() ? 0 : rows.begin()->first / 2;
  file.holding(text);
  {
    Journal opened(file.path(), journal.study);
    require(text_of("", opened.rows()) == text_of("", rows), "an opened journal has the cells of the file");
    opened.append({{cell, {1.0 / 3.0, -0.0}}});
  }
  rows[cell] = {1.0 / 3.0, -0.0};
  std::ofstream(file.path(), std::ios::app) << "7,0.25,0.1";  // as if killed in the middle of a line
  Journal opened(file.path(), journal.study);
  require(text_of("", opened.rows()) == text_of("", rows), "a cell is kept, and what was torn off is not");
  opened.finish();
  const std::string sorted = read_text(file.path());
  require(sorted == text_of(journal.study, rows), "a finished journal has its cells in their order");
  const Journaled again = read_journal(file.path());
  require(text_of(again.study, again.rows) == sorted, "a journal reads the same when written out again");
}

void check_shard(const std::string& text) {
  Sharing sharing;
  CLI::App app;
  add_shard(app, sharing);
  try {
    app.parse(std::vector<std::string>{"--shard=" + text});
  } catch (const CLI::ParseError&) {
    return;
  }
  require(sharing.shard < sharing.shards, "a shard is one of all");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const MemoryFile file;
  const std::string_view bytes{reinterpret_cast<const char*>(data), size};
  const std::string_view text = bytes.substr(0, bytes.find('\0'));
  if (text.size() < bytes.size()) check_shard(std::string{bytes.substr(text.size() + 1)});
  Journaled journal;
  try {
    journal = read_journal(file.holding(text));
  } catch (const InputError& error) {
    require(std::string_view{error.what()}.starts_with(file.path().native()), "an error names the file");
    return 0;
  }
  check_cut(journal, text, file);
  check_opened(journal, text, file);
  return 0;
}
