// Any bytes are settings, or an error. The bytes up to the first zero are a file, those between further zeros a `--set`
// each.

#include "fuzz/memory_file.hpp"
#include "shell/settings.hpp"

namespace {

template <class Read>
bool can(const Read& read) {
  try {
    return static_cast<bool>(read());
  } catch (const InputError& error) {
    require(error.what()[0] != '\0', "an error says something");
    return false;
  }
}

/// Reads every value by every type.
void check_values(const Settings& settings) {
  for (const auto& key : settings.names()) {
    require(settings.has(key), "a name is a key");
    const bool number = can([&] { return settings.get<double>(key).has_value(); });
    const bool boolean = can([&] { return settings.get<bool>(key).has_value(); });
    const bool string = can([&] { return settings.get<std::string>(key).has_value(); });
    const bool strings = can([&] { return settings.get<std::vector<std::string>>(key).has_value(); });
    const bool numbers = can([&] { return settings.get<std::vector<double>>(key).has_value(); });
    const bool table = can([&] { return settings.sub(key), true; });
    can([&] { return settings.get<std::vector<std::vector<double>>>(key).has_value(); });
    require(!number || std::isfinite(*settings.get<double>(key)), "a number is finite");
    require((!number || numbers) && (!string || strings), "one value is a list of one");
    require(number + boolean + string + table <= 1, "a value has one type");
    if (table) check_values(settings.sub(key));
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
  check_values(settings);
  require(can([&] { return settings.refuse_unknown(), true; }), "what was asked for is known");
  return 0;
}
