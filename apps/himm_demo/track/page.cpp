#include "himm_demo/track/track.hpp"

#include <sigmax/estimation/chi_square.hpp>

namespace sigmax::apps {
namespace {

constexpr std::size_t most_tracks = 200;
constexpr std::size_t most_marks = 300;    // of each kind and track
constexpr std::size_t most_stays = 1000;   // of a history
constexpr std::size_t most_on_map = 8000;  // places of all tracks together
constexpr std::size_t most_sensors = 6;    // with a chart of their own
constexpr std::size_t recent_rows = 20;    // whose mean NIS is drawn

/// Columns of a measurement: its position, its error, where the target was, and its speed, course and climb.
constexpr std::size_t plot_at = 0, plot_error_at = 3, truth_at = 6, truth_moves_at = 9, plot_columns = 12;

/// Columns of an estimate; the weights of the models follow. Speed, course and climb have their σ beside them.
constexpr std::size_t position_at = 0, error_at = 3, sigma_at = 6, moves_at = 9, nis_at = 15, quantities_at = 16,
                      outlier_at = 17, sensor_at = 18, innovation_at = 19, innovations = 4,
                      weights_at = innovation_at + innovations;

constexpr std::array<const char*, 3> cartesian_names = {"x", "y", "z"}, geodetic_names = {"east", "north", "up"};

std::vector<double> since(double first, std::vector<double> times) {
  for (double& time : times) time -= first;
  return times;
}

bool any(const std::vector<double>& values) {
  return std::ranges::any_of(values, [](double value) { return !std::isnan(value); });
}

/// Speed, course and climb, each with its standard deviation; NaN where they are not known.
using Moves = std::array<double, 6>;

/// How fast in plan, which way and how fast up a velocity is, with its covariance: to first order in its errors. A
/// course that may as well be any, ± 2 σ of more than a right angle, is not known. Along one axis there is the velocity
/// alone.
Moves moves_of(const std::array<double, 3>& velocity, const std::array<Position, 3>& covariance, int axes,
               bool from_north) {
  Moves moves;
  moves.fill(nan);
  if (axes == 1) return {velocity[0], std::sqrt(covariance[0][0]), nan, nan, nan, nan};
  const double speed = std::hypot(velocity[0], velocity[1]);
  const double c = speed > 0.0 ? velocity[0] / speed : 1.0, s = speed > 0.0 ? velocity[1] / speed : 0.0;
  const double both = 2.0 * c * s * covariance[0][1];
  moves[0] = speed;
  moves[1] = std::sqrt(std::max(0.0, c * c * covariance[0][0] + both + s * s * covariance[1][1]));
  const double across = std::sqrt(std::max(0.0, s * s * covariance[0][0] - both + c * c * covariance[1][1]));
  if (speed > 0.0 && across / speed < 45.0 * degree) {
    const double angle = from_north ? std::atan2(c, s) : std::atan2(s, c);
    moves[2] = std::remainder(angle / degree - 180.0, 360.0) + 180.0;
    moves[3] = across / speed / degree;
  }
  if (axes == 3) {
    moves[4] = velocity[2];
    moves[5] = std::sqrt(covariance[2][2]);
  }
  return moves;
}

/// Adds a curve unless nothing of it is known, with a band of ± 2 σ where there is a σ.
void add(Curve curve, LineChart& chart, const std::vector<double>& sigma = {}) {
  if (!any(curve.values)) return;
  for (std::size_t k = 0; k < sigma.size(); ++k) {
    curve.lower.push_back(curve.values[k] - 2.0 * sigma[k]);
    curve.upper.push_back(curve.values[k] + 2.0 * sigma[k]);
  }
  chart.curves.push_back(std::move(curve));
}

/// Counts courses on beyond 360°, so that no curve jumps when north is passed.
void count_on(LineChart& chart) {
  double before = nan;
  for (std::size_t k = 0; k < chart.x.size(); ++k)
    for (Curve& curve : chart.curves) {
      if (std::isnan(curve.values[k])) continue;
      const double turns = std::isnan(before) ? 0.0 : 360.0 * std::round((before - curve.values[k]) / 360.0);
      for (auto* const values : {&curve.values, &curve.lower, &curve.upper})
        if (!values->empty()) (*values)[k] += turns;
      before = curve.values[k];
    }
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

/// The same for what a map shows.
std::vector<GraticuleLine> graticule_of(const Geodetic& anchor, const Plan& plan) {
  double west = nan, east = nan, south = nan, north = nan;
  if (!plan.focus.empty()) {
    west = plan.focus[0];
    east = plan.focus[1];
    south = plan.focus[2];
    north = plan.focus[3];
  }
  for (const PlanTrace& trace : plan.traces)
    for (std::size_t k = 0; plan.focus.empty() && k < trace.x.size(); ++k) {
      west = std::fmin(west, trace.x[k]);
      east = std::fmax(east, trace.x[k]);
      south = std::fmin(south, trace.y[k]);
      north = std::fmax(north, trace.y[k]);
    }
  const double half = 0.6 * std::max(east - west, north - south);  // the map is about half as wide again as it is high
  const double x = 0.5 * (west + east), y = 0.5 * (south + north);
  if (!(half > 0.0)) return {};
  return graticule(anchor, x - 1.4 * half, x + 1.4 * half, y - half, y + half);
}

/// Least and greatest x and y of all but the outermost places, with a margin, where these would make the rest small.
std::vector<double> usual_bounds(std::vector<double> x, std::vector<double> y) {
  std::vector<double> bounds;
  bool far = false;
  for (auto* const values : {&x, &y}) {
    if (values->empty()) return {};
    std::ranges::sort(*values);
    const std::size_t cut = values->size() / 50;
    const double least = (*values)[cut], greatest = (*values)[values->size() - 1 - cut],
                 margin = 0.2 * (greatest - least);
    far |= values->back() - values->front() > 2.0 * (greatest - least + 2.0 * margin);
    bounds.insert(bounds.end(), {least - margin, greatest + margin});
  }
  return far ? bounds : std::vector<double>{};
}

}  // namespace

TrackPage::TrackPage(const std::vector<FilterSettings>& filters, const RecordingReader& recording, bool truth_known)
    : filters_(filters),
      recording_(recording),
      truth_known_(truth_known),
      models_(model_names(filters)),
      smooths_(std::ranges::any_of(filters, &FilterSettings::smooth)) {}

/// Null for tracks that are not shown.
TrackPage::Track* TrackPage::track_of(const Row& row) {
  if (const auto found = tracks_.find(row.track); found != tracks_.end()) return &found->second;
  if (tracks_.size() == most_tracks) return nullptr;
  std::vector<std::size_t> watched = {plot_error_at, plot_error_at + 1, plot_error_at + 2};
  for (std::size_t f = 0; f < filters_.size(); ++f)
    for (std::size_t i = 0; i < weights_at + models_.size(); ++i)
      if (i < sigma_at || i == moves_at || i == moves_at + 4 || i == outlier_at || i >= weights_at)
        watched.push_back(column(f, i));
  const std::size_t least = 4 * watched.size();
  Thinned rows(column(filters_.size(), 0), std::max(most_rows(), least), std::move(watched));
  Track track{.first_time = row.plot.time,
              .rows = std::move(rows),
              .histories = std::vector<std::vector<ModeStay>>(filters_.size()),
              .recent = std::vector<Recent>(filters_.size())};
  return &tracks_.emplace(row.track, std::move(track)).first->second;
}

/// Where a filter's columns are.
std::size_t TrackPage::column(std::size_t filter, std::size_t i) const {
  return plot_columns + filter * (weights_at + models_.size()) + i;
}

/// So many rows as make a page of some MB: a curve and its band take about 20 bytes a row.
std::size_t TrackPage::most_rows() const {
  const auto axes = static_cast<std::size_t>(recording_.axes());
  return 4'800'000 / (100 + filters_.size() * (70 * axes + 60));
}

/// The numbers of a row that filters may still tell of.
std::vector<double>& TrackPage::numbers(Track& track, double time, std::size_t line) {
  return track.open.try_emplace({time, line}, column(filters_.size(), 0), nan).first->second;
}

/// Takes rows down of which nothing more is told. When there are too many in all, the longest track has half as many.
void TrackPage::close(Track& track, std::size_t left_open) {
  for (; track.open.size() > left_open; track.open.erase(track.open.begin())) {
    kept_ -= track.rows.kept();
    track.rows.add(track.open.begin()->first.first, track.open.begin()->second);
    kept_ += track.rows.kept();
  }
  if (kept_ <= most_rows()) return;
  Thinned& longest =
      std::ranges::max_element(tracks_, {}, [](const Named& one) { return one.second.rows.kept(); })->second.rows;
  kept_ -= longest.kept();
  longest.limit(longest.kept() / 2);
  kept_ += longest.kept();
}

void TrackPage::finish() {
  for (auto& [name, track] : tracks_) close(track, 0);
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
  std::vector<double>& numbers = this->numbers(*track, row.plot.time, row.line);
  const bool is_whole = row.plot.sensor != AnyPlot::Sensor::components;
  for (std::size_t i = 0; i < 3; ++i) {
    const bool is_seen = position && (is_whole || i >= static_cast<std::size_t>(recording_.axes()) ||
                                      component_of(row.plot, static_cast<int>(i)));
    if (is_seen) numbers[plot_at + i] = (*position)[i];
    if (row.truth) numbers[truth_at + i] = (*row.truth)[i];
    if (is_seen && row.truth) numbers[plot_error_at + i] = (*position)[i] - (*row.truth)[i];
  }
  if (row.truth) {  // from its last place to this one
    Position velocity{};
    const bool moves = track->last_truth && row.plot.time > track->last_truth->first;
    for (std::size_t i = 0; moves && i < 3; ++i)
      velocity[i] = ((*row.truth)[i] - track->last_truth->second[i]) / (row.plot.time - track->last_truth->first);
    if (moves && track->anchor) {
      const auto turn = LocalFrame(*track->anchor, recording_.axes()).local_axes(*row.truth);
      const Position there = velocity;
      for (std::size_t i = 0; i < 3; ++i)
        velocity[i] = turn[i][0] * there[0] + turn[i][1] * there[1] + turn[i][2] * there[2];
    }
    const Moves all = moves_of(velocity, {}, recording_.axes(), recording_.on_the_earth());
    constexpr double least_speed = 1.0;  // at rest a recorder's noise goes all ways
    for (std::size_t i = 0; moves && i < 3; ++i)
      if (i != 1 || all[0] >= least_speed) numbers[truth_moves_at + i] = all[2 * i];
    if (moves || !track->last_truth) track->last_truth = {row.plot.time, *row.truth};
  }
  constexpr std::size_t awaited = 2;  // a start may wait for the row after it
  if (!smooths_) close(*track, awaited);
}

void TrackPage::estimated(const Row& row, std::size_t filter, const TargetPoint& point, int measured) {
  Track* const track = track_of(row);
  if (!track) return;
  double* const numbers = &this->numbers(*track, point.time, row.line)[column(filter, 0)];
  if (filter == 0) ++track->estimates;
  const auto axes = static_cast<std::size_t>(recording_.axes());
  const std::size_t n = point.mean.size();
  for (std::size_t axis = 0; axis < axes; ++axis) {
    numbers[position_at + axis] = point.mean[axis];
    if (row.truth) numbers[error_at + axis] = point.mean[axis] - (*row.truth)[axis];
    numbers[sigma_at + axis] = std::sqrt(point.covariance[axis * (n + 1)]);
  }
  if (n >= 2 * axes) {
    Position velocity{};
    std::array<Position, 3> covariance{};
    for (std::size_t i = 0; i < axes; ++i) {
      velocity[i] = point.mean[axes + i];
      for (std::size_t j = 0; j < axes; ++j) covariance[i][j] = point.covariance[(axes + i) * n + axes + j];
    }
    std::ranges::copy(moves_of(velocity, covariance, recording_.axes(), recording_.on_the_earth()), numbers + moves_at);
  }
  if (point.nis) judge(row, point, measured, track->recent[filter], numbers);
  const auto& own = filters_[filter].models;
  for (std::size_t j = 0; j < own.size(); ++j)
    numbers[weights_at + static_cast<std::size_t>(std::ranges::find(models_, own[j]) - models_.begin())] =
        point.weights[j];
}

/// The mean NIS of the last rows, and what of this one stands by itself.
void TrackPage::judge(const Row& row, const TargetPoint& point, int measured, Recent& recent, double* numbers) {
  constexpr double one_in_a_thousand = 0.999;
  recent.emplace_back(*point.nis, measured);
  if (recent.size() > recent_rows) recent.pop_front();
  double nis = 0.0, number = 0.0;
  for (const auto& [one, its_number] : recent) {
    nis += one;
    number += its_number;
  }
  numbers[nis_at] = nis / number;
  numbers[quantities_at] = number;
  if (*point.nis > chi_square_quantile(one_in_a_thousand, measured)) numbers[outlier_at] = *point.nis / measured;
  const auto sensor = std::ranges::find(sensors_, row.sensor);
  numbers[sensor_at] = static_cast<double>(sensor - sensors_.begin());
  if (sensor == sensors_.end()) sensors_.push_back(row.sensor);
  std::copy_n(point.normalized_innovation.begin(), std::min(innovations, point.normalized_innovation.size()),
              numbers + innovation_at);
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

std::vector<const TrackPage::Named*> TrackPage::longest_first() const {
  std::vector<const Named*> all;
  for (const Named& one : tracks_) all.push_back(&one);
  std::ranges::stable_sort(all, std::greater<>(), [](const Named* one) { return one->second.estimates; });
  return all;
}

void TrackPage::add_to(Report& page, const TrackOutcome& outcome) const {
  page.groups.push_back({measurement_name, true});
  page.groups.push_back({truth_name, true});
  if (!truth_known_) page.groups.pop_back();
  for (const auto& filter : filters_) page.groups.push_back({filter.name});
  page.chooser = "Track";
  if (recording_.axes() > 1 && tracks_.size() > 1) page.panels.insert(page.panels.begin() + 1, map_of_all());
  for (const Named* const one : longest_first()) {
    const auto& [track_name, track] = *one;
    const std::string name = track_name.empty() ? "all rows" : track_name;
    View view{name, charts(track)};
    if (recording_.axes() > 1) view.panels.insert(view.panels.begin(), plan(name, track));
    const auto tally = outcome.each.find(track_name);
    if (tally != outcome.each.end() && tally->second.silent)
      view.panels.emplace_back(Words{"No estimate", tally->second.why_silent()});
    page.views.push_back(std::move(view));
  }
  if (not_shown_ > 0)
    page.verdict.push_back(fmt::format("Drawn are the first {} tracks; {} rows of others are in the tables only.",
                                       tracks_.size(), not_shown_));
  std::size_t taken = 0;
  for (const auto& [name, track] : tracks_) taken += track.rows.taken();
  if (kept_ < taken)
    page.verdict.push_back(
        fmt::format("The charts are thinned: of {} rows {} are drawn, with the least and the greatest place, error, "
                    "speed, climb, weight and NIS of every stretch.",
                    taken, kept_));
}

std::vector<LineChart> TrackPage::charts_of_the_first() const {
  if (tracks_.empty()) return {};
  const Track& track = longest_first().front()->second;
  return {error_charts(track).front(), modes(track, 0)};
}

LineChart TrackPage::chart(const Track& track, std::string title, std::string y_label) const {
  LineChart made{.title = std::move(title),
                 .x_label = "time since the first row, s",
                 .y_label = std::move(y_label),
                 .x = since(track.first_time, track.rows.times())};
  made.joined = true;
  add_restarts(track, made);
  return made;
}

/// Heights above the ellipsoid where the recording is geodetic, else along z.
std::vector<double> TrackPage::heights(const Track& track, std::size_t from) const {
  std::vector<double> z = track.rows.column(from + 2);
  if (!track.anchor) return z;
  const std::vector<double> x = track.rows.column(from), y = track.rows.column(from + 1);
  const LocalFrame frame(*track.anchor, recording_.axes());
  for (std::size_t k = 0; k < z.size(); ++k)
    if (!std::isnan(z[k])) z[k] = frame.to_geodetic({x[k], y[k], z[k]}).altitude_m;
  return z;
}

/// How fast, which way, how high; which mode; how certain and how well it fits.
std::vector<Panel> TrackPage::charts(const Track& track) const {
  std::vector<Panel> panels;
  const bool geodetic = recording_.on_the_earth();
  const int axes = recording_.axes();
  const auto put = [&](LineChart made) {
    if (!made.curves.empty()) panels.emplace_back(std::move(made));
  };
  const auto place = [&](const char* title, const char* y_label, std::size_t axis) {
    const auto values = [&](std::size_t from) {
      return axis == 2 ? heights(track, from) : track.rows.column(from + axis);
    };
    LineChart made = chart(track, title, y_label);
    add({.name = measurement_name, .group = measurement_name, .values = values(plot_at), .dots = true}, made);
    add({.name = truth_name, .group = truth_name, .values = values(truth_at)}, made);
    for (std::size_t f = 0; f < filters_.size(); ++f)
      add({filters_[f].name, filters_[f].name, values(column(f, position_at))}, made,
          track.rows.column(column(f, sigma_at + axis)));
    return made;
  };
  const auto motion = [&](const char* title, const std::string& y_label, std::size_t which) {
    LineChart made = chart(track, title, y_label + "; band: ± 2 σ");
    add({.name = truth_name, .group = truth_name, .values = track.rows.column(truth_moves_at + which)}, made);
    for (std::size_t f = 0; f < filters_.size(); ++f) {
      const std::size_t at = column(f, moves_at + 2 * which);
      add({filters_[f].name, filters_[f].name, track.rows.column(at)}, made, track.rows.column(at + 1));
      if (which == 0 && axes > 1 && !made.curves.empty())
        for (double& lower : made.curves.back().lower) lower = lower < 0.0 ? 0.0 : lower;
    }
    return made;
  };
  if (axes == 1) put(place("Position", "x, m", 0));
  put(axes == 1 ? motion("Velocity", "m/s", 0) : motion("Speed", axes == 3 ? "in plan, m/s" : "m/s", 0));
  LineChart course = motion("Course", geodetic ? "° from north, clockwise" : "° from x, counter-clockwise", 1);
  course.period = 360.0;
  course.joined = false;  // nobody knows it in between
  count_on(course);
  put(std::move(course));
  if (axes == 3) {
    put(place("Height", geodetic ? "above the ellipsoid, m; band: ± 2 σ" : "z, m; band: ± 2 σ", 2));
    put(motion("Climb", "m/s", 2));
  }
  for (std::size_t f = 0; f < filters_.size(); ++f) put(modes(track, f));
  for (LineChart& made : error_charts(track)) put(std::move(made));
  add_trust(track, panels);
  return panels;
}

/// Errors, a chart for each axis, where the truth is known; else one chart of standard deviations.
std::vector<LineChart> TrackPage::error_charts(const Track& track) const {
  std::vector<LineChart> all;
  LineChart sigmas = chart(track, "Standard deviations", "σ, m");
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(recording_.axes()); ++axis) {
    const std::string along = (recording_.on_the_earth() ? geodetic_names : cartesian_names)[axis];
    LineChart errors = chart(track, "Error in " + along, "error, m; band: ± 2 σ");
    add({.name = measurement_name,
         .group = measurement_name,
         .values = track.rows.column(plot_error_at + axis),
         .dots = true},
        errors);
    for (std::size_t f = 0; f < filters_.size(); ++f) {
      const std::string& filter = filters_[f].name;
      const auto sigma = track.rows.column(column(f, sigma_at + axis));
      add({filter, filter, track.rows.column(column(f, error_at + axis))}, errors, sigma);
      add({.name = filter + " " + along, .group = filter, .values = sigma, .dash = static_cast<int>(axis)}, sigmas);
    }
    if (truth_known_) all.push_back(std::move(errors));
  }
  if (!truth_known_) all.push_back(std::move(sigmas));
  return all;
}

/// When it manoeuvred, by one filter: the weights of its modes above each other.
LineChart TrackPage::modes(const Track& track, std::size_t filter) const {
  const FilterSettings& own = filters_[filter];
  LineChart made = chart(track, "Mode weights of " + own.name,
                         own.fuzzy ? "possibilities, one above the other" : "probabilities, one above the other");
  made.stacked = true;
  made.greatest_y = own.fuzzy ? static_cast<double>(own.models.size()) : 1.0;
  for (std::size_t j = 0; j < models_.size(); ++j)
    add({.name = models_[j], .group = own.name, .values = track.rows.column(column(filter, weights_at + j)), .dash = 0},
        made);
  add_history(track, filter, made);
  return made;
}

/// Whether to trust it: the mean NIS of the last rows, with single ones that are far too great, and the innovations of
/// each sensor.
void TrackPage::add_trust(const Track& track, std::vector<Panel>& panels) const {
  LineChart nis = chart(track, "NIS a measured quantity",
                        fmt::format("mean of {} rows; right is 1; dots: single ones beyond 99.9 %", recent_rows));
  nis.logarithmic = true;
  nis.least_y = 0.01;
  Curve usual{
      .name = "95 % if consistent", .group = measurement_name, .values = track.rows.column(column(0, quantities_at))};
  for (double& number : usual.values) {
    const bool known = !std::isnan(number);
    usual.lower.push_back(known ? chi_square_quantile(0.025, number) / number : nan);
    usual.upper.push_back(known ? chi_square_quantile(0.975, number) / number : nan);
    if (known) number = 1.0;
  }
  add(std::move(usual), nis);
  for (std::size_t f = 0; f < filters_.size(); ++f) {
    const std::string& filter = filters_[f].name;
    add({filter, filter, track.rows.column(column(f, nis_at))}, nis);
    add({.name = filter + " outliers",
         .group = filter,
         .values = track.rows.column(column(f, outlier_at)),
         .dots = true},
        nis);
  }
  if (!nis.curves.empty()) panels.emplace_back(std::move(nis));
  for (std::size_t s = 0; s < std::min(most_sensors, sensors_.size()); ++s) {
    constexpr double end = 5.0;
    LineChart made = chart(track, sensors_[s].empty() ? "Innovations" : "Innovations of " + sensors_[s],
                           "each number in its own σ, up to ± 5");
    made.least_y = -end;
    made.greatest_y = end;
    made.expected = {{-2.0, 2.0, "95 % if consistent"}};
    for (std::size_t f = 0; f < filters_.size(); ++f) {
      const auto sensor = track.rows.column(column(f, sensor_at));
      for (std::size_t i = 0; i < innovations; ++i) {
        Curve one{.name = fmt::format("{} {}", filters_[f].name, i + 1),
                  .group = filters_[f].name,
                  .values = track.rows.column(column(f, innovation_at + i)),
                  .dots = true};
        for (std::size_t k = 0; k < sensor.size(); ++k)
          if (sensor[k] != static_cast<double>(s)) one.values[k] = nan;
        add(std::move(one), made);
      }
    }
    if (!made.curves.empty()) panels.emplace_back(std::move(made));
  }
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

/// Which mode the best history has when: a band below the modes of a filter that has one.
void TrackPage::add_history(const Track& track, std::size_t filter, LineChart& modes) const {
  const auto& stays = track.histories[filter];
  const FilterSettings& own = filters_[filter];
  if (stays.empty() || modes.x.empty()) return;
  if (stays.size() > most_stays) {
    modes.note = fmt::format("The best history changes {} times, too often to be drawn.", stays.size() - 1);
    return;
  }
  HistoryBand band{"best history of " + own.name, own.name, {}};
  for (std::size_t i = 0; i < stays.size(); ++i) {
    const std::string& model = own.models[stays[i].mode];
    const auto shade = std::ranges::find(models_, model) - models_.begin();
    band.stays.push_back({stays[i].since - track.first_time,
                          i + 1 < stays.size() ? stays[i + 1].since - track.first_time : modes.x.back(), model,
                          static_cast<std::size_t>(shade)});
  }
  modes.histories.push_back(std::move(band));
}

Plan TrackPage::plan(const std::string& name, const Track& track) const {
  const bool geodetic = track.anchor.has_value();
  const bool high = recording_.axes() == 3;
  Plan plan{
      .title = "Track " + name, .x_label = geodetic ? "east, m" : "x, m", .y_label = geodetic ? "north, m" : "y, m"};
  if (name == "all rows") plan.title = "Track";
  const auto add = [&](const std::string& of, PlanTrace::Shape shape, std::size_t from) {
    PlanTrace trace{
        .name = of, .group = of, .shape = shape, .x = track.rows.column(from), .y = track.rows.column(from + 1)};
    if (high) trace.z = track.rows.column(from + 2);
    std::size_t known = 0;
    for (std::size_t k = 0; k < trace.x.size(); ++k) {
      if (std::isnan(trace.x[k]) || std::isnan(trace.y[k])) continue;
      for (auto* const values : {&trace.x, &trace.y, &trace.z})
        if (!values->empty()) (*values)[known] = (*values)[k];
      ++known;
    }
    for (auto* const values : {&trace.x, &trace.y, &trace.z})
      if (!values->empty()) values->resize(known);
    if (known > 0) plan.traces.push_back(std::move(trace));
  };
  add(measurement_name, PlanTrace::Shape::dots, plot_at);
  if (truth_known_) add(truth_name, PlanTrace::Shape::line, truth_at);
  for (std::size_t f = 0; f < filters_.size(); ++f)
    add(filters_[f].name, PlanTrace::Shape::line, column(f, position_at));
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
  if (geodetic) plan.graticule = graticule_of(*track.anchor, plan);
  return plan;
}

/// A line for each track, or its measurements where there is no estimate; in one frame, and with fewer places.
Plan TrackPage::map_of_all() const {
  const bool geodetic = recording_.on_the_earth();
  Plan plan{.title = "All tracks",
            .x_label = geodetic ? "east, m" : "x, m",
            .y_label = geodetic ? "north, m" : "y, m",
            .note = "A click on a track opens it."};
  const std::size_t step = 1 + kept_ / most_on_map;
  std::optional<LocalFrame> frame;
  std::vector<double> all_x, all_y;
  for (const Named* const one : longest_first()) {
    const auto& [name, track] = *one;
    const bool followed = track.estimates > 0;
    PlanTrace trace{.name = name, .shape = followed ? PlanTrace::Shape::line : PlanTrace::Shape::dots};
    const std::size_t from = followed ? column(0, position_at) : plot_at;
    const auto x = track.rows.column(from), y = track.rows.column(from + 1), z = track.rows.column(from + 2);
    std::optional<LocalFrame> own;
    if (track.anchor) own.emplace(*track.anchor, recording_.axes());
    if (own && !frame) frame = own;
    for (std::size_t k = 0; k < x.size(); ++k) {
      if ((k % step != 0 && k + 1 != x.size()) || std::isnan(x[k]) || std::isnan(y[k])) continue;
      Position at{x[k], y[k], std::isnan(z[k]) ? 0.0 : z[k]};
      if (own) at = frame->to_local(own->to_geodetic(at));
      trace.x.push_back(at[0]);
      trace.y.push_back(at[1]);
    }
    all_x.insert(all_x.end(), trace.x.begin(), trace.x.end());
    all_y.insert(all_y.end(), trace.y.begin(), trace.y.end());
    if (!trace.x.empty()) plan.traces.push_back(std::move(trace));
  }
  plan.focus = usual_bounds(std::move(all_x), std::move(all_y));
  if (frame) plan.graticule = graticule_of(frame->origin(), plan);
  return plan;
}

void TrackTally::goes_to(const std::vector<double>& mean, int axes) {
  Position here{};
  std::copy_n(mean.begin(), axes, here.begin());
  if (before) way_m += std::hypot(here[0] - (*before)[0], here[1] - (*before)[1], here[2] - (*before)[2]);
  before = here;
}

std::string TrackTally::why_silent() const {
  constexpr std::size_t start = 3;  // measurements
  return fmt::format("{} measurement{}; a filter starts from {} whole positions, and tells from the next on{}",
                     measurements, measurements == 1 ? "" : "s", start,
                     measurements > start ? ", and these do not lie so near each other" : "");
}

}  // namespace sigmax::apps
