#include "himm_demo/track/track.hpp"

#include <sigmax/estimation/chi_square.hpp>

namespace sigmax::apps {
namespace {

constexpr std::size_t most_tracks = 8;
constexpr std::size_t most_rows = 9000;   // of all series of a page together
constexpr std::size_t most_marks = 300;   // of each kind and track
constexpr std::size_t most_stays = 1000;  // of a history

/// Columns of a measurement: its position, its error and where the target was.
constexpr std::size_t plot_at = 0, plot_error_at = 3, truth_at = 6, plot_columns = 9;

/// Columns of an estimate; the weights of the models follow.
constexpr std::size_t position_at = 0, error_at = 3, sigma_at = 6, nis_at = 9, quantities_at = 10, weights_at = 11;

constexpr std::array<const char*, 3> cartesian_names = {"x", "y", "z"}, geodetic_names = {"east", "north", "up"};

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
  return std::ranges::any_of(values, [](double value) { return !std::isnan(value); });
}

/// A round number of degrees that parts a range into three to seven.
double round_step(double range) {
  constexpr std::array steps = {0.0001, 0.0002, 0.0005, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05,
                                0.1,    0.2,    0.5,    1.0,   2.0,   5.0,   10.0, 20.0};
  const auto step = std::ranges::find_if(steps, [&](double one) { return range / one <= 7.0; });
  return step == steps.end() ? 30.0 : *step;
}

std::string degrees_text(double value, const char* positive, const char* negative) {
  return fmt::format("{:.6g}° {}", std::abs(value), value < 0.0 ? negative : positive);
}

/// Parallels and meridians about a place that cross a part of its frame, at round degrees.
std::vector<GraticuleLine> graticule(const Geodetic& anchor, double west, double east, double south, double north) {
  constexpr int points = 24;
  const LocalFrame frame(anchor, 2);
  double least_latitude = 90.0, greatest_latitude = -90.0, least_longitude = 540.0, greatest_longitude = -540.0;
  for (int i = 0; i <= points; ++i)
    for (const auto& [x, y] : {std::pair{west + (east - west) * i / points, south},
                               {west + (east - west) * i / points, north},
                               {west, south + (north - south) * i / points},
                               {east, south + (north - south) * i / points}}) {
      const Geodetic place = frame.to_geodetic({x, y, 0.0});
      // The meridian of 180° is no border here.
      const double longitude = anchor.longitude_deg + std::remainder(place.longitude_deg - anchor.longitude_deg, 360.0);
      least_latitude = std::min(least_latitude, place.latitude_deg);
      greatest_latitude = std::max(greatest_latitude, place.latitude_deg);
      least_longitude = std::min(least_longitude, longitude);
      greatest_longitude = std::max(greatest_longitude, longitude);
    }
  std::vector<GraticuleLine> lines;
  const auto add = [&](std::string label, const auto& place_at) {
    GraticuleLine line{std::move(label), {}, {}};
    for (int i = 0; i <= points; ++i) {
      const Position at = frame.to_local(place_at(static_cast<double>(i) / points));
      line.x.push_back(at[0]);
      line.y.push_back(at[1]);
    }
    lines.push_back(std::move(line));
  };
  const double tall = greatest_latitude - least_latitude, wide = greatest_longitude - least_longitude;
  const auto for_each_round = [](double least, double greatest, const auto& use) {
    const double step = round_step(greatest - least), first = std::ceil(least / step) * step;
    for (int i = 0; i < 8 && first + i * step <= greatest; ++i) use(first + i * step);
  };
  for_each_round(least_latitude, greatest_latitude, [&](double latitude) {
    add(degrees_text(latitude, "N", "S"), [&](double part) {
      return Geodetic{latitude, least_longitude + part * wide, 0.0};
    });
  });
  for_each_round(least_longitude, greatest_longitude, [&](double longitude) {
    add(degrees_text(std::remainder(longitude, 360.0), "E", "W"), [&](double part) {
      return Geodetic{least_latitude + part * tall, longitude, 0.0};
    });
  });
  return lines;
}

}  // namespace

