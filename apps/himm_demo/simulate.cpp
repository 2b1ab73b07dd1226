#include "himm_demo/subcommands.hpp"

#include <ctime>
#include <tuple>

#include <sigmax/estimation/chi_square.hpp>

#include "himm_demo/experiment/experiment.hpp"
#include "himm_demo/experiment/sentences.hpp"
#include "report/result.hpp"
#include "study/study.hpp"

namespace sigmax::apps {
namespace {

/// What all runs say of one filter, or of the raw measurement. Samples and phases are counted from 0; what is by sample
/// is NaN before the first estimate.
class Performance {
 public:
  /// Of the measurement, if there is no filter.
  explicit Performance(const Experiment& experiment, const FilterSettings* filter = nullptr)
      : experiment_(experiment), filter_(filter) {}

  const FilterSettings* filter() const { return filter_; }
  std::string name() const { return filter_ ? filter_->name : "measurement"; }

  /// What is summed up of a sample beside squared errors by axis, which come first, and the weights, which come last.
  enum Figure : std::size_t { nees_position = 3, nees_velocity, nis, nis_count, weight_count, first_weight };

  /// The numbers of a run go into a row, and out of it into the sums; `row` begins behind them afterwards.
  void append(const Trace& trace, Study::Row& row) const {
    row.resize(row.size() + squares, 0.0);
    add_squares(experiment_.scenario, trace.error, &row[row.size() - squares]);
    row.push_back(crossing([&](std::size_t k) -> const auto& { return trace.weights[k]; }).value_or(nan));
    for (std::size_t k = 0; k < trace.error.size(); ++k) {
      const Vector<3> squared = trace.error[k].cwiseAbs2();
      row.insert(row.end(), squared.begin(), squared.end());
      const bool taken = !std::isnan(trace.nis[k]);  // else the gate turned the measurement away
      const auto& weights = trace.weights[k];
      row.insert(row.end(), {trace.nees_position[k], trace.nees_velocity[k], taken ? trace.nis[k] : 0.0,
                             taken ? 1.0 : 0.0, weights.empty() ? 0.0 : 1.0});
      row.insert(row.end(), weights.begin(), weights.end());
      row.resize(row.size() + figures_ - first_weight - weights.size(), 0.0);
    }
  }
  void add(std::span<const double>& row) {
    for (std::size_t i = 0; i < squares; ++i) run_squares_[i].push_back(row[i]);
    if (!std::isnan(row[squares])) crossings_.push_back(row[squares]);
    row = row.subspan(squares + 1);
    for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += row[i];
    for (std::size_t i = 0; i < spread_.size(); ++i) spread_[i].add(row[i / 3 * figures_ + i % 3]);
    row = row.subspan(sums_.size());
  }

  double rmse(std::size_t sample, std::size_t axis) const { return std::sqrt(sum(sample, axis) / runs()); }
  /// At 95 % confidence.
  double rmse_half_width(std::size_t sample, std::size_t axis) const {
    return spread_[3 * sample + axis].interval().half_width / (2.0 * rmse(sample, axis));  // delta method
  }

  /// The mean of NEES or NIS at a sample, over a phase, or over all of them; 3 if consistent, or 6 with the velocity.
  double at(std::size_t sample, Figure figure) const {
    const double count = figure == nis ? sum(sample, nis_count) : runs();
    return count > 0.0 ? sum(sample, figure) / count : nan;
  }
  double mean(Figure figure, std::optional<std::size_t> phase = std::nullopt) const {
    double sums = 0.0, samples = 0.0;
    for (const Phase& each : experiment_.scenario.phases) {
      const double mean = figure == nis ? phase_mean(each, [&](std::size_t k) { return sum(k, nis); }) /
                                              phase_mean(each, [&](std::size_t k) { return sum(k, nis_count); })
                                        : phase_mean(each, [&](std::size_t k) { return sum(k, figure) / runs(); });
      if (phase && &each == &experiment_.scenario.phases[*phase]) return mean;
      const double length = each.last - each.first + 1;
      sums += length * mean;
      samples += length;
    }
    return sums / samples;
  }

  /// Means of the models' weights, as they are told of a sample; empty before the first estimate.
  std::vector<double> told_weights(std::size_t sample) const {
    const auto source = static_cast<std::size_t>(static_cast<int>(sample) - experiment_.mode_sample_shift);
    return source < experiment_.samples() ? weights(source) : std::vector<double>();
  }

