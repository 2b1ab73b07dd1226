#include "himm_demo/tune/tune.hpp"

#include <cstdlib>
#include <numeric>

#ifdef SIGMAX_TUNING
#include <sigmax/tuning/search.hpp>
#else
#include <sigmax/hybrid/fit.hpp>
#endif

#include <boost/algorithm/string/split.hpp>

#include <sigmax/estimation/chi_square.hpp>
#include <sigmax/hybrid/fit_target.hpp>

#include "shell/progress.hpp"

namespace sigmax::apps {

bool can_search() {
#ifdef SIGMAX_TUNING
  return true;
#else
  return false;
#endif
}

namespace {

constexpr std::size_t rounds = 2;  // of a search and the transition's EM
constexpr std::size_t most_em_steps = 3;
constexpr double least_improvement = 1e-4;  // nats a row
constexpr double no_more = 0.01;            // of all rows: chance, not another kind of fit
constexpr double surface_step = 0.25;       // of a logarithm: rows jump over the gate, which is no slope

/// Of candidates without a gate of their own: what it turns away is unheard of, yet would move a filter.
constexpr double usual_gate = 1.0 - 1e-8;
constexpr double usual_rejections = 3.0;  // in a row, as a start wants

constexpr double usual_sojourn_steps = 20.0;  // as .95 on the diagonal

constexpr std::array factors = {0.03, 0.1, 0.3, 3.0, 10.0, 30.0};  // by which a number may be off at first
constexpr std::array turns = {0.1, 0.3, 1.0, 2.0, 3.0, 5.0, 8.0, 12.0, 20.0, 30.0};  // at first, in ° a step
constexpr std::size_t most_sweeps = 4;
constexpr double nothing = 1e-3;    // as good as, times a noise
constexpr std::size_t blocks = 20;  // of rows whose errors last, as those of estimates do

/// How often a search of n numbers may ask.
std::size_t budget(std::size_t numbers) { return numbers == 0 ? 1 : 25 * (numbers + 1); }

/// A number of a filter's settings that is fitted, and where it stands.
struct FreeNumber {
  FitParameter parameter;
  std::function<void(FilterSettings&, double)> set;
  bool sensor = false;    ///< whether it is a sensor's
  bool relative = false;  ///< whether `set` changes what is there by it
  bool noise = false;     ///< whether it is a standard deviation
  double least = 0.0;     ///< of a sensor's: what its column resolves; `set` takes no less

