#include "shell/settings.hpp"

#include <cmath>
#include <set>
#include <sstream>

#include <toml++/toml.h>

#include "shell/files.hpp"

namespace sigmax::apps {

/// A file, or one `--set key=value`, whose single line needs no numbers.
struct Origin {
  std::string name;
  bool is_file = true;

  std::string place(const toml::source_region& region) const {
    if (!is_file || region.begin.line == 0) return name;
    return fmt::format("{}:{}:{}", name, region.begin.line, region.begin.column);
  }
};

namespace {

using Numbers = std::vector<double>;
using Matrix = std::vector<Numbers>;
using Strings = std::vector<std::string>;

std::string key_name(std::string_view key) { return "key " + in_quotes(key); }

std::string described(const toml::node& node) {
  if (const auto* string = node.as_string()) return "the string " + in_quotes(string->get());
  if (node.is_table()) return "a table";
  std::ostringstream text;
  text << toml::toml_formatter{node};
  return (node.is_array() ? "the array " : "") + in_quotes(text.str());
}

/// Converts one value and says where it stands if it cannot be.
struct Reader {
  const Origin& origin;
  std::string key;

  /// The name of the key within its table and a value, as they would stand in a file.
  std::string as_in(std::string_view value) const {
    return fmt::format("write it as in {} = {}", std::string_view{key}.substr(key.rfind('.') + 1), value);
  }

  InputError error(const toml::node& node, std::string_view expected, std::string_view remedy = {}) const {
    return InputError({.where = origin.place(node.source()),
                       .what = key_name(key),
                       .found = described(node),
                       .expected = expected,
                       .remedy = remedy});
  }

  void read(const toml::node& node, double& value) const {
    const auto number = node.is_number() ? node.value<double>() : std::nullopt;
    if (!number || !std::isfinite(*number))
      throw error(node, node.is_number() ? "a finite number" : "a number", as_in("3.5"));
    value = *number;
  }

  void read(const toml::node& node, bool& value) const { read_exactly(node, value, "true or false", "true"); }

  void read(const toml::node& node, std::string& value) const { read_exactly(node, value, "a string", "\"text\""); }

  template <class Value>
  void read_exactly(const toml::node& node, Value& value, std::string_view expected, std::string_view example) const {
    const auto* known = node.as<Value>();
    if (!known) throw error(node, expected, as_in(example));
    value = known->get();
  }

  void read(const toml::node& node, Strings& values) const {
    read_array(node, node.is_string(), values, "a string or an array of strings", R"(["one", "two"])");
  }

  void read(const toml::node& node, Numbers& values) const {
    read_array(node, node.is_number(), values, "a number or an array of numbers", "[1.0, 2.0]");
  }

  void read(const toml::node& node, Matrix& rows) const {
    constexpr std::string_view example = "[[1.0, 0.5], [0.5, 1.0]]";
    const auto* array = node.as_array();
    if (!array) throw error(node, "an array of rows, each an array of numbers", as_in(example));
    for (const auto& row : *array) {
      read_array(row, false, rows.emplace_back(), "a row, which is an array of numbers", example);
      if (rows.back().size() != rows.front().size())
        throw error(row, fmt::format("a row of {} numbers as the first", rows.front().size()),
                    "make all rows of the same length");
    }
  }

  /// The values of an array, or the one that stands for such.
  template <class Value>
  void read_array(const toml::node& node, bool is_one, std::vector<Value>& values, std::string_view expected,
                  std::string_view example) const {
    if (is_one) return read(node, values.emplace_back());
    const auto* array = node.as_array();
    if (!array) throw error(node, expected, as_in(example));
    for (const auto& element : *array) read(element, values.emplace_back());
  }
};

/// Refuses characters beyond ASCII except in comments and in strings of one line. Elsewhere they are no TOML or, in
/// strings of many lines, no use to settings, and toml++ may run into undefined behaviour (its issues 190 and 295).
void refuse_beyond_ascii(std::string_view text, const Origin& origin) {
  std::string_view closing;  // what ends the comment or the string; empty outside both
  std::size_t step = 1;
  for (std::size_t i = text.starts_with("\xEF\xBB\xBF") ? 3 : 0; i < text.size(); i += step) {
    const std::string_view rest = text.substr(i);
    step = 1;
    if (static_cast<unsigned char>(rest[0]) >= 0x80U && closing.size() != 1) {
      const std::string_view before = text.substr(0, i);
      const std::string_view line = before.substr(before.rfind('\n') + 1);
      const auto starts_character = [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; };
      toml::source_region region;
      region.begin.line = static_cast<toml::source_index>(1 + std::ranges::count(before, '\n'));
      region.begin.column = static_cast<toml::source_index>(1 + std::ranges::count_if(line, starts_character));
      throw InputError(
          {.where = origin.place(region), .what = "is not TOML", .remedy = "put characters beyond ASCII into quotes"});
    }
    if (closing.empty()) {
      if (rest[0] == '#') closing = "\n";
      for (const std::string_view quote : {"'", "\"", "'''", "\"\"\""})
        if (rest.starts_with(quote)) {
          closing = quote;
          step = quote.size();
        }
    } else if (closing[0] == '"' && rest[0] == '\\') {
      step = 2;
    } else if (rest.starts_with(closing)) {
      step = closing.size();
      // The last quotes of five close, and the others belong to the string.
      while (step > 1 && step < 5 && step < rest.size() && rest[step] == closing[0]) ++step;
      closing = {};
    }
  }
}

toml::table parsed(std::string_view text, const Origin& origin) {
  refuse_beyond_ascii(text, origin);
  try {
    return toml::parse(text, origin.name);
  } catch (const toml::parse_error& error) {
    throw InputError({.where = origin.place(error.source()), .what = "is not TOML", .remedy = error.description()});
  }
}

}  // namespace

/// One table of one origin. The keys asked for are kept here, since every view of the table adds to them.
struct Settings::Layer {
  Origin origin;
  std::shared_ptr<const toml::table> document;
  const toml::table* table = nullptr;
  std::string prefix{};
  std::set<std::string, std::less<>> asked{};
  std::map<std::string, std::shared_ptr<Layer>, std::less<>> children{};

