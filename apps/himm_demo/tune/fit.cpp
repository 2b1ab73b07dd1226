#include <cstdlib>

#include <boost/algorithm/string/split.hpp>

#include "himm_demo/tune/tune.hpp"
#include "shell/progress.hpp"

namespace sigmax::apps {
namespace {

/// Of candidates without a gate of their own: what it turns away is unheard of, yet would move a filter.
constexpr double usual_gate = 1.0 - 1e-8;
constexpr double usual_rejections = 3.0;  // in a row, as a start wants

constexpr double usual_sojourn_steps = 20.0;  // as .95 on the diagonal
constexpr std::size_t blocks = 20;            // of rows whose errors last, as those of estimates do

/// A number of a filter's settings that is fitted.
struct Number : FreeNumber<FilterSettings> {
  double rounding = 0.0;  ///< of a sensor's: what its column resolves
};

double rounded(double value) { return std::strtod(fmt::format("{:.4g}", value).c_str(), nullptr); }

void add_sensor(const FilterSettings& settings, const std::string& name, const TuneData& data,
                std::vector<Number>& numbers) {
  using enum AnyDetection::Sensor;
  const TuneSensor& sensor = data.sensors.at(name);
  const SensorSettings& now = settings.accuracy_of(name);
  // Of quantities of a kind, from one to another: no less than their rounding, no more than they change from row to
  // row.
  const auto add = [&](std::string_view what, double start, Sensor kind, int from, int to, double unit,
                       const std::function<void(SensorSettings&, double)>& set) {
    const auto column = sensor.rounding.lower_bound({kind, from});
    if (kind == components && !sensor.rounding.empty() &&
        (column == sensor.rounding.end() || MeasuredQuantity(kind, to) < column->first))
      return;  // a sensor that never sees it
    const double least = sensor.rounding_of(kind, from, to) / unit;
    double most = 0.0;
    for (int i = from; i <= to; ++i) most = std::max(most, data.scale.change({kind, i}) / unit);
    if (std::isinf(least) || !(most > 0.0)) return;  // a column that never changes tells nothing of its noise
    numbers.push_back({{{.name = fmt::format("{}{}{}", what, name.empty() ? "" : " of ", name),
                         .start = start,
                         .least = std::max(least, 1e-5 * most),
                         .most = std::max(30.0 * most, 3.0 * least),
                         .step = 0.7},
                        [=](FilterSettings& changed, double value) {
                          set(name.empty() ? changed.accuracy
                                           : changed.sensors.try_emplace(name, changed.accuracy).first->second,
                              value);
                        }},
                       least});
  };
  // One number for axes from one to another, which keep their ratio.
  const auto add_axes = [&](std::string_view whose, int from, int to) {
    auto sigma = now.position_m;
    if (data.axes == 3) sigma.resize(3, sigma.back());
    const double start = sigma[sigma.size() == 1 ? 0 : static_cast<std::size_t>(from)];
    add(fmt::format("{}sigma_position_m", whose), start, components, from, to, 1.0,
        [=](SensorSettings& accuracy, double value) {
          if (accuracy.position_m.size() < sigma.size()) accuracy.position_m = sigma;
          for (std::size_t i = 0; i < sigma.size(); ++i)
            if (sigma.size() == 1 || (static_cast<int>(i) >= from && static_cast<int>(i) <= to))
              accuracy.position_m[i] = value * (sigma[i] / start);
        });
  };
  if (sensor.position) {
    add_axes("", 0, std::min(data.axes, 2) - 1);
    if (data.axes == 3) add_axes("height's ", 2, 2);
  }
  if (sensor.velocity && now.velocity_mps)
    add("sigma_velocity_mps", *now.velocity_mps, components, data.axes, 2 * data.axes, 1.0,
        [](SensorSettings& accuracy, double value) { accuracy.velocity_mps = value; });
  if (sensor.range_rate && now.range_rate_mps)
    add("sigma_range_rate_mps", *now.range_rate_mps, polar, data.axes, data.axes, 1.0,
        [](SensorSettings& accuracy, double value) { accuracy.range_rate_mps = value; });
  const std::array radar_names = {"sigma_range_m", "sigma_azimuth_deg", "sigma_elevation_deg"};
  for (const int i : {1, 0, 2}) {
    if (!(sensor.radar || (i == 1 && sensor.bearing)) || (i == 2 && data.axes < 3)) continue;
    const auto place = static_cast<std::size_t>(i);
    const double unit = i == 0 ? 1.0 : degree;
    const bool alone = sensor.bearing && !sensor.radar;
    add(radar_names[place], now.radar[place] / unit, alone ? bearing : polar, alone ? 0 : i, alone ? 0 : i, unit,
        [=](SensorSettings& accuracy, double value) { accuracy.radar[place] = value * unit; });
  }
}

/// All that a search may change. By the RMSE, which a common factor of all noises leaves as it is, the sensors stay as
/// they are.
std::vector<Number> free_numbers(const FilterSettings& settings, const TuneData& data, const TuneOptions& options) {
  std::vector<Number> numbers;
  if (options.fits("models"))
    for (auto& number : motion_numbers(settings, data.scale)) numbers.push_back({{number.parameter, number.set}});
  if (options.fits("sensors") && !options.truth)
    for (const auto& [name, sensor] : data.sensors) add_sensor(settings, name, data, numbers);
  if (options.fits("transition") && settings.scheme != Scheme::independent)
    for (auto& number : transition_numbers(settings, data.scale)) numbers.push_back({{number.parameter, number.set}});
  return numbers;
}

/// The settings with these numbers, to four digits.
FilterSettings with(FilterSettings settings, const std::vector<Number>& numbers, const std::vector<double>& values) {
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i].set(settings, rounded(values[i]));
  return settings;
}

/// Other motions in place of the filter's: models that it had keep their parameters.
FilterSettings with_models(const FilterSettings& settings, const std::string& joined) {
  FilterSettings result = settings;
  const auto known = each(known_motions(), &KnownMotion::name);
  std::vector<std::string> names;
  boost::split(names, joined, [](char letter) { return letter == '+'; });
  for (const std::string& name : names)
    if (!known_motion(name))
      throw UsageError({.what = "--models",
                        .found = in_quotes(name),
                        .expected = fmt::format("one of {}, joined by + as dwna+dwpa", fmt::join(known, ", ")),
                        .remedy = nearest_word(name, known)});
  replace_models(result, names);
  const std::size_t modes = result.models.size();
  if (modes == settings.models.size()) return result;
  result.transition = default_transition(result, result.fuzzy);
  if (!result.sojourn_s.empty()) result.sojourn_s.assign(modes > 1 ? modes : 0, result.sojourn_s.front());
  return result;
}

/// What a radar measured is predicted in its own space whatever the settings: the covariance of a conversion depends on
/// what was measured, and so is not that of a density. A target at the radar itself, seen in directions without error,
/// would explain everything.
RowLosses judged(const TuneData& data, FilterSettings settings, bool by_truth) {
  if (!by_truth) settings.radar_measurement = RadarForm::polar;
  return losses(data, settings, by_truth);
}

/// How far half of the rows that are withheld, each fourth, are from where the filter expects them, by fold.
struct Withheld {
  double median_m = 0.0, rows = 0.0;
};
std::vector<Withheld> withheld(const TuneData& data, const FilterSettings& settings, const RowFolds& folds,
                               std::size_t count, bool all_rows) {
  std::vector<std::vector<double>> off(count);
  for (std::size_t first = all_rows ? 0 : 3; first < 4; ++first) {
    const auto look = [&](std::size_t t, const TargetPoint& now) {
      const AnyDetection& detection = data.tracks[t].rows[now.tag].detection;
      const bool whole = now.tag % 4 == first && axes_seen(detection, data.axes) == data.axes;
      const auto seen = whole ? position_of(detection, data.axes) : std::nullopt;
      double squares = 0.0;
      for (std::size_t i = 0; seen && i < static_cast<std::size_t>(data.axes); ++i)
        squares += std::pow((*seen)[i] - now.mean[i], 2);
      if (seen) off[folds[t][now.tag]].push_back(std::sqrt(squares));
    };
    losses(data, settings, false, look, first);
  }
  std::vector<Withheld> all;
  for (auto& own : off) all.push_back({own.empty() ? 0.0 : median(own), static_cast<double>(own.size())});
  return all;
}

/// By how much they are farther off than before, beyond chance: the mean over folds of a logarithm.
double farther(const std::vector<Withheld>& now, const std::vector<Withheld>& before) {
  constexpr double chance = 0.1;  // of the medians of one row, both of the same rows
  double sum = 0.0;
  for (std::size_t f = 0; f < now.size(); ++f)
    if (now[f].median_m > 0.0 && before[f].median_m > 0.0)
      sum += std::max(0.0, std::log(now[f].median_m / before[f].median_m) - chance / std::sqrt(before[f].rows));
  return sum / static_cast<double>(now.size());
}

/// What a search makes less: the losses, and more of all where rows that are withheld are farther off than by the
/// settings before. A likelihood looks one row ahead only, and may prefer models that lose a target in a gap.
RowLosses searched(const TuneData& data, const FilterSettings& settings, const TuneOptions& options,
                   const RowFolds& folds, const std::vector<Withheld>& before) {
  constexpr double nats = 10.0;
  RowLosses all = judged(data, settings, options.truth);
  if (options.truth) return all;
  const double more = nats * farther(withheld(data, settings, folds, options.folds, false), before);
  for (auto& rows : all)
    for (double& loss : rows) loss += more;
  return all;
}

/// Fits one set of models, with a regard for gaps or without one.
Candidate fitted(const std::string& name, FilterSettings base, const TuneData& data, const TuneOptions& options,
                 const std::vector<Withheld>* before, Progress& progress) {
  Candidate best;
  const bool prequential = !options.truth;
  const RowFolds folds = data.folds(options.folds);
  std::vector<StateAugmentation> rules = {base.augmentation};
  for (const auto rule : {StateAugmentation::zero, StateAugmentation::borrowed_variance, StateAugmentation::unbiased})
    if (options.fits("augmentation") && rule != base.augmentation && base.motions.size() > 1) rules.push_back(rule);
  double least = infinity;
  for (const StateAugmentation rule : rules) {
    const auto numbers = free_numbers(base, data, options);
    base.augmentation = rule;
    const auto objective = [&](const RowLosses& all, const RowCounts& counts) {
      return objective_of(data, all, options.truth, counts);
    };
    const auto lost = [&](const std::vector<double>& values) {
      progress.advance();
      const FilterSettings tried = with(base, numbers, values);
      return before ? searched(data, tried, options, folds, *before) : judged(data, tried, options.truth);
    };
    const bool again = least < infinity;  // by another augmentation, from where the first one led
    if (again &&
        !(objective(lost(each(numbers, [](const Number& number) { return number.parameter.start; })), {}) < least))
      continue;
    const TuneProblem problem{each(numbers, &Number::parameter), lost, objective, !options.truth};
    const SearchOptions how{.samples = again ? 0U : 40U,
                            .starts = again ? 1 : 2 * options.starts,
                            .local = 14,
                            .rounds = 3,
                            .seed = options.seed};
    const Tuned tuned = tune(problem, folds, how);
    if (!(tuned.fit.loss < least)) continue;
    least = tuned.fit.loss;
    best = {name, with(base, numbers, tuned.fit.values), numbers.size(), {}, tuned.held_out};
    const auto errors =
        standard_errors(problem, tuned, prequential ? 1 : std::max<std::size_t>(data.measurements / blocks, 1));
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const FitParameter& parameter = numbers[i].parameter;
      const double value = tuned.fit.values[i], unit = parameter.scale == Scale::linear ? parameter.unit : value;
      best.numbers.push_back(
          {parameter.name, value, errors[i] * unit, numbers[i].rounding > 0.0 && value <= 1.001 * numbers[i].rounding});
    }
    base = best.settings;
  }
  best.settings = read_filters(Settings::parse(as_toml({best.settings})), {}).front();
  best.losses = judged(data, best.settings, options.truth);
  return best;
}

}  // namespace

