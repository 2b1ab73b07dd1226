#include "himm_demo/track/estimates.hpp"

#include "table/timestamp.hpp"

namespace sigmax::apps {

EstimatesFile::EstimatesFile(ResultFiles* files, const std::vector<FilterSettings>& filters,
                             const RecordingReader& recording, bool iso_times) {
  if (!files) return;
  const auto axes = static_cast<std::size_t>(recording.axes());
  std::vector<std::string> keys;
  const auto add = [&](std::string key, std::function<Cell(const Estimate&)> cell) {
    keys.push_back(std::move(key));
    cells_.push_back(std::move(cell));
  };
  add("time_s", [](const Estimate& e) { return e.point.time; });
  if (iso_times) add("time_utc", [](const Estimate& e) { return iso_time(e.point.time); });
  if (recording.has_tracks()) add("track", [](const Estimate& e) { return e.track; });
  add("filter", [](const Estimate& e) { return e.filter.name; });
  // What there is of the mean, and of its standard deviations, along each axis.
  constexpr std::array formats = {"{}_m", "v{}_mps", "a{}_mps2", "sigma_{}_m", "sigma_v{}_mps"};
  for (std::size_t k = 0; k < 3 * formats.size(); ++k)
    add(fmt::format(fmt::runtime(formats[k / 3]), "xyz"[k % 3]), [=](const Estimate& e) {
      const std::size_t n = e.point.mean.size(), i = k / 3 % 3 * axes + k % 3;
      if (k % 3 >= axes || i >= n / axes * axes) return Cell();
      return Cell(k < 9 ? e.point.mean[i] : std::sqrt(e.point.covariance[i * (n + 1)]));
    });
  add("nis", [](const Estimate& e) { return e.point.nis ? Cell(*e.point.nis) : Cell(); });
  const auto turns = [](const FilterSettings& filter) {
    return !std::ranges::all_of(filter.motions, &MotionChoice::linear);
  };
  if (std::ranges::any_of(filters, turns))
    add("turn_rate_deg_s", [=](const Estimate& e) {  // which comes after the derivatives
      const std::vector<double>& mean = e.point.mean;
      return mean.size() % axes > 0 ? Cell(mean[mean.size() / axes * axes] / degree) : Cell();
    });
  for (const auto& model : model_names(filters))
    add("weight_" + model, [=](const Estimate& e) {
      const auto& own = e.filter.models;
      const auto j = static_cast<std::size_t>(std::ranges::find(own, model) - own.begin());
      return j < own.size() ? Cell(e.point.weights[j]) : Cell();
    });
  add("most_likely", [](const Estimate& e) { return e.filter.models[e.point.most_likely_mode]; });
  if (recording.on_the_earth()) {
    add("latitude_deg", [](const Estimate& e) { return e.place ? Cell(e.place->latitude_deg) : Cell(); });
    add("longitude_deg", [](const Estimate& e) { return e.place ? Cell(e.place->longitude_deg) : Cell(); });
    add("altitude_m", [=](const Estimate& e) { return e.place && axes == 3 ? Cell(e.place->altitude_m) : Cell(); });
  }
  file_.emplace(*files, "estimates.csv", keys);
}

}  // namespace sigmax::apps
