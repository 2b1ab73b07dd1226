#include "himm_demo/filters/settings.hpp"

#include <sstream>

namespace sigmax::apps {
namespace {

using FilterKey = Key<FilterSettings>;

/// Of each key a line with its name and, indented, what it means, and where the key itself cannot say it, what may be
/// given and what it is by default.
constexpr std::string_view table_of_texts =
#include "himm_demo/filters/keys.txt"
    ;

const KeyText& text_of(const std::string& name) {
  static const auto texts = [] {
    std::map<std::string, KeyText> all;
    std::istringstream lines{std::string(table_of_texts)};
    KeyText* text = nullptr;
    for (std::string line; std::getline(lines, line);) {
      const std::string words(trimmed(line));
      if (words == line)
        text = &all[line];
      else if (words.starts_with("Values: "))
        text->values = words.substr(words.find(' ') + 1);
      else if (words.starts_with("Default: "))
        text->by_default = words.substr(words.find(' ') + 1);
      else
        text->meaning = words;
    }
    return all;
  }();
  return texts.at(name);
}

/// The numbers in TOML.
std::string toml_list(const std::vector<double>& numbers) {
  return fmt::format("[{}]", list_of(numbers, [](double number) {
                       const std::string text = shortest(number);  // TOML tells integers apart
                       return text.find_first_of(".eni") == std::string::npos ? text + ".0" : text;
                     }));
}

/// What a number must be.
struct Range {
  std::string_view expected;
  bool (*holds)(double);
  std::string_view remedy = {};

