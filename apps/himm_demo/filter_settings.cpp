#include "himm_demo/filter_settings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "support/output.hpp"

namespace sigmax::apps {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

template <class Value>
using Names = std::initializer_list<std::pair<std::string_view, Value>>;

const Names<MixedCovariance> mixed_covariances = {{"selected", MixedCovariance::selected},
                                                  {"own", MixedCovariance::own},
                                                  {"own_recentred", MixedCovariance::own_recentred},
                                                  {"released", MixedCovariance::released}};
const Names<MixingWeights> mixing_weights = {{"correct", MixingWeights::correct},
                                             {"released", MixingWeights::released}};
const Names<Lift> lifts = {
    {"zero", Lift::zero}, {"borrowed_variance", Lift::borrowed_variance}, {"unbiased", Lift::unbiased}};
const Names<Tie> ties = {{"stay", Tie::stay}, {"first", Tie::first}, {"last", Tie::last}};
const Names<Start> starts = {{"points", Start::points}, {"released", Start::released}, {"given", Start::given}};
const Names<bool> kinds = {{"random", false}, {"fuzzy", true}};
const Names<Scheme> schemes = {{"interacting", Scheme::interacting},
                               {"common_start", Scheme::common_start},
                               {"second_order", Scheme::second_order},
                               {"independent", Scheme::independent}};
const Names<MemberType> members = {
    {"kf", MemberType::kf}, {"ekf", MemberType::ekf}, {"ukf", MemberType::ukf}, {"ckf", MemberType::ckf}};
const Names<LikelihoodForm> likelihoods = {{"density", LikelihoodForm::density},
                                           {"possibility", LikelihoodForm::possibility}};
const Names<OutputSpread> spreads = {{"included", OutputSpread::included}, {"omitted", OutputSpread::omitted}};
const Names<RadarForm> radar_forms = {{"standard", RadarForm::standard},
                                      {"unbiased", RadarForm::unbiased},
                                      {"debiased", RadarForm::debiased},
                                      {"polar", RadarForm::polar}};
const Names<bool> outputs = {{"mixed", false}, {"most_likely", true}};

/// A filter with a name of its own: the kind of its mode, and what it has by default.
struct KnownFilter {
  std::string_view name;
  bool fuzzy;
  void (*adapt)(FilterDefaults&);
};
const std::initializer_list<KnownFilter> known_filters = {
    {"imm", false, [](FilterDefaults&) {}},
    {"imm_correct", false, [](FilterDefaults& own) { own.imm_mixing = MixingWeights::correct; }},
    {"imm_released", false, [](FilterDefaults& own) { own.imm_mixing = MixingWeights::released; }},
    {"imm_most_likely", false, [](FilterDefaults& own) { own.most_likely_output = true; }},
    {"imm_as_printed", false, [](FilterDefaults& own) { own.output_spread = OutputSpread::omitted; }},
    {"gpb1", false, [](FilterDefaults& own) { own.scheme = Scheme::common_start; }},
    {"gpb2", false, [](FilterDefaults& own) { own.scheme = Scheme::second_order; }},
    {"static_random", false, [](FilterDefaults& own) { own.scheme = Scheme::independent; }},
    {"himm", true, [](FilterDefaults&) {}},
    {"himm_selected", true, [](FilterDefaults& own) { own.mixed_covariance = MixedCovariance::selected; }},
    {"himm_own", true, [](FilterDefaults& own) { own.mixed_covariance = MixedCovariance::own; }},
    {"himm_own_recentred", true, [](FilterDefaults& own) { own.mixed_covariance = MixedCovariance::own_recentred; }},
    {"himm_released", true, [](FilterDefaults& own) { own.mixed_covariance = MixedCovariance::released; }},
    {"himm_global", true, [](FilterDefaults& own) { own.scheme = Scheme::common_start; }},
    {"himm_possibility", true, [](FilterDefaults& own) { own.likelihood = LikelihoodForm::possibility; }},
    {"viterbi", true, [](FilterDefaults& own) { own.scheme = Scheme::second_order; }},
    {"static_fuzzy", true, [](FilterDefaults& own) { own.scheme = Scheme::independent; }}};

const KnownFilter* known_filter(std::string_view name) {
  const auto found = std::find_if(known_filters.begin(), known_filters.end(),
                                  [&](const KnownFilter& filter) { return filter.name == name; });
  return found == known_filters.end() ? nullptr : &*found;
}

template <class Value>
std::string_view name_of(Names<Value> names, Value value) {
  return std::find_if(names.begin(), names.end(), [&](const auto& entry) { return entry.second == value; })->first;
}

/// `stays` on the diagonal and `leaves` elsewhere.
std::vector<std::vector<double>> transition_of(std::size_t modes, double stays, double leaves) {
  std::vector<std::vector<double>> rows(modes, std::vector<double>(modes, leaves));
  for (std::size_t i = 0; i < modes; ++i) rows[i][i] = stays;
  return rows;
}

bool default_kind(const Settings& settings, const std::string& name) {
  if (const KnownFilter* known = known_filter(name)) return known->fuzzy;
  if (name.starts_with("himm")) return true;
  if (name.starts_with("imm")) return false;
  std::vector<std::string_view> names;
  for (const auto& known : known_filters) names.push_back(known.name);
  throw settings.error("filters",
                       fmt::format("\"all\", names out of {}, other names that begin with imm or himm, or a table "
                                   "[filter.{}] with a kind",
                                   fmt::join(names, ", "), name),
                       "add filter." + name + ".kind = \"random\" or \"fuzzy\"");
}

void refuse_bad_transition(const Settings& settings, const char* key, const FilterSettings& filter) {
  const auto& rows = filter.transition;
  const std::size_t modes = filter.models.size();
  if (rows.size() != modes || rows.front().size() != modes)
    throw settings.error(key, fmt::format("{0} rows of {0} numbers, one for each model", modes),
                         "give a row for each of the models");
  for (std::size_t i = 0; i < modes; ++i) {
    double total = 0.0;
    for (const double value : rows[i]) {
      if (!(value >= 0.0 && value <= 1.0))
        throw settings.error(key, "numbers between 0 and 1", "correct row " + std::to_string(i + 1));
      total = filter.fuzzy ? std::max(total, value) : total + value;
    }
    if (!(std::abs(total - 1.0) <= 1e-9))
      throw settings.error(
          key,
          fmt::format("a {} of 1 in every row; that of row {} (from {}) is {}", filter.fuzzy ? "maximum" : "sum", i + 1,
                      filter.models[i], shortest(total)),
          total > 0.0 ? fmt::format("divide that row by {}", shortest(total)) : "give a number above 0 in that row");
  }
}

Accuracy read_accuracy(const Settings& settings, const Accuracy& otherwise) {
  Accuracy accuracy;
  const auto positive = [&](const char* key, double value_otherwise) {
    const double value = settings.number(key, value_otherwise);
    if (!(value > 0.0))
      throw settings.error(key, "a positive standard deviation",
                           "a covariance is positive definite: give a small one rather than 0");
    return value;
  };
  accuracy.radar = {positive("sigma_range_m", otherwise.radar.range),
                    positive("sigma_azimuth_deg", otherwise.radar.azimuth / degree) * degree,
                    positive("sigma_elevation_deg", otherwise.radar.elevation / degree) * degree};
  accuracy.position_m = settings.numbers("sigma_position_m", otherwise.position_m);
  if (accuracy.position_m.size() != 1 && accuracy.position_m.size() != 3)
    throw settings.error("sigma_position_m", "one standard deviation, or one for each of x, y, z");
  for (const double sigma : accuracy.position_m)
    if (!(sigma > 0.0))
      throw settings.error("sigma_position_m", "positive standard deviations",
                           "a covariance is positive definite: give a small one rather than 0");
  return accuracy;
}

FilterSettings read_filter(const Settings& settings, const std::string& name, bool fuzzy,
                           const FilterDefaults& defaults) {
  FilterSettings filter;
  filter.name = name;
  filter.fuzzy = fuzzy;
  filter.scheme = settings.choice("scheme", schemes, defaults.scheme);
  filter.motions = read_motions(settings, defaults.sigma_w);
  filter.models = names_of(filter.motions);
  filter.member = settings.choice("member", members, MemberType::ekf);
  filter.radar_measurement = settings.choice("radar_measurement", radar_forms, RadarForm::standard);
  if (filter.member == MemberType::kf) {
    const auto refuse = [&](const std::string& what) {
      return settings.error("member", fmt::format("ekf, ukf or ckf, since {} not linear", what),
                            "linear models have the Kalman filter whatever the member is");
    };
    for (std::size_t i = 0; i < filter.motions.size(); ++i)
      if (!filter.motions[i].linear()) throw refuse(fmt::format("the model {} is", filter.models[i]));
    if (filter.radar_measurement == RadarForm::polar) throw refuse("radar_measurement = \"polar\" is");
  }
  const std::size_t modes = filter.models.size();

  // Both transitions are asked for, so that one for the other kind of filter is no unknown key.
  const double leaves = modes > 1 ? 0.05 / static_cast<double>(modes - 1) : 0.0;
  const auto probability =
      settings.matrix("transition_probability", transition_of(modes, modes > 1 ? 0.95 : 1.0, leaves));
  const auto possibility = settings.matrix("transition_possibility", transition_of(modes, 1.0, defaults.possibility));
  filter.transition = fuzzy ? possibility : probability;
  refuse_bad_transition(settings, fuzzy ? "transition_possibility" : "transition_probability", filter);

  filter.sojourn_s = settings.numbers("sojourn_s", {});
  if (!filter.sojourn_s.empty()) {
    if (modes < 2 || filter.sojourn_s.size() != modes)
      throw settings.error("sojourn_s", "a mean sojourn time, in s, for each of two models or more");
    for (const double time : filter.sojourn_s)
      if (!(time > 0.0 && std::isfinite(1.0 / time))) throw settings.error("sojourn_s", "positive times, in s");
  }

  filter.mixed_covariance = settings.choice("mixed_covariance", mixed_covariances, defaults.mixed_covariance);
  filter.imm_mixing = settings.choice("imm_mixing", mixing_weights, defaults.imm_mixing);
  filter.lift = settings.choice("lift", lifts, defaults.lift);
  filter.mixing_tie = settings.choice("mixing_tie", ties, defaults.mixing_tie);
  filter.output_tie = settings.choice("output_tie", ties, defaults.output_tie);
  filter.likelihood = settings.choice("likelihood", likelihoods, defaults.likelihood);
  filter.output_spread = settings.choice("output_spread", spreads, defaults.output_spread);
  filter.most_likely_output = settings.choice("output", outputs, defaults.most_likely_output);

  filter.start = settings.choice("start", starts, defaults.start);
  filter.start_mean = settings.numbers("start_mean", {});
  filter.start_covariance_diagonal = settings.numbers("start_covariance_diagonal", {});
  filter.start_time_s = settings.number("start_time_s");
  filter.start_sigma_turn_deg_s = settings.number("start_sigma_turn_deg_s", filter.start_sigma_turn_deg_s);
  if (!(filter.start_sigma_turn_deg_s > 0.0))
    throw settings.error("start_sigma_turn_deg_s", "a positive standard deviation, in °/s");
  if (filter.start == Start::given) {
    if (filter.start_mean.size() != 9)
      throw settings.error("start_mean", "nine numbers x, y, z, vx, vy, vz, ax, ay, az, since start = \"given\"");
    if (filter.start_covariance_diagonal.size() != 9)
      throw settings.error("start_covariance_diagonal", "nine variances, since start = \"given\"");
    for (const double variance : filter.start_covariance_diagonal)
      if (!(variance >= 0.0))
        throw settings.error("start_covariance_diagonal", "variances that are not negative",
                             "give the squares of standard deviations");
  }

  filter.gate_probability = settings.number("gate_probability", filter.gate_probability);
  if (!(filter.gate_probability > 0.0 && filter.gate_probability <= 1.0))
    throw settings.error("gate_probability", "a probability above 0; 1 is no gate");
  filter.restart_after_s = settings.number("restart_after_s");
  if (filter.restart_after_s && !(*filter.restart_after_s > 0.0))
    throw settings.error("restart_after_s", "a positive time, in s");

  filter.smooth = settings.boolean("smooth", false);

  Accuracy usual{defaults.sigma_radar, {10.0}};
  filter.accuracy = read_accuracy(settings, usual);
  const Settings sensors = settings.sub("sensor");
  for (const auto& sensor : sensors.names())
    filter.sensors.emplace(sensor, read_accuracy(sensors.sub(sensor), filter.accuracy));
  return filter;
}

std::string as_toml(const Accuracy& accuracy) {
  return fmt::format("sigma_range_m = {}\nsigma_azimuth_deg = {}\nsigma_elevation_deg = {}\nsigma_position_m = {}\n",
                     toml_number(accuracy.radar.range), toml_number(accuracy.radar.azimuth / degree),
                     toml_number(accuracy.radar.elevation / degree), toml_list(accuracy.position_m));
}

}  // namespace

