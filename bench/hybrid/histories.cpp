/// The filters of docs/histories.md on the paper's scenarios, compared run by run with the first of them:
///
///     sigmax_histories --scenario 1 --group 1 --runs 2000 --seed 1001 \
///         imm:p=.02,q=.05,s=3,w=1 himm_histories:p=.008,q=.03,s=3,w=1
///
/// A filter is a scheme (imm, himm, himm_histories, imm_histories; imm_scales: an IMM with a manoeuvre mode for each
/// entry scale; told: a filter that is told the modes) with settings; several values with / between them are a filter
/// each, so that a grid is one word. p, q: the transition out of and into constant velocity; s, w: σ_w of
/// both models; e: entry scales with + between them (of imm and himm: none is the borrowed variance), v: their share
/// along z; b: histories; l: minus the least log weight; c: cut; t: tempering.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <Eigen/Cholesky>

#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/radar.hpp>
#include <sigmax/estimation/start.hpp>
#include <sigmax/hybrid/history_filter.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>

#include "himm_demo/experiment/tally.hpp"
#include "shell/progress.hpp"
#include "shell/random.hpp"

namespace {

using namespace sigmax;
using namespace sigmax::apps;

using Models = std::tuple<IndependentAxes<3, DiscreteWhiteNoise<2>>, IndependentAxes<3, DiscreteWhiteNoise<3>>>;

/// A filter by its name and its settings, all of which have a default.
struct Spec {
  std::string scheme;
  std::map<std::string, std::string> settings;

  std::string name() const {
    std::string result = scheme;
    for (const auto& [key, value] : settings) result += (result == scheme ? ":" : ",") + key + "=" + value;
    return result;
  }
  double number(const std::string& key, double by_default) const {
    const auto found = settings.find(key);
    return found == settings.end() ? by_default : std::stod(found->second);
  }
};

std::vector<std::string> split(const std::string& text, char by) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == by)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

std::vector<Spec> read_specs(const std::vector<std::string>& words) {
  std::vector<Spec> all;
  for (const auto& word : words) {
    const auto parts = split(word, ':');
    std::vector<Spec> specs{{parts[0], {}}};
    if (parts.size() > 1)
      for (const auto& setting : split(parts[1], ',')) {
        const auto pair = split(setting, '=');
        if (pair.size() != 2) throw std::invalid_argument("'" + setting + "' is not KEY=VALUE");
        std::vector<Spec> next;
        for (const Spec& spec : specs)
          for (const auto& value : split(pair[1], '/')) {
            next.push_back(spec);
            next.back().settings[pair[0]] = value;
          }
        specs = next;
      }
    all.insert(all.end(), specs.begin(), specs.end());
  }
  return all;
}

/// A filter as this program sees it.
struct Runner {
  virtual ~Runner() = default;
  virtual void restart(const Bank<Models>::Estimates& start) = 0;
  virtual Gaussian<3> step(double dt, const Gaussian<3>& z) = 0;
};

template <class Filter>
struct RunnerOf final : Runner {
  explicit RunnerOf(Filter of) : filter(std::move(of)) {}
  void restart(const Bank<Models>::Estimates& start) override { filter.restart(start); }
  Gaussian<3> step(double dt, const Gaussian<3>& z) override {
    filter.step(dt, z);
    const auto estimate = filter.estimate();
    return {estimate.mean.template head<3>(), estimate.covariance.template topLeftCorner<3, 3>()};
  }
  Filter filter;
};

std::vector<double> scales_of(const Spec& spec, std::vector<double> by_default) {
  const auto scales = spec.settings.find("e");
  if (scales == spec.settings.end()) return by_default;
  by_default.clear();
  for (const auto& scale : split(scales->second, '+')) by_default.push_back(std::stod(scale));
  return by_default;
}