  bool is_least() const { return least > 0.0 && parameter.start <= least; }
};

double rounded(double value) {
  return value == 0.0 ? value : std::strtod(fmt::format("{:.4g}", value).c_str(), nullptr);
}

/// Turns are searched in degrees a step, so that no unit of time matters.
void add_motions(const FilterSettings& settings, const TuneData& data, std::vector<FreeNumber>& numbers) {
  for (std::size_t j = 0; j < settings.motions.size(); ++j)
    for (const auto which :
         {MotionParameter::sigma_w, MotionParameter::tau, MotionParameter::turn_rate, MotionParameter::turn_drift}) {
      const MotionChoice& motion = settings.motions[j];
      const bool linear = which == MotionParameter::turn_rate;
      if (!motion.known().has_parameter(which) || !(linear || motion[which] > 0.0)) continue;
      const auto& known = motion_parameters()[static_cast<std::size_t>(which)];
      numbers.push_back({.parameter = {.name = fmt::format("{} of {}", known.key, settings.models[j]),
                                       .start = motion[which],
                                       .scale = linear ? Scale::linear : Scale::logarithmic,
                                       .unit = 1.0 / data.long_step_s},
                         .set = [=](FilterSettings& changed, double value) { changed.motions[j][which] = value; },
                         .noise = which == MotionParameter::sigma_w || which == MotionParameter::turn_drift});
    }
}

/// The accuracy of a sensor: that of all where rows name none.
Accuracy& accuracy_in(FilterSettings& settings, const std::string& sensor) {
  return sensor.empty() ? settings.accuracy : settings.sensors.try_emplace(sensor, settings.accuracy).first->second;
}

void add_sensor(const FilterSettings& settings, const std::string& name, const TuneSensor& sensor, int axes,
                std::vector<FreeNumber>& numbers) {
  const Accuracy& now = settings.accuracy_of(name);
  const auto add = [&](std::string_view what, double start, double least,
                       const std::function<void(Accuracy&, double)>& set) {
    if (std::isinf(least)) return;  // a column that never changes tells nothing of its noise
    numbers.push_back(
        {.parameter = {.name = fmt::format("{}{}{}", what, name.empty() ? "" : " of ", name),
                       .start = std::max(start, least)},
         .set = [=](FilterSettings& changed, double value) { set(accuracy_in(changed, name), std::max(value, least)); },
         .sensor = true,
         .noise = true,
         .least = least});
  };
  const auto least = [&](int from, int to) { return sensor.rounding_of(AnyPlot::Sensor::components, from, to); };
  if (sensor.position) {
    // One number for axes from one to another, which keep their ratio.
    const auto add_axes = [&](std::string_view whose, int from, int to) {
      if (!sensor.sees(from, to)) return;
      auto sigma = now.position_m;
      if (axes == 3 || sensor.apart) sigma.resize(3, sigma.back());
      const double start = sigma[sigma.size() == 1 ? 0 : static_cast<std::size_t>(from)];
      add(fmt::format("{}sigma_position_m", whose), start, least(from, to), [=](Accuracy& accuracy, double value) {
        if (accuracy.position_m.size() < sigma.size()) accuracy.position_m = sigma;
        for (std::size_t i = 0; i < sigma.size(); ++i)
          if (sigma.size() == 1 || (static_cast<int>(i) >= from && static_cast<int>(i) <= to))
            accuracy.position_m[i] = value * (sigma[i] / start);
      });
    };
    const int last = std::min(axes, 2) - 1;
    add_axes(sensor.apart ? "x's " : "", 0, sensor.apart ? 0 : last);
    if (sensor.apart) add_axes("y's ", 1, 1);
    if (axes == 3) add_axes("height's ", 2, 2);
  }
  if (sensor.velocity && now.velocity_mps)
    add("sigma_velocity_mps", *now.velocity_mps, least(axes, 2 * axes),
        [](Accuracy& accuracy, double value) { accuracy.velocity_mps = value; });
  if (sensor.range_rate && now.range_rate_mps)
    add("sigma_range_rate_mps", *now.range_rate_mps, sensor.rounding_of(AnyPlot::Sensor::doppler, axes, axes),
        [](Accuracy& accuracy, double value) { accuracy.range_rate_mps = value; });
  const std::array radar_names = {"sigma_range_m", "sigma_azimuth_deg", "sigma_elevation_deg"};
  for (const int i : {1, 0, 2}) {
    const bool is_seen = sensor.radar || (i == 1 && sensor.bearing);
    if (!is_seen || (i == 2 && axes < 3)) continue;
    const auto place = static_cast<std::size_t>(i);
    const double unit = i == 0 ? 1.0 : degree;
    const double least_of_radar =
        std::max({sensor.rounding_of(AnyPlot::Sensor::polar, i, i), sensor.rounding_of(AnyPlot::Sensor::doppler, i, i),
                  i == 1 ? sensor.rounding_of(AnyPlot::Sensor::bearing, 0, 0) : 0.0});
    add(radar_names[place], now.radar[place] / unit, least_of_radar / unit,
        [=](Accuracy& accuracy, double value) { accuracy.radar[place] = value * unit; });
  }
}

/// Leaving for another mode becomes more likely, or more possible, by a factor.
void leave(FilterSettings& settings, double factor) {
  for (double& sojourn : settings.sojourn_s) sojourn /= factor;
  for (std::size_t i = 0; i < settings.transition.size(); ++i) {
    auto& row = settings.transition[i];
    for (std::size_t j = 0; j < row.size(); ++j)
      if (j != i) row[j] *= factor;
    const double total = settings.fuzzy ? *std::ranges::max_element(row) : std::accumulate(row.begin(), row.end(), 0.0);
    for (double& value : row) value /= total;
  }
}

/// Whether there is a transition to fit.
bool has_transition(const FilterSettings& settings, const TuneOptions& options) {
  return settings.models.size() > 1 && settings.scheme != Scheme::independent && options.fits("transition");
}

/// All that a search may change: the parameters of the models, the sensors' standard deviations, and one factor on
/// leaving any mode. By the RMSE, which a common factor of all noises leaves as it is, the sensors stay as they are.
std::vector<FreeNumber> free_numbers(const FilterSettings& settings, const TuneData& data, const TuneOptions& options) {
  std::vector<FreeNumber> numbers;
  if (options.fits("models")) add_motions(settings, data, numbers);
  if (options.fits("sensors") && options.objective != Objective::rmse)
    for (const auto& [name, sensor] : data.sensors) add_sensor(settings, name, sensor, data.axes, numbers);
  if (has_transition(settings, options))
    numbers.push_back({{.name = "leaving a mode, times", .start = 1.0}, leave, false, true});
  return numbers;
}

/// The settings with these numbers.
FilterSettings with(FilterSettings settings, const std::vector<FreeNumber>& numbers,
                    const std::vector<double>& values) {
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i].set(settings, values[i]);
  return settings;
}

/// Models of a fixed step as those of continuous time, which leave open what a way of so many seconds was, where the
/// velocities at its ends are known: a sensor's noise may stand for that. Whether there were any.
bool continue_motions(FilterSettings& settings, double step_s) {
  bool any = false;
  for (MotionChoice& motion : settings.motions) {
    const bool by_velocity = motion.name == "dwna";
    if (!by_velocity && motion.name != "dwpa") continue;
    motion.name = by_velocity ? "cwna" : "cwpa";
    motion[MotionParameter::sigma_w] *= std::pow(step_s, by_velocity ? 0.5 : -0.5);
    any = true;
  }
  settings.models = names_of(settings.motions);
  return any;
}

/// Numbers that another filter was given, its sensors' alone or all, to begin with.
void borrow(FilterSettings& settings, const FilterSettings& from, bool sensors_alone, const TuneData& data,
            const TuneOptions& options) {
  const auto theirs = free_numbers(from, data, options);
  for (const FreeNumber& number : free_numbers(settings, data, options))
    for (const FreeNumber& other : theirs)
      if (other.parameter.name == number.parameter.name && !number.relative && (number.sensor || !sensors_alone))
        number.set(settings, other.parameter.start);
}

/// So many numbers are fitted, those of the transition included.
std::size_t count_of(const std::vector<FreeNumber>& numbers, const FilterSettings& settings,
                     const TuneOptions& options) {
  if (!has_transition(settings, options)) return numbers.size();
  const std::size_t modes = settings.models.size();  // the factor on leaving is one of those of the transition
  return numbers.size() - 1 + (settings.sojourn_s.empty() ? modes * (modes - 1) : modes);
}

/// Every fitted number to four digits, as people write them; transitions stay normalised.
void round_off(FilterSettings& settings) {
  for (auto& motion : settings.motions)
    for (double& value : motion.parameters) value = rounded(value);
  const auto round_accuracy = [](Accuracy& accuracy) {
    for (double& sigma : accuracy.position_m) sigma = rounded(sigma);
    if (accuracy.velocity_mps) accuracy.velocity_mps = rounded(*accuracy.velocity_mps);
    if (accuracy.range_rate_mps) accuracy.range_rate_mps = rounded(*accuracy.range_rate_mps);
    accuracy.radar = {rounded(accuracy.radar[0]), rounded(accuracy.radar[1] / degree) * degree,
                      rounded(accuracy.radar[2] / degree) * degree};
  };
  round_accuracy(settings.accuracy);
  for (auto& [name, accuracy] : settings.sensors) round_accuracy(accuracy);
  for (double& sojourn : settings.sojourn_s) sojourn = rounded(sojourn);
  for (std::size_t i = 0; i < settings.transition.size(); ++i) {
    auto& row = settings.transition[i];
    double others = 0.0;
    for (std::size_t j = 0; j < row.size(); ++j) {
      if (settings.fuzzy || j != i) row[j] = rounded(row[j]);
      if (j != i) others += row[j];
    }
    if (!settings.fuzzy) row[i] = std::strtod(fmt::format("{:.12f}", 1.0 - others).c_str(), nullptr);
  }
}

/// The transition of so many models of which nothing is known.
void set_usual_transition(FilterSettings& settings) {
  const std::size_t modes = settings.models.size();
  const double others =
      settings.fuzzy ? settings.leaving_possibility : 0.05 / static_cast<double>(std::max<std::size_t>(modes, 2) - 1);
  settings.transition.assign(modes, std::vector<double>(modes, others));
  for (std::size_t i = 0; i < modes; ++i) settings.transition[i][i] = settings.fuzzy || modes == 1 ? 1.0 : 0.95;
}

/// Other motions in place of the filter's: models that it had keep their parameters.
FilterSettings with_models(const FilterSettings& settings, const std::string& joined) {
  FilterSettings result = settings;
  result.motions.clear();
  const auto known = each(known_motions(), &KnownMotion::name);
  std::vector<MotionChoice> left = settings.motions;
  std::vector<std::string> names;
  boost::split(names, joined, [](char letter) { return letter == '+'; });
  for (const std::string& name : names) {
    if (!known_motion(name))
      throw UsageError({.what = "--models",
                        .found = in_quotes(name),
                        .expected = fmt::format("one of {}, joined by + as dwna+dwpa", fmt::join(known, ", ")),
                        .remedy = nearest_word(name, known)});
    const auto same = std::ranges::find(left, name, &MotionChoice::name);
    result.motions.push_back(same == left.end() ? settings.motions.front() : *same);
    result.motions.back().name = name;
    if (same != left.end()) left.erase(same);
  }
  result.models = names_of(result.motions);
  const std::size_t modes = result.models.size();
  if (modes == settings.models.size()) return result;
  set_usual_transition(result);
  if (!result.sojourn_s.empty()) {
    const double usual = result.sojourn_s.front();
    result.sojourn_s.assign(modes > 1 ? modes : 0, usual);
  }
  return result;
}

/// The settings by which predictions are compared. What a radar measured is predicted in its own space whatever the
/// settings: the covariance of a conversion depends on what was measured, and so is not that of a density. A target at
/// the radar itself, seen in directions without error, would explain everything.
FilterSettings judged_settings(FilterSettings settings, Objective objective) {
  if (objective == Objective::prequential) settings.radar_measurement = RadarForm::polar;
  return settings;
}

/// The losses, or for each row that has a measurement a very great one where the filter fails.
RowLosses judged(const TuneData& data, const FilterSettings& settings, Objective objective) {
  try {
    return losses(data, judged_settings(settings, objective), objective);
  } catch (const std::exception&) {
    constexpr double of_failure = 1e6;
    RowLosses result;
    for (const TuneTrack& track : data.tracks)
      result.push_back(each(track.rows, [](const Row& row) { return row.measured() ? of_failure : nan; }));
    return result;
  }
}

/// One fit: of settings, to the rows that count. It draws no random numbers but those of the start.
class Fitter {
 public:
  Fitter(const TuneData& data, const TuneOptions& options, Progress& progress, RowCounts counts = {})
      : data_(data), options_(options), progress_(progress), counts_(std::move(counts)) {}