FilterDefaults FilterDefaults::of(Preset preset) {
  FilterDefaults defaults;
  if (preset == Preset::paper_text) {
    defaults.mixed_covariance = MixedCovariance::own;
    defaults.lift = Lift::zero;
  } else {
    defaults.possibility = 0.2;
    defaults.mixed_covariance = MixedCovariance::released;
    defaults.imm_mixing = MixingWeights::released;
    defaults.lift = Lift::borrowed_variance;
    defaults.mixing_tie = Tie::last;
    defaults.output_tie = Tie::first;
    defaults.start = Start::released;
    defaults.filters = {"imm", "himm", "imm_correct"};
  }
  return defaults;
}

bool asks_for_all(const Settings& settings) {
  return settings.strings("filters", std::vector<std::string>{}) == std::vector<std::string>{"all"};
}

std::vector<FilterSettings> read_filters(const Settings& settings, const FilterDefaults& defaults) {
  auto names = settings.strings("filters", defaults.filters);
  if (names.empty()) throw settings.error("filters", "the name of at least one filter");
  if (asks_for_all(settings)) {
    names.clear();
    for (const auto& known : known_filters) names.emplace_back(known.name);
  }
  const Settings tables = settings.sub("filter");
  const auto read = [&](const std::string& name) {
    const Settings table = tables.sub(name);
    const bool fuzzy = table.has("kind") ? table.choice("kind", kinds, false) : default_kind(settings, name);
    FilterDefaults own = defaults;
    if (const KnownFilter* known = known_filter(name)) known->adapt(own);
    return read_filter(settings.overlaid_by(table), name, fuzzy, own);
  };
  for (const auto& name : tables.names()) read(name);  // also what is not run must be right
  std::vector<FilterSettings> filters;
  for (const auto& name : names) {
    if (std::count(names.begin(), names.end(), name) > 1) throw settings.error("filters", "each name once");
    if (name == "measurement") throw settings.error("filters", "names other than measurement, which is the raw one's");
    filters.push_back(read(name));
  }
  return filters;
}

