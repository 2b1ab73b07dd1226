#include "himm_demo/estimates_file.hpp"

#include <algorithm>
#include <cmath>

#include "support/angle.hpp"
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

EstimatesFile::EstimatesFile(AtomicFile& file, const std::vector<FilterSettings>& filters,
                             const RecordingReader& recording, bool iso_times)
    : file_(file), recording_(recording), iso_times_(iso_times) {
  for (const auto& filter : filters)
    for (const auto& motion : filter.motions) turns_ = turns_ || !motion.linear();
  models_ = model_names(filters);
  file_.write(iso_times_ ? "time_s,time_utc" : "time_s");
  file_.write(recording_.has_tracks() ? ",track,filter" : ",filter");
  file_.write(
      ",x_m,y_m,z_m,vx_mps,vy_mps,vz_mps,ax_mps2,ay_mps2,az_mps2,sigma_x_m,sigma_y_m,sigma_z_m,"
      "sigma_vx_mps,sigma_vy_mps,sigma_vz_mps,nis");
  if (turns_) file_.write(",turn_rate_deg_s");
  for (const auto& model : models_) file_.print(",weight_{}", model);
  file_.write(recording_.geodetic() ? ",most_likely,latitude_deg,longitude_deg,altitude_m\n" : ",most_likely\n");
}

template <int Axes>
void EstimatesFile::add(const std::string& track, const FilterSettings& settings, const TrackPoint<Axes>& point,
                        const std::optional<Geodetic>& place) {
  const auto& estimate = point.estimate;
  const auto has = [&](int order, int axis) { return axis < Axes && order * Axes + axis < estimate.size(); };
  file_.write(shortest(point.time));
  if (iso_times_) file_.print(",{}", iso_time(point.time));
  if (recording_.has_tracks()) file_.print(",{}", csv_field(track));
  file_.print(",{}", csv_field(settings.name));
  for (int order = 0; order < 3; ++order)
    for (int axis = 0; axis < 3; ++axis)
      cell(has(order, axis) ? std::optional(estimate.mean(order * Axes + axis)) : std::nullopt);
  for (int order = 0; order < 2; ++order)
    for (int axis = 0; axis < 3; ++axis) {
      const int i = order * Axes + axis;
      cell(has(order, axis) ? std::optional(std::sqrt(estimate.covariance(i, i))) : std::nullopt);
    }
  cell(point.nis);
  if (turns_) cell(point.turn_rate ? std::optional(*point.turn_rate / degree) : std::nullopt);
  for (const auto& model : models_) {
    const auto own = std::find(settings.models.begin(), settings.models.end(), model);
    cell(own == settings.models.end()
             ? std::nullopt
             : std::optional(point.weights[static_cast<std::size_t>(own - settings.models.begin())]));
  }
  file_.print(",{}", settings.models[point.most_likely_mode]);
  if (place) {
    cell(place->latitude_deg);
    cell(place->longitude_deg);
    cell(Axes == 3 ? std::optional(place->altitude_m) : std::nullopt);
  }
  file_.write("\n");
}

void EstimatesFile::cell(std::optional<double> value) { file_.print(",{}", value ? shortest(*value) : ""); }

template Geodetic tell_from(const LocalFrame<2>&, const LocalFrame<2>&, TrackPoint<2>&);
template Geodetic tell_from(const LocalFrame<3>&, const LocalFrame<3>&, TrackPoint<3>&);
template void EstimatesFile::add(const std::string&, const FilterSettings&, const TrackPoint<2>&,
                                 const std::optional<Geodetic>&);
template void EstimatesFile::add(const std::string&, const FilterSettings&, const TrackPoint<3>&,
                                 const std::optional<Geodetic>&);

}  // namespace sigmax::apps
