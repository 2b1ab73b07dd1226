#include "himm_demo/tracker.hpp"

namespace sigmax::apps {

template <int Axes>
Tracker<Axes>::Tracker(FilterSettings settings) : settings_(std::move(settings)) {
  for (std::size_t i = 0; i < settings_.orders.size(); ++i)
    models_.emplace_back(settings_.sigma_w[i], Vector<Axes>::Zero(), settings_.orders[i]);
}

template <int Axes>
void Tracker<Axes>::take(double time, const std::optional<Measurement>& z,
                         const std::function<void(double time)>& stepped) {
  if (running()) {
    step(time, z);
    stepped(time);
  } else if (settings_.start == Start::given) {
    waiting_.push_back({time, z});
    if (!settings_.start_time_s && waiting_.size() < 2) return;
    start_given(settings_.start_time_s ? *settings_.start_time_s : 2.0 * waiting_[0].first - waiting_[1].first);
    for (const auto& [waited, measurement] : waiting_) {
      step(waited, measurement);
      stepped(waited);
    }
    waiting_.clear();
  } else if (z) {
    points_.push_back({time, *z});
    if (points_.size() == 3) start_from_points();
  }
}

template <int Axes>
auto Tracker<Axes>::estimate() const -> Estimate {
  return std::visit(
      [&](const auto& filter) {
        return settings_.most_likely_output ? filter.most_likely_estimate() : filter.estimate();
      },
      *filter_);
}

template <int Axes>
double Tracker<Axes>::weight(std::size_t mode) const {
  return std::visit([&](const auto& filter) { return filter.belief()[mode]; }, *filter_);
}

template <int Axes>
std::size_t Tracker<Axes>::most_likely_mode() const {
  return std::visit([](const auto& filter) { return filter.most_likely_mode(); }, *filter_);
}

template <int Axes>
std::optional<double> Tracker<Axes>::nis() const {
  return std::visit([](const auto& filter) { return filter.measured() ? std::optional(filter.nis()) : std::nullopt; },
                    *filter_);
}

template <int Axes>
void Tracker<Axes>::step(double time, const std::optional<Measurement>& z) {
  std::visit(
      [&](auto& filter) {
        if (z)
          filter.step(time - time_, *z);
        else
          filter.step(time - time_);
      },
      *filter_);
  time_ = time;
}

template <int Axes>
void Tracker<Axes>::start_from_points() {
  const bool released = settings_.start == Start::released;
  const auto wide = released ? released_start<Axes>(points_[0], points_[1], points_[2])
                             : three_point_start<Axes>(points_[0], points_[1], points_[2]);
  const auto narrow = two_point_start<Axes>(points_[1], points_[2]);
  Starts starts(models_.size());
  for (std::size_t i = 0; i < models_.size(); ++i) {
    const Eigen::Index n = models_[i].size();
    if (models_[i].order() == 2 && !released) {
      starts[i] = {narrow.mean, narrow.covariance};
    } else {
      starts[i] = {wide.mean.head(n), wide.covariance.topLeftCorner(n, n)};
    }
  }
  start(points_.back().time, starts);
  points_.clear();
}

template <int Axes>
void Tracker<Axes>::start_given(double time) {
  const Vector<9> mean = Eigen::Map<const Vector<9>>(settings_.start_mean.data());
  const Vector<9> variance = Eigen::Map<const Vector<9>>(settings_.start_covariance_diagonal.data());
  Starts starts(models_.size());
  for (std::size_t i = 0; i < models_.size(); ++i) {
    const Eigen::Index n = models_[i].size();
    starts[i].mean.resize(n);
    starts[i].covariance.setZero(n, n);
    for (Eigen::Index k = 0; k < n; ++k) {  // the keys always speak of three axes
      const Eigen::Index key = k / Axes * 3 + k % Axes;
      starts[i].mean(k) = mean(key);
      starts[i].covariance(k, k) = variance(key);
    }
  }
  start(time, starts);
}

template <int Axes>
void Tracker<Axes>::start(double time, const Starts& starts) {
  time_ = time;
  if (settings_.fuzzy) {
    Interaction<Fuzzy> interaction{
        settings_.lift, {settings_.mixed_covariance, settings_.mixing_tie}, settings_.output_tie};
    filter_.emplace(Himm(models_, this->template transition<Fuzzy>(), starts, interaction));
  } else {
    Interaction<Random> interaction{settings_.lift, {settings_.imm_mixing}, settings_.output_tie};
    filter_.emplace(Imm(models_, this->template transition<Random>(), starts, interaction));
  }
}

template <int Axes>
template <Uncertainty Kind>
Relation<Kind, Kind> Tracker<Axes>::transition() const {
  const Variable<Kind> mode{"mode", settings_.models};
  return {mode, mode, settings_.transition};
}

template class Tracker<2>;
template class Tracker<3>;

}  // namespace sigmax::apps