TrackPage::TrackPage(const std::vector<FilterSettings>& filters, const RecordingReader& recording, bool truth_known)
    : filters_(filters), recording_(recording), truth_known_(truth_known), models_(model_names(filters)) {}

/// Null for tracks that are not shown. Each series may keep so many rows that all together are not too many.
TrackPage::Track* TrackPage::track_of(const Row& row) {
  if (const auto found = tracks_.find(row.track); found != tracks_.end()) return &found->second;
  if (tracks_.size() == most_tracks) return nullptr;
  const std::size_t room = most_rows / ((filters_.size() + 1) * (tracks_.size() + 1));
  const std::size_t columns = weights_at + models_.size();
  Track track{row.plot.time, Thinned(plot_columns, std::max(room, 4 * plot_columns)),
              std::vector<Thinned>(filters_.size(), Thinned(columns, std::max(room, 4 * columns))),
              std::vector<std::vector<ModeStay>>(filters_.size())};
  for (auto& [name, other] : tracks_) {
    other.plots.limit(room);
    for (Thinned& estimates : other.estimates) estimates.limit(room);
  }
  return &tracks_.emplace(row.track, std::move(track)).first->second;
}

void TrackPage::measured(const Row& row, const std::optional<Position>& position,
                         const std::optional<Geodetic>& anchor) {
  Track* const track = track_of(row);
  if (!track) {
    ++not_shown_;
    return;
  }
  if (anchor) track->anchor = anchor;
  track->last_position = position;
  if (!position && !row.truth) return;
  std::vector<double> numbers(plot_columns, nan);
  const bool is_whole = row.plot.sensor != AnyPlot::Sensor::components;
  for (std::size_t i = 0; i < 3; ++i) {
    const bool is_seen = position && (is_whole || i >= static_cast<std::size_t>(recording_.axes()) ||
                                      component_of(row.plot, static_cast<int>(i)));
    if (is_seen) numbers[plot_at + i] = (*position)[i];
    if (row.truth) numbers[truth_at + i] = (*row.truth)[i];
    if (is_seen && row.truth) numbers[plot_error_at + i] = (*position)[i] - (*row.truth)[i];
  }
  track->plots.add(row.plot.time, numbers);
}

void TrackPage::estimated(const Row& row, std::size_t filter, const TargetPoint& point, int measured) {
  Track* const track = track_of(row);
  if (!track) return;
  std::vector<double> numbers(weights_at + models_.size(), nan);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(recording_.axes()); ++axis) {
    numbers[position_at + axis] = point.mean[axis];
    if (row.truth) numbers[error_at + axis] = point.mean[axis] - (*row.truth)[axis];
    numbers[sigma_at + axis] = std::sqrt(point.covariance[axis * (point.mean.size() + 1)]);
  }
  numbers[nis_at] = point.nis.value_or(nan);
  if (point.nis) numbers[quantities_at] = measured;
  const auto& own = filters_[filter].models;
  for (std::size_t j = 0; j < own.size(); ++j)
    numbers[weights_at + static_cast<std::size_t>(std::ranges::find(models_, own[j]) - models_.begin())] =
        point.weights[j];
  track->estimates[filter].add(point.time, numbers);
}

/// A rejection is marked where the measurement was, and not where there was none.
void TrackPage::mark(const Row& row, std::size_t filter, bool rejection) {
  Track* const track = track_of(row);
  if (!track || (rejection && !track->last_position)) return;
  auto& marks = rejection ? track->rejections : track->restarts;
  if (marks.size() < most_marks)
    marks.push_back({row.plot.time, filter, track->last_position.value_or(Position{nan, nan, nan})});
}

void TrackPage::explained(const std::string& track, std::size_t filter, const std::vector<ModeStay>& stays) {
  if (const auto found = tracks_.find(track); found != tracks_.end()) found->second.histories[filter] = stays;
}