  static std::shared_ptr<Layer> of(Origin origin, std::string_view text) {
    const auto document = std::make_shared<const toml::table>(parsed(text, origin));
    return std::make_shared<Layer>(Layer{std::move(origin), document, document.get()});
  }

  void require_table_if_any(std::string_view key) const {
    const auto* node = table->get(key);
    if (node && !node->is_table())
      throw reader(key).error(*node, "a table", fmt::format("write [{0}{1}], or {0}{1}.KEY = value", prefix, key));
  }

  /// After `require_table_if_any`.
  std::shared_ptr<Layer> child(std::string_view key) {
    const auto* node = table->get(key);
    if (!node) return nullptr;
    auto& known = children[std::string{key}];
    if (!known)
      known = std::make_shared<Layer>(Layer{origin, document, node->as_table(), fmt::format("{}{}.", prefix, key)});
    return known;
  }

  Reader reader(std::string_view key) const { return {origin, fmt::format("{}{}", prefix, key)}; }

  void refuse_unknown() const {
    for (const auto& [key, node] : *table)
      if (!asked.contains(key.str()))
        throw InputError({.where = origin.place(key.source()),
                          .what = "unknown " + key_name(fmt::format("{}{}", prefix, key.str())),
                          .remedy = suggestion(key.str(), asked, prefix)});
    for (const auto& [key, layer] : children) layer->refuse_unknown();
  }
};

Settings Settings::read(const std::filesystem::path& file, std::span<const std::string> sets) {
  Settings settings;
  if (!file.empty()) settings.layers_.push_back(Layer::of({file.string()}, read_text(file)));
  for (const std::string& set : sets) {
    const auto equals = set.find('=');
    const std::string_view key = trimmed(std::string_view{set}.substr(0, equals));
    const std::string_view value = equals == std::string::npos ? "" : trimmed(std::string_view{set}.substr(equals + 1));
    if (key.empty() || value.empty()) throw UsageError("--set: found {}, expected key=value", in_quotes(set));
    const std::string text = fmt::format("{} = {}", key, toml_value(value));
    settings.layers_.push_back(Layer::of({"--set " + set, false}, text));
  }
  return settings;
}

Settings Settings::parse(std::string_view text) {
  Settings settings;
  settings.layers_.push_back(Layer::of({"settings"}, text));
  return settings;
}

const Settings::Layer* Settings::find(std::string_view key) const {
  const Layer* found = nullptr;
  for (const auto& layer : layers_) {
    layer->asked.emplace(key);
    if (layer->table->contains(key)) found = layer.get();
  }
  return found;
}

bool Settings::has(std::string_view key) const { return find(key) != nullptr; }

template <class Value>
std::optional<Value> Settings::get(std::string_view key) const {
  const Layer* const layer = find(key);
  if (!layer) return std::nullopt;
  Value value{};
  layer->reader(key).read(*layer->table->get(key), value);
  return value;
}

template std::optional<double> Settings::get(std::string_view) const;
template std::optional<bool> Settings::get(std::string_view) const;
template std::optional<std::string> Settings::get(std::string_view) const;
template std::optional<Strings> Settings::get(std::string_view) const;
template std::optional<Numbers> Settings::get(std::string_view) const;
template std::optional<Matrix> Settings::get(std::string_view) const;

std::string Settings::choice(std::string_view key, std::span<const std::string_view> names,
                             std::string_view otherwise) const {
  std::string chosen = get(key, std::string(otherwise));
  if (chosen != otherwise && std::ranges::find(names, chosen) == names.end())
    throw error(key, fmt::format("one of {}", fmt::join(names, ", ")), nearest_word(chosen, names));
  return chosen;
}

Settings Settings::sub(std::string_view key) const {
  find(key);
  for (const auto& layer : layers_)
    layer->require_table_if_any(key);  // all, before the keys of one are to be asked for
  Settings settings;
  for (const auto& layer : layers_)
    if (auto child = layer->child(key)) settings.layers_.push_back(std::move(child));
  return settings;
}

std::vector<std::string> Settings::names() const {
  std::set<std::string> names;
  for (const auto& layer : layers_)
    for (const auto& [key, node] : *layer->table) names.emplace(key.str());
  return {names.begin(), names.end()};
}

Settings Settings::overlaid_by(const Settings& own) const {
  Settings settings;
  for (const bool is_file : {true, false})
    for (const Settings* const each : {this, &own})
      std::ranges::copy_if(each->layers_, std::back_inserter(settings.layers_),
                           [&](const auto& layer) { return layer->origin.is_file == is_file; });
  return settings;
}

void Settings::refuse_unknown() const {
  for (const auto& layer : layers_) layer->refuse_unknown();
}

InputError Settings::error(std::string_view key, std::string_view expected, std::string_view remedy) const {
  if (const Layer* const layer = find(key)) return layer->reader(key).error(*layer->table->get(key), expected, remedy);
  const auto known = defaults_.find(key);
  const std::string found = known == defaults_.end() ? "nothing" : "the default " + in_quotes(known->second);
  return InputError({.what = key_name(key), .found = found, .expected = expected, .remedy = remedy});
}

}  // namespace sigmax::apps
