#include "himm_demo/tune/tune.hpp"

namespace sigmax::apps {

Diagnosis diagnose(const TuneData& data, const FilterSettings& settings, Objective objective) {
  Diagnosis diagnosis;
  std::map<std::string, InnovationTally, std::less<>> sensors;
  for (const auto& model : settings.models) diagnosis.modes.push_back({model});
  std::map<std::string, std::vector<double>, std::less<>> last;  // by sensor, of the track at hand
  std::size_t track = 0, rows = 0, judged = 0;
  double squares = 0.0;
  const auto look = [&](std::size_t t, const TargetPoint& now) {
    if (t != track) last.clear();
    track = t;
    const Row& row = data.row({t, now.tag});
    if (row.truth) {
      for (std::size_t axis = 0; axis < static_cast<std::size_t>(data.axes); ++axis)
        squares += std::pow(now.mean[axis] - (*row.truth)[axis], 2);
      ++judged;
    }
    if (!now.nis && now.log_score) diagnosis.set_aside.push_back({t, now.tag});
    if (!now.nis) return;
    sensors[row.sensor].add(now.normalized_innovation, last[row.sensor]);
    diagnosis.modes[now.most_likely_mode].innovations.add(now.normalized_innovation);
    last[row.sensor] = now.normalized_innovation;
    for (std::size_t j = 0; j < now.weights.size(); ++j) diagnosis.modes[j].weight += now.weights[j];
    ++rows;
  };
  RowLosses lost;
  try {
    lost = losses(data, settings, objective, look);
  } catch (const std::exception& error) {
    const TuneTrack& its = data.tracks[track];
    throw InputError("{}:{}: filter '{}' on the track that begins here: {}; begin with settings that track takes",
                     its.file, its.rows.front().line, settings.name, error.what());
  }
  if (std::isnan(mean_loss(lost)))
    throw InputError(
        "{}: filter '{}' makes no estimate that could be judged: its start may want positions, or fewer rows at one "
        "time; drop a column that is always empty, as a track starts from whole positions, or give a start, --set "
        "start=given, or places of bearings, --set sensor.NAME.at=[E,N]",
        data.tracks.front().file, settings.name);
  for (auto& mode : diagnosis.modes) mode.weight /= static_cast<double>(std::max<std::size_t>(rows, 1));
  for (auto& [name, tally] : sensors) diagnosis.sensors.push_back({name.empty() ? "all rows" : name, tally});
  if (judged > 0) diagnosis.rmse_m = std::sqrt(squares / static_cast<double>(judged));
  return diagnosis;
}

std::string_view verdict_of(const InnovationTally& sensor) {
  if (sensor.count() < 10) return "too few rows to say";
  const double nis = sensor.mean_square(), apart = sensor.autocorrelation();
  const bool high = nis > sensor.band().upper, low = nis < sensor.band().lower;
  const bool lags = apart > sensor.autocorrelation_band(), overshoots = apart < -sensor.autocorrelation_band();
  if (high) return lags ? "models too stiff" : "optimistic sensor";
  if (low) return overshoots ? "models too loose" : "pessimistic sensor";
  return lags ? "gain too low" : overshoots ? "gain too high" : "as it should be";
}

}  // namespace sigmax::apps
