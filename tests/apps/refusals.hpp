#pragma once

#include <nlohmann/json.hpp>

#include "apps/temporary_directory.hpp"
#include "support/program.hpp"

namespace sigmax::apps {

using Files = std::map<std::string, std::string>;

/// A command that a program refuses, run by a shell in a directory of `files`, and words of the one line that it says.
struct Refusal {
  std::string name, run;
  Files files;
  int status;
  std::vector<std::string> says;

  friend void PrintTo(const Refusal& refusal, std::ostream* text) { *text << refusal.run; }
};

/// The cases of a table in JSON: how each differs from `usual`. A pair of texts is what is replaced in the usual file.
inline std::vector<Refusal> refusals(const std::string& table, const Refusal& usual) {
  std::vector<Refusal> result;
  std::ifstream file(SIGMAX_SOURCE "/tests/apps/" + table);
  const auto cases = nlohmann::ordered_json::parse(file, nullptr, true, true);  // with comments
  for (const auto& [name, fields] : cases.items()) {
    Refusal& refusal = result.emplace_back(usual);
    refusal.name = name;
    for (const auto& [key, value] : fields.items()) {
      if (key == "run") {
        refusal.run = value;
      } else if (key == "status") {
        refusal.status = value;
      } else if (key == "says") {
        refusal.says = value;
      } else if (value.is_string()) {
        refusal.files[key] = value;
      } else {
        std::string& text = refusal.files.at(key);
        text.replace(text.find(value.at(0)), value.at(0).template get<std::string>().size(), value.at(1));
      }
    }
  }
  return result;
}

/// What is refused is explained, in one line unless the command itself was wrong or something else is printed, and no
/// file is written.
inline void expect_refused(const Refusal& refusal, const std::string& program, bool prints_too = false) {
  const TemporaryDirectory directory;
  for (const auto& [name, text] : refusal.files) directory.write(name, text);
  const std::string name = std::filesystem::path(program).filename();
  const auto ending = program::run("/bin/sh", {"-c", "cd \"$1\"; " + name + "() { \"$0\" \"$@\"; }; " + refusal.run,
                                               program::chosen(program), directory.path()});
  EXPECT_EQ(ending.status, refusal.status) << ending.output;
  for (const auto& words : refusal.says)
    EXPECT_NE(ending.output.find(words), std::string::npos) << "no '" << words << "' in: " << ending.output;
  if (refusal.status == 3) {
    EXPECT_TRUE(says(ending.output, {name + ": "}));
    if (!prints_too) {
      EXPECT_EQ(std::count(ending.output.begin(), ending.output.end(), '\n'), 1) << ending.output;
    }
  }
  Files left;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory.path()))
    if (entry.is_regular_file()) left[std::filesystem::relative(entry.path(), directory.path())] = contents(entry);
  EXPECT_EQ(left, refusal.files);
}

}  // namespace sigmax::apps