  /// Takes the other if it is better, unless more rows are stray to it: of places that were held or interpolated some
  /// are exact, and all others would be given up.
  void keep_better(Fitted& best, Fitted other) const {
    if (other.fitted < best.fitted && share_of_strays(other.settings) < share_of_strays(best.settings) + no_more)
      best = std::move(other);
  }

  /// From far away: great steps. With those of sensors, and a search from there, also from sensors that are nearly
  /// exact, since from great errors the way to a target that swings within few of its steps leads over worse ones, and
  /// from motions that are: from great noise of theirs the errors of measured velocities are taken for it.
  Fitted far(const FilterSettings& settings, bool with_sensors) const {
    Fitted best = from(settings);
    leave_plateau(best, with_sensors);
    scan(best, with_sensors);
    if (!with_sensors) return best;
    search_numbers(best, 0);
    learn(best);
    const auto also_from = [&](bool sensors, const std::string& alone) {
      constexpr double nearly_exact = 1e-3;
      FilterSettings exact = settings;
      for (const FreeNumber& number : free_numbers(settings, data_, options_))
        if (number.sensor == sensors && number.noise && (alone.empty() || number.parameter.name == alone))
          number.set(exact, nearly_exact * number.parameter.start);
      Fitted other = from(exact);
      if (sensors) scan(other, false);
      keep_better(best, searched(std::move(other)));
    };
    also_from(true, "");
    FilterSettings lasting = settings;
    if (remembers_steps(lasting)) keep_better(best, searched(from(lasting)));
    // Which of several motions is quiet, a search does not find out.
    for (const FreeNumber& number : free_numbers(settings, data_, options_))
      if (number.noise && !number.sensor) also_from(false, number.parameter.name);
    return best;
  }

  /// From where a mode of the other kind leads, fuzzy or random: where one sticks, the other one seldom does.
  void by_other_mode(Fitted& best, const FilterSettings& settings) const {
    FilterSettings other = settings, back = settings;
    other.fuzzy = !settings.fuzzy;
    set_usual_transition(other);
    borrow(back, far(other, true).settings, false, data_, options_);
    keep_better(best, searched(from(back)));
  }

  /// From where those led, by start number `start` about it; and from there with noise of velocities and range rates,
  /// if they are measured, and motions that suit it: by none, all that they change is the target's, as far as a search
  /// sees.
  Fitted fit(const FilterSettings& settings, std::size_t start) const {
    Fitted best = descended(from(settings), start);
    const double before = best.fitted;
    scan(best, true);  // a noise that is next to nothing has no slope
    if (before - best.fitted > least_improvement) best = descended(std::move(best), 0);
    FilterSettings noisy = best.settings;
    if (!takes_noise_of_rates(noisy)) return best;
    Fitted other = from(noisy);
    scan(other, false);
    other = descended(std::move(other), start);
    return other.fitted < best.fitted ? other : best;
  }

  /// The losses about what was found.
  LossSurface surface(const Fitted& about) const {
    const auto numbers = told_numbers(about.settings);
    return {numbers.size(), surface_step, [&](const std::vector<double>& offsets) {
              progress_.advance();
              return judged(data_, moved(about.settings, numbers, offsets), options_.objective);
            }};
  }

  /// To the least loss of the rows that count, by the surface, and the transition anew.
  Fitted refit(const Fitted& about, const LossSurface& surface) const {
    Fitted best = least(about, surface.shape(counts_));
    learn(best);
    return best;
  }

