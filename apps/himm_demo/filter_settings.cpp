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
const Names<bool> kinds = {{"imm", false}, {"himm", true}};
const Names<bool> outputs = {{"mixed", false}, {"most_likely", true}};

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

/// The distinct names of the models: a second dwna is dwna_2.
std::vector<std::string> distinct(const std::vector<std::string>& names) {
  std::vector<std::string> result;
  for (const auto& name : names) {
    const auto before = std::count(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(result.size()), name);
    result.push_back(before == 0 ? name : fmt::format("{}_{}", name, before + 1));
  }
  return result;
}

bool default_kind(const Settings& settings, const std::string& name) {
  if (name.starts_with("himm")) return true;
  if (name.starts_with("imm")) return false;
  throw settings.error("filters", "names that begin with imm or himm, or a table [filter." + name + "] with a kind",
                       "add filter." + name + ".kind = \"imm\" or \"himm\"");
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
  const auto types = settings.strings("models", {"dwna", "dwpa"});
  if (types.empty()) throw settings.error("models", "at least one of dwna, dwpa");
  for (const auto& type : types) {
    if (type != "dwna" && type != "dwpa") throw settings.error("models", "names out of dwna, dwpa");
    filter.orders.push_back(type == "dwna" ? 2 : 3);
  }
  filter.models = distinct(types);
  const std::size_t modes = types.size();

  filter.sigma_w = settings.numbers("sigma_w", {defaults.sigma_w});
  if (filter.sigma_w.size() == 1) filter.sigma_w.resize(modes, filter.sigma_w.front());
  if (filter.sigma_w.size() != modes) throw settings.error("sigma_w", "one number, or one for each model");
  for (const double sigma : filter.sigma_w)
    if (!(sigma >= 0.0)) throw settings.error("sigma_w", "numbers that are not negative, in m/s²");

  // Both transitions are asked for, so that one for the other kind of filter is no unknown key.
  const double leaves = modes > 1 ? 0.05 / static_cast<double>(modes - 1) : 0.0;
  const auto probability =
      settings.matrix("transition_probability", transition_of(modes, modes > 1 ? 0.95 : 1.0, leaves));
  const auto possibility = settings.matrix("transition_possibility", transition_of(modes, 1.0, defaults.possibility));
  filter.transition = fuzzy ? possibility : probability;
  refuse_bad_transition(settings, fuzzy ? "transition_possibility" : "transition_probability", filter);

  filter.mixed_covariance = settings.choice("mixed_covariance", mixed_covariances, defaults.mixed_covariance);
  filter.imm_mixing = settings.choice("imm_mixing", mixing_weights, defaults.imm_mixing);
  filter.lift = settings.choice("lift", lifts, defaults.lift);
  filter.mixing_tie = settings.choice("mixing_tie", ties, defaults.mixing_tie);
  filter.output_tie = settings.choice("output_tie", ties, defaults.output_tie);
  filter.most_likely_output = settings.choice("output", outputs, false);

  filter.start = settings.choice("start", starts, defaults.start);
  filter.start_mean = settings.numbers("start_mean", {});
  filter.start_covariance_diagonal = settings.numbers("start_covariance_diagonal", {});
  filter.start_time_s = settings.number("start_time_s");
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

  Accuracy usual{defaults.sigma_radar, {10.0}};
  filter.accuracy = read_accuracy(settings, usual);
  const Settings sensors = settings.sub("sensor");
  for (const auto& sensor : sensors.names())
    filter.sensors.emplace(sensor, read_accuracy(sensors.sub(sensor), filter.accuracy));
  return filter;
}

std::string listed(const std::vector<double>& numbers) {
  std::vector<std::string> texts;
  for (const double number : numbers) {
    std::string text = shortest(number);
    if (text.find_first_of(".eni") == std::string::npos) text += ".0";  // TOML tells integers from floats
    texts.push_back(std::move(text));
  }
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

std::string as_toml(const Accuracy& accuracy) {
  return fmt::format("sigma_range_m = {}\nsigma_azimuth_deg = {}\nsigma_elevation_deg = {}\nsigma_position_m = {}\n",
                     shortest(accuracy.radar.range), shortest(accuracy.radar.azimuth / degree),
                     shortest(accuracy.radar.elevation / degree), listed(accuracy.position_m));
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

std::vector<FilterSettings> read_filters(const Settings& settings, const FilterDefaults& defaults) {
  const auto names = settings.strings("filters", defaults.filters);
  if (names.empty()) throw settings.error("filters", "the name of at least one filter");
  const Settings tables = settings.sub("filter");
  const auto read = [&](const std::string& name) {
    const Settings table = tables.sub(name);
    const bool fuzzy = table.has("kind") ? table.choice("kind", kinds, false) : default_kind(settings, name);
    FilterDefaults own = defaults;
    if (name == "imm_correct") own.imm_mixing = MixingWeights::correct;
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

std::string as_toml(const std::vector<FilterSettings>& filters) {
  std::vector<std::string> names;
  for (const auto& filter : filters) names.push_back("\"" + filter.name + "\"");
  std::string text = fmt::format("filters = [{}]\n", fmt::join(names, ", "));
  for (const auto& filter : filters) {
    std::vector<std::string> models;
    for (const int order : filter.orders) models.push_back(order == 2 ? "\"dwna\"" : "\"dwpa\"");
    std::vector<std::string> rows;
    for (const auto& row : filter.transition) rows.push_back(listed(row));
    text += fmt::format("\n[filter.{}]\nkind = \"{}\"\n", filter.name, name_of(kinds, filter.fuzzy));
    text += fmt::format("models = [{}]\nsigma_w = {}\n", fmt::join(models, ", "), listed(filter.sigma_w));
    text += fmt::format("{} = [{}]\n", filter.fuzzy ? "transition_possibility" : "transition_probability",
                        fmt::join(rows, ", "));
    if (filter.fuzzy)
      text += fmt::format("mixed_covariance = \"{}\"\nmixing_tie = \"{}\"\n",
                          name_of(mixed_covariances, filter.mixed_covariance), name_of(ties, filter.mixing_tie));
    else
      text += fmt::format("imm_mixing = \"{}\"\n", name_of(mixing_weights, filter.imm_mixing));
    text += fmt::format("lift = \"{}\"\noutput = \"{}\"\noutput_tie = \"{}\"\nstart = \"{}\"\n",
                        name_of(lifts, filter.lift), name_of(outputs, filter.most_likely_output),
                        name_of(ties, filter.output_tie), name_of(starts, filter.start));
    if (filter.start == Start::given) {
      text += fmt::format("start_mean = {}\nstart_covariance_diagonal = {}\n", listed(filter.start_mean),
                          listed(filter.start_covariance_diagonal));
      if (filter.start_time_s) text += fmt::format("start_time_s = {}\n", shortest(*filter.start_time_s));
    }
    text += as_toml(filter.accuracy);
    for (const auto& [sensor, accuracy] : filter.sensors)
      text += fmt::format("\n[filter.{}.sensor.\"{}\"]\n{}", filter.name, sensor, as_toml(accuracy));
  }
  return text;
}

}  // namespace sigmax::apps