  /// Root mean square over the samples of a phase: by axis, and of the distance.
  double phase_rmse(std::size_t phase, std::size_t axis) const {
    return std::sqrt(
        phase_mean(experiment_.scenario.phases[phase], [&](std::size_t k) { return sum(k, axis) / runs(); }));
  }
  double phase_rmse(std::size_t phase) const {
    const double x = phase_rmse(phase, 0), y = phase_rmse(phase, 1), z = phase_rmse(phase, 2);
    return std::sqrt(x * x + y * y + z * z);
  }
  /// Of all phases.
  double peak_rmse(std::size_t axis) const {
    double peak = 0.0;
    for (const Phase& phase : experiment_.scenario.phases)
      for (int k = phase.first; k <= phase.last; ++k)
        peak = std::max(peak, rmse(static_cast<std::size_t>(k - 1), axis));
    return peak;
  }

  /// When the manoeuvre model's weight first crosses the other's upwards after the onset, in (fractional) samples, over
  /// the runs that crossed, how many those are, and of the averaged curves. None of it holds for a filter without a
  /// manoeuvre model, or a smoothed one, which knows of the manoeuvre before it begins.
  std::optional<Interval> cross_time_of_runs() const {
    return crossings_.empty() ? std::nullopt : std::optional(mean_interval(crossings_));
  }
  std::optional<std::size_t> runs_crossed() const {
    return manoeuvre_ ? std::optional(crossings_.size()) : std::nullopt;
  }
  std::optional<double> cross_time_of_curves() const {
    return crossing([&](std::size_t k) { return weights(k); });
  }

  /// This RMSE minus that of another one in one phase and axis, paired by run (delta method).
  Interval minus(const Performance& other, std::size_t phase, std::size_t axis) const {
    // RMSE = √mean(m) over the runs' mean squares m; its first-order change with one run's m is m / (2 RMSE n).
    const double own = phase_rmse(phase, axis), others = other.phase_rmse(phase, axis);
    const auto& own_squares = run_squares_[3 * phase + axis];
    const auto& others_squares = other.run_squares_[3 * phase + axis];
    std::vector<double> influence(own_squares.size());
    for (std::size_t s = 0; s < influence.size(); ++s)
      influence[s] = own_squares[s] / (2.0 * own) - others_squares[s] / (2.0 * others);
    return {own - others, mean_interval(influence).half_width};
  }

 private:
  /// When the weights of samples cross; nothing without a manoeuvre model.
  template <class WeightsOf>
  std::optional<double> crossing(const WeightsOf& weights_of) const {
    if (!manoeuvre_) return std::nullopt;
    return cross_time(experiment_, [&](std::size_t k) { return weight_difference(weights_of(k), *manoeuvre_); });
  }
  std::vector<double> weights(std::size_t sample) const {
    std::vector<double> weights;
    for (std::size_t i = first_weight; i < figures_ && sum(sample, weight_count) > 0.0; ++i)
      weights.push_back(sum(sample, i) / runs());
    return weights;
  }
  double sum(std::size_t sample, std::size_t figure) const { return sums_[sample * figures_ + figure]; }
  double runs() const { return static_cast<double>(experiment_.runs); }