std::vector<std::pair<std::string, FilterSettings>> model_sets(const FilterSettings& settings,
                                                               const TuneOptions& options, const TuneData* data) {
  std::vector<std::string> names = options.models;
  const bool moving = data && std::ranges::any_of(data->sensors, [](const auto& own) { return own.second.velocity; });
  const bool continuous = names.empty() && data && (data->scale.uneven || moving);
  if (names.empty()) {
    auto motions = each(settings.motions, &MotionChoice::name);
    for (const auto& [fixed, free] : {std::pair{"dwna", "cwna"}, std::pair{"dwpa", "cwpa"}})
      if (continuous) std::ranges::replace(motions, std::string(fixed), std::string(free));
    names = {fmt::format("{}", fmt::join(motions, "+"))};
    for (const auto& motion : motions)
      if (std::ranges::find(names, motion) == names.end()) names.push_back(motion);
  }
  std::vector<std::pair<std::string, FilterSettings>> sets;
  for (const auto& name : names) {
    FilterSettings own = with_models(settings, name);
    if (own.gate_probability == 1.0) {
      own.gate_probability = usual_gate;
      own.restart_after_rejections = usual_rejections;
    }
    if (continuous && own.sojourn_s.empty() && own.models.size() > 1 && own.scheme != Scheme::independent)
      own.sojourn_s.assign(own.models.size(), usual_sojourn_steps * data->scale.step_s);
    sets.emplace_back(name, std::move(own));
  }
  return sets;
}

