#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <fmt/ranges.h>

#include "shell/text.hpp"

namespace sigmax::apps {

/// The keys of a TOML file, overridden by `--set key=value` in their order, read by name and type.
///
///     const Settings settings = Settings::read("himm.toml", {"sigma_w=5", "filter.imm.sigma_w=3",
///     "augmentation=zero"}); const double sigma_w = settings.get("sigma_w", 3.0); const Settings filters =
///     settings.sub("filter"); for (const auto& name : filters.names()) make(settings.overlaid_by(filters.sub(name)));
///     settings.refuse_unknown();
///
/// A value of `--set` is TOML in which words may stand without quotes. Each value comes back empty, or as the default,
/// if the key is absent; one of another type throws InputError with its place, the key, what was found and expected.
class Settings {
 public:
  /// No keys at all: everything has its default.
  Settings() = default;

  /// An empty path stands for no file. Throws InputError for what is not TOML, UsageError for a set without "key=".
  static Settings read(const std::filesystem::path& file, std::span<const std::string> sets = {});

  /// Of a text in TOML.
  static Settings parse(std::string_view text);

  bool has(std::string_view key) const;

  /// @{
  /// A value: a finite double, bool, std::string, std::vector of strings or of doubles, for which one stands, too, or
  /// rows of equal length.
  template <class Value>
  std::optional<Value> get(std::string_view key) const;
  template <class Value>
  Value get(std::string_view key, Value otherwise) const {
    if (auto value = get<Value>(key)) return *std::move(value);
    defaults_.insert_or_assign(std::string(key), fmt::format("{}", otherwise));
    return otherwise;
  }
  /// @}

  /// One of the names.
  std::string choice(std::string_view key, std::span<const std::string_view> names, std::string_view otherwise) const;

  /// The keys of a table, which has none if it is absent.
  Settings sub(std::string_view key) const;

  /// The keys that are set, sorted.
  std::vector<std::string> names() const;

  /// These settings where `own` says nothing else; what `--set` says of either goes before what a file says.
  Settings overlaid_by(const Settings& own) const;

  /// Throws InputError for a key, here or in a table taken by `sub`, that was never asked for; suggests the nearest one
  /// that was. To be called when everything has been read.
  void refuse_unknown() const;

  /// An error about one key, for rules that only the caller knows.
  InputError error(std::string_view key, std::string_view expected, std::string_view remedy = {}) const;

 private:
  struct Layer;

  /// The last layer that holds the key, or null; the key counts as asked for.
  const Layer* find(std::string_view key) const;

  std::vector<std::shared_ptr<Layer>> layers_;
  mutable std::map<std::string, std::string, std::less<>> defaults_;  // that were asked for, as text
};

}  // namespace sigmax::apps