  const Experiment& experiment_;
  const FilterSettings* filter_;
  std::optional<std::size_t> manoeuvre_ = filter_ ? manoeuvre_model(*filter_) : std::nullopt;  // its model
  std::size_t figures_ = first_weight + (filter_ ? filter_->models.size() : 0);
  std::vector<double> sums_ = std::vector(experiment_.samples() * figures_, 0.0);  // over the runs, in their order
  std::vector<RunningMean> spread_ =
      std::vector<RunningMean>(3 * experiment_.samples());  // of squared errors, by sample and axis
  std::array<std::vector<double>, squares> run_squares_{};  // by run
  std::vector<double> crossings_;
};

/// So many filters that not all can be told apart at once.
bool crowded(const Experiment& experiment) { return experiment.filters.size() > 6; }

/// Of the measurement, then of the filters, so far of no run; and all numbers of a run, which are added to all of them.
std::vector<Performance> performances(const Experiment& experiment) {
  std::vector<Performance> all = {Performance(experiment)};
  for (const auto& filter : experiment.filters) all.emplace_back(experiment, &filter);
  return all;
}

Study::Row row_of(const std::vector<Performance>& performances, const TracedRun& run) {
  Study::Row row;
  performances[0].append(run.measurement, row);
  for (std::size_t f = 0; f < run.filters.size(); ++f) performances[f + 1].append(run.filters[f], row);
  return row;
}

void add(std::span<const double> row, std::vector<Performance>& performances) {
  for (Performance& of : performances) of.add(row);
}

/// Where a position in plan lies with a probability of 95 %, if it is normal.
ErrorEllipse error_ellipse(const std::string& group, const Vector<3>& centre, const SquareMatrix<3>& covariance) {
  const double chi_square = -2.0 * std::log(0.05);  // the 95 % quantile with two degrees of freedom
  const double mean = 0.5 * (covariance(0, 0) + covariance(1, 1)), apart = 0.5 * (covariance(0, 0) - covariance(1, 1));
  const double radius = std::hypot(apart, covariance(0, 1));  // of Mohr's circle: variances are mean ± radius
  const double angle = 0.5 * std::atan2(covariance(0, 1), apart) / degree;
  return {group,
          centre.x(),
          centre.y(),
          std::sqrt(chi_square * (mean + radius)),
          std::sqrt(chi_square * std::max(0.0, mean - radius)),
          angle > 45.0 ? angle - 180.0 : angle};  // of both directions of the axis the one from −135° on
}

/// Makes the panels of all runs and of one run alike.
class Views {
 public:
  explicit Views(const Experiment& experiment) : experiment_(experiment), one_(experiment) {
    one_.runs = 1;
    const Phase& manoeuvre = experiment_.scenario.phases[1];
    shaded_ = {{static_cast<double>(manoeuvre.first), static_cast<double>(manoeuvre.last), "manoeuvre"}};
  }

  View all_runs(const std::vector<Performance>& found, const TracedRun& first) const {
    View view{experiment_.runs == 1 ? "the only run" : fmt::format("all {} runs", experiment_.runs), {}};
    for (std::size_t axis = 0; axis < 3; ++axis) view.panels.emplace_back(rmse(found, axis));
    add_consistency(view, found, "mean ");
    view.panels.emplace_back(plan(first, 1));
    return view;
  }

  View one_run(const TracedRun& run, std::size_t number) const {
    View view{fmt::format("run {}", number), {}};
    for (std::size_t axis = 0; axis < 3; ++axis) view.panels.emplace_back(error(run, axis));
    std::vector<Performance> found = performances(one_);
    add(row_of(found, run), found);
    add_consistency(view, found, "");
    view.panels.emplace_back(plan(run, number));
    return view;
  }

 private:
  const std::string& name(std::size_t f) const { return experiment_.filters[f].name; }

  /// The numbers of all samples, counted from 0.
  template <class Value>
  std::vector<double> by_sample(const Value& value) const {
    return each_below(experiment_.samples(), value);
  }

  LineChart chart(std::string title, std::string y_label) const {
    return {.title = std::move(title),
            .x_label = "sample",
            .y_label = std::move(y_label),
            .x = by_sample([](std::size_t k) { return static_cast<double>(k + 1); }),
            .shaded = shaded_};
  }

  LineChart rmse(const std::vector<Performance>& found, std::size_t axis) const {
    LineChart made = chart(fmt::format("RMSE in {}", axis_names[axis]), "RMSE, m");
    for (const Performance& of : found) {
      const auto value = [&](std::size_t k) { return of.rmse(k, axis); };
      const auto shifted = [&](double widths) {
        return by_sample([&](std::size_t k) { return value(k) + widths * of.rmse_half_width(k, axis); });
      };
      Curve& curve = made.curves.emplace_back(Curve{of.name(), of.name(), by_sample(value)});
      if (crowded(experiment_)) continue;
      curve.lower = shifted(-1.0);
      curve.upper = shifted(1.0);
    }
    if (experiment_.runs > 1 && !crowded(experiment_)) made.note = "Bands: 95 % confidence of the RMSE over the runs.";
    return made;
  }

  LineChart error(const TracedRun& run, std::size_t axis) const {
    LineChart made = chart(fmt::format("Error in {}", axis_names[axis]), "error, m");
    const auto errors = [&](const Trace& trace) {
      return by_sample([&](std::size_t k) { return trace.error[k](static_cast<Eigen::Index>(axis)); });
    };
    made.curves.push_back(
        {.name = measurement_name, .group = measurement_name, .values = errors(run.measurement), .dots = true});
    for (std::size_t f = 0; f < experiment_.filters.size(); ++f)
      made.curves.push_back({name(f), name(f), errors(run.filters[f])});
    return made;
  }