void TrackPage::add_to(Report& page) const {
  page.groups.push_back({measurement_name, true});
  page.groups.push_back({truth_name, true});
  if (!truth_known_) page.groups.pop_back();
  for (const auto& filter : filters_) page.groups.push_back({filter.name});
  page.chooser = "Track";
  for (const auto& [track_name, track] : tracks_) {
    const std::string name = track_name.empty() ? "all rows" : track_name;
    View view{name, charts(track)};
    if (recording_.axes() > 1) view.panels.insert(view.panels.begin(), plan(name, track));
    page.views.push_back(std::move(view));
  }
  if (not_shown_ > 0)
    page.verdict.push_back(fmt::format("Shown are the first {} tracks; {} rows of others are in the tables only.",
                                       tracks_.size(), not_shown_));
  std::size_t taken = 0, kept = 0;
  for (const auto& [name, track] : tracks_)
    for (const Thinned& estimates : track.estimates) {
      taken += estimates.taken();
      kept += estimates.kept();
    }
  if (kept < taken)
    page.verdict.push_back(
        fmt::format("The charts are thinned: of {} estimates {} are drawn, with the least and the greatest number of "
                    "every stretch.",
                    taken, kept));
}

std::vector<LineChart> TrackPage::charts_of_the_first() const {
  if (tracks_.empty()) return {};
  const auto panels = charts(tracks_.begin()->second);
  return {std::get<LineChart>(panels.front()), std::get<LineChart>(panels[panels.size() - 2])};
}

/// Below which 95 % of the NIS are if the filter is consistent: a band, or a point for each row where rows measure
/// different numbers of measured.
void add_usual_nis(const std::vector<double>& measured, LineChart& chart) {
  const char* const name = "95 % if consistent";
  std::vector<double> usual;
  for (const double number : measured) usual.push_back(std::isnan(number) ? number : chi_square_quantile(0.95, number));
  const auto first = std::ranges::find_if(usual, [](double value) { return !std::isnan(value); });
  if (first == usual.end()) return;
  if (std::all_of(first, usual.end(), [&](double value) { return std::isnan(value) || value == *first; }))
    chart.expected = {{0.0, *first, name}};
  else
    chart.curves.push_back({.name = name, .group = measurement_name, .values = std::move(usual), .dots = true});
}

/// Along one axis the position; errors or standard deviations, NIS and weights; all of one time.
std::vector<Panel> TrackPage::charts(const Track& track) const {
  std::vector<double> all = since(track.first_time, track.plots.times());
  for (const Thinned& estimates : track.estimates) {
    const auto times = since(track.first_time, estimates.times());
    all.insert(all.end(), times.begin(), times.end());
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  const auto of = [&](const Thinned& rows, std::size_t column) {
    return at_times(all, since(track.first_time, rows.times()), rows.column(column));
  };
  const auto chart = [&](std::string title, std::string y_label) {
    LineChart made{
        .title = std::move(title), .x_label = "time since the first row, s", .y_label = std::move(y_label), .x = all};
    made.joined = true;
    add_restarts(track, made);
    return made;
  };
  std::vector<Panel> panels;
  const auto axes = static_cast<std::size_t>(recording_.axes());
  const bool geodetic = recording_.on_the_earth();
  if (axes == 1) {
    LineChart along = chart("Position", "x, m");
    along.curves.push_back(
        {.name = measurement_name, .group = measurement_name, .values = of(track.plots, plot_at), .dots = true});
    for (std::size_t f = 0; f < filters_.size(); ++f)
      along.curves.push_back({filters_[f].name, filters_[f].name, of(track.estimates[f], position_at)});
    panels.emplace_back(std::move(along));
  }
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const std::string name = (geodetic ? geodetic_names : cartesian_names)[axis];
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
  add_usual_nis(of(track.estimates.front(), quantities_at), nis);
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
void TrackPage::add_restarts(const Track& track, LineChart& chart) const {
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
      const auto shade = std::ranges::find(models_, model) - models_.begin();
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
  Plan plan{
      .title = "Track " + name, .x_label = geodetic ? "east, m" : "x, m", .y_label = geodetic ? "north, m" : "y, m"};
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
                      .shape = PlanTrace::Shape::crosses};
      for (const Mark& mark : marks)
        if (mark.filter == f) {
          trace.x.push_back(mark.position[0]);
          trace.y.push_back(mark.position[1]);
          if (high) trace.z.push_back(mark.position[2]);
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
