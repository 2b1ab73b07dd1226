// Any bytes are a journal or an error that names the file; so they are when each of their lines gets its checksum. A
// journal that was cut off holds some of the same cells; one that was changed in a byte is refused, unless that tore
// off its end; after it was opened, appended to, and torn off again, it holds the old cells and the new one, and
// finished it reads the same. The bytes behind the first zero are a --shard.
#include <CLI/CLI.hpp>

#include "fuzz/memory_file.hpp"
#include "shell/files.hpp"
#include "shell/text.hpp"
#include "study/study.hpp"

namespace {

/// A journal of these cells in their order; numbers that are none equal each other here.
std::string text_of(const std::string& study, const CellRows& rows) {
  std::string text = sealed(study);
  for (const auto& [cell, row] : rows) text += journal_line(cell, row);
  return text;
}

/// The text with a checksum behind each whole line.
std::string with_seals(std::string_view text) {
  std::string result;
  for (std::size_t end = 0; (end = text.find('\n')) != std::string_view::npos; text.remove_prefix(end + 1))
    result += sealed(text.substr(0, end));
  return result.append(text);
}

/// The journal that a text is, or none.
std::optional<Journaled> read(std::string_view text, const MemoryFile& file) {
  try {
    return read_journal(file.holding(text));
  } catch (const InputError& error) {
    require(std::string_view{error.what()}.starts_with(file.path().native()), "an error names the file");
    return {};
  }
}

void check_changed(std::string text, std::size_t at, const MemoryFile& file) {
  text[at] = static_cast<char>(text[at] ^ 1);
  const auto changed = read(text, file);
  if (!changed) return;
  const Journaled cut = read_journal(file.holding(text.substr(0, at)));
  require(text_of(changed->study, changed->rows) == text_of(cut.study, cut.rows), "no change is read as a number");
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
  read(text, file);
  const std::string with = with_seals(text);
  const auto journal = read(with, file);
  if (!journal) return 0;
  check_cut(*journal, with, file);
  check_changed(with, 997 * size % with.size(), file);
  check_opened(*journal, with, file);
  return 0;
}