  /// Weights, NEES and NIS of the filters.
  void add_consistency(View& view, const std::vector<Performance>& found, const std::string& mean) const {
    view.panels.emplace_back(weights(found, mean + "probability (IMM) or possibility (HIMM)"));
    for (const auto& [title, label, figure] : {std::tuple("NEES of the position", "NEES", Performance::nees_position),
                                               std::tuple("NIS", "NIS", Performance::nis)}) {
      LineChart made = chart(title, mean + label);
      const Band band = chi_square_band(3, mean.empty() ? 1 : experiment_.runs);
      made.expected = {{band.lower, band.upper, "95 % if consistent"}};
      for (std::size_t f = 0; f < experiment_.filters.size(); ++f)
        made.curves.push_back(
            {name(f), name(f), by_sample([&, figure = figure](std::size_t k) { return found[f + 1].at(k, figure); })});
      keep_usual(made);
      view.panels.emplace_back(std::move(made));
    }
  }

  /// A curve of each filter and model; the dash tells the model.
  LineChart weights(const std::vector<Performance>& found, std::string y_label) const {
    LineChart made = chart("Mode weights", std::move(y_label));
    made.greatest_y = 1.05;
    const std::vector<std::string> models = model_names(experiment_.filters);
    for (std::size_t f = 0; f < experiment_.filters.size(); ++f) {
      const auto& own = experiment_.filters[f].models;
      for (std::size_t j = 0; j < own.size(); ++j) {
        const auto weight = [&](std::size_t k) {
          const std::vector<double> weights = found[f + 1].told_weights(k);
          return weights.empty() ? nan : weights[j];
        };
        const auto model = std::ranges::find(models, own[j]) - models.begin();
        made.curves.push_back({.name = name(f) + " " + own[j],
                               .group = name(f),
                               .values = by_sample(weight),
                               .dash = static_cast<int>(model)});
      }
    }
    return made;
  }

  /// The track of a run; with an error ellipse of each filter at a few samples.
  Plan plan(const TracedRun& run, std::size_t number) const {
    Plan plan{.title = fmt::format("Track of run {}", number), .x_label = "x, m", .y_label = "y, m"};
    const auto add = [&](const std::string& of, PlanTrace::Shape shape, const auto& at) {
      const auto along = [&](Eigen::Index axis) { return by_sample([&](std::size_t k) { return at(k)(axis); }); };
      plan.traces.push_back({.name = of, .group = of, .shape = shape, .x = along(0), .y = along(1), .z = along(2)});
    };
    const auto seen_by = [&](const Trace& trace) {
      return [&](std::size_t k) -> Vector<3> { return run.truth[k].head<3>() + trace.error[k]; };
    };
    add(measurement_name, PlanTrace::Shape::dots, seen_by(run.measurement));
    add(truth_name, PlanTrace::Shape::line, [&](std::size_t k) -> Vector<3> { return run.truth[k].head<3>(); });
    for (std::size_t f = 0; f < experiment_.filters.size(); ++f) {
      add(name(f), PlanTrace::Shape::line, seen_by(run.filters[f]));
      for (std::size_t k = 4; !crowded(experiment_) && k < run.truth.size(); k += 5) {
        const auto& covariance = run.filters[f].covariance[k];
        if (!std::isnan(covariance(0, 0)))
          plan.ellipses.push_back(error_ellipse(name(f), seen_by(run.filters[f])(k), covariance));
      }
    }
    // The corners of the target's way from a little before the manoeuvre on.
    const auto onset = static_cast<std::size_t>(experiment_.scenario.onset() - 1);
    const std::size_t first = onset < 3 ? 0 : onset - 3, last = std::min(onset + 15, run.truth.size() - 1);
    for (const Eigen::Index axis : {0, 1}) {
      const auto [least, greatest] = std::minmax(run.truth[first](axis), run.truth[last](axis));
      plan.focus.insert(plan.focus.end(), {least, greatest});
    }
    plan.note = "It opens at the beginning of the manoeuvre.";
    if (!plan.ellipses.empty()) plan.note += " Ellipses: 95 % as each filter states it, every 5 samples.";
    return plan;
  }