  /// To the least loss, by the surface; the numbers have their standard errors, and a sensor's noise without one is as
  /// great as it may be. The best that was found on the way goes to `better`.
  Fitted with_errors(const Fitted& about, const LossSurface& surface, Fitted& better) const {
    const bool errors_last = options_.objective != Objective::prequential;
    const auto shape = surface.shape(counts_, errors_last ? std::max<std::size_t>(data_.measurements / blocks, 1) : 1);
    Fitted best = least(about, shape);
    std::vector<Fitted> rivals;
    const auto errors = errors_of(best, told_numbers(about.settings), shape, rivals);
    better = best;
    for (const Fitted& rival : rivals)
      if (rival.settings.models == best.settings.models) keep_better(better, rival);
    for (const auto& [name, error] : errors)
      if (const FreeNumber its = named(best.settings, name); !(error < 1.0) && its.sensor && !its.is_least())
        raise(best, name);
    for (const auto& [name, error] : errors) {
      const FreeNumber its = named(best.settings, name);
      const auto& [start, scale, unit] = std::tie(its.parameter.start, its.parameter.scale, its.parameter.unit);
      best.numbers.push_back({name, start, error < 1.0 ? (scale == Scale::linear ? unit : start) * error : infinity,
                              its.is_least(), its.sensor});
    }
    return best;
  }

 private:
  Fitted searched(Fitted best) const {
    scan(best, true);
    search_numbers(best, 0);
    learn(best);
    return best;
  }

  Fitted descended(Fitted best, std::size_t start) const {
    for (std::size_t round = 0; round < rounds; ++round) {
      const double before = best.fitted;
      search_numbers(best, round == 0 ? start : 0);
      learn(best);
      const bool parted = round == 0 && part_models(best);
      if (!(before - best.fitted > least_improvement) && !parted) break;
    }
    return best;
  }

  /// A tau below a step, or of more than a thousand, as one in s is of rows that are days or milliseconds apart, makes
  /// no difference to a search: ten steps instead, in that unit of time. Whether there is any.
  bool remembers_steps(FilterSettings& settings) const {
    bool any = false;
    for (MotionChoice& motion : settings.motions) {
      double& tau = motion[MotionParameter::tau];
      const double steps = tau / data_.long_step_s;
      if (!motion.known().has_parameter(MotionParameter::tau) || (steps >= 1.0 && steps <= 1000.0)) continue;
      const double unit = 10.0 * data_.long_step_s / std::exchange(tau, 10.0 * data_.long_step_s);
      motion[MotionParameter::sigma_w] *= std::pow(unit, 1 - motion.known().derivatives);
      any = true;
    }
    return any && options_.fits("models");
  }

  double share_of_strays(const FilterSettings& settings) const {
    return data_.share_of_strays(judged(data_, settings, options_.objective));
  }

  /// Gives measured velocities and range rates, if there are any, a third of what nine in ten of their changes from row
  /// to row stay below as noise.
  bool takes_noise_of_rates(FilterSettings& settings) const {
    bool any = false;
    for (const FreeNumber& number : free_numbers(settings, data_, options_)) {
      const bool is_range_rate = number.parameter.name.starts_with("sigma_range_rate");
      if (is_range_rate || number.parameter.name.starts_with("sigma_velocity")) {
        const double width =
            data_.stray_width({is_range_rate ? AnyPlot::Sensor::doppler : AnyPlot::Sensor::components, data_.axes});
        if (width == 0.0) continue;
        number.set(settings, width / 18.0);
        any = true;
      }
    }
    return any;
  }

  /// A standard error, greater where all rows lose less than two nats at two of it, the other numbers following: where
  /// a loss flattens out, as with a tau of half the recording, a parabola tells too little.
  double as_lost(const Fitted& at, const std::vector<FreeNumber>& numbers, const std::vector<double>& ridge,
                 double error) const {
    constexpr double wider = 1.25;
    const auto loss = [&](double off) {
      std::vector<double> offsets = ridge;
      for (double& offset : offsets) offset *= off;
      return value(moved(at.settings, numbers, offsets));
    };
    double least = at.fitted;  // or near it, where a search ended too early
    for (const double share : {-1.0, -0.5, 0.5, 1.0}) least = std::min(least, loss(share * error));
    const double most = least + 2.0 / static_cast<double>(data_.measurements);
    for (const double side : {2.0, -2.0})
      while (options_.objective != Objective::rmse && error < 1.0 && loss(side * error) < most) error *= wider;
    return error;
  }

  Fitted least(const Fitted& about, const LossSurface::Shape& shape) const {
    Fitted best{about.settings, value(about.settings)};
    take_if_better(best, moved(about.settings, told_numbers(about.settings), shape.least));
    return best;
  }

  /// The standard errors of the numbers, each with its name, in their scales; by the surface's shape about `numbers`,
  /// or by what the rows lose elsewhere. What is as likely joins the rivals.
  std::vector<std::pair<std::string, double>> errors_of(const Fitted& best, const std::vector<FreeNumber>& numbers,
                                                        const LossSurface::Shape& shape,
                                                        std::vector<Fitted>& rivals) const {
    const auto now = told_numbers(best.settings);
    auto all = free_numbers(best.settings, data_, options_);
    std::erase_if(all, &FreeNumber::relative);
    for (const FreeNumber& number : all)
      if (number.sensor && number.noise && !number.is_least()) add_rival(best, number, nothing, rivals);
    const std::set<std::string> tied = add_rivals_within_steps(best, rivals);
    std::vector<std::pair<std::string, double>> errors;
    for (const FreeNumber& number : all) {
      double& error = errors.emplace_back(number.parameter.name, infinity).second;
      if (number.is_least() || tied.contains(number.parameter.name) || (number.noise && may_be_nothing(best, number)))
        continue;
      for (std::size_t i = 0; i < numbers.size() && now.size() == numbers.size(); ++i)
        if (numbers[i].parameter.name == number.parameter.name && shape.error[i] < 1.0)
          error = as_lost(best, now, shape.ridges[i], shape.error[i]);
      if (!(error < 1.0)) error = profiled(best, number, rivals);
    }
    for (const Fitted& rival : rivals)
      for (const FreeNumber& theirs : free_numbers(rival.settings, data_, options_))
        for (std::size_t i = 0; i < all.size(); ++i)
          if (const FitParameter& its = all[i].parameter; its.name == theirs.parameter.name)
            errors[i].second =
                std::max(errors[i].second, 0.5 * std::abs(its.scaled(theirs.parameter.start) - its.scaled(its.start)));
    return errors;
  }