/// The two models by hand, for what no filter of the library is: entered with an acceleration of a scale, left without.
struct Pair {
  explicit Pair(const Spec& spec)
      : calm(dwna<3>(spec.number("s", 3.0))),
        turning(dwpa<3>(spec.number("w", spec.number("s", 3.0)))),
        vertical(spec.number("v", EntryPrior{}.vertical)) {}

  Gaussian<9> entered(const Gaussian<6>& from, double scale) const {
    Gaussian<9> result{Vector<9>::Zero(), SquareMatrix<9>::Zero()};
    result.mean.head<6>() = from.mean;
    result.covariance.topLeftCorner<6, 6>() = from.covariance;
    for (const Eigen::Index i : {6, 7, 8}) {
      const double sigma = i == 8 ? vertical * scale : scale;
      result.covariance(i, i) = sigma * sigma;
    }
    return result;
  }
  static Gaussian<6> left(const Gaussian<9>& from) {
    return {from.mean.head<6>(), from.covariance.topLeftCorner<6, 6>()};
  }

  IndependentAxes<3, DiscreteWhiteNoise<2>> calm;
  IndependentAxes<3, DiscreteWhiteNoise<3>> turning;
  double vertical;
};

template <int N>
Gaussian<3> position_of(const Gaussian<N>& estimate) {
  return {estimate.mean.template head<3>(), estimate.covariance.template topLeftCorner<3, 3>()};
}

/// One Kalman filter that changes its model when the target does.
struct Told final : Runner {
  Told(const Spec& spec, const Scenario& scenario)
      : pair(spec), scale(scales_of(spec, {25.0}).front()), first(scenario.onset()), last(scenario.last_accelerated) {}
  void restart(const Bank<Models>::Estimates& start) override {
    straight = std::get<0>(start);
    sample = 3;
  }
  Gaussian<3> step(double dt, const Gaussian<3>& z) override {
    const bool turned = turns;
    turns = sample >= first && sample <= last;
    ++sample;
    if (turns) {
      if (!turned) curved = pair.entered(straight, scale);
      curved = update(pair.turning, predict(pair.turning, curved, dt), z);
      return position_of(curved);
    }
    if (turned) straight = Pair::left(curved);
    straight = update(pair.calm, predict(pair.calm, straight, dt), z);
    return position_of(straight);
  }

  Pair pair;
  double scale;
  int first, last, sample = 3;
  bool turns = false;
  Gaussian<6> straight;
  Gaussian<9> curved;
};

/// An IMM with a mode for constant velocity and one for each scale that an acceleration may have when it begins; p is
/// shared among them, and one goes over into another by way of constant velocity only.
struct ImmOfScales final : Runner {
  explicit ImmOfScales(const Spec& spec)
      : pair(spec), scales(scales_of(spec, {11.0, 20.0, 40.0})), p(spec.number("p", 0.05)), q(spec.number("q", p)) {}
  void restart(const Bank<Models>::Estimates& start) override {
    straight = std::get<0>(start);
    curved.assign(scales.size(), std::get<1>(start));
    weights.assign(scales.size() + 1, 1.0 / static_cast<double>(scales.size() + 1));
  }
  Gaussian<3> step(double dt, const Gaussian<3>& z) override {
    const std::size_t n = scales.size();
    std::vector<double> next(n + 1);
    next[0] = (1.0 - p) * weights[0];
    for (std::size_t j = 1; j <= n; ++j) next[0] += q * weights[j];
    std::vector<Gaussian<9>> mixed(n);
    Gaussian<6> calm;
    std::vector<double> shares{(1.0 - p) * weights[0] / next[0]};
    std::vector<Gaussian<6>> lefts{straight};
    for (std::size_t j = 0; j < n; ++j) {
      shares.push_back(q * weights[j + 1] / next[0]);
      lefts.push_back(Pair::left(curved[j]));
    }
    calm = moments(shares, lefts);
    for (std::size_t j = 0; j < n; ++j) {
      const double in = p / static_cast<double>(n) * weights[0], stays = (1.0 - q) * weights[j + 1];
      next[j + 1] = in + stays;
      mixed[j] = moments<9>({in / next[j + 1], stays / next[j + 1]}, {pair.entered(straight, scales[j]), curved[j]});
    }
    std::vector<double> logs(n + 1);
    const auto take = [&](const auto& model, const auto& from, std::size_t mode) {
      auto result = predict(model, from, dt);
      logs[mode] = std::log(next[mode]) + update(model, result, z, result).log_likelihood;
      return result;
    };
    straight = take(pair.calm, calm, 0);
    for (std::size_t j = 0; j < n; ++j) curved[j] = take(pair.turning, mixed[j], j + 1);
    const double greatest = *std::max_element(logs.begin(), logs.end());
    double sum = 0.0;
    for (const double log : logs) sum += std::exp(log - greatest);
    for (std::size_t j = 0; j <= n; ++j) weights[j] = std::exp(logs[j] - greatest) / sum;
    std::vector<Gaussian<3>> positions{position_of(straight)};
    for (const auto& each : curved) positions.push_back(position_of(each));
    return moments(weights, positions);
  }
  template <int N>
  static Gaussian<N> moments(const std::vector<double>& weights, const std::vector<Gaussian<N>>& parts) {
    Gaussian<N> result;
    std::vector<detail::Mixture::Part> all;
    for (const auto& part : parts) all.push_back({detail::view(part)});
    detail::match_moments({detail::view(parts[0]), all}, weights.data(), weights.data(), detail::view(result));
    return result;
  }