  const Experiment& experiment_;
  Experiment one_;  // of one run
  std::vector<Marked> shaded_;
};

int runs_in_page(const Experiment& experiment) {
  constexpr std::size_t most_numbers = 42000;                          // some 350 kB
  const std::size_t per_sample = 12 + experiment.filters.size() * 12;  // coordinates, errors, weights, NEES and NIS
  const auto fit = static_cast<int>(most_numbers / (per_sample * experiment.samples()));
  return crowded(experiment) ? 1 : std::min(std::clamp(fit, 1, 8), experiment.runs);
}

/// The experiment as the views of a page: curves over the samples of all runs (Figs. 2–11), of the measurement and all
/// filters, and of the first runs each, up to 8, fewer if many filters would make the page great.
std::vector<View> views_of(const Experiment& experiment, const std::vector<Performance>& found) {
  const Views views(experiment);
  std::vector<View> all;
  for (int number = 0; number < runs_in_page(experiment); ++number) {
    const TracedRun run = experiment.traced(static_cast<std::uint64_t>(number));
    if (number == 0) all.push_back(views.all_runs(found, run));
    if (!crowded(experiment)) all.push_back(views.one_run(run, static_cast<std::size_t>(number) + 1));
  }
  return all;
}

struct SimulateOptions {
  int scenario = 1, group = 1;
  Preset preset = Preset::paper_text;
  std::optional<int> runs;
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: as many as the machine has
  FilterOptions filters;
  OutputOptions output;
};

/// All that an experiment found.
struct Found {
  const SimulateOptions& options;
  const Experiment& experiment;
  std::vector<Performance> performances;      ///< of the measurement, then of the filters
  std::map<std::string, double> ns_per_step;  ///< of each filter; empty unless all filters were asked for
};

/// CPU time of a step of each filter in ns, on one thread: the median over some of the runs. Not reproducible.
std::map<std::string, double> nanoseconds_per_step(const Experiment& experiment) {
  constexpr int most_runs = 15;
  const auto cpu_time = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
  };
  std::map<std::string, double> medians;
  for (const auto& filter : experiment.filters) {
    std::vector<double> times;
    for (int number = 0; number < std::min(most_runs, experiment.runs); ++number) {
      RandomStream random(experiment.seed, static_cast<std::uint64_t>(number));
      const auto plots = plots_of(filter, experiment.scenario.step_s,
                                  simulate(experiment.scenario, experiment.group.data, random).measured);
      AnyTarget target(choice_of(filter, 3));
      double start = 0.0;
      int steps = -1;  // the first only warms up
      for (const AnyPlot& plot : plots) {
        if (steps == 0) start = cpu_time();
        target.take(plot, [&](std::size_t, bool is_start) { steps += is_start ? 0 : 1; });
      }
      if (filter.smooth) target.smoothed([](const TargetPoint&) {});
      times.push_back((cpu_time() - start) / steps);
    }
    std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
    medians[filter.name] = times[times.size() / 2];
  }
  return medians;
}

/// Parts of the table of figures: RMSE by phase and axis; NEES; cross-times; a few figures of many filters.
struct FigurePart {
  enum : unsigned { rmse = 1, nees = 2, cross_times = 4, overview = 8 };
};

/// All figures of all runs of a filter, or of the measurement, as far as it has them.
std::vector<Field> figures_of(const Found& found, const Performance& of) {
  std::vector<Field> all = {{of_words("filter", "filter"), of.name()}};
  const auto add = [&](ResultColumn column, const Cell& cell) { all.push_back({std::move(column), cell}); };
  const auto add_of_filter = [&](const ResultColumn& column, const Cell& cell) {
    add(column, of.filter() ? cell : Cell());
  };
  const auto add_rmse = [&](const std::string& key, const std::string& header, const std::string& group, unsigned part,
                            const Cell& rmse) {
    add({.key = key + "_m", .header = header, .sized = true, .group = group, .parts = part}, rmse);
  };
  const auto add_axes = [&](const std::string& key, const std::string& group, const auto& rmse) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      add_rmse(fmt::format("{}_{}", key, axis_names[axis]), axis_names[axis], group, FigurePart::rmse, rmse(axis));
  };
  const std::vector<std::string> phases(phase_names.begin(), phase_names.end());
  for (std::size_t p = 0; p < 3; ++p) {
    add_rmse("rmse_" + phases[p], phases[p], "RMSE, m:", FigurePart::overview, of.phase_rmse(p));
    add_axes("rmse_" + phases[p], phases[p], [&](std::size_t axis) { return of.phase_rmse(p, axis); });
  }
  add_axes("peak", "peak", [&](std::size_t axis) { return of.peak_rmse(axis); });
  const auto add_consistency = [&](Performance::Figure figure, const std::string& key, const std::string& group,
                                   const std::string& name) {
    const bool nees = !group.empty();  // whose phases have a table on the terminal
    for (std::size_t p = 0; p < 3; ++p)
      add_of_filter(
          {.key = key + "_" + phases[p], .header = phases[p], .group = group, .parts = nees ? FigurePart::nees : 0U},
          of.mean(figure, p));
    add_of_filter({.header = name, .group = nees ? "NEES:" : "", .parts = FigurePart::overview}, of.mean(figure));
  };
  add_consistency(Performance::nees_position, "nees_position", "position:", "position");
  add_consistency(Performance::nees_velocity, "nees_position_velocity", "and velocity:", "and velocity");
  add_consistency(Performance::nis, "nis", "", "NIS");

