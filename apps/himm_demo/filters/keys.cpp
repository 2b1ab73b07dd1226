#include "himm_demo/filters/settings.hpp"

#include "himm_demo/experiment/scenario.hpp"
#include "support/output.hpp"
#include "support/text.hpp"

namespace sigmax::apps {
namespace {

using FilterKey = Key<FilterSettings>;

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
bool any(double) { return true; }
const Range flag{"true, false", any};

constexpr std::string_view small_sigma = "a covariance is positive definite: give a small one rather than 0";

/// One out of several names, which are those of the enumerators in their order.
template <class Owner, class Value>
FilterKey choice(std::string name, std::string meaning, Value Owner::*member,
                 const std::vector<std::string_view>& names) {
  const auto name_of = [=](const FilterSettings& filter) { return names[static_cast<std::size_t>(filter.*member)]; };
  return {name, std::move(meaning), list_of(names),
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

std::string written(double value, double unit) { return toml_number(value / unit); }
std::string written(std::size_t value, double) { return std::to_string(value); }
std::string written(std::optional<double> value, double) { return value ? toml_number(*value) : ""; }
std::string written(const std::vector<double>& values, double) { return values.empty() ? "" : toml_list(values); }
std::string written(bool value, double) { return value ? "true" : "false"; }
/// @}

/// One of them, which `of` finds in its owner. Where there is none, or a flag is off, that changes nothing.
template <class Owner, class Of>
Key<Owner> value(std::string name, std::string meaning, Of of, Range range, double unit = 1.0) {
  return {name,
          std::move(meaning),
          std::string(range.expected),
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
          std::string(known.meaning),
          std::string(range.expected) + "; one, or one a model",
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

/// The models themselves; each new one is as that of its name, or else as the first of those that were there.
FilterKey models() {
  return {"models", "The motions that the target may follow.", motion_names(),
          [](const Settings& settings, FilterSettings& filter) {
            const auto names = each(filter.motions, &MotionChoice::name);
            const std::vector<MotionChoice> before = std::exchange(filter.motions, {});
            for (const auto& name : settings.get("models", names)) {
              if (!known_motion(name)) throw settings.error("models", "names out of " + motion_names());
              const auto same = std::ranges::find(before, name, &MotionChoice::name);
              filter.motions.push_back(same == before.end() ? before.front() : *same);
              filter.motions.back().name = name;
            }
            if (filter.motions.empty()) throw settings.error("models", "at least one of " + motion_names());
            filter.models = names_of(filter.motions);
          },
          [](const FilterSettings& filter) {
            return fmt::format("[{}]", list_of(filter.motions, [](const MotionChoice& motion) {
                                 return fmt::format("\"{}\"", motion.name);
                               }));
          }};
}

/// The transition of one kind of mode. That of the other kind is read too, so that it is no unknown key.
FilterKey transition(const std::string& name, std::string meaning, std::string values, std::string by_default,
                     bool fuzzy) {
  return {name,
          std::move(meaning),
          std::move(values),
          [=](const Settings& settings, FilterSettings& filter) {
            const std::size_t modes = filter.models.size();
            const double others = static_cast<double>(std::max<std::size_t>(modes, 2) - 1);
            std::vector<std::vector<double>> rows(modes, std::vector<double>(modes));
            for (std::size_t i = 0; i < modes; ++i) {
              double leaves = fuzzy ? filter.leaving_possibility : filter.leaving_probability;
              if (filter.motions[i].manoeuvres()) leaves = filter.leaving_a_manoeuvre.value_or(leaves);
              std::ranges::fill(rows[i], fuzzy ? leaves : leaves / others);
              rows[i][i] = fuzzy || modes == 1 ? 1.0 : 1.0 - leaves;
            }
            rows = settings.get(name, rows);
            if (filter.fuzzy == fuzzy) filter.transition = rows;
          },
          [](const FilterSettings& filter) { return fmt::format("[{}]", list_of(filter.transition, toml_list)); },
          [=](const FilterSettings& filter) {
            return filter.fuzzy == fuzzy && filter.scheme != Scheme::independent && filter.sojourn_s.empty();
          },
          std::move(by_default)};
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
bool has_prior(const FilterSettings& filter) { return filter.lift == Lift::prior; }
bool keeps_histories(const FilterSettings& filter) { return filter.scheme == Scheme::histories; }
bool given(const FilterSettings& filter) { return filter.start == StartRule::given; }

std::vector<Key<Accuracy>> made_accuracy_keys() {
  using A = Accuracy;
  constexpr Range sigma{"a positive standard deviation", positive, small_sigma};
  auto position = value<A>("sigma_position_m", "Accuracy of measurements that are no radar's; one, or one an axis.",
                           &A::position_m, {"positive standard deviations", positive, small_sigma});
  position.read = [read = position.read](const Settings& settings, A& accuracy) {
    read(settings, accuracy);
    if (accuracy.position_m.size() != 1 && accuracy.position_m.size() != 3)
      throw settings.error("sigma_position_m", "one standard deviation, or one for each of x, y, z");
  };
  std::vector<Key<A>> keys;
  for (const auto& [name, what] : {std::pair{"sigma_range_m", "range"}, std::pair{"sigma_azimuth_deg", "azimuth"},
                                   std::pair{"sigma_elevation_deg", "elevation"}}) {
    const auto in = [i = keys.size()](A& accuracy) -> double& { return accuracy.radar[i]; };
    keys.push_back(value<A>(name, fmt::format("Accuracy of a radar's {}, as the filters believe it.", what), in, sigma,
                            keys.empty() ? 1.0 : degree));
    keys.back().by_default = "that of --radar, or of the group";
  }
  keys.push_back(std::move(position));
  keys.push_back(value<A>("sigma_velocity_mps",
                          "Accuracy of each component of a measured velocity, or of a speed and course; without it "
                          "they are not taken for measurements.",
                          &A::velocity_mps, sigma));
  keys.push_back(value<A>("sigma_range_rate_mps",
                          "Accuracy of a radar's range rate; without it that is not taken for a measurement.",
                          &A::range_rate_mps, sigma));
  auto at = value<A>("at",
                     "Where a radar or a station of bearings stands, in m: what it measures is about this place. "
                     "Columns sensor_x_m, sensor_y_m and sensor_z_m go before.",
                     [](A & accuracy) -> auto& { return accuracy.place.at_m; }, {"[E, N] or [E, N, U]", any});
  at.read = [read = at.read](const Settings& settings, A& accuracy) {
    read(settings, accuracy);
    if (!accuracy.place.at_m.empty() && accuracy.place.at_m.size() != 2 && accuracy.place.at_m.size() != 3)
      throw settings.error("at", "two or three numbers, [E, N] or [E, N, U], in m");
  };
  at.by_default = "that of --radar-at";
  keys.push_back(std::move(at));
  keys.push_back(value<A>(
      "latitude_deg",
      "The same on the Earth, with longitude_deg. Columns sensor_latitude_deg and sensor_longitude_deg go before.",
      [](A & accuracy) -> auto& { return accuracy.place.latitude_deg; },
      {"degrees from −90 to 90", [](double degrees) { return std::abs(degrees) <= 90.0; }}));
  keys.push_back(value<A>("longitude_deg", "See latitude_deg.",
                          [](A & accuracy) -> auto& { return accuracy.place.longitude_deg; },
                          {"degrees from −360 to 360", [](double degrees) { return std::abs(degrees) <= 360.0; }}));
  keys.push_back(value<A>("altitude_m", "Above the ellipsoid, of a sensor on the Earth; without it, 0.",
                          [](A & accuracy) -> auto& { return accuracy.place.altitude_m; }, {"an altitude, in m", any}));
  return keys;
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
  const bool bare = !name.empty() && std::ranges::all_of(name, [](char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9') ||
           letter == '_' || letter == '-';
  });
  return bare ? name : toml_string(name);
}

/// The text below a name.
std::string indented(std::string_view text) {
  std::string result;
  for (const auto& line : lines_of(text, terminal_width - 4)) result += "    " + line + "\n";
  return result;
}

std::string entry(std::string_view name, std::string_view meaning, std::string_view values,
                  const std::string& by_default) {
  return fmt::format("{}\n{}{}{}", name, indented(meaning), indented(fmt::format("Values: {}", values)),
                     indented("Default: " + by_default));
}

template <class Owner>
std::string entry(const Key<Owner>& key, const Owner& track, const Owner& paper, const Owner& released) {
  const auto value = [&](const Owner& owner) {
    const std::string text = key.write(owner);
    return text.empty() ? "none" : text;
  };
  std::string by_default = key.by_default.empty() ? value(track) : key.by_default;
  if (key.by_default.empty() && value(paper) != value(track)) by_default += "; preset paper_text: " + value(paper);
  if (key.by_default.empty() && value(released) != value(track)) by_default += "; preset released: " + value(released);
  return entry(key.name, key.meaning, key.values, by_default);
}

/// The table of all keys, for people.
std::string key_table() {
  const FilterSettings track = FilterDefaults{}.filter;
  const FilterSettings paper = FilterDefaults::of(Preset::paper_text).filter;
  const FilterSettings released = FilterDefaults::of(Preset::released).filter;
  std::string text = entry("filters", "The filters to run.",
                           "names with a meaning of their own, others that begin with imm or himm, others that have a "
                           "table [filter.NAME] with a kind; \"all\" for those without histories",
                           R"(["imm", "himm"]; preset released: also "imm_correct")");
  text += entry("filter.NAME.kind", "The kind of the filter's mode.", "random, fuzzy", "from the name");
  for (const auto& key : filter_keys()) text += entry(key, track, paper, released);
  for (const auto& key : accuracy_keys()) text += entry(key, track.accuracy, paper.accuracy, released.accuracy);
  text += entry("sensor.NAME.KEY", "One of the last ten keys, for the rows whose column sensor says NAME.", "as there",
                "that of all sensors");
  text += entry("filter.NAME.KEY", "Any key, for one filter.", "as there", "that of all filters");
  return text;
}

}  // namespace

const std::vector<FilterKey>& filter_keys() {
  using F = FilterSettings;
  static const std::vector<FilterKey> keys = {
      // Models, how the mode moves on, and how mixtures over it collapse.
      choice("scheme", "When several modes become one Gaussian.", &F::scheme,
             {"interacting", "common_start", "second_order", "independent", "histories"}),
      models(), per_model(MotionParameter::sigma_w), per_model(MotionParameter::tau),
      per_model(MotionParameter::turn_rate), per_model(MotionParameter::turn_drift),
      only([](const F& f) { return turns(f) || f.radar_measurement == RadarForm::polar; },
           choice("member",
                  "The filter of what is not linear: ct, and every model if radar_measurement is polar; linear models "
                  "have the Kalman filter, and kf refuses others.",
                  &F::member, {"kf", "ekf", "ukf", "ckf"})),
      only([](const F& f) { return f.scheme != Scheme::independent; },
           value<F>("sojourn_s",
                    "Mean sojourn times of the models, one each, instead of the transitions below: P is that of the "
                    "time between two rows, and Π that P on the ratio scale.",
                    &F::sojourn_s,
                    {"positive times, in s", [](double s) { return s > 0.0 && std::isfinite(1.0 / s); }})),
      transition("transition_probability", "P, from one row to the next. For a random mode.",
                 "rows of numbers that sum to 1", ".95 on the diagonal; of histories .996, of a manoeuvre .97", false),
      transition("transition_possibility", "Π, from one row to the next. For a fuzzy mode.",
                 "rows of numbers whose maximum is 1",
                 "1 on the diagonal, else 1/2; preset released: 1/5; histories: .004, from a manoeuvre .03", true),
      only([](const F& f) { return f.fuzzy && mixes(f); },
           choice("mixed_covariance", "The reading of (57). For a fuzzy mode.", &F::mixed_covariance,
                  {"selected", "own", "own_recentred", "released", "envelope"})),
      only([](const F& f) { return f.fuzzy && (mixes(f) || f.scheme == Scheme::second_order); },
           choice("mixing_tie", "Which of equally possible predecessors is taken. For a fuzzy mode.", &F::mixing_tie,
                  {"stay", "first", "last"})),
      only([](const F& f) { return !f.fuzzy && mixes(f); },
           choice("imm_mixing", "The weights of (59). For a random mode.", &F::imm_mixing, {"correct", "released"})),
      only([](const F& f) { return !f.fuzzy; }, choice("output_spread",
                                                       "Whether the output's covariance (68) has the spread of the "
                                                       "means, or omits it as printed. For a random mode.",
                                                       &F::output_spread, {"included", "omitted"})),
      // Likelihoods, what a model lacks, histories, and the output.
      choice("likelihood", "The innovation's density, or its possibility exp(−d²/2), which has no determinant.",
             &F::likelihood, {"density", "possibility"}),
      choice("lift", "What stands for a component that a model lacks.", &F::lift,
             {"zero", "borrowed_variance", "unbiased", "prior"}),
      only(has_prior, value<F>("entry_scales",
                               "Standard deviations of a component that begins, if lift is prior: of accelerations in "
                               "m/s². Histories try each of them.",
                               [](F& f) -> std::vector<double>& { return f.entry.scales; },
                               {"positive standard deviations", positive})),
      only(has_prior, value<F>("entry_vertical", "So much of them along z.",
                               [](F& f) -> double& { return f.entry.vertical; }, {"a positive share", positive})),
      only([](const F& f) { return has_prior(f) && turns(f); },
           value<F>(
               "entry_turn_deg_s", "Standard deviation of the rate with which ct begins.",
               [](F& f) -> double& { return f.entry.turn_rate; }, {"a positive one, in °/s", positive}, degree)),
      only(keeps_histories,
           value<F>("histories", "So many histories of the mode are kept at most, and one that ends in each mode.",
                    &F::histories,
                    {"a whole number from 1 to 10000",
                     [](double n) { return n >= 1.0 && n <= 10000.0 && n == std::floor(n); }})),
      only(keeps_histories,
           value<F>("cut",
                    "The output is of the histories with so much of the best one's weight: 1 is the best alone, 0 all.",
                    &F::cut, {"a number from 0 to 1", [](double c) { return c >= 0.0 && c <= 1.0; }})),
      only(keeps_histories,
           value<F>("tempering", "Likelihoods count to this power: below 1 for accuracies that are believed too good.",
                    &F::tempering, {"a number above 0, at most 1", [](double t) { return t > 0.0 && t <= 1.0; }})),
      choice("output", "The output: of all modes, or of the most likely one.", &F::most_likely_output,
             {"mixed", "most_likely"}),
      choice("output_tie", "Which of equally possible modes is taken.", &F::output_tie, {"stay", "first", "last"}),
      // Start, gate, restart; smoothing, and how radar measurements are taken.
      choice("start",
             "How the filter starts: from the first three measurements (points), as the authors' program does, or as "
             "given.",
             &F::start, {"points", "released", "given"}),
      only(turns,
           value<F>("start_sigma_turn_deg_s", "Standard deviation of the rate with which ct starts. The rate is 0.",
                    &F::start_sigma_turn_deg_s, {"a positive standard deviation, in °/s", positive})),
      only(given, value<F>("start_mean", "The mean of a given start.", &F::start_mean,
                           {"nine numbers x, y, z, vx, vy, vz, ax, ay, az", any})),
      only(given,
           value<F>("start_covariance_diagonal", "The variances of a given start.", &F::start_covariance_diagonal,
                    {"variances that are not negative", not_negative, "give the squares of standard deviations"})),
      only(given,
           value<F>("start_time_s", "When a given start holds; without it, one step before the first measurement.",
                    &F::start_time_s, {"a time, in s", any})),
      only([](const F& f) { return f.gate_probability < 1.0; },
           value<F>("gate_probability",
                    "The probability that a right measurement passes the gate. What does not pass counts as missed. 1 "
                    "is no gate.",
                    &F::gate_probability,
                    {"a probability above 0; 1 is no gate", [](double p) { return p > 0.0 && p <= 1.0; }})),
      value<F>("restart_after_s",
               "After so long without a measurement that passes, the filter starts again from the next three.",
               &F::restart_after_s, {"a positive time, in s", positive}),
      only([](const F& f) { return f.gate_probability < 1.0; },
           value<F>("restart_after_rejections",
                    "After so many measurements in a row that the gate turned away, the filter starts again from them. "
                    "0 is never.",
                    &F::restart_after_rejections,
                    {"a whole number from 0 to 1000",
                     [](double n) { return n >= 0.0 && n <= 1000.0 && n == std::floor(n); }})),
      value<F>("smooth", "Whether the output is of the whole recording rather than of what came before.", &F::smooth,
               flag),
      only(keeps_histories,
           value<F>(
               "explain",
               "Whether track tells when the mode changed: the most possible history of each track, with its dates.",
               &F::explain, flag)),
      choice("radar_measurement",
             "A radar's measurements as positions by the standard, unbiased or debiased conversion, or polar: in its "
             "own space.",
             &F::radar_measurement, {"standard", "unbiased", "debiased", "polar"})};
  return keys;
}

const std::vector<Key<Accuracy>>& accuracy_keys() {
  static const std::vector<Key<Accuracy>> keys = made_accuracy_keys();
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
                                        const std::optional<std::array<double, 3>>& radar) {
  FilterDefaults defaults;
  if (radar) defaults.filter.accuracy.radar = {(*radar)[0], (*radar)[1] * degree, (*radar)[2] * degree};
  const Settings settings = Settings::read(options.config, options.sets);
  auto filters = read_filters(settings, defaults);
  settings.refuse_unknown();
  for (const auto& filter : filters) {
    recording.velocity |= filter.knows(&Accuracy::velocity_mps);
    recording.range_rate |= filter.knows(&Accuracy::range_rate_mps);
    recording.sensor_places |= filter.accuracy.place.latitude_deg.has_value();
    for (const auto& [sensor, own] : filter.sensors) {
      recording.sensor_places |= own.place.latitude_deg.has_value();
      if (own.place != filters.front().accuracy_of(sensor).place)
        throw InputError(
            "filter '{}': sensor '{}' stands elsewhere than by filter '{}'; a sensor has one place, so give it in "
            "[sensor.{}]",
            filter.name, sensor, filters.front().name, toml_key(sensor));
    }
    if (filter.accuracy.place != filters.front().accuracy.place)
      throw InputError("filter '{}': sensors stand elsewhere than by filter '{}'; give one place for all filters",
                       filter.name, filters.front().name);
  }
  return filters;
}

void add_filter_options(CLI::App& program, FilterOptions& options) {
  Subcommand app(program);
  app.option("--config", options.config, "Settings in TOML").type("FILE.toml");
  app.option("--set", options.sets, "One setting, as lift=unbiased; may be repeated").type("KEY=VALUE").repeated();
  app.flag("--print-config", options.print_config, "Print the settings in force and stop");
}

void add_keys(CLI::App& program, const std::string&) {
  Subcommand app(program, "keys", "Lists the keys of --config and --set.");
  app.run([] { fmt::print("{}", key_table()); });
}

}  // namespace sigmax::apps