  Pair pair;
  std::vector<double> scales, weights;
  double p, q;
  Gaussian<6> straight;
  std::vector<Gaussian<9>> curved;
};

template <Uncertainty Kind>
std::unique_ptr<Runner> made(const Spec& spec, bool histories) {
  constexpr bool fuzzy = std::same_as<Kind, Fuzzy>;
  const double sigma_w = spec.number("s", 3.0);
  const Models models{dwna<3>(sigma_w), dwpa<3>(spec.number("w", sigma_w))};
  const double p = spec.number("p", fuzzy ? 0.5 : 0.05);
  const double q = spec.number("q", p);
  const Variable<Kind> mode{"mode", {"dwna", "dwpa"}};
  const double stays = fuzzy ? 1.0 : 1.0 - p, stays_too = fuzzy ? 1.0 : 1.0 - q;
  const Relation<Kind, Kind> transition{mode, mode, {{stays, p}, {q, stays_too}}};
  Interaction<Kind> interaction;
  if (histories || spec.settings.count("e") > 0) interaction.augmentation = StateAugmentation::prior;
  interaction.entry.scales = scales_of(spec, interaction.entry.scales);
  interaction.entry.vertical = spec.number("v", interaction.entry.vertical);
  const Gaussian<9> nowhere{Vector<9>::Zero(), SquareMatrix<9>::Identity()};
  if (!histories)
    return std::make_unique<RunnerOf<InteractingMultipleModel<Models, Kind>>>(
        InteractingMultipleModel<Models, Kind>(models, transition, nowhere, interaction));
  HistoryRules<Kind> rules;
  rules.histories = static_cast<std::size_t>(spec.number("b", 24.0));
  rules.cut = spec.number("c", rules.cut);
  rules.tempering = spec.number("t", 1.0);
  rules.least_log_weight = -spec.number("l", 12.0);
  return std::make_unique<RunnerOf<HistoryFilter<Models, Kind>>>(
      HistoryFilter<Models, Kind>(models, transition, nowhere, rules, interaction));
}