  const auto runs = of.cross_time_of_runs();
  const auto crossed = of.runs_crossed();
  const std::string of_all = crossed ? fmt::format("{} of {}", *crossed, found.experiment.runs) : "–";
  const auto curves = of.cross_time_of_curves();
  const auto paper =
      of.filter() ? paper_cross_time(found.options.scenario, found.options.group, *of.filter()) : std::nullopt;
  const auto ns = found.ns_per_step.find(of.name());
  add_of_filter(
      {.key = "cross_time_of_runs", .header = "mean of runs", .interval = true, .parts = FigurePart::cross_times},
      runs);
  add_of_filter({.header = "runs", .group = "cross-time:", .parts = FigurePart::overview}, runs ? runs->mean : nan);
  add_of_filter({.key = "runs_crossed", .parts = 0}, crossed);
  add_of_filter({.header = "runs that crossed", .parts = FigurePart::cross_times}, of_all);
  add_of_filter({.key = "cross_time_of_curves", .header = "of the averaged curves", .parts = FigurePart::cross_times},
                curves);
  add_of_filter({.header = "curves", .group = "cross-time:", .parts = FigurePart::overview}, curves);
  add_of_filter({.key = "cross_time_of_paper", .header = "paper", .parts = FigurePart::cross_times}, paper);
  add_of_filter({.header = "ns/step", .digits = 0, .parts = FigurePart::overview},
                ns == found.ns_per_step.end() ? Cell() : Cell(ns->second));
  return all;
}

/// One filter against another: a row for each phase with the differences of RMSE by axis, and what the paper claims.
struct Comparison {
  std::string filter, reference;
  ResultTable table;
  std::string sentence;  ///< what became of the claims, if there are any
};

Comparison compared(const Found& found, const Performance& of, const Performance& to) {
  Comparison comparison{of.name(), to.name(), {}, ""};
  for (std::size_t p = 0; p < 3; ++p) {
    std::vector<Field> fields = {{of_words("phase", fmt::format("{} − {}, m", of.name(), to.name())), phase_names[p]}};
    std::array<Interval, 3> difference;
    std::array<double, 3> reference;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      difference[axis] = of.minus(to, p, axis);
      reference[axis] = to.phase_rmse(p, axis);
      const char* const name = axis_names[axis];
      fields.push_back(
          {{.key = name, .header = name, .sign = true, .sized = true, .interval = true}, difference[axis]});
    }
    if (judged(*of.filter(), *to.filter())) {
      const Region claim = claim_of(found.options.scenario, found.options.group, p);
      const std::string holds = verdict(claim, difference, reference);
      const bool correct = to.filter()->imm_mixing == MixingWeights::correct;
      fields.push_back({of_words("", "the paper says"), word_of(claim)});
      fields.push_back({of_words("", fmt::format("against the {} IMM that", correct ? "correct" : "released")), holds});
      comparison.sentence += fmt::format("{} {} the manoeuvre the paper says {}, which {}{}",
                                         p ? ";" : fmt::format("{} against {}:", of.name(), to.name()), phase_names[p],
                                         word_of(claim), holds, p == 2 ? "." : "");
    }
    comparison.table.row_of(fields);
  }
  return comparison;
}