  void require(const Settings& settings, std::string_view key, double value) const {
    if (!(std::isfinite(value) && holds(value))) throw settings.error(key, expected, remedy);
  }
};

bool positive(double value) { return value > 0.0; }
bool not_negative(double value) { return value >= 0.0; }
bool above_0_to_1(double value) { return value > 0.0 && value <= 1.0; }
bool any(double) { return true; }

/// One out of several names, which are those of the enumerators in their order.
template <class Owner, class Value>
FilterKey choice(const std::string& name, Value Owner::*member, const std::vector<std::string_view>& names) {
  const auto name_of = [=](const FilterSettings& filter) { return names[static_cast<std::size_t>(filter.*member)]; };
  return {name,
          {text_of(name).meaning, list_of(names)},
          [=](const Settings& settings, FilterSettings& filter) {
            const std::string chosen = settings.choice(name, names, name_of(filter));
            filter.*member = static_cast<Value>(std::ranges::find(names, chosen) - names.begin());
          },
          [=](const FilterSettings& filter) { return fmt::format("\"{}\"", name_of(filter)); }};
}

/// @{
/// A value that a key has: a number, perhaps in another unit, a whole one, one that may be absent, a list, a flag.
void read(const Settings& settings, const std::string& key, const Range& range, double unit, double& value) {
  const double given = settings.get(key, value / unit);
  range.require(settings, key, given);
  value = given * unit;
}
void read(const Settings& settings, const std::string& key, const Range& range, double, std::size_t& value) {
  auto number = static_cast<double>(value);
  read(settings, key, range, 1.0, number);
  value = static_cast<std::size_t>(number);
}
void read(const Settings& settings, const std::string& key, const Range& range, double, std::optional<double>& value) {
  if (const auto given = settings.get<double>(key)) value = given;
  if (value) range.require(settings, key, *value);
}
void read(const Settings& settings, const std::string& key, const Range& range, double, std::vector<double>& values) {
  values = settings.get(key, values);
  for (const double value : values) range.require(settings, key, value);
}
void read(const Settings& settings, const std::string& key, const Range&, double, bool& value) {
  value = settings.get(key, value);
}

/// In another unit to 15 digits, which hide that it was converted.
std::string written(double value, double unit) {
  return toml_number(unit == 1.0 ? value : std::strtod(fmt::format("{:.15g}", value / unit).c_str(), nullptr));
}
std::string written(std::size_t value, double) { return std::to_string(value); }
std::string written(std::optional<double> value, double) { return value ? toml_number(*value) : ""; }
std::string written(const std::vector<double>& values, double) { return values.empty() ? "" : toml_list(values); }
std::string written(bool value, double) { return value ? "true" : "false"; }
/// @}

/// One of them, which `of` finds in its owner. Where there is none, or a flag is off, that changes nothing.
template <class Owner, class Of>
Key<Owner> value(const std::string& name, Of of, bool (*holds)(double), std::string_view remedy = {},
                 double unit = 1.0) {
  const Range range{text_of(name).values, holds, remedy};
  return {name, text_of(name),
          [=](const Settings& settings, Owner& owner) { read(settings, name, range, unit, std::invoke(of, owner)); },
          [=](Owner owner) { return written(std::invoke(of, owner), unit); },
          [=](Owner owner) {
            const std::string text = written(std::invoke(of, owner), unit);
            return !text.empty() && text != "false";
          }};
}

/// A number for each model: one for all, or one each.
FilterKey per_model(MotionParameter parameter) {
  const KnownParameter& known = motion_parameters()[static_cast<std::size_t>(parameter)];
  const std::string name{known.key};
  const Range range{known.expected, known.valid};
  const auto values = [=](const FilterSettings& filter) {
    return each(filter.motions, [=](const MotionChoice& motion) { return motion[parameter]; });
  };
  return {name,
          {std::string(known.meaning), std::string(range.expected) + "; one, or one a model"},
          [=](const Settings& settings, FilterSettings& filter) {
            auto given = settings.get(name, values(filter));
            if (given.size() == 1) given.resize(filter.motions.size(), given.front());
            if (given.size() != filter.motions.size()) throw settings.error(name, "one number, or one for each model");
            for (std::size_t i = 0; i < given.size(); ++i) {
              range.require(settings, name, given[i]);
              filter.motions[i][parameter] = given[i];
            }
          },
          [=](const FilterSettings& filter) { return toml_list(values(filter)); },
          [=](const FilterSettings& filter) {
            return std::ranges::any_of(
                filter.motions, [=](const MotionChoice& motion) { return motion.known().has_parameter(parameter); });
          }};
}

/// The names of all motions.
std::string motion_names() { return list_of(known_motions(), &KnownMotion::name); }

/// The models themselves.
FilterKey models() {
  return {"models",
          {text_of("models").meaning, motion_names()},
          [](const Settings& settings, FilterSettings& filter) {
            const auto names = settings.get("models", each(filter.motions, &MotionChoice::name));
            for (const auto& name : names)
              if (!known_motion(name)) throw settings.error("models", "names out of " + motion_names());
            if (names.empty()) throw settings.error("models", "at least one of " + motion_names());
            replace_models(filter, names);
          },
          [](const FilterSettings& filter) {
            return fmt::format("[{}]", list_of(filter.motions, [](const MotionChoice& motion) {
                                 return fmt::format("\"{}\"", motion.name);
                               }));
          }};
}

/// The transition of one kind of mode. That of the other kind is read too, so that it is no unknown key.
FilterKey transition(const std::string& name, bool fuzzy) {
  return {name, text_of(name),
          [=](const Settings& settings, FilterSettings& filter) {
            const auto rows = settings.get(name, default_transition(filter, fuzzy));
            if (filter.fuzzy == fuzzy) filter.transition = rows;
          },
          [](const FilterSettings& filter) { return fmt::format("[{}]", list_of(filter.transition, toml_list)); },
          [=](const FilterSettings& filter) {
            return filter.fuzzy == fuzzy && filter.scheme != Scheme::independent && filter.sojourn_s.empty();
          }};
}

/// The key where `applies`.
FilterKey only(bool (*applies)(const FilterSettings&), FilterKey key) {
  const auto before = key.applies;
  key.applies = [=](const FilterSettings& filter) { return applies(filter) && before(filter); };
  return key;
}

bool turns(const FilterSettings& filter) {
  return std::ranges::any_of(filter.motions, [](const MotionChoice& motion) { return !motion.linear(); });
}
bool mixes(const FilterSettings& filter) {
  return filter.scheme == Scheme::interacting || filter.scheme == Scheme::common_start;
}
bool has_prior(const FilterSettings& filter) { return filter.augmentation == StateAugmentation::prior; }
bool keeps_histories(const FilterSettings& filter) { return filter.scheme == Scheme::histories; }
bool gates(const FilterSettings& filter) { return filter.gate_probability < 1.0; }
bool given(const FilterSettings& filter) { return filter.start == StartRule::given; }

/// The key of a list that has so many numbers.
template <class Of>
Key<SensorSettings> of_sizes(const std::vector<std::size_t>& sizes, const std::string& expected, Of of,
                             Key<SensorSettings> key) {
  key.read = [=, name = key.name, read = key.read](const Settings& settings, SensorSettings& accuracy) {
    read(settings, accuracy);
    if (std::ranges::find(sizes, std::invoke(of, accuracy).size()) == sizes.end()) throw settings.error(name, expected);
  };
  return key;
}

template <class Owner>
std::string as_toml(const std::vector<Key<Owner>>& keys, const Owner& owner) {
  std::string text;
  for (const auto& key : keys)
    if (key.applies(owner)) text += fmt::format("{} = {}\n", key.name, key.write(owner));
  return text;
}

/// A string of TOML. Control characters are escaped, so that a terminal shows them, too.
std::string toml_string(std::string_view text) {
  std::string quoted;
  for (const char letter : text) quoted.append(letter == '"' || letter == '\\' ? "\\" : "").push_back(letter);
  return "\"" + escaped(quoted, "\\u{:04X}") + "\"";
}

/// A key of TOML, in quotes where it needs them.
std::string toml_key(const std::string& name) {
  constexpr std::string_view bare = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
  return !name.empty() && name.find_first_not_of(bare) == name.npos ? name : toml_string(name);
}

/// The text below a name.
std::string indented(std::string_view text) {
  std::string result;
  for (const auto& line : lines_of(text, terminal_width - 4)) result += "    " + line + "\n";
  return result;
}

std::string entry(const std::string& name, const KeyText& text) {
  return fmt::format("{}\n{}{}{}", name, indented(text.meaning), indented("Values: " + text.values),
                     indented("Default: " + text.by_default));
}

template <class Owner>
std::string entry(const Key<Owner>& key, const Owner& track, const Owner& paper, const Owner& released) {
  KeyText text = key.text;
  if (!text.by_default.empty()) return entry(key.name, text);
  const auto value = [&](const Owner& owner) {
    const std::string written = key.write(owner);
    return written.empty() ? "none" : written;
  };
  text.by_default = value(track);
  if (value(paper) != value(track)) text.by_default += "; preset paper_text: " + value(paper);
  if (value(released) != value(track)) text.by_default += "; preset released: " + value(released);
  return entry(key.name, text);
}

/// The table of all keys, for people.
std::string key_table() {
  const FilterSettings track = FilterDefaults{}.filter;
  const FilterSettings paper = FilterDefaults::of(Preset::paper_text).filter;
  const FilterSettings released = FilterDefaults::of(Preset::released).filter;
  std::string text;
  for (const char* name : {"filters", "filter.NAME.kind"}) text += entry(name, text_of(name));
  for (const auto& key : filter_keys()) text += entry(key, track, paper, released);
  for (const auto& key : accuracy_keys()) text += entry(key, track.accuracy, paper.accuracy, released.accuracy);
  for (const char* name : {"sensor.NAME.KEY", "filter.NAME.KEY"}) text += entry(name, text_of(name));
  return text;
}

}  // namespace

const std::vector<FilterKey>& filter_keys() {
  using F = FilterSettings;
  static const std::vector<FilterKey> keys = {
      // Models, how the mode moves on, and how mixtures over it collapse.
      choice("scheme", &F::scheme, {"interacting", "common_start", "second_order", "independent", "histories"}),
      models(), per_model(MotionParameter::sigma_w), per_model(MotionParameter::tau),
      per_model(MotionParameter::turn_rate), per_model(MotionParameter::turn_drift),
      only([](const F& f) { return turns(f) || f.radar_measurement == RadarForm::polar; },
           choice("member", &F::member, {"kf", "ekf", "ukf", "ckf"})),
      only([](const F& f) { return f.scheme != Scheme::independent; },
           value<F>("sojourn_s", &F::sojourn_s, [](double s) { return s > 0.0 && std::isfinite(1.0 / s); })),
      transition("transition_probability", false), transition("transition_possibility", true),
      only([](const F& f) { return f.fuzzy && mixes(f); },
           choice("mixed_covariance", &F::mixed_covariance,
                  {"selected", "own", "own_recentred", "released", "envelope"})),
      only([](const F& f) { return f.fuzzy && (mixes(f) || f.scheme == Scheme::second_order); },
           choice("mixing_tie", &F::mixing_tie, {"stay", "first", "last"})),
      only([](const F& f) { return !f.fuzzy && mixes(f); },
           choice("imm_mixing", &F::imm_mixing, {"correct", "released"})),
      only([](const F& f) { return !f.fuzzy; }, choice("output_spread", &F::output_spread, {"included", "omitted"})),
      // Likelihoods, what a model lacks, histories, and the output.
      choice("likelihood", &F::likelihood, {"density", "possibility"}),
      choice("augmentation", &F::augmentation, {"zero", "borrowed_variance", "unbiased", "prior"}),
      only(has_prior, value<F>(
                          "entry_scales", [](F& f) -> std::vector<double>& { return f.entry.scales; }, positive)),
      only(has_prior, value<F>(
                          "entry_vertical", [](F& f) -> double& { return f.entry.vertical; }, positive)),
      only([](const F& f) { return has_prior(f) && turns(f); },
           value<F>(
               "entry_turn_deg_s", [](F& f) -> double& { return f.entry.turn_rate; }, positive, {}, degree)),
      only(keeps_histories, value<F>("histories", &F::histories,
                                     [](double n) { return n >= 1.0 && n <= 10000.0 && n == std::floor(n); })),
      only(keeps_histories, value<F>("cut", &F::cut, [](double c) { return c >= 0.0 && c <= 1.0; })),
      only(keeps_histories, value<F>("tempering", &F::tempering, above_0_to_1)),
      choice("output", &F::most_likely_output, {"mixed", "most_likely"}),
      choice("output_tie", &F::output_tie, {"stay", "first", "last"}),
      // Start, gate, restart; smoothing, and how radar measurements are taken.
      choice("start", &F::start, {"points", "released", "given"}),
      only(turns, value<F>("start_sigma_turn_deg_s", &F::start_sigma_turn_deg_s, positive)),
      only(given, value<F>("start_mean", &F::start_mean, any)),
      only(given, value<F>("start_covariance_diagonal", &F::start_covariance_diagonal, not_negative,
                           "give the squares of standard deviations")),
      only(given, value<F>("start_time_s", &F::start_time_s, any)),
      only(gates, value<F>("gate_probability", &F::gate_probability, above_0_to_1)),
      value<F>("restart_after_s", &F::restart_after_s, positive),
      only(gates, value<F>("restart_after_rejections", &F::restart_after_rejections,
                           [](double n) { return n >= 0.0 && n <= 1000.0 && n == std::floor(n); })),
      value<F>("smooth", &F::smooth, any), only(keeps_histories, value<F>("explain", &F::explain, any)),
      choice("radar_measurement", &F::radar_measurement, {"standard", "unbiased", "debiased", "polar"})};
  return keys;
}

const std::vector<Key<SensorSettings>>& accuracy_keys() {
  using A = SensorSettings;
  constexpr std::string_view small = "a covariance is positive definite: give a small one rather than 0";
  const auto radar = [](std::size_t i) { return [i](A& accuracy) -> double& { return accuracy.radar[i]; }; };
  const auto at = [](A& accuracy) -> std::vector<double>& { return accuracy.place.at_m; };
  const auto place = [](std::optional<double> SensorPlace::*of) {
    return [of](A& accuracy) -> std::optional<double>& { return accuracy.place.*of; };
  };
  static const std::vector<Key<A>> keys = {
      value<A>("sigma_range_m", radar(0), positive, small),
      value<A>("sigma_azimuth_deg", radar(1), positive, small, degree),
      value<A>("sigma_elevation_deg", radar(2), positive, small, degree),
      of_sizes({1, 3}, "one standard deviation, or one for each of x, y, z", &A::position_m,
               value<A>("sigma_position_m", &A::position_m, positive, small)),
      value<A>("sigma_velocity_mps", &A::velocity_mps, positive, small),
      value<A>("sigma_range_rate_mps", &A::range_rate_mps, positive, small),
      of_sizes({0, 2, 3}, "two or three numbers, [E, N] or [E, N, U], in m", at, value<A>("at", at, any)),
      value<A>("latitude_deg", place(&SensorPlace::latitude_deg),
               [](double degrees) { return std::abs(degrees) <= 90.0; }),
      value<A>("longitude_deg", place(&SensorPlace::longitude_deg),
               [](double degrees) { return std::abs(degrees) <= 360.0; }),
      value<A>("altitude_m", place(&SensorPlace::altitude_m), any)};
  return keys;
}

std::string as_toml(const std::vector<FilterSettings>& filters) {
  const auto quoted = [](const FilterSettings& filter) { return toml_string(filter.name); };
  std::string text = fmt::format("filters = [{}]\n", list_of(filters, quoted));
  for (const auto& filter : filters) {
    text += fmt::format("\n[filter.{}]\nkind = \"{}\"\n", toml_key(filter.name), filter.fuzzy ? "fuzzy" : "random");
    text += as_toml(filter_keys(), filter) + as_toml(accuracy_keys(), filter.accuracy);
    for (const auto& [sensor, accuracy] : filter.sensors)
      text += fmt::format("\n[filter.{}.sensor.{}]\n{}", toml_key(filter.name), toml_string(sensor),
                          as_toml(accuracy_keys(), accuracy));
  }
  return text;
}

std::vector<FilterSettings> filters_for(RecordingOptions& recording, const FilterOptions& options,
                                        const std::optional<std::array<double, 3>>& radar, FilterDefaults defaults) {
  if (radar) defaults.filter.accuracy.radar = {(*radar)[0], (*radar)[1] * degree, (*radar)[2] * degree};
  const Settings settings = Settings::read(options.config, options.sets);
  auto filters = read_filters(settings, defaults);
  settings.refuse_unknown();
  for (const auto& filter : filters) {
    recording.velocity |= filter.has_sigma(&SensorSettings::velocity_mps);
    recording.range_rate |= filter.has_sigma(&SensorSettings::range_rate_mps);
    auto all = filter.sensors;
    all.emplace("", filter.accuracy);
    for (const auto& [sensor, own] : all) {
      recording.sensor_places |= own.place.latitude_deg.has_value();
      if (own.place != filters.front().accuracy_of(sensor).place)
        throw InputError(
            "filter '{}': {} stands elsewhere than by filter '{}'; a sensor has one place, so give it in {}",
            filter.name, sensor.empty() ? "a sensor" : fmt::format("sensor '{}'", sensor), filters.front().name,
            sensor.empty() ? "a key of all filters" : fmt::format("[sensor.{}]", toml_key(sensor)));
    }
  }
  return filters;
}

void add_filter_options(Subcommand app, FilterOptions& options) {
  app.option("--config", options.config, "Settings in TOML").type("FILE.toml");
  app.option("--set", options.sets, "One setting, as sigma_w=5; may be repeated").type("KEY=VALUE").repeated();
  app.flag("--print-config", options.print_config, "Print the settings in force and stop");
}

void add_keys(CLI::App& program, const std::string&) {
  Subcommand app(program, "keys", "Lists the keys of --config and --set.");
  app.run([] { fmt::print("{}", key_table()); });
}

}  // namespace sigmax::apps
