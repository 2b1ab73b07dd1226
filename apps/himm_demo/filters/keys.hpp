#pragma once

#include <functional>
#include <string>
#include <vector>

#include "himm_demo/filters/settings.hpp"
#include "recording/recording.hpp"

namespace CLI {
class App;
}

namespace sigmax::apps {

/// Everything that is known of one key: reading, writing, and the table of keys are loops over these.
template <class Owner>
struct Key {
  std::string name;
  std::string meaning;
  std::string values;  ///< what may be given
  /// Leaves the owner's value where the key is absent; throws InputError for what cannot be.
  std::function<void(const Settings&, Owner&)> read;
  /// The value in TOML; empty if there is none.
  std::function<std::string(const Owner&)> write;
  /// Whether it changes anything; only then it is written.
  std::function<bool(const Owner&)> applies = [](const Owner&) { return true; };
  std::string by_default = {};  ///< in words, where no value can say it
};

/// The keys of a filter in the order in which they are read, written and listed.
const std::vector<Key<FilterSettings>>& filter_keys();

/// Those of a sensor, which a filter has too.
const std::vector<Key<Accuracy>>& accuracy_keys();

/// The filters that --config and --set name for a recording: a radar is as accurate as the simulated one, if there is
/// one. What they know the accuracy of, velocities and range rates, is asked of the recording. Throws InputError for
/// what cannot be, and for keys that nobody knows.
std::vector<FilterSettings> filters_for(RecordingOptions& recording, const std::string& config,
                                        const std::vector<std::string>& sets,
                                        const std::optional<std::array<double, 3>>& radar);

/// --config, --set and --print-config.
void add_filter_options(CLI::App& app, std::string& config, std::vector<std::string>& sets, bool& print_config);

}  // namespace sigmax::apps