/// Every fuzzy filter against every random one that takes the same and makes the same of it; without such a pair, every
/// filter against the first.
std::vector<Comparison> comparisons(const Found& found) {
  std::vector<Comparison> all;
  const auto& of = found.performances;
  for (std::size_t f = 1; f < of.size(); ++f)
    for (std::size_t r = 1; r < of.size(); ++r) {
      const FilterSettings &a = *of[f].filter(), &b = *of[r].filter();
      if (a.fuzzy && !b.fuzzy && a.scheme == b.scheme && a.smooth == b.smooth &&
          a.radar_measurement == b.radar_measurement && a.sojourn_s == b.sojourn_s)
        all.push_back(compared(found, of[f], of[r]));
    }
  const bool none = all.empty();
  for (std::size_t f = 2; f < of.size() && none; ++f) all.push_back(compared(found, of[f], of[1]));
  return all;
}

/// The RMSE of every sample, and the mean weights.
ResultTable rmse_by_sample(const Found& found) {
  ResultTable table({{.key = "sample"}, {.key = "filter"}, {.key = "axis"}, {.key = "rmse_m"}});
  for (const Performance& of : found.performances)
    for (std::size_t k = 0; k < found.experiment.samples(); ++k)
      for (std::size_t axis = 0; axis < 3; ++axis) table.row({k + 1, of.name(), axis_names[axis], of.rmse(k, axis)});
  return table;
}

ResultTable weights_by_sample(const Found& found) {
  const std::vector<std::string> models = model_names(found.experiment.filters);
  ResultTable table;
  for (const Performance& of : found.performances)
    for (std::size_t k = 0; k < found.experiment.samples() && of.filter(); ++k) {
      const std::vector<double> weights = of.told_weights(k);
      std::vector<Field> fields = {{{.key = "sample"}, k + 1}, {{.key = "filter"}, of.name()}};
      for (const auto& model : models) {
        const auto& own = of.filter()->models;
        const auto j = static_cast<std::size_t>(std::ranges::find(own, model) - own.begin());
        fields.push_back({{.key = "weight_" + model}, j < weights.size() ? Cell(weights[j]) : Cell()});
      }
      table.row_of(fields);
    }
  return table;
}

void report(const Found& found, ResultFiles& files) {
  const SimulateOptions& options = found.options;
  const Experiment& experiment = found.experiment;
  const auto& phases = experiment.scenario.phases;
  Result result(options.output);
  result.page.title =
      fmt::format("Scenario {}, group {}: {} simulated runs", options.scenario, options.group, experiment.runs);
  result.facts("scenario", options.scenario, "group", options.group, "preset", name_of(options.preset), "runs",
               experiment.runs, "seed", experiment.seed, "settings_toml", as_toml(experiment.filters));
  result.say("Scenario {}, group {}, preset {}: {} runs, seed {}", options.scenario, options.group,
             name_of(options.preset), experiment.runs, experiment.seed);
  std::vector<std::string> of_samples;
  for (std::size_t p = 0; p < 3; ++p)
    of_samples.push_back(fmt::format("{} {}–{}", phase_names[p], phases[p].first, phases[p].last));
  result.say("Phases by sample: {}", list_of(of_samples));

  const bool brief = !found.ns_per_step.empty();
  ResultTable figures;
  for (const Performance& of : found.performances) figures.row_of(figures_of(found, of));
  const auto compared = comparisons(found);
  ResultTable few = figures.part(FigurePart::overview, "filter"),
              consistency = figures.part(FigurePart::nees, "mean NEES", 1);
  few.rule();
  few.row({"if consistent", {}, {}, {}, "3", "6", "3", {}, {}, {}});
  consistency.rule();
  consistency.row({"if consistent", "3", "3", "3", "6", "6", "6"});
  result.add(figures, {.printed = false, .csv = "filters.csv", .summary = {"results"}});
  result.add(rmse_by_sample(found), {.printed = false, .csv = "rmse.csv"});
  result.add(weights_by_sample(found), {.printed = false, .csv = "weights.csv"});
  result.add(few, {.printed = brief});
  result.add(figures.part(FigurePart::rmse, "position RMSE, m"),
             {.printed = !brief, .title = "Position RMSE by phase"});
  for (std::size_t i = 0; i < compared.size(); ++i) {
    result.facts_at({"comparisons", i}, "filter", compared[i].filter, "minus", compared[i].reference);
    result.add(compared[i].table, {.printed = !brief,
                                   .summary = {"comparisons", i, "rmse_difference_m"},
                                   .title = crowded(experiment) ? "" : "Difference of RMSE, paired by run, ± 95 %"});
    if (result.page.verdict.size() < 2 && !compared[i].sentence.empty())
      result.page.verdict.push_back(compared[i].sentence);
  }
  result.say(
      {{brief,
        "(RMSE of the distance. NEES and NIS: means over all phases. Cross-time: mean of the runs' that crossed, and "
        "of the averaged curves, in samples. ns/step: CPU time on one thread, median; all else is the same for a "
        "seed.)"},
       {!brief && !compared.empty(),
        fmt::format("(RMSE differences ± 95 % by paired runs; negative is better. \"Competitive\": within {:.0f} %.)",
                    100.0 * competitive_fraction)}});
  result.add(consistency, {.printed = !brief, .title = "Mean NEES"});
  result.add(figures.part(FigurePart::cross_times, "cross-time, sample", 1),
             {.printed = !brief, .title = "Cross-time: when the manoeuvre model overtakes"});
  result.say({{!brief && experiment.mode_sample_shift != 0,
               "(As in the released program, mode weights are counted one sample early.)"}});
  for (const auto& filter : experiment.filters)
    if (brief) result.fact({"not_reproducible", "ns_per_step", filter.name}, found.ns_per_step.at(filter.name));

  Report& page = result.page;
  page.verdict.push_back(fmt::format("Preset {}, seed {}; a sample is {} s. The manoeuvre is in samples {} to {}.",
                                     name_of(options.preset), experiment.seed, shortest(experiment.scenario.step_s),
                                     phases[1].first, phases[1].last));
  if (crowded(experiment)) page.verdict.push_back("Two filters are switched on at first.");
  page.groups = {{measurement_name, true}, {truth_name, true}};
  for (const auto& filter : experiment.filters)
    page.groups.push_back({.name = filter.name, .shown = !crowded(experiment) || page.groups.size() < 4});
  page.chooser = "Show";
  if (files.report_wanted()) page.views = views_of(experiment, found.performances);
  page.last.emplace_back(Words{"Settings in force", as_toml(experiment.filters), true});
  result.publish(files);
}

