#include "himm_demo/filters/settings.hpp"

namespace sigmax::apps {
namespace {

/// A filter with a name of its own: the kind of its mode, and what it has by default.
struct KnownFilter {
  std::string_view name;
  bool fuzzy;
  void (*adapt)(FilterSettings&);
  bool tuned = false;  ///< has settings of its own for the whole filter, so that it is no row beside the others
};

/// The filter over histories: a rare manoeuvre that begins with any acceleration and then hardly changes it.
FilterSettings& keep_histories(FilterSettings& own) {
  own.scheme = Scheme::histories;
  own.augmentation = StateAugmentation::prior;
  own.leaving_possibility = own.leaving_probability = 0.004;
  own.leaving_a_manoeuvre = 0.03;
  for (MotionChoice& motion : own.motions)
    if (motion.manoeuvres()) motion[MotionParameter::sigma_w] *= 0.1;
  return own;
}

const std::initializer_list<KnownFilter> known_filters = {
    {"imm", false, [](FilterSettings&) {}},
    {"imm_correct", false, [](FilterSettings& own) { own.imm_mixing = MixingWeights::correct; }},
    {"imm_released", false, [](FilterSettings& own) { own.imm_mixing = MixingWeights::released; }},
    {"imm_most_likely", false, [](FilterSettings& own) { own.most_likely_output = true; }},
    {"imm_as_printed", false, [](FilterSettings& own) { own.output_spread = OutputSpread::omitted; }},
    {"gpb1", false, [](FilterSettings& own) { own.scheme = Scheme::common_start; }},
    {"gpb2", false, [](FilterSettings& own) { own.scheme = Scheme::second_order; }},
    {"static_random", false, [](FilterSettings& own) { own.scheme = Scheme::independent; }},
    {"imm_histories", false, [](FilterSettings& own) { keep_histories(own).cut = 0.0; }, true},
    {"himm", true, [](FilterSettings&) {}},
    {"himm_selected", true, [](FilterSettings& own) { own.mixed_covariance = MixedCovariance::selected; }},
    {"himm_own", true, [](FilterSettings& own) { own.mixed_covariance = MixedCovariance::own; }},
    {"himm_own_recentred", true, [](FilterSettings& own) { own.mixed_covariance = MixedCovariance::own_recentred; }},
    {"himm_released", true, [](FilterSettings& own) { own.mixed_covariance = MixedCovariance::released; }},
    {"himm_envelope", true, [](FilterSettings& own) { own.mixed_covariance = MixedCovariance::envelope; }},
    {"himm_global", true, [](FilterSettings& own) { own.scheme = Scheme::common_start; }},
    {"himm_possibility", true, [](FilterSettings& own) { own.likelihood = LikelihoodForm::possibility; }},
    {"himm_histories", true, [](FilterSettings& own) { keep_histories(own); }, true},
    {"himm_histories_fast", true, [](FilterSettings& own) { keep_histories(own).histories = 8; }, true},
    {"viterbi", true, [](FilterSettings& own) { own.scheme = Scheme::second_order; }},
    {"static_fuzzy", true, [](FilterSettings& own) { own.scheme = Scheme::independent; }}};

const KnownFilter* known_filter(std::string_view name) {
  const auto found = std::ranges::find(known_filters, name, &KnownFilter::name);
  return found == known_filters.end() ? nullptr : &*found;
}

bool default_kind(const Settings& settings, const Settings& table, const std::string& name) {
  if (const KnownFilter* known = known_filter(name)) return known->fuzzy;
  const auto names = each(known_filters, &KnownFilter::name);
  if (name.starts_with("himm") || name.starts_with("imm")) {
    // A name by itself means nothing but the plain filter: one like another's is that, misspelt.
    for (const std::string_view known : names)
      if (table.names().empty() && known.size() > 4 && spelling_distance(name, known) <= 2)
        throw settings.error(
            "filters", "the name of a filter, or one that no other is like",
            fmt::format("did you mean \"{0}\"? For a filter of your own of that name give a key of [filter.{1}]", known,
                        name));
    return name.starts_with("himm");
  }
  throw settings.error(
      "filters",
      fmt::format(
          "\"all\", names out of {}, other names that begin with imm or himm, or a table [filter.{}] with a kind",
          fmt::join(names, ", "), name),
      "add filter." + name + ".kind = \"random\" or \"fuzzy\"");
}

void refuse_bad_transition(const Settings& settings, const char* key, const FilterSettings& filter) {
  const auto& rows = filter.transition;
  const std::size_t modes = filter.models.size();
  if (rows.size() != modes || rows.front().size() != modes)
    throw settings.error(key, fmt::format("{0} rows of {0} numbers, one for each model", modes),
                         "give a row for each of the models");
  const auto total = [&](std::size_t i, bool of_column) {
    double all = 0.0;
    for (std::size_t j = 0; j < modes; ++j) {
      const double value = of_column ? rows[j][i] : rows[i][j];
      all = filter.fuzzy ? std::max(all, value) : all + value;
    }
    return all;
  };
  const auto is_one = [](double sum) { return std::abs(sum - 1.0) <= 1e-9; };
  bool transposed = true;
  for (std::size_t i = 0; i < modes; ++i) transposed &= is_one(total(i, true));
  const std::string_view what = filter.fuzzy ? "maximum" : "sum";
  for (std::size_t i = 0; i < modes; ++i) {
    if (!std::ranges::all_of(rows[i], [](double value) { return value >= 0.0 && value <= 1.0; }))
      throw settings.error(key, "numbers between 0 and 1", "correct row " + std::to_string(i + 1));
    const double sum = total(i, false);
    if (is_one(sum)) continue;
    throw settings.error(
        key,
        fmt::format("a {} of 1 in every row; that of row {} (from {}) is {}", what, i + 1, filter.models[i],
                    shortest(sum)),
        transposed  ? fmt::format("its columns {} 1: transpose it", filter.fuzzy ? "have a maximum of" : "sum to")
        : sum > 0.0 ? fmt::format("divide that row by {}", shortest(sum))
                    : "give a number above 0 in that row");
  }
}

/// What no key can tell by itself.
void refuse_bad_combinations(const Settings& settings, const FilterSettings& filter) {
  if (filter.member == MemberType::kf) {
    const auto refuse = [&](const std::string& what) {
      return settings.error("member", fmt::format("ekf, ukf or ckf, since {} not linear", what),
                            "linear models have the Kalman filter whatever the member is");
    };
    for (std::size_t i = 0; i < filter.motions.size(); ++i)
      if (!filter.motions[i].linear()) throw refuse(fmt::format("the model {} is", filter.models[i]));
    if (filter.radar_measurement == RadarForm::polar) throw refuse("radar_measurement = \"polar\" is");
  }
  refuse_bad_transition(settings, filter.fuzzy ? "transition_possibility" : "transition_probability", filter);
  const std::size_t modes = filter.models.size();
  if (filter.scheme == Scheme::histories && filter.histories < modes)
    throw settings.error("histories", fmt::format("{} or more, one for each model", modes));
  if (filter.augmentation == StateAugmentation::prior && filter.entry.scales.empty())
    throw settings.error("entry_scales", "one or more, since augmentation = \"prior\"");
  if (!filter.sojourn_s.empty() && (modes < 2 || filter.sojourn_s.size() != modes))
    throw settings.error("sojourn_s", "a mean sojourn time, in s, for each of two models or more");
  if (filter.start != StartRule::given) return;
  if (filter.start_mean.size() != 9)
    throw settings.error("start_mean", "nine numbers x, y, z, vx, vy, vz, ax, ay, az, since start = \"given\"");
  if (filter.start_covariance_diagonal.size() != 9)
    throw settings.error("start_covariance_diagonal", "nine variances, since start = \"given\"");
}

/// Throws where they say in two ways where the sensor stands, or not wholly.
void read_sensor(const Settings& settings, SensorSettings& sensor) {
  const bool in_metres = settings.has("at");
  const bool on_earth = settings.has("latitude_deg") || settings.has("longitude_deg") || settings.has("altitude_m");
  if (in_metres && on_earth)
    throw settings.error("at", "one place, in metres or by latitude_deg and longitude_deg", "leave out one of both");
  if (in_metres) sensor.place = {};
  if (on_earth) sensor.place.at_m.clear();
  for (const auto& key : accuracy_keys()) {
    key.read(settings, sensor);
    if (settings.has(key.name)) sensor.given.insert(key.name);
  }
  if (on_earth && !(sensor.place.latitude_deg && sensor.place.longitude_deg))
    throw settings.error(sensor.place.latitude_deg       ? "latitude_deg"
                         : settings.has("longitude_deg") ? "longitude_deg"
                                                         : "altitude_m",
                         "latitude_deg and longitude_deg together", "give both");
}

/// The filter that the settings make of its defaults.
FilterSettings read_filter(const Settings& settings, FilterSettings filter) {
  for (const auto& key : filter_keys()) key.read(settings, filter);
  read_sensor(settings, filter.accuracy);
  refuse_bad_combinations(settings, filter);
  const Settings sensors = settings.sub("sensor");
  for (const auto& name : sensors.names())
    read_sensor(sensors.sub(name), filter.sensors.emplace(name, filter.accuracy).first->second);
  return filter;
}

}  // namespace

TargetChoice choice_of(const FilterSettings& settings, int axes) {
  for (const auto& motion : settings.motions)
    if (axes < motion.known().least_axes)
      throw UsageError({.what = "filter '" + settings.name + "': the recording has one axis, and " + motion.name +
                                " turns in a plane",
                        .remedy = "choose motions that do not turn"});
  TargetChoice choice = settings;
  choice.axes = axes;
  choice.rules = {.gate_probability = settings.gate_probability,
                  .rejections = static_cast<std::size_t>(settings.restart_after_rejections),
                  .longest_gap = settings.restart_after_s.value_or(infinity),
                  .record = settings.smooth || (settings.explain && settings.scheme == Scheme::histories)};
  return choice;
}

void start_at_zero(std::vector<FilterSettings>& filters) {
  for (FilterSettings& filter : filters) {
    filter.restart_after_s.reset();  // later starts are from positions
    filter.restart_after_rejections = 0;
    if (filter.start == StartRule::given) continue;
    filter.start = StartRule::given;
    filter.start_mean.assign(9, 0.0);
    filter.start_covariance_diagonal = {1e-6, 1e-6, 1e-6, 1e6, 1e6, 1e6, 1e2, 1e2, 1e2};
  }
}

FilterDefaults FilterDefaults::of(Preset preset) {
  FilterDefaults defaults;
  FilterSettings& filter = defaults.filter;
  if (preset == Preset::paper_text) {
    filter.mixed_covariance = MixedCovariance::own;
    filter.augmentation = StateAugmentation::zero;
  } else {
    filter.leaving_possibility = 0.2;
    filter.mixed_covariance = MixedCovariance::released;
    filter.imm_mixing = MixingWeights::released;
    filter.mixing_tie = Tie::last;
    filter.output_tie = Tie::first;
    filter.start = StartRule::released;
    defaults.names = {"imm", "himm", "imm_correct"};
  }
  return defaults;
}

std::vector<FilterSettings> read_filters(const Settings& settings, const FilterDefaults& defaults) {
  auto names = settings.get("filters", defaults.names);
  if (names.empty()) throw settings.error("filters", "the name of at least one filter");
  if (names == std::vector<std::string>{"all"}) {
    names.clear();
    for (const auto& known : known_filters)
      if (!known.tuned) names.emplace_back(known.name);
  }
  const Settings tables = settings.sub("filter");
  constexpr std::array<std::string_view, 2> kinds = {"random", "fuzzy"};
  const auto read = [&](const std::string& name) {
    const Settings table = tables.sub(name);
    FilterSettings own = defaults.filter;
    own.name = name;
    own.fuzzy =
        table.has("kind") ? table.choice("kind", kinds, "random") == "fuzzy" : default_kind(settings, table, name);
    if (const KnownFilter* known = known_filter(name)) known->adapt(own);
    return read_filter(settings.overlaid_by(table), std::move(own));
  };
  for (const auto& name : tables.names()) read(name);  // also what is not run must be right
  std::vector<FilterSettings> filters;
  for (const auto& name : names) {
    if (std::ranges::count(names, name) > 1) throw settings.error("filters", "each name once");
    if (name == "measurement") throw settings.error("filters", "names other than measurement, which is the raw one's");
    filters.push_back(read(name));
  }
  return filters;
}

std::vector<std::string> names_of(const std::vector<MotionChoice>& motions) {
  std::vector<std::string> names;
  for (auto motion = motions.begin(); motion != motions.end(); ++motion) {
    const auto before =
        std::count_if(motions.begin(), motion, [&](const auto& other) { return other.name == motion->name; });
    names.push_back(before == 0 ? motion->name : fmt::format("{}_{}", motion->name, before + 1));
  }
  return names;
}

void replace_models(FilterSettings& filter, const std::vector<std::string>& motions) {
  std::vector<MotionChoice> left = filter.motions;
  const MotionChoice first = left.front();
  filter.motions.clear();
  for (const std::string& name : motions) {
    const auto same = std::ranges::find(left, name, &MotionChoice::name);
    filter.motions.push_back(same == left.end() ? first : *same);
    filter.motions.back().name = name;
    if (same != left.end()) left.erase(same);
  }
  filter.models = names_of(filter.motions);
}

std::vector<std::vector<double>> default_transition(const FilterSettings& filter, bool fuzzy) {
  const std::size_t modes = filter.models.size();
  const double others = static_cast<double>(std::max<std::size_t>(modes, 2) - 1);
  std::vector<std::vector<double>> rows(modes, std::vector<double>(modes));
  for (std::size_t i = 0; i < modes; ++i) {
    double leaves = fuzzy ? filter.leaving_possibility : filter.leaving_probability;
    if (filter.motions[i].manoeuvres()) leaves = filter.leaving_a_manoeuvre.value_or(leaves);
    std::ranges::fill(rows[i], fuzzy ? leaves : leaves / others);
    rows[i][i] = fuzzy || modes == 1 ? 1.0 : 1.0 - leaves;
  }
  return rows;
}

std::vector<std::string> model_names(const std::vector<FilterSettings>& filters) {
  std::vector<std::string> names;
  for (const auto& filter : filters)
    for (const auto& model : filter.models)
      if (std::ranges::find(names, model) == names.end()) names.push_back(model);
  return names;
}

}  // namespace sigmax::apps
