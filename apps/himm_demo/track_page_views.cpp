#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <sigmax/estimation/chi_square.hpp>

#include "himm_demo/experiment/scenario.hpp"
#include "himm_demo/track_page.hpp"
#include "himm_demo/track_page_columns.hpp"
#include "support/missing.hpp"

namespace sigmax::apps {
using namespace track_page;

namespace {

/// The numbers of one series at the times of all; NaN in between.
std::vector<double> at_times(const std::vector<double>& all, const std::vector<double>& times,
                             const std::vector<double>& values) {
  std::vector<double> result(all.size(), nan);
  std::size_t k = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    while (k < all.size() && all[k] < times[i]) ++k;
    if (k < all.size()) result[k] = values[i];
  }
  return result;
}

std::vector<double> since(double first, std::vector<double> times) {
  for (double& time : times) time -= first;
  return times;
}

bool any(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double value) { return !std::isnan(value); });
}

}  // namespace

View TrackPage::view_of(const std::string& name, const Track& track) const {
  View view{name, charts(track)};
  if (recording_.axes() > 1) view.panels.insert(view.panels.begin(), plan(name, track));
  return view;
}

std::vector<LineChart> TrackPage::charts_of_the_first() const {
  if (tracks_.empty()) return {};
  const auto panels = charts(tracks_.begin()->second);
  return {std::get<LineChart>(panels.front()), std::get<LineChart>(panels[panels.size() - 2])};
}

