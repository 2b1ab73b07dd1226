// Any bytes are settings whose values read the same when written out again, or an error. The bytes up to the first zero
// are a file, those between further zeros a `--set` each.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "fuzz/memory_file.hpp"
#include "fuzz/require.hpp"
#include "support/settings.hpp"

namespace {

using namespace sigmax::apps;
using sigmax::fuzz::MemoryFile;
using sigmax::fuzz::require;

/// A key in quotes, as TOML has it.
std::string key_text(std::string_view key) {
  std::string text = "\"";
  for (const char byte : key) {
    const auto code = static_cast<unsigned char>(byte);
    if (code < 0x20U || code == 0x7FU || byte == '"' || byte == '\\')
      text += fmt::format("\\u{:04X}", code);
    else
      text += byte;
  }
  return text += '"';
}

/// Reads a value by every type: those that it has.
struct Types {
  bool number = false, integer = false, boolean = false, string = false, strings = false, numbers = false,
       matrix = false, table = false;

  friend bool operator==(const Types&, const Types&) = default;
};

template <class Read>
bool can(const Read& read) {
  try {
    return static_cast<bool>(read());
  } catch (const InputError& error) {
    require(error.what()[0] != '\0', "an error says something");
    return false;
  }
}

/// Leaves the value in force in the narrowest type that it has.
Types types_of(const Settings& settings, const std::string& key) {
  Types types;
  types.number = can([&] { return settings.number(key).has_value(); });
  types.integer = can([&] { return settings.integer(key).has_value(); });
  types.boolean = can([&] { return settings.boolean(key).has_value(); });
  types.string = can([&] { return settings.string(key).has_value(); });
  types.strings = can([&] { return settings.strings(key).has_value(); });
  types.numbers = can([&] { return settings.numbers(key).has_value(); });
  types.matrix = can([&] { return settings.matrix(key).has_value(); });
  types.table = can([&] { return settings.sub(key), true; });
  require(!types.number || std::isfinite(*settings.number(key)), "a number is finite");
  require(!types.string || settings.string(key).has_value(), "a string can be read twice");
  require((!types.number || types.numbers) && (!types.string || types.strings), "one value is a list of one");
  require(types.number + types.boolean + types.string + types.table <= 1, "a value has one type");
  return types;
}

/// The values as `in_force` writes them are TOML and mean the same.
void check_values(const Settings& settings, const MemoryFile& file) {
  for (const auto& key : settings.names()) {
    require(settings.has(key), "a name is a key");
    const Types types = types_of(settings, key);
    if (types.table) {
      check_values(settings.sub(key), file);
      continue;
    }
    const auto& in_force = settings.in_force();
    if (in_force.empty() || in_force.back().first != key) continue;  // of no type that settings have
    const std::string value = in_force.back().second;
    const Settings again = Settings::read(file.holding(key_text(key) + " = " + value));
    require(types_of(again, key) == types, "a value written out again has the same types");
    require(again.in_force().back() == std::pair{key, value}, "a value reads the same when written out again");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const MemoryFile file;
  std::vector<std::string> parts{{}};
  for (std::size_t i = 0; i < size; ++i)
    if (data[i] == 0)
      parts.emplace_back();
    else
      parts.back() += static_cast<char>(data[i]);

  Settings settings;
  try {
    settings = Settings::read(file.holding(parts[0]), std::span{parts}.subspan(1));
  } catch (const InputError& error) {
    require(error.what()[0] != '\0', "an error says something");
    return 0;
  } catch (const UsageError& error) {
    require(error.what()[0] != '\0', "an error says something");
    return 0;
  }
  require(can([&] { return settings.refuse_unknown(), true; }) == settings.names().empty(),
          "a key that nobody asked for is refused");
  check_values(settings, file);
  require(can([&] { return settings.refuse_unknown(), true; }), "what was asked for is known");
  return 0;
}