TunedFilter tune(const FilterSettings& settings, TuneData& data, const TuneOptions& options) {
  const auto sets = model_sets(settings, options, &data);
  const RowFolds folds = data.folds(options.folds);
  TunedFilter tuned{{{.name = "as before", .settings = settings}}};
  Candidate& before = tuned.candidates.front();
  before.losses = before.held_out = judged(data, settings, options.truth);
  data.most_strays = std::max(0.05, data.robust.strays(before.losses));
  const auto fourth_before = withheld(data, settings, folds, options.folds, false);
  const auto withheld_before = withheld(data, settings, folds, options.folds, true);
  std::size_t work = 0;
  for (const auto& [name, base] : sets) {
    const std::size_t n = free_numbers(base, data, options).size();
    work += 40 * n + (2 * options.starts + 2) * 14 * (n + 1) + LossSurface::asked(n) + options.folds + 2 * n;
  }
  const auto is_as_near = [&](const Candidate& found) {
    return farther(withheld(data, found.settings, folds, options.folds, true), withheld_before) == 0.0;
  };
  Progress progress(settings.name, work, options.output.quiet);
  for_each_run(
      sets.size(), options.threads,
      [&](std::size_t c) {
        Candidate found = fitted(sets[c].first, sets[c].second, data, options, nullptr, progress);
        if (!options.truth && !is_as_near(found))
          found = fitted(sets[c].first, sets[c].second, data, options, &fourth_before, progress);
        return found;
      },
      [&](std::size_t, Candidate&& found) { tuned.candidates.push_back(std::move(found)); });
  const auto loss = [&](const Candidate& of) { return objective_of(data, of.losses, options.truth); };
  std::vector<RowLosses> held_out = {tuned.before().held_out};
  for (std::size_t c = 1; c < tuned.candidates.size(); ++c) {
    Candidate& candidate = tuned.candidates[c];
    candidate.gain = mean_difference(tuned.before().held_out, candidate.held_out);
    const bool better = loss(candidate) < loss(tuned.before()) && (options.truth || is_as_near(candidate));
    held_out.push_back(better ? candidate.held_out : held_out.front());  // of equals the first one is taken
  }
  tuned.selected = select_settings(held_out, each(tuned.candidates, &Candidate::fitted_numbers));
  return tuned;
}

}  // namespace sigmax::apps