  /// The settings with a number times a factor, or of a linear one its logarithm more, the others searched anew.
  Fitted held(const Fitted& found, const FreeNumber& number, double factor) const {
    constexpr double worth_a_search = 0.5;  // nats a row: great steps end so near
    const FitParameter& its = number.parameter;
    FilterSettings other = found.settings;
    number.set(other, its.value(its.scaled(its.start) + std::log(factor)));
    Fitter others = *this;
    others.held_ = its.name;
    Fitted result = others.from(other);
    others.scan(result, true);
    return result.fitted < found.fitted + worth_a_search ? others.descended(std::move(result), 0) : result;
  }

  /// Whether all rows lose less than two nats by it.
  bool is_as_likely(const Fitted& rival, const Fitted& found) const {
    return rival.fitted < found.fitted + 2.0 / static_cast<double>(data_.measurements);
  }

  /// The least loss so; where all rows lose less than two nats by it, those numbers are as likely, and rivals.
  double add_rival(const Fitted& found, const FreeNumber& number, double factor, std::vector<Fitted>& rivals) const {
    const Fitted rival = held(found, number, factor);
    if (is_as_likely(rival, found)) rivals.push_back(rival);
    return rival.fitted;
  }

  /// The same of models of continuous time in place of those of a fixed step, which are fitted. Returns the sensors'
  /// noises that may be nothing by them, or are another half of themselves away.
  std::set<std::string> add_rivals_within_steps(const Fitted& found, std::vector<Fitted>& rivals) const {
    constexpr double away = 1.5;
    std::set<std::string> tied;
    FilterSettings other = found.settings;
    if (!continue_motions(other, data_.step_s)) return tied;
    const Fitted rival = searched(from(other));
    if (!is_as_likely(rival, found)) return tied;
    rivals.push_back(rival);
    const auto now = free_numbers(found.settings, data_, options_);  // of sensors, the same at the same places
    const auto then = free_numbers(rival.settings, data_, options_);
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (!now[i].sensor) continue;
      const double times = now[i].parameter.start / then[i].parameter.start;
      if (now[i].noise && (std::max(times, 1.0 / times) > away || may_be_nothing(rival, then[i])))
        tied.insert(now[i].parameter.name);
    }
    return tied;
  }

  /// The standard error of a number that a parabola does not tell, by what the rows lose at e times it and at an e-th;
  /// infinite where that is less than two nats on a side.
  double profiled(const Fitted& found, const FreeNumber& number, std::vector<Fitted>& rivals) const {
    if (options_.objective == Objective::rmse) return infinity;
    double lost = infinity;
    for (const double side : {1.0, -1.0})
      lost = std::min(lost, add_rival(found, number, std::exp(side), rivals) - found.fitted);
    lost *= static_cast<double>(data_.measurements);
    return lost < 2.0 ? infinity : std::sqrt(0.5 / lost);
  }

  /// Whether the rows lose no more without a noise, within a standard error: the curvature does not tell, as both it
  /// and the slopes vanish alike.
  bool may_be_nothing(const Fitted& found, const FreeNumber& noise) const {
    FilterSettings without = found.settings;
    noise.set(without, nothing * noise.parameter.start);
    const MeanDifference worse =
        mean_difference(judged(data_, without, options_.objective), judged(data_, found.settings, options_.objective));
    const double half_a_nat = 0.5 / static_cast<double>(data_.measurements);
    return worse.mean <= std::max(worse.error, half_a_nat) &&
           share_of_strays(without) <= share_of_strays(found.settings) + no_more;
  }

  /// A sensor's noise as great as it may be where the rows lose half a nat by it: less would be stated for no reason.
  void raise(Fitted& found, const std::string& name) const {
    constexpr std::size_t most_steps = 80;
    constexpr double step = std::numbers::sqrt2;
    const double most = found.fitted + 0.5 / static_cast<double>(data_.measurements);
    for (std::size_t k = 0; k < most_steps; ++k) {
      const FreeNumber noise = named(found.settings, name);
      Fitted raised = found;
      noise.set(raised.settings, step * noise.parameter.start);
      raised.fitted = value(raised.settings);
      if (!(raised.fitted < most)) raised = held(found, noise, step);
      if (!(raised.fitted < most)) return;
      found = raised;
    }
  }

  /// The settings, but no number less than may be fitted.
  Fitted from(FilterSettings settings) const {
    for (const FreeNumber& number : free_numbers(settings, data_, options_))
      if (number.least > 0.0) number.set(settings, number.parameter.start);
    const double found = value(settings);
    return {std::move(settings), found};
  }

  /// The objective; infinite where the filter fails.
  double value(const FilterSettings& settings) const {
    try {
      const double found =
          objective_of(losses(data_, judged_settings(settings, options_.objective), options_.objective),
                       options_.objective, counts_);
      return std::isnan(found) ? infinity : found;
    } catch (const std::exception&) {
      return infinity;
    }
  }

  bool take_if_better(Fitted& best, const FilterSettings& settings) const {
    const double found = value(settings);
    if (!(found < best.fitted)) return false;
    best.settings = settings;
    best.fitted = found;
    return true;
  }

  /// All but the one that is held.
  std::vector<FreeNumber> searched_numbers(const FilterSettings& settings) const {
    auto numbers = free_numbers(settings, data_, options_);
    std::erase_if(numbers, [&](const FreeNumber& number) { return number.parameter.name == held_; });
    return numbers;
  }

  FreeNumber named(const FilterSettings& settings, const std::string& name) const {
    const auto numbers = free_numbers(settings, data_, options_);
    return *std::ranges::find(numbers, name, [](const FreeNumber& number) { return number.parameter.name; });
  }

  /// The numbers that are not as small as they may be.
  std::vector<FreeNumber> told_numbers(const FilterSettings& settings) const {
    auto numbers = free_numbers(settings, data_, options_);
    std::erase_if(numbers, [](const FreeNumber& number) { return number.is_least(); });
    return numbers;
  }

