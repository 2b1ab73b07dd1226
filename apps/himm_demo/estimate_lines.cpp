#include "himm_demo/estimate_lines.hpp"

#include <algorithm>
#include <cmath>

#include "support/angle.hpp"
#include "support/csv.hpp"
#include "support/output.hpp"
#include "support/timestamp.hpp"

namespace sigmax::apps {

template <int Axes>
Geodetic tell_from(const LocalFrame<Axes>& anchor, const LocalFrame<Axes>& frame, TrackPoint<Axes>& point) {
  auto& [mean, covariance] = point.estimate;
  const Vector<Axes> position = mean.template head<Axes>();
  const SquareMatrix<Axes> turn = frame.local_axes(position);
  for (Eigen::Index i = 0; i < mean.size(); i += Axes) {
    mean.template segment<Axes>(i) = turn * mean.template segment<Axes>(i);
    for (Eigen::Index j = 0; j < mean.size(); j += Axes)
      covariance.template block<Axes, Axes>(i, j) =
          (turn * covariance.template block<Axes, Axes>(i, j) * turn.transpose()).eval();
  }
  const Geodetic place = frame.to_geodetic(position);
  mean.template head<Axes>() = anchor.to_local(place);
  return place;
}

EstimateLines::EstimateLines(const std::vector<FilterSettings>& filters, const RecordingReader& recording,
                             bool iso_times)
    : has_tracks_(recording.has_tracks()),
      geodetic_(recording.geodetic()),
      iso_times_(iso_times),
      models_(model_names(filters)) {
  for (const auto& filter : filters)
    for (const auto& motion : filter.motions) turns_ = turns_ || !motion.linear();
}

std::string EstimateLines::header() const {
  std::string line = iso_times_ ? "time_s,time_utc" : "time_s";
  line += has_tracks_ ? ",track,filter" : ",filter";
  line +=
      ",x_m,y_m,z_m,vx_mps,vy_mps,vz_mps,ax_mps2,ay_mps2,az_mps2,sigma_x_m,sigma_y_m,sigma_z_m,"
      "sigma_vx_mps,sigma_vy_mps,sigma_vz_mps,nis";
  if (turns_) line += ",turn_rate_deg_s";
  for (const auto& model : models_) line += ",weight_" + model;
  return line + (geodetic_ ? ",most_likely,latitude_deg,longitude_deg,altitude_m\n" : ",most_likely\n");
}

template <int Axes>
std::string EstimateLines::line(const std::string& track, const FilterSettings& settings, const TrackPoint<Axes>& point,
                                const std::optional<Geodetic>& place) const {
  const auto& estimate = point.estimate;
  const auto has = [&](int order, int axis) { return axis < Axes && order * Axes + axis < estimate.size(); };
  std::string line = shortest(point.time);
  const auto text = [&](std::string_view of) { line.append(",").append(of); };
  const auto number = [&](std::optional<double> value) { text(value ? shortest(*value) : ""); };
  if (iso_times_) text(iso_time(point.time));
  if (has_tracks_) text(csv_field(track));
  text(csv_field(settings.name));
  for (int order = 0; order < 3; ++order)
    for (int axis = 0; axis < 3; ++axis)
      number(has(order, axis) ? std::optional(estimate.mean(order * Axes + axis)) : std::nullopt);
  for (int order = 0; order < 2; ++order)
    for (int axis = 0; axis < 3; ++axis) {
      const int i = order * Axes + axis;
      number(has(order, axis) ? std::optional(std::sqrt(estimate.covariance(i, i))) : std::nullopt);
    }
  number(point.nis);
  if (turns_) number(point.turn_rate ? std::optional(*point.turn_rate / degree) : std::nullopt);
  for (const auto& model : models_) {
    const auto own = std::find(settings.models.begin(), settings.models.end(), model);
    number(own == settings.models.end()
               ? std::nullopt
               : std::optional(point.weights[static_cast<std::size_t>(own - settings.models.begin())]));
  }
  text(settings.models[point.most_likely_mode]);
  if (place) {
    number(place->latitude_deg);
    number(place->longitude_deg);
    number(Axes == 3 ? std::optional(place->altitude_m) : std::nullopt);
  }
  return line + "\n";
}

template Geodetic tell_from(const LocalFrame<1>&, const LocalFrame<1>&, TrackPoint<1>&);
template Geodetic tell_from(const LocalFrame<2>&, const LocalFrame<2>&, TrackPoint<2>&);
template Geodetic tell_from(const LocalFrame<3>&, const LocalFrame<3>&, TrackPoint<3>&);
template std::string EstimateLines::line(const std::string&, const FilterSettings&, const TrackPoint<1>&,
                                         const std::optional<Geodetic>&) const;
template std::string EstimateLines::line(const std::string&, const FilterSettings&, const TrackPoint<2>&,
                                         const std::optional<Geodetic>&) const;
template std::string EstimateLines::line(const std::string&, const FilterSettings&, const TrackPoint<3>&,
                                         const std::optional<Geodetic>&) const;

}  // namespace sigmax::apps
