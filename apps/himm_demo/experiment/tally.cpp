#include "himm_demo/experiment/tally.hpp"

#include <numeric>

#include <sigmax/estimation/metrics.hpp>

namespace sigmax::apps {
namespace {

/// The last model that manoeuvres, if another does not. Its crossing is a delay.
std::optional<std::size_t> manoeuvre_model(const FilterSettings& filter) {
  if (filter.smooth || std::ranges::all_of(filter.motions, &MotionChoice::manoeuvres)) return std::nullopt;
  for (std::size_t j = filter.motions.size(); j-- > 0;)
    if (filter.motions[j].manoeuvres()) return j;
  return std::nullopt;
}

/// The weight of a model minus the greatest of the others; 0 without weights.
double weight_difference(const std::vector<double>& weights, std::size_t model) {
  if (weights.empty()) return 0.0;
  double other = 0.0;
  for (std::size_t j = 0; j < weights.size(); ++j)
    if (j != model) other = std::max(other, weights[j]);
  return weights[model] - other;
}

/// The mean of value(sample) over the samples of a phase.
template <class Value>
double phase_mean(const Phase& phase, const Value& value) {
  double sum = 0.0;
  for (int k = phase.first; k <= phase.last; ++k) sum += value(static_cast<std::size_t>(k - 1));
  return sum / (phase.last - phase.first + 1);
}

/// When a lead(sample) becomes positive after the onset, in fractional samples counted from one.
template <class Lead>
std::optional<double> crossing_of(const Experiment& experiment, const Lead& lead) {
  for (int k = std::max(experiment.scenario.onset(), 2); k <= experiment.scenario.samples(); ++k) {
    const double previous = lead(static_cast<std::size_t>(k - 2)), now = lead(static_cast<std::size_t>(k - 1));
    if (previous <= 0.0 && now > 0.0) return k - 1 + previous / (previous - now) + experiment.mode_sample_shift;
  }
  return std::nullopt;
}

Sample sample_of(const TargetPoint& point, const Vector<6>& truth) {
  const auto n = static_cast<Eigen::Index>(point.mean.size());
  const Eigen::Map<const Eigen::VectorXd> mean(point.mean.data(), n);
  const Eigen::Map<const Eigen::MatrixXd> covariance(point.covariance.data(), n, n);
  Sample sample{mean.head<3>() - truth.head<3>(), covariance.topLeftCorner<3, 3>()};
  sample.nees_position = normalized_error_squared<3, 3>(sample.error, sample.covariance);
  if (n >= 6)
    sample.nees_velocity = normalized_error_squared<6, 6>(mean.head<6>() - truth, covariance.topLeftCorner<6, 6>());
  sample.nis = point.nis.value_or(nan);
  sample.weights = point.weights;
  return sample;
}

/// What the experiment's radar saw, sample by sample, as the filter takes it; the tag is the sample, from 0.
std::vector<AnyDetection> detections_of(const FilterSettings& filter, double step_s, std::span<const Polar> seen) {
  std::vector<AnyDetection> detections;
  for (const auto& [range, azimuth, elevation] : seen) {
    const std::array z = {range, azimuth.radians(), elevation.radians()}, unknown = {nan, nan, nan};
    AnyDetection detection = AnyDetection::polar(step_s * static_cast<double>(detections.size()), z, unknown);
    detection.tag = detections.size();
    detections.push_back(with_sensor_noise(filter, "", detection, 3));
  }
  return detections;
}

}  // namespace

Recording Experiment::recording(std::uint64_t number) const {
  RandomStream random(seed, number);
  return simulate(scenario, group.data, random);
}

TracedRun Experiment::traced(std::uint64_t number) const {
  const auto [truth, measured] = recording(number);
  TracedRun run{truth, std::vector(1 + filters.size(), Trace(truth.size()))};
  for (std::size_t k = 0; k < truth.size(); ++k)
    run.traces[0][k].error = to_cartesian(measured[k]) - truth[k].head<3>();
  for (std::size_t f = 0; f < filters.size(); ++f) {
    const FilterSettings& filter = filters[f];
    const auto visit = [&, &truth = run.truth](const TargetPoint& point) {
      run.traces[f + 1][point.tag] = sample_of(point, truth[point.tag]);
    };
    const auto detections = detections_of(filter, scenario.step_s, measured);
    AnyTarget target(choice_of(filter, 3));
    for (std::size_t k = 0; k < detections.size(); ++k) try {
        target.follow({&detections[k], 1}, [&](const TargetPoint& point) {
          if (!filter.smooth) visit(point);
        });
        if (filter.smooth && k + 1 == detections.size()) target.smoothed(visit);
      } catch (const std::exception& error) {
        throw std::runtime_error(
            fmt::format("run {}, filter '{}', sample {}: {}", number + 1, filter.name, k + 1, error.what()));
      }
  }
  return run;
}

FilterDefaults defaults_of(Preset preset, const Group& parameters) {
  FilterDefaults defaults = FilterDefaults::of(preset);
  for (auto& motion : defaults.filter.motions) motion[MotionParameter::sigma_w] = parameters.sigma_w;
  defaults.filter.accuracy.radar = {parameters.model.range, parameters.model.azimuth.radians(),
                                    parameters.model.elevation.radians()};
  return defaults;
}

Experiment experiment_of(Preset preset, int scenario_number, int group_number, const Settings& settings, int runs,
                         std::uint64_t seed) {
  const Group parameters = group(group_number, scenario_number);
  auto filters = read_filters(settings, defaults_of(preset, parameters));
  settings.refuse_unknown();
  const int mode_sample_shift = preset == Preset::released ? -1 : 0;
  return {scenario(scenario_number, preset), parameters, std::move(filters), runs, seed, mode_sample_shift};
}

Tally::Tally(Experiment what, bool by_sample)
    : experiment(std::move(what)), manoeuvre_(1), columns_(1 + figures * size()) {
  for (const FilterSettings& one : experiment.filters) {
    manoeuvre_.push_back(manoeuvre_model(one));
    width_ = std::max(width_, weight + one.models.size());
  }
  if (!by_sample) width_ = 0;
  means_.resize(at(size(), 0));
}

void Tally::add_figures(const Trace& trace, std::size_t of, double* sums) const {
  const auto& phases = experiment.scenario.phases;
  for (std::size_t i = 0; i < 9; ++i) {
    const auto axis = static_cast<Eigen::Index>(i % 3);
    sums[square + i] += phase_mean(phases[i / 3], [&](std::size_t k) { return std::pow(trace[k].error(axis), 2); });
  }
  const int onset = experiment.scenario.onset(), last = experiment.scenario.samples();
  const auto squared_z = [&](std::size_t k) { return std::pow(trace[k].error.z(), 2); };
  sums[onset_z] += phase_mean({onset - 10, onset - 1}, squared_z);
  sums[onset_z + 1] += phase_mean({onset, std::min(onset + 9, last)}, squared_z);
  if (!manoeuvre_[of]) return;
  const auto leads = [&](std::size_t k) { return weight_difference(trace[k].weights, *manoeuvre_[of]); };
  for (std::size_t p = 0; p < phases.size(); ++p) {
    sums[lead + p] += phase_mean(phases[p], [&](std::size_t k) { return leads(k) > 0.0 ? 1.0 : 0.0; });
    for (auto k = static_cast<std::size_t>(phases[p].first - 1); k < static_cast<std::size_t>(phases[p].last); ++k)
      sums[switches + p] += (leads(k) > 0.0) != (leads(k - 1) > 0.0) ? 1.0 : 0.0;
  }
  if (const auto crosses = crossing_of(experiment, leads)) {
    sums[crossing] += *crosses;
    sums[crossed] += 1.0;
  }
  for (int k = onset - 2; k < std::min(onset + 14, last); ++k)
    sums[curve + static_cast<std::size_t>(k - onset + 2)] += leads(static_cast<std::size_t>(k));
}

Study::Row Tally::row(std::uint64_t first, std::uint64_t last) const {
  Study::Row row(columns_.size(), 0.0);
  row[0] = static_cast<double>(last - first);
  for (std::uint64_t number = first; number < last; ++number) {
    const TracedRun run = experiment.traced(number);
    for (std::size_t of = 0; of < size(); ++of) {
      add_figures(run.traces[of], of, &row[1 + figures * of]);
      for (std::size_t k = 0; k < experiment.samples() && width_ > 0; ++k) {
        const Sample& sample = run.traces[of][k];
        for (const double error : sample.error) row.push_back(error * error);
        row.insert(row.end(), {sample.nees_position, sample.nees_velocity, sample.nis});
        row.insert(row.end(), sample.weights.begin(), sample.weights.end());
        row.resize(columns_.size() + at(of, k + 1), nan);
      }
    }
  }
  return row;
}

void Tally::add(std::span<const double> row) {
  const std::size_t numbers = columns_.size() + means_.size();
  if (row.size() != numbers)
    throw std::runtime_error(fmt::format("a cell of {} numbers, expected {}", row.size(), numbers));
  for (std::size_t c = 0; c < columns_.size(); ++c) columns_[c].push_back(row[c]);
  for (std::size_t i = 0; i < means_.size(); ++i)
    if (const double number = row[columns_.size() + i]; !std::isnan(number)) means_[i].add(number);
}

std::string Tally::name(std::size_t of) const { return of == 0 ? measurement_name : experiment.filters[of - 1].name; }

std::optional<std::size_t> Tally::place(std::string_view name) const {
  for (std::size_t of = 0; of < size(); ++of)
    if (this->name(of) == name) return of;
  return std::nullopt;
}

const std::vector<double>& Tally::column(std::size_t of, std::size_t figure) const {
  return columns_[1 + figures * of + figure];
}

Statistic Tally::mean(std::size_t of, std::size_t figure) const {
  return Statistic::mean(column(of, figure), columns_[0]);
}

Statistic Tally::rmse(std::size_t of, std::size_t phase, std::size_t axis) const {
  return sqrt(mean(of, square + 3 * phase + axis));
}

Statistic Tally::over_measurement(std::size_t of) const {
  const auto ratio = [&](std::size_t i) { return rmse(of, i / 3, i % 3) / rmse(0, i / 3, i % 3); };
  Statistic sum = ratio(0);
  for (std::size_t i = 1; i < 9; ++i) sum = sum + ratio(i);
  return sum * (1.0 / 9.0);
}

Statistic Tally::cross_time(std::size_t of) const { return Statistic::mean(column(of, crossing), column(of, crossed)); }

std::vector<double> Tally::cross_times(std::size_t of) const {
  std::vector<double> times = column(of, crossing);
  std::erase(times, 0.0);
  return times;
}

Statistic Tally::cross_time_of_batches(std::size_t of) const {
  for (std::size_t i = 1; i < figures - curve; ++i) {
    const Statistic before = mean(of, curve + i - 1), now = mean(of, curve + i);
    if (before.value() <= 0.0 && now.value() > 0.0)
      return before / (before - now) +
             (experiment.scenario.onset() - 2.0 + static_cast<double>(i) + experiment.mode_sample_shift);
  }
  return {};
}

double Tally::mean_at(std::size_t of, std::size_t sample, std::size_t figure) const {
  const RunningMean& mean = means_[at(of, sample) + figure];
  return mean.count() > 0 ? mean.mean() : nan;
}

double Tally::rmse_at(std::size_t of, std::size_t sample, std::size_t axis) const {
  return std::sqrt(mean_at(of, sample, squared + axis));
}

double Tally::half_width_at(std::size_t of, std::size_t sample, std::size_t axis) const {
  const RunningMean& mean = means_[at(of, sample) + axis];
  return mean.count() > 0 ? mean.interval().half_width / (2.0 * rmse_at(of, sample, axis)) : nan;  // delta method
}

std::vector<double> Tally::weights(std::size_t of, std::size_t sample) const {
  auto all = each_below(filter(of)->models.size(), [&](std::size_t j) { return mean_at(of, sample, weight + j); });
  std::erase_if(all, [](double one) { return std::isnan(one); });
  return all;
}

std::vector<double> Tally::weights_at(std::size_t of, std::size_t sample) const {
  const auto source = static_cast<std::size_t>(static_cast<int>(sample) - experiment.mode_sample_shift);
  return source < experiment.samples() ? weights(of, source) : std::vector<double>();
}

std::optional<double> Tally::cross_time_of_curves(std::size_t of) const {
  if (!manoeuvre_[of]) return std::nullopt;
  return crossing_of(experiment, [&](std::size_t k) { return weight_difference(weights(of, k), *manoeuvre_[of]); });
}

double Tally::peak_rmse(std::size_t of, std::size_t axis) const {
  double peak = 0.0;
  for (auto k = static_cast<std::size_t>(experiment.scenario.phases[0].first - 1); k < experiment.samples(); ++k)
    peak = std::max(peak, rmse_at(of, k, axis));
  return peak;
}

double Tally::mean_of(std::size_t of, BySample figure, std::size_t phase) const {
  const Phase& one = experiment.scenario.phases[phase];
  const auto count = [&](std::size_t k) { return static_cast<double>(means_[at(of, k) + figure].count()); };
  const auto total = [&](std::size_t k) { return count(k) > 0.0 ? count(k) * mean_at(of, k, figure) : 0.0; };
  return phase_mean(one, total) / phase_mean(one, count);
}

}  // namespace sigmax::apps