  /// The settings with offsets to numbers, in their scales.
  static FilterSettings moved(const FilterSettings& settings, const std::vector<FreeNumber>& numbers,
                              const std::vector<double>& offsets) {
    std::vector<double> values;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const FitParameter& parameter = numbers[i].parameter;
      values.push_back(parameter.value(parameter.scaled(parameter.start) + offsets[i]));
    }
    return with(settings, numbers, values);
  }

  void learn(Fitted& best) const {
    if (has_transition(best.settings, options_)) learn_transition(best);
    if (options_.fits("lift")) try_lifts(best);
  }

  /// Where most rows count as stray ones, as where a filter that is made for seconds begins on fixes hours apart, no
  /// number alone makes much of a difference: all noises of the motions, and all of the sensors, by greater steps.
  void leave_plateau(Fitted& best, bool with_sensors) const {
    if (!(share_of_strays(best.settings) > 0.5)) return;
    const FilterSettings begun = best.settings;
    for (const double of_motions : {1.0, 30.0, 1000.0, 3e-2, 1e-3, 3e-5, 1e-6, 1e-9, 1e-12, 1e-15})
      for (const double of_sensors : {1.0, 30.0, 3e-2, 1e-3}) {
        FilterSettings tried = begun;
        for (const FreeNumber& number : free_numbers(begun, data_, options_))
          if (number.noise && (with_sensors || !number.sensor))
            number.set(tried, (number.sensor ? of_sensors : of_motions) * number.parameter.start);
        take_if_better(best, tried);
      }
  }

  /// Where many rows count as stray ones, as the flights of a bird beside its nights, models that are alike are no
  /// help: each is tried as a far wilder one than the others, which may be quieter than they are. Whether that is
  /// better.
  bool part_models(Fitted& best) const {
    const FilterSettings begun = best.settings;
    if (begun.models.size() < 2 || !(share_of_strays(begun) > 0.05)) return false;
    auto numbers = free_numbers(begun, data_, options_);
    std::erase_if(numbers, [](const FreeNumber& number) { return number.sensor || !number.noise; });
    bool better = false;
    for (const FreeNumber& wild : numbers)
      for (double factor = 10.0; factor < 1e12; factor *= 10.0)
        for (const double of_others : {1.0, 1e-3}) {
          FilterSettings tried = begun;
          for (const FreeNumber& number : numbers)
            number.set(tried, (&number == &wild ? factor : of_others) * number.parameter.start);
          better |= take_if_better(best, tried);
        }
    return better;
  }

  /// One number after the other by great factors, the sensors' first: a search would be caught where measurements that
  /// are thought exact are explained by a wild target, or all by great errors.
  void scan(Fitted& best, bool with_sensors) const {
    auto numbers = searched_numbers(best.settings);
    std::erase_if(numbers, [&](const FreeNumber& number) { return number.sensor && !with_sensors; });
    std::stable_partition(numbers.begin(), numbers.end(), [](const FreeNumber& number) { return number.sensor; });
    for (std::size_t sweep = 0; sweep < most_sweeps; ++sweep) {
      const double before = best.fitted;
      for (FreeNumber& number : numbers) {
        const FilterSettings base = best.settings;
        double taken = number.parameter.start;
        const auto try_number = [&](double other) {
          FilterSettings tried = base;
          number.set(tried, other);
          if (take_if_better(best, tried)) taken = other;
        };
        if (number.parameter.scale == Scale::linear)
          for (const double turn : turns)
            for (const double a_step : {turn, -turn}) try_number(number.parameter.value(a_step));
        else
          for (const double factor : factors) try_number(factor * number.parameter.start);
        if (!number.relative) number.parameter.start = taken;
        progress_.advance(factors.size());
      }
      if (!(before - best.fitted > least_improvement)) return;
    }
  }

  void search_numbers(Fitted& best, std::size_t start) const {
    const auto numbers = searched_numbers(best.settings);
    std::vector<FitParameter> parameters;
    for (const auto& number : numbers) {
      parameters.push_back(number.parameter);
      parameters.back().step = number.parameter.scale == Scale::linear ? 1.0 : 0.7;
    }
    const std::size_t most = budget(numbers.size());
    std::size_t asked = 0;
    const auto loss = [&](const std::vector<double>& values) {
      if (asked++ < most) progress_.advance();
      return value(with(best.settings, numbers, values));
    };
#ifdef SIGMAX_TUNING
    const Fit found =
        search(parameters, loss, {.samples = start > 0 ? 8U : 0U, .starts = 1, .seed = options_.seed + start});
#else
    const Fit found;
#endif
    progress_.advance(most - std::min(asked, most));
    if (found.loss < best.fitted) best = {with(best.settings, numbers, found.values), found.loss, {}};
  }

  /// EM for the transition, as long as it helps: the filters' weights are not exact, so that it need not.
  void learn_transition(Fitted& best) const {
    for (std::size_t k = 0; k < most_em_steps; ++k) {
      const double before = best.fitted;
      FilterSettings next = best.settings;
      TransitionCounts counts(next.models.size(), next.fuzzy);
      const FilterSettings judged = judged_settings(next, options_.objective);
      try {
        for (std::size_t t = 0; t < data_.tracks.size(); ++t)
          count_transitions(
              judged_choice(data_, judged), data_.plots(data_.tracks[t], judged),
              [&](std::size_t row) { return !counts_ || counts_(t, row); }, counts);
      } catch (const std::exception&) {
        return;  // what cannot be smoothed is not learned from
      }
      if (next.sojourn_s.empty())
        next.transition = counts.transition(next.transition);
      else
        next.sojourn_s = counts.sojourns(next.sojourn_s);
      take_if_better(best, next);
      if (!(before - best.fitted > least_improvement)) return;
    }
  }

  /// The lift matters where one model lacks what another has.
  void try_lifts(Fitted& best) const {
    const auto& motions = best.settings.motions;
    const auto other = [&](const MotionChoice& motion) {
      return motion.known().derivatives != motions[0].known().derivatives || motion.linear() != motions[0].linear();
    };
    if (std::ranges::none_of(motions, other)) return;
    for (const Lift lift : {Lift::zero, Lift::borrowed_variance, Lift::unbiased}) {
      FilterSettings next = best.settings;
      next.lift = lift;
      if (lift != best.settings.lift) take_if_better(best, next);
    }
  }

  const TuneData& data_;
  const TuneOptions& options_;
  Progress& progress_;
  RowCounts counts_;
  std::string held_{};
};

/// Whether all noises may be fitted, so that what remains great is a row's own fault.
bool fits_noises(const TuneOptions& options) {
  return options.objective == Objective::prequential && options.fits("models") && options.fits("sensors");
}