std::vector<std::string> model_names(const std::vector<FilterSettings>& filters) {
  std::vector<std::string> names;
  for (const auto& filter : filters)
    for (const auto& model : filter.models)
      if (std::find(names.begin(), names.end(), model) == names.end()) names.push_back(model);
  return names;
}

std::string as_toml(const std::vector<FilterSettings>& filters) {
  std::vector<std::string> names;
  for (const auto& filter : filters) names.push_back("\"" + filter.name + "\"");
  std::string text = fmt::format("filters = [{}]\n", fmt::join(names, ", "));
  for (const auto& filter : filters) {
    const bool mixes = filter.scheme == Scheme::interacting || filter.scheme == Scheme::common_start;
    text += fmt::format("\n[filter.{}]\nkind = \"{}\"\nscheme = \"{}\"\n", filter.name, name_of(kinds, filter.fuzzy),
                        name_of(schemes, filter.scheme));
    text += as_toml(filter.motions);
    const bool turns = std::any_of(filter.motions.begin(), filter.motions.end(),
                                   [](const Motion& motion) { return !motion.linear(); });
    if (turns || filter.radar_measurement == RadarForm::polar)
      text += fmt::format("member = \"{}\"\n", name_of(members, filter.member));
    if (filter.scheme != Scheme::independent && !filter.sojourn_s.empty()) {
      text += fmt::format("sojourn_s = {}\n", toml_list(filter.sojourn_s));
    } else if (filter.scheme != Scheme::independent) {
      std::vector<std::string> rows;
      for (const auto& row : filter.transition) rows.push_back(toml_list(row));
      text += fmt::format("{} = [{}]\n", filter.fuzzy ? "transition_possibility" : "transition_probability",
                          fmt::join(rows, ", "));
    }
    if (filter.fuzzy && mixes)
      text += fmt::format("mixed_covariance = \"{}\"\n", name_of(mixed_covariances, filter.mixed_covariance));
    if (filter.fuzzy && filter.scheme != Scheme::independent)
      text += fmt::format("mixing_tie = \"{}\"\n", name_of(ties, filter.mixing_tie));
    if (!filter.fuzzy && mixes)
      text += fmt::format("imm_mixing = \"{}\"\n", name_of(mixing_weights, filter.imm_mixing));
    if (!filter.fuzzy) text += fmt::format("output_spread = \"{}\"\n", name_of(spreads, filter.output_spread));
    text += fmt::format("likelihood = \"{}\"\nlift = \"{}\"\noutput = \"{}\"\noutput_tie = \"{}\"\nstart = \"{}\"\n",
                        name_of(likelihoods, filter.likelihood), name_of(lifts, filter.lift),
                        name_of(outputs, filter.most_likely_output), name_of(ties, filter.output_tie),
                        name_of(starts, filter.start));
    if (turns) text += fmt::format("start_sigma_turn_deg_s = {}\n", toml_number(filter.start_sigma_turn_deg_s));
    if (filter.start == Start::given) {
      text += fmt::format("start_mean = {}\nstart_covariance_diagonal = {}\n", toml_list(filter.start_mean),
                          toml_list(filter.start_covariance_diagonal));
      if (filter.start_time_s) text += fmt::format("start_time_s = {}\n", toml_number(*filter.start_time_s));
    }
    if (filter.gate_probability < 1.0)
      text += fmt::format("gate_probability = {}\n", toml_number(filter.gate_probability));
    if (filter.restart_after_s) text += fmt::format("restart_after_s = {}\n", toml_number(*filter.restart_after_s));
    if (filter.smooth) text += "smooth = true\n";
    text += fmt::format("radar_measurement = \"{}\"\n", name_of(radar_forms, filter.radar_measurement));
    text += as_toml(filter.accuracy);
    for (const auto& [sensor, accuracy] : filter.sensors)
      text += fmt::format("\n[filter.{}.sensor.\"{}\"]\n{}", filter.name, sensor, as_toml(accuracy));
  }
  return text;
}

}  // namespace sigmax::apps