/// Along one axis the position; errors or standard deviations, NIS and weights; all of one time.
std::vector<Panel> TrackPage::charts(const Track& track) const {
  std::vector<double> all = since(track.first_time, track.plots.times());
  for (const Thinned& estimates : track.estimates) {
    const auto times = since(track.first_time, estimates.times());
    all.insert(all.end(), times.begin(), times.end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  const auto of = [&](const Thinned& rows, std::size_t column) {
    return at_times(all, since(track.first_time, rows.times()), rows.column(column));
  };
  const auto chart = [&](std::string title, std::string y_label) {
    LineChart made{.title = std::move(title),
                   .x_label = "time since the first row, s",
                   .y_label = std::move(y_label),
                   .x = all,
                   .curves = {}};
    made.joined = true;
    mark(track, made);
    return made;
  };
  std::vector<Panel> panels;
  const auto axes = static_cast<std::size_t>(recording_.axes());
  const bool geodetic = recording_.geodetic();
  if (axes == 1) {
    LineChart along = chart("Position", "x, m");
    along.curves.push_back(
        {.name = measurement_name, .group = measurement_name, .values = of(track.plots, plot_at), .dots = true});
    for (std::size_t f = 0; f < filters_.size(); ++f)
      along.curves.push_back({filters_[f].name, filters_[f].name, of(track.estimates[f], position_at)});
    panels.emplace_back(std::move(along));
  }
  constexpr std::array places = {"east", "north", "up"};
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const std::string name = geodetic ? places[axis] : axis_names[axis];
    LineChart made = truth_known_ ? chart("Error in " + name, "error, m; band: ± 2 σ")
                                  : chart("Standard deviation in " + name, "σ, m");
    if (truth_known_)
      made.curves.push_back({.name = measurement_name,
                             .group = measurement_name,
                             .values = of(track.plots, plot_error_at + axis),
                             .dots = true});
    for (std::size_t f = 0; f < filters_.size(); ++f) {
      Curve curve{filters_[f].name, filters_[f].name,
                  of(track.estimates[f], (truth_known_ ? error_at : sigma_at) + axis)};
      if (truth_known_) {
        const auto sigma = of(track.estimates[f], sigma_at + axis);
        for (std::size_t k = 0; k < all.size(); ++k) {
          curve.lower.push_back(curve.values[k] - 2.0 * sigma[k]);
          curve.upper.push_back(curve.values[k] + 2.0 * sigma[k]);
        }
      }
      made.curves.push_back(std::move(curve));
    }
    panels.emplace_back(std::move(made));
  }
  LineChart weights = chart("Mode weights", "probability (IMM) or possibility (HIMM)");
  weights.greatest_y = 1.05;
  LineChart nis = chart("NIS of the measurements", "NIS");
  nis.expected = {{0.0, chi_square_quantile(0.95, static_cast<double>(axes)), "95 % if consistent"}};
  for (std::size_t f = 0; f < filters_.size(); ++f) {
    nis.curves.push_back({filters_[f].name, filters_[f].name, of(track.estimates[f], nis_at)});
    for (std::size_t j = 0; j < models_.size(); ++j) {
      auto values = of(track.estimates[f], weights_at + j);
      if (any(values))
        weights.curves.push_back({.name = filters_[f].name + " " + models_[j],
                                  .group = filters_[f].name,
                                  .values = std::move(values),
                                  .dash = static_cast<int>(j)});
    }
  }
  limit_axis(nis);
  add_histories(track, weights);
  panels.emplace_back(std::move(weights));
  panels.emplace_back(std::move(nis));
  return panels;
}

/// Restarts as lines, a few at most: more would be a shade.
void TrackPage::mark(const Track& track, LineChart& chart) const {
  if (track.restarts.size() > 20) chart.note = "There are too many restarts to be marked.";
  for (std::size_t i = 0; i < track.restarts.size() && track.restarts.size() <= 20; ++i) {
    const Mark& restart = track.restarts[i];
    const double time = restart.time - track.first_time;
    chart.shaded.push_back({time, time, filters_[restart.filter].name + " restarts"});
  }
}

/// Which mode the best history has when: a band for each filter that has one.
void TrackPage::add_histories(const Track& track, LineChart& weights) const {
  for (std::size_t f = 0; f < filters_.size() && !weights.x.empty(); ++f) {
    const auto& stays = track.histories[f];
    if (stays.empty()) continue;
    if (stays.size() > most_stays) {
      weights.note = fmt::format("The best history of {} changes {} times, too often to be drawn.", filters_[f].name,
                                 stays.size() - 1);
      continue;
    }
    HistoryBand band{"best history of " + filters_[f].name, filters_[f].name, {}};
    for (std::size_t i = 0; i < stays.size(); ++i) {
      const std::string& model = filters_[f].models[stays[i].mode];
      const auto shade = std::find(models_.begin(), models_.end(), model) - models_.begin();
      band.stays.push_back({stays[i].since - track.first_time,
                            i + 1 < stays.size() ? stays[i + 1].since - track.first_time : weights.x.back(), model,
                            static_cast<std::size_t>(shade)});
    }
    weights.histories.push_back(std::move(band));
  }
}

Plan TrackPage::plan(const std::string& name, const Track& track) const {
  const bool geodetic = track.anchor.has_value();
  const bool high = recording_.axes() == 3;
  Plan plan{.title = "Track " + name,
            .x_label = geodetic ? "east, m" : "x, m",
            .y_label = geodetic ? "north, m" : "y, m",
            .traces = {}};
  if (name == "all rows") plan.title = "Track";
  const auto add = [&](const std::string& of, const std::string& group, PlanTrace::Shape shape, const Thinned& rows,
                       std::size_t from) {
    PlanTrace trace{.name = of, .group = group, .shape = shape, .x = rows.column(from), .y = rows.column(from + 1)};
    if (high) trace.z = rows.column(from + 2);
    if (any(trace.x)) plan.traces.push_back(std::move(trace));
  };
  add(measurement_name, measurement_name, PlanTrace::Shape::dots, track.plots, plot_at);
  if (truth_known_) add(truth_name, truth_name, PlanTrace::Shape::line, track.plots, truth_at);
  for (std::size_t f = 0; f < filters_.size(); ++f)
    add(filters_[f].name, filters_[f].name, PlanTrace::Shape::line, track.estimates[f], position_at);
  const auto crosses = [&](const char* what, const std::vector<Mark>& marks) {
    for (std::size_t f = 0; f < filters_.size(); ++f) {
      PlanTrace trace{.name = fmt::format("{} {}", what, filters_[f].name),
                      .group = filters_[f].name,
                      .shape = PlanTrace::Shape::crosses,
                      .x = {},
                      .y = {}};
      for (const Mark& mark : marks)
        if (mark.filter == f) {
          trace.x.push_back(mark.position.x());
          trace.y.push_back(mark.position.y());
          if (high) trace.z.push_back(mark.position.z());
        }
      if (!trace.x.empty()) plan.traces.push_back(std::move(trace));
    }
  };
  crosses("rejected by", track.rejections);
  crosses("restart of", track.restarts);
  if (track.rejections.size() == most_marks || track.restarts.size() == most_marks)
    plan.note = fmt::format("Only the first {} rejections and restarts are marked.", most_marks);
  if (geodetic) {
    double west = nan, east = nan, south = nan, north = nan;
    for (const PlanTrace& trace : plan.traces)
      for (std::size_t k = 0; k < trace.x.size(); ++k) {
        west = std::fmin(west, trace.x[k]);
        east = std::fmax(east, trace.x[k]);
        south = std::fmin(south, trace.y[k]);
        north = std::fmax(north, trace.y[k]);
      }
    const double half =
        0.6 * std::max(east - west, north - south);  // the map is about half as wide again as it is high
    const double x = 0.5 * (west + east), y = 0.5 * (south + north);
    if (half > 0.0) plan.graticule = graticule(*track.anchor, x - 1.4 * half, x + 1.4 * half, y - half, y + half);
  }
  return plan;
}

}  // namespace sigmax::apps