/// What the rows say of settings, and which do not pass the gate.
struct Kept {
  double nis = 1.0;    ///< the mean of those that do, none for more than the usual gate lets pass, a measured quantity
  double reach = 1.0;  ///< what 95 % of the rows' NIS stay below: so many times what they should
  double reach_of_kept = 1.0;  ///< likewise, of those that pass alone
  double loss = infinity;
  std::vector<RowPlace> set_aside{};  ///< that do not
};

/// Rows in a row that do not pass are one event, beyond all others.
Kept kept_by(const FilterSettings& settings, const TuneData& data, Objective objective) {
  constexpr double stated = 0.95;
  double sum = 0.0, numbers = 0.0;
  std::vector<double> parts;  // of the quantile
  Kept kept;
  const auto look = [&](std::size_t, const TargetPoint& now) {
    if (!now.nis) return;
    const auto size = static_cast<int>(now.normalized_innovation.size());
    sum += std::min(*now.nis, chi_square_quantile(usual_gate, size));
    numbers += size;
    parts.push_back(*now.nis / chi_square_quantile(stated, size));
  };
  try {
    kept.loss =
        objective_of(losses(data, judged_settings(settings, objective), objective, look, &kept.set_aside), objective);
  } catch (const std::exception&) {
    return {};
  }
  if (parts.empty()) return kept;
  kept.nis = sum / numbers;
  kept.reach_of_kept = quantile(parts, stated);
  const auto& set_aside = kept.set_aside;
  for (std::size_t k = 0; k < set_aside.size(); ++k)
    if (k == 0 || set_aside[k].track != set_aside[k - 1].track || set_aside[k].row > set_aside[k - 1].row + 1)
      parts.push_back(infinity);
  kept.reach = quantile(parts, stated);
  return kept;
}

/// Real errors have long tails, and what is most likely need not be as wide as the errors are: all noises change by
/// one factor, which leaves the filter's gains as they are, until the region that is stated to hold 95 % holds as many
/// of the rows. Of several targets, of which some move as no others do, that goes no farther than until the mean NIS is
/// near the end of 0.9 to 1.1. Rows that not even sigmas four times as great reach are no noise: where they are too
/// many, the others alone count. So it does nothing where any rows state their sigmas, since sigma_w alone would change
/// the gains. The result is to four digits, and without a gate of ours if the rows after confirm all that it turns away
/// and nearly as much is told without; and by how much the sigmas changed.
double finish(FilterSettings& settings, double gate, const TuneData& data, const TuneOptions& options) {
  constexpr double least_nis = 0.93, greatest_nis = 1.07, tolerance = 0.03, most_at_once = 2.0;
  constexpr std::size_t most_steps = 12;
  constexpr double most_in_all = 16.0;  // of variances
  constexpr std::size_t fewest_rows = 50;
  constexpr double tolerable = 0.5;  // nats a row
  const FilterSettings fitted = settings;
  const auto is_stated = [](const auto& named) { return named.second.stated; };
  const auto is_noise = [](const FreeNumber& number) { return number.sensor && number.noise; };
  const bool all_may_change = fits_noises(options) && std::ranges::none_of(data.sensors, is_stated) &&
                              std::ranges::any_of(free_numbers(settings, data, options), is_noise);
  double in_all = 1.0;
  bool kept_alone = false;
  for (std::size_t k = 0; k < most_steps && all_may_change; ++k) {
    if (in_all > most_in_all && !kept_alone) {
      settings = fitted;
      in_all = 1.0;
      kept_alone = true;
    }
    const Kept kept = kept_by(settings, data, options.objective);
    const double reach = kept_alone ? kept.reach_of_kept : kept.reach;
    double wanted = data.tracks.size() > 1 ? std::clamp(reach, kept.nis / greatest_nis, kept.nis / least_nis) : reach;
    // Where tracks are short, much of it is how wide they begin.
    if (data.measurements < fewest_rows * data.tracks.size()) wanted = std::max(wanted, 1.0);
    const double factor = std::clamp(wanted, 1.0 / most_at_once, most_at_once);
    if (!(std::abs(factor - 1.0) > tolerance)) break;
    in_all *= factor;
    const auto numbers = free_numbers(settings, data, options);
    if (factor < 1.0 && std::ranges::any_of(numbers, &FreeNumber::is_least))
      break;  // its rounding is more than the filter needs
    for (const FreeNumber& number : numbers)
      if (number.noise) number.set(settings, std::sqrt(factor) * number.parameter.start);
  }
  round_off(settings);
  FilterSettings open = settings;
  open.gate_probability = gate;
  TuneData told = data;
  const auto strays = leave_out_strays(told, judged_settings(settings, options.objective));
  const Kept kept = kept_by(settings, data, options.objective);
  const bool are_confirmed = std::ranges::find_first_of(kept.set_aside, strays) == kept.set_aside.end();
  if (are_confirmed && kept_by(open, data, options.objective).loss < kept.loss + tolerable) settings = open;
  return std::sqrt(in_all);
}

}  // namespace

std::vector<ModelSet> model_sets(const FilterSettings& settings, const TuneOptions& options, const TuneData& data) {
  std::vector<std::string> names = options.models;
  const bool moving = std::ranges::any_of(data.sensors, [](const auto& sensor) { return sensor.second.velocity; });
  const bool continuous = names.empty() && (data.uneven_steps || moving);
  if (names.empty()) {
    auto motions = each(settings.motions, &MotionChoice::name);
    for (const auto& [fixed, free] : {std::pair{"dwna", "cwna"}, std::pair{"dwpa", "cwpa"}})
      if (continuous) std::ranges::replace(motions, std::string(fixed), std::string(free));
    names = {fmt::format("{}", fmt::join(motions, "+"))};
    for (const auto& motion : motions)
      if (std::ranges::find(names, motion) == names.end()) names.push_back(motion);
  }
  std::vector<ModelSet> sets;
  for (const auto& name : names) {
    sets.push_back({name, with_models(settings, name)});
    FilterSettings& own = sets.back().settings;
    for (MotionChoice& motion : own.motions) {  // beyond half a circle a step another turn is as good
      double& turn = motion[MotionParameter::turn_rate];
      if (options.fits("models") && std::abs(turn) * data.step_s > 180.0)
        turn = std::remainder(turn, 360.0 / data.step_s);
    }
    if (own.gate_probability == 1.0) {
      own.gate_probability = usual_gate;
      own.restart_after_rejections = usual_rejections;
    }
    if (continuous && own.sojourn_s.empty() && own.models.size() > 1 && own.scheme != Scheme::independent)
      own.sojourn_s.assign(own.models.size(), usual_sojourn_steps * data.step_s);
  }
  return sets;
}