std::unique_ptr<Runner> made(const Spec& spec, const Scenario& scenario) {
  if (spec.scheme == "told") return std::make_unique<Told>(spec, scenario);
  if (spec.scheme == "imm_scales") return std::make_unique<ImmOfScales>(spec);
  if (spec.scheme == "imm") return made<Random>(spec, false);
  if (spec.scheme == "himm") return made<Fuzzy>(spec, false);
  if (spec.scheme == "imm_histories") return made<Random>(spec, true);
  if (spec.scheme == "himm_histories") return made<Fuzzy>(spec, true);
  throw std::invalid_argument("no filter '" + spec.scheme +
                              "'; expected imm, himm, imm_histories, himm_histories, imm_scales, told");
}

constexpr std::size_t phase_count = 5;
constexpr std::array<const char*, phase_count> phase_names = {"before", "onset", "during", "end", "after"};

/// The phase of a sample, counted from one: the manoeuvre and the time after it, each with its first fifteen samples
/// apart.
std::optional<std::size_t> phase_of(int sample, const Scenario& scenario) {
  const auto& [before, during, after] = scenario.phases;
  if (sample < before.first) return std::nullopt;
  if (sample <= before.last) return 0;
  if (sample <= during.last) return sample < during.first + 15 ? 1 : 2;
  return sample < after.first + 15 ? 3 : 4;
}

/// Of one filter in one run: sums over the samples of each phase.
struct Sums {
  std::array<std::array<double, 3>, phase_count> squares{};  ///< of the position's error, by axis
  std::array<double, phase_count> nees{};
  double nanoseconds = 0.0;

  double total() const {
    double sum = 0.0;
    for (const auto& axes : squares)
      for (const double square : axes) sum += square;
    return sum;
  }
};

double cpu_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
}

std::vector<Sums> run(const std::vector<Spec>& specs, const Scenario& scenario, const Group& group, std::uint64_t seed,
                      std::size_t number) {
  RandomStream random(seed, number);
  const auto recording = simulate(scenario, group.data, random);
  std::vector<Gaussian<3>> z;
  for (const Polar& seen : recording.measured) z.push_back(to_cartesian(seen, group.model));
  const double T = scenario.step_s;
  const std::array<TimedMeasurement<3>, 3> first{{{0.0, z[0]}, {T, z[1]}, {2.0 * T, z[2]}}};
  const Bank<Models>::Estimates start{two_point_start<3>(first[1], first[2]),
                                      three_point_start<3>(first[0], first[1], first[2])};
  std::vector<Sums> result;
  for (const Spec& spec : specs) {
    const auto filter = made(spec, scenario);
    filter->restart(start);
    Sums& sums = result.emplace_back();
    std::vector<Gaussian<3>> estimates;
    estimates.reserve(z.size());
    const double started = cpu_time();
    for (std::size_t k = 3; k < z.size(); ++k) estimates.push_back(filter->step(T, z[k]));
    sums.nanoseconds = (cpu_time() - started) / static_cast<double>(estimates.size());
    for (std::size_t k = 3; k < z.size(); ++k) {
      const auto phase = phase_of(static_cast<int>(k) + 1, scenario);
      if (!phase) continue;
      const Gaussian<3>& estimate = estimates[k - 3];
      const Vector<3> error = estimate.mean - recording.truth[k].head<3>();
      for (std::size_t axis = 0; axis < 3; ++axis)
        sums.squares[*phase][axis] += error(static_cast<Eigen::Index>(axis)) * error(static_cast<Eigen::Index>(axis));
      sums.nees[*phase] += error.dot(estimate.covariance.llt().solve(error)) / 3.0;
    }
  }
  return result;
}

/// √(Σa/Σb) over the runs, with the half-width of its interval at z standard deviations: of the logarithm, whose
/// first-order change with one run is ½(a/Σa − b/Σb).
struct Ratio {
  double value, half_width;
};
Ratio ratio(const std::vector<double>& a, const std::vector<double>& b, double z) {
  double sum_a = 0.0, sum_b = 0.0, squares = 0.0;
  for (const double value : a) sum_a += value;
  for (const double value : b) sum_b += value;
  const auto n = static_cast<double>(a.size());
  for (std::size_t r = 0; r < a.size(); ++r) {
    const double influence = 0.5 * n * (a[r] / sum_a - b[r] / sum_b);
    squares += influence * influence;
  }
  const double value = std::sqrt(sum_a / sum_b);
  return {value, value * z * std::sqrt(squares / (n * (n - 1.0)))};
}

