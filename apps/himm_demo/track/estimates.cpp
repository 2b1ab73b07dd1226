#include "himm_demo/track/estimates.hpp"

#include "table/timestamp.hpp"

namespace sigmax::apps {

EstimatesFile::EstimatesFile(ResultFiles* files, const std::vector<FilterSettings>& filters,
                             const RecordingReader& recording, bool iso_times) {
  if (!files) return;
  const auto axes = static_cast<std::size_t>(recording.axes());
  std::vector<std::string> keys;
  const auto add = [&](std::string key, auto cell) {
    keys.push_back(std::move(key));
    cells_.push_back(std::move(cell));
  };
  add("time_s", [](auto& point, auto&) { return point.time; });
  if (iso_times) add("time_utc", [](auto& point, auto&) { return iso_time(point.time); });
  if (recording.has_tracks()) add("track", [this](auto&, auto&) { return track_; });
  add("filter", [](auto&, auto& filter) { return filter.name; });
  // What there is of the mean, and of its standard deviations, along each axis.
  constexpr std::array formats = {"{}_m", "v{}_mps", "a{}_mps2", "sigma_{}_m", "sigma_v{}_mps"};
  for (std::size_t k = 0; k < 3 * formats.size(); ++k)
    add(fmt::format(fmt::runtime(formats[k / 3]), "xyz"[k % 3]), [=](auto& point, auto&) {
      const std::size_t n = point.mean.size(), i = k / 3 % 3 * axes + k % 3;
      if (k % 3 >= axes || i >= n / axes * axes) return Cell();
      return Cell(k < 9 ? point.mean[i] : std::sqrt(point.covariance[i * (n + 1)]));
    });
  add("nis", [](auto& point, auto&) { return point.nis ? Cell(*point.nis) : Cell(); });
  const auto turns = [](const FilterSettings& filter) {
    return !std::ranges::all_of(filter.motions, &MotionChoice::linear);
  };
  if (std::ranges::any_of(filters, turns))
    add("turn_rate_deg_s", [=](auto& point, auto&) {  // which comes after the derivatives
      const std::vector<double>& mean = point.mean;
      return mean.size() % axes > 0 ? Cell(mean[mean.size() / axes * axes] / degree) : Cell();
    });
  for (const auto& model : model_names(filters))
    add("weight_" + model, [=](auto& point, auto& filter) {
      const auto& own = filter.models;
      const auto j = static_cast<std::size_t>(std::ranges::find(own, model) - own.begin());
      return j < own.size() ? Cell(point.weights[j]) : Cell();
    });
  add("most_likely", [](auto& point, auto& filter) { return filter.models[point.most_likely_mode]; });
  if (recording.on_the_earth()) {
    add("latitude_deg", [](auto& point, auto&) { return point.place.latitude_deg; });
    add("longitude_deg", [](auto& point, auto&) { return point.place.longitude_deg; });
    add("altitude_m", [=](auto& point, auto&) { return axes == 3 ? Cell(point.place.altitude_m) : Cell(); });
  }
  file_.emplace(*files, "estimates.csv", keys);
}

}  // namespace sigmax::apps