void simulate_and_report(const SimulateOptions& options) {
  const Settings settings = Settings::read(options.filters.config, options.filters.sets);
  const int runs = options.runs.value_or(options.preset == Preset::released ? 50 : 100);
  const Experiment experiment =
      experiment_of(options.preset, options.scenario, options.group, settings, runs, options.seed);
  if (options.filters.print_config) {
    fmt::print("{}", as_toml(experiment.filters));
    return;
  }
  refuse_to_overwrite(options.output, {options.filters.config}, {"filters.csv", "rmse.csv", "weights.csv"});
  Found found{options, experiment, performances(experiment), {}};
  const Study study{"runs", static_cast<std::size_t>(experiment.runs),
                    [&](std::size_t number) { return row_of(found.performances, experiment.traced(number)); }};
  const auto take = [&](std::size_t, const Study::Row& row) { add(row, found.performances); };
  if (!run(study, {.threads = options.threads}, options.output, take)) return;
  if (asks_for_all(settings)) found.ns_per_step = nanoseconds_per_step(experiment);
  ResultFiles files(options.output);
  report(found, files);
}

}  // namespace

void add_simulate(CLI::App& program, const std::string& command) {
  Subcommand app(program, "simulate", "The paper's experiment (section VI) on simulated radar targets.");
  const auto options = std::make_shared<SimulateOptions>();
  app.option("--scenario", options->scenario, "1: fire control radar, 2: surveillance radar").in({1, 2});
  app.option("--group", options->group, "Group of data and model parameters, section VI.C").in({1, 2, 3, 4});
  app.choice(
         "--preset", {"paper_text", "released"},
         [options](int preset) { options->preset = both_presets.at(static_cast<std::size_t>(preset)); },
         "The experiment as printed (paper_text) or as the authors' program has it (released)")
      .text("paper_text|released [paper_text]");
  app.option("--runs", options->runs, "Monte Carlo runs [100, or 50 for released]").in(1, 100000000);
  add_threads(app, options->threads);
  add_seed(app, options->seed);
  add_filter_options(app, options->filters);
  add_results(app, options->output, command);
  app.run([options] { simulate_and_report(*options); });
}

}  // namespace sigmax::apps