std::size_t work_of(const FilterSettings& settings, const TuneData& data, const TuneOptions& options) {
  std::size_t work = 0;
  for (const auto& [name, base] : model_sets(settings, options, data)) {
    const auto numbers = free_numbers(base, data, options);
    const auto motions = static_cast<std::size_t>(
        std::ranges::count_if(numbers, [](const FreeNumber& number) { return number.noise && !number.sensor; }));
    const std::size_t far = (base.models.size() > 1 ? 2 : 1) * (2 + motions);  // starts
    const std::size_t scan = most_sweeps * factors.size() * numbers.size(), search = budget(numbers.size());
    work += (far + options.starts) * scan + (far + rounds * options.starts) * search +
            LossSurface::asked(numbers.size()) + options.folds;
  }
  return work;
}

TunedFilter tune(const FilterSettings& settings, const TuneData& data, const TuneOptions& options,
                 const TunedFilter* similar, Progress& progress) {
  const RowFolds folds = data.folds(options.folds);
  auto bases = model_sets(settings, options, data);
  const std::size_t sets = bases.size();
  const auto tell = [&](std::size_t c, std::string_view what) {
    progress.tell(fmt::format("{}: {}, {}", settings.name, bases[c].name, what));
  };
  for (std::size_t c = 0; c < sets && similar; ++c)
    if (similar->candidates.size() != sets + 1 || similar->candidates[c + 1].name != bases[c].name) similar = nullptr;
  const Fitter fitter(data, options, progress);
  std::vector<Fitted> begun(sets), fitted(sets);
  const auto far = [&](std::size_t c, const FilterSettings& from, bool with_sensors) {
    tell(c, "by great steps");
    return fitter.far(from, with_sensors);
  };
  std::size_t first = 0;
  for (std::size_t c = 1; c < sets; ++c)
    if (bases[c].settings.models.size() < bases[first].settings.models.size()) first = c;
  in_parallel(sets, options.threads, [&](std::size_t c) {
    begun[c] = far(c, bases[c].settings, true);
    if (!similar && bases[c].settings.models.size() > 1) fitter.by_other_mode(begun[c], bases[c].settings);
  });
  // The sensors of one set are those of the others, and another filter's numbers are near.
  in_parallel(sets, options.threads, [&](std::size_t c) {
    if (!similar && c == first) return;
    FilterSettings borrowed = bases[c].settings;
    borrow(borrowed, similar ? similar->candidates[c + 1].settings : begun[first].settings, !similar, data, options);
    fitter.keep_better(begun[c], far(c, borrowed, false));
  });
  const std::size_t starts = similar ? 1 : options.starts;
  for_each_run(
      sets * starts, options.threads,
      [&](std::size_t i) {
        tell(i % sets, fmt::format("search {} of {}", i / sets + 1, starts));
        return fitter.fit(begun[i % sets].settings, i / sets);
      },
      [&](std::size_t i, Fitted&& found) {
        if (found.fitted < fitted[i % sets].fitted || i < sets) fitted[i % sets] = std::move(found);
      });
  TunedFilter tuned;
  TuneData told = data;
  const auto& likeliest = *std::ranges::min_element(fitted, {}, &Fitted::fitted);
  if (fits_noises(options))
    tuned.strays = leave_out_strays(told, judged_settings(likeliest.settings, options.objective));
  const Fitter fitter_of_told(told, options, progress);
  std::vector<std::vector<RowLosses>> without(sets);
  in_parallel(sets, options.threads, [&](std::size_t c) {
    if (!tuned.strays.empty()) {
      tell(c, "without strays");
      fitted[c] = fitter_of_told.fit(fitted[c].settings, 0);
    }
    constexpr std::size_t most_again = 2;
    const double half_a_nat = 0.5 / static_cast<double>(told.measurements);
    Fitted found;
    for (std::size_t again = 0; again <= most_again; ++again) {
      tell(c, "errors and folds");
      const LossSurface surface = fitter_of_told.surface(fitted[c]);
      without[c].clear();
      for (std::size_t fold = 0; fold < options.folds; ++fold) {
        const auto counts = [&](std::size_t t, std::size_t k) { return folds[t][k] != fold; };
        without[c].push_back(judged(told, Fitter(told, options, progress, counts).refit(fitted[c], surface).settings,
                                    options.objective));
        progress.advance();
      }
      Fitted better;
      found = fitter_of_told.with_errors(fitted[c], surface, better);
      if (!(better.fitted < found.fitted - half_a_nat)) break;
      fitted[c] = fitter_of_told.fit(better.settings, 0);
    }
    fitted[c] = found;
    fitted[c].widened = finish(fitted[c].settings, settings.gate_probability, data, options);
  });

  for (std::size_t c = 0; c <= sets; ++c) {
    Candidate& candidate = tuned.candidates.emplace_back(Candidate{{settings}, "as before"});
    if (c > 0) candidate = {fitted[c - 1], bases[c - 1].name};
    tuned.held_out.push_back(c > 0 ? held_out(folds, without[c - 1]) : judged(told, settings, options.objective));
    candidate.held_out = objective_of(tuned.held_out[c], options.objective);
    if (c == 0) candidate.fitted = candidate.held_out;
    candidate.gain = mean_difference(tuned.held_out.front(), tuned.held_out[c]);
    tuned.numbers.push_back(
        c > 0 ? count_of(free_numbers(bases[c - 1].settings, data, options), bases[c - 1].settings, options) : 0);
  }
  tuned.selected = select_settings(tuned.held_out, tuned.numbers);
  FilterSettings unscented = tuned.best().settings;
  const auto by_radar = [](const auto& named) { return named.second.radar || named.second.range_rate; };
  if (std::exchange(unscented.member, MemberType::ukf) == MemberType::ekf &&
      std::ranges::any_of(data.sensors, by_radar)) {
    const auto loss = [&](const FilterSettings& own) { return mean_loss(judged(told, own, options.objective)); };
    tuned.by_unscented = (loss(tuned.best().settings) - loss(unscented)) * static_cast<double>(told.measurements);
  }
  return tuned;
}

}  // namespace sigmax::apps