void print(const std::vector<Spec>& specs, const std::vector<std::vector<Sums>>& runs, const Scenario& scenario,
           bool brief) {
  constexpr double z95 = 1.960, z_simultaneous = 2.935;  // of 15 intervals, by Bonferroni
  std::array<int, phase_count> samples{};
  for (int k = 1; k <= scenario.samples(); ++k)
    if (const auto phase = phase_of(k, scenario)) ++samples[*phase];
  const auto over_runs = [&](std::size_t f, const auto& figure) {
    std::vector<double> values;
    for (const auto& run : runs) values.push_back(figure(run[f]));
    return values;
  };
  const auto mean = [&](std::size_t f, const auto& figure) {
    double sum = 0.0;
    for (const double value : over_runs(f, figure)) sum += value;
    return sum / static_cast<double>(runs.size());
  };
  const auto cost = [&](std::size_t f) {
    const auto times = over_runs(f, [](const Sums& sums) { return sums.nanoseconds; });
    return *std::min_element(times.begin(), times.end());
  };
  int all_samples = 0;
  for (const int count : samples) all_samples += count;
  for (std::size_t f = 0; f < specs.size(); ++f) {
    const auto total = [](const Sums& sums) { return sums.total(); };
    const Ratio all = ratio(over_runs(f, total), over_runs(0, total), z95);
    std::printf("%.4f ±%.4f  RMSE %8.2f m  cost %5.2f  NEES/3", all.value, all.half_width,
                std::sqrt(mean(f, total) / all_samples), cost(f) / cost(0));
    for (std::size_t p = 0; p < phase_count; ++p)
      if (samples[p] > 0) std::printf(" %.2f", mean(f, [&](const Sums& sums) { return sums.nees[p]; }) / samples[p]);
    std::printf("  %s\n", specs[f].name().c_str());
    if (brief || f == 0) continue;
    for (std::size_t p = 0; p < phase_count; ++p) {
      if (samples[p] == 0) continue;
      std::printf("  %-7s", phase_names[p]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto square = [&](const Sums& sums) { return sums.squares[p][axis]; };
        const Ratio part = ratio(over_runs(f, square), over_runs(0, square), z_simultaneous);
        std::printf("  %s %.3f ±%.3f%s", axis_names[axis], part.value, part.half_width,
                    part.value - part.half_width > 1.0 ? " above" : "");
      }
      std::printf("\n");
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Filters over histories and others on the paper's scenarios, compared with the first of them");
  int number = 1, group_number = 1, threads = 0;
  std::size_t runs = 100;
  std::uint64_t seed = 1;
  bool brief = false;
  std::vector<std::string> words;
  app.add_option("--scenario", number)->check(CLI::IsMember({1, 2}));
  app.add_option("--group", group_number)->check(CLI::IsMember({1, 2, 3, 4}));
  app.add_option("--runs", runs)->check(CLI::Range(2, 1000000));
  app.add_option("--seed", seed);
  app.add_option("--threads", threads);
  app.add_flag("--brief", brief, "One line a filter");
  app.add_option("FILTERS", words)->required();
  CLI11_PARSE(app, argc, argv);
  try {
    const auto specs = read_specs(words);
    const Scenario target = scenario(number, Preset::paper_text);
    const Group parameters = group(group_number, number);
    std::vector<std::vector<Sums>> results;
    for_each_run(
        runs, threads_or_all(threads), [&](std::size_t r) { return run(specs, target, parameters, seed, r); },
        [&](std::size_t, std::vector<Sums> sums) { results.push_back(std::move(sums)); });
    print(specs, results, target, brief);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sigmax_histories: %s\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
