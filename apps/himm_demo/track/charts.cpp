#include "himm_demo/track/page.hpp"
#include "himm_demo/track/track.hpp"

#include <sigmax/estimation/chi_square.hpp>

namespace sigmax::apps {
namespace {

constexpr std::size_t most_stays = 1000;   // of a history
constexpr std::size_t most_on_map = 8000;  // places of all tracks together
constexpr std::size_t most_sensors = 6;    // with a chart of their own

constexpr std::array<const char*, 3> cartesian_names = {"x", "y", "z"}, geodetic_names = {"east", "north", "up"};

Curve dots(std::string name, const std::string& group, std::vector<double> values) {
  return {.name = std::move(name), .group = group, .values = std::move(values), .dots = true};
}

/// Adds a curve unless nothing of it is known, with a band of ± 2 σ where there is a σ.
void add(Curve curve, LineChart& chart, const std::vector<double>& sigma = {}) {
  if (std::ranges::all_of(curve.values, [](double value) { return std::isnan(value); })) return;
  for (std::size_t k = 0; k < sigma.size(); ++k) {
    curve.lower.push_back(curve.values[k] - 2.0 * sigma[k]);
    curve.upper.push_back(curve.values[k] + 2.0 * sigma[k]);
  }
  chart.curves.push_back(std::move(curve));
}

/// Courses within one turn, which begins where the fewest of them are. Where a curve leaves it on one side and comes in
/// on the other, a row of gaps parts it.
void keep_within_one_turn(LineChart& chart) {
  constexpr double sector = 30.0;
  std::array<std::size_t, 12> counts{};
  for (const Curve& curve : chart.curves)
    for (const double value : curve.values)
      if (!std::isnan(value)) ++counts[static_cast<std::size_t>(value / sector) % counts.size()];
  chart.period = 360.0;
  chart.least_y = sector * (0.5 + static_cast<double>(std::ranges::min_element(counts) - counts.begin()));
  chart.greatest_y = chart.least_y + chart.period;
  for (Curve& curve : chart.curves)
    for (std::size_t k = 0; k < chart.x.size(); ++k)
      if (curve.values[k] < chart.least_y)
        for (auto* const values : {&curve.values, &curve.lower, &curve.upper})
          if (!values->empty()) (*values)[k] += chart.period;
  for (std::size_t k = chart.x.size(); k-- > 1;) {
    if (std::ranges::none_of(
            chart.curves, [k](const Curve& curve) { return std::abs(curve.values[k] - curve.values[k - 1]) > 180.0; }))
      continue;
    const auto at = static_cast<std::ptrdiff_t>(k);
    chart.x.insert(chart.x.begin() + at, 0.5 * (chart.x[k - 1] + chart.x[k]));
    for (Curve& curve : chart.curves)
      for (auto* const values : {&curve.values, &curve.lower, &curve.upper})
        if (!values->empty()) values->insert(values->begin() + at, nan);
  }
}

/// A round number of degrees that parts a range into three to seven.
double round_step(double range) {
  const double power = std::pow(10.0, std::floor(std::log10(range / 7.0)));
  return power * (range <= 14.0 * power ? 2.0 : range <= 35.0 * power ? 5.0 : 10.0);
}

std::string degrees_text(double value, const char* positive, const char* negative) {
  return fmt::format("{:.6g}° {}", std::abs(value), value < 0.0 ? negative : positive);
}

/// Parallels and meridians about a place that cross what a map shows, at round degrees.
std::vector<GraticuleLine> graticule(const Geodetic& anchor, const Plan& plan) {
  const auto [least_x, greatest_x, least_y, greatest_y] = plan.bounds();
  const double half = 0.6 * std::max(greatest_x - least_x, greatest_y - least_y);
  if (!(half > 0.0)) return {};
  // A map may be half as wide again as it is high.
  const double middle = 0.5 * (least_x + greatest_x), west = middle - 1.4 * half, east = middle + 1.4 * half;
  const double south = 0.5 * (least_y + greatest_y) - half, north = south + 2.0 * half;
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

/// Least and greatest x and y of all but the outermost places, with a margin, where those are so many times as far.
std::vector<double> usual_bounds(const Plan& plan, double times) {
  std::vector<double> bounds;
  bool far = false;
  for (const auto axis : {&PlanTrace::x, &PlanTrace::y}) {
    std::vector<double> values;
    for (const PlanTrace& one : plan.traces) values.insert(values.end(), (one.*axis).begin(), (one.*axis).end());
    if (values.empty()) return {};
    std::ranges::sort(values);
    const std::size_t cut = values.size() / 50;
    const double least = values[cut], greatest = values[values.size() - 1 - cut], margin = 0.2 * (greatest - least);
    far |= values.back() - values.front() > times * (greatest - least + 2.0 * margin);
    bounds.insert(bounds.end(), {least - margin, greatest + margin});
  }
  return far ? bounds : std::vector<double>{};
}

}  // namespace

std::vector<const TrackPage::Named*> TrackPage::longest_first() const {
  auto all = each(tracks_, [](const Named& one) { return &one; });
  std::ranges::stable_sort(all, std::greater<>(), [](const Named* one) { return one->second.estimates; });
  return all;
}

void TrackPage::add_to(Report& page, const TrackOutcome& outcome) const {
  page.groups.push_back({measurement_name, true});
  if (truth_known_) page.groups.push_back({truth_name, true});
  for (const auto& filter : filters_) page.groups.push_back({filter.name});
  page.chooser = "Track";
  if (recording_.axes() > 1 && tracks_.size() > 1) page.panels.insert(page.panels.begin() + 1, map_of_all());
  for (const Named* const one : longest_first()) {
    const auto& [track_name, track] = *one;
    const std::string name = track_name.empty() ? "all rows" : track_name;
    View view{name, charts(track)};
    if (recording_.axes() > 1) view.panels.insert(view.panels.begin(), plan(name, track));
    const auto tally = outcome.each.find(track_name);
    if (tally != outcome.each.end() && tally->second.estimates == 0)
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

LineChart TrackPage::chart(const Track& track, std::string title, std::string y_label) const {
  LineChart made{.title = std::move(title),
                 .x_label = "time since the first row, s",
                 .y_label = std::move(y_label),
                 .x = track.rows.times()};
  for (double& time : made.x) time -= track.first_time;
  made.joined = true;
  // Restarts as lines, a few at most: more would be a shade.
  if (track.restarts.size() > 20) made.note = "There are too many restarts to be marked.";
  for (std::size_t i = 0; i < track.restarts.size() && track.restarts.size() <= 20; ++i) {
    const Mark& restart = track.restarts[i];
    const double time = restart.time - track.first_time;
    made.shaded.push_back({time, time, filters_[restart.filter].name + " restarts"});
  }
  return made;
}

/// Heights above the ellipsoid where the recording is geodetic, else along z, by its column.
std::vector<double> TrackPage::heights(const Track& track, std::size_t from) const {
  std::vector<double> z = track.rows.column(from);
  if (!track.anchor) return z;
  const std::vector<double> x = track.rows.column(from - 2), y = track.rows.column(from - 1);
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
  const auto motion = [&](const char* title, const std::string& y_label, std::size_t truth, std::size_t estimate,
                          std::size_t sigma) {
    LineChart made = chart(track, title, y_label + "; band: ± 2 σ");
    const bool is_height = estimate == position_at + 2;
    const auto values = [&](std::size_t from) { return is_height ? heights(track, from) : track.rows.column(from); };
    if (estimate < error_at) add(dots(measurement_name, measurement_name, values(plot_at + estimate)), made);
    add({truth_name, truth_name, values(truth)}, made);
    for (std::size_t f = 0; f < filters_.size(); ++f)
      add({filters_[f].name, filters_[f].name, values(column(f, estimate))}, made, track.rows.column(column(f, sigma)));
    return made;
  };
  if (axes == 1) put(motion("Position", "x, m", truth_at, position_at, sigma_at));
  LineChart speed = motion(axes == 1 ? "Velocity" : "Speed", axes == 3 ? "in plan, m/s" : "m/s", truth_moves_at,
                           moves_at, moves_at + 1);
  for (Curve& curve : speed.curves)
    for (double& lower : curve.lower)
      if (axes > 1 && lower < 0.0) lower = 0.0;
  if (axes > 1) limit_axis(speed, 0.98, 1.5);  // the first rows may tell hardly any
  put(std::move(speed));
  LineChart course = motion("Course", geodetic ? "° from north, clockwise" : "° from x, counter-clockwise",
                            truth_moves_at + 1, moves_at + 2, moves_at + 3);
  course.joined = false;  // nobody knows it in between
  keep_within_one_turn(course);
  put(std::move(course));
  if (axes == 3) {
    put(motion("Height", geodetic ? "above the ellipsoid, m" : "z, m", truth_at + 2, position_at + 2, sigma_at + 2));
    put(motion("Climb", "m/s", truth_moves_at + 2, moves_at + 4, moves_at + 5));
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
    add(dots(measurement_name, measurement_name, track.rows.column(plot_error_at + axis)), errors);
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
  std::vector<double> means;
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
    const std::vector<double> recent = track.rows.column(column(f, nis_at));
    std::ranges::copy_if(recent, std::back_inserter(means), [](double mean) { return mean > 0.0; });
    add({filter, filter, recent}, nis);
    add(dots(filter + " outliers", filter, track.rows.column(column(f, outlier_at))), nis);
  }
  std::ranges::sort(means);  // the first rows, and rest, would take half of the axis
  nis.least_y = means.empty() ? 0.1 : std::clamp(0.8 * means[means.size() / 100], 0.01, 0.3);
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
        Curve one = dots(fmt::format("{} {}", filters_[f].name, i + 1), filters_[f].name,
                         track.rows.column(column(f, innovation_at + i)));
        for (std::size_t k = 0; k < sensor.size(); ++k)
          if (sensor[k] != static_cast<double>(s)) one.values[k] = nan;
        add(std::move(one), made);
      }
    }
    if (!made.curves.empty()) panels.emplace_back(std::move(made));
  }
}

/// Which mode the best history has when: a band below the modes of a filter that has one.
void TrackPage::add_history(const Track& track, std::size_t filter, LineChart& modes) const {
  const auto& stays = track.histories[filter];
  if (stays.empty() || modes.x.empty()) return;
  if (stays.size() > most_stays) {
    modes.note = fmt::format("The best history changes {} times, too often to be drawn.", stays.size() - 1);
    return;
  }
  HistoryBand band{"best history of " + filters_[filter].name, filters_[filter].name, {}};
  for (std::size_t i = 0; i < stays.size(); ++i) {
    const std::string& model = filters_[filter].models[stays[i].mode];
    band.stays.push_back({stays[i].since - track.first_time,
                          i + 1 < stays.size() ? stays[i + 1].since - track.first_time : modes.x.back(), model,
                          static_cast<std::size_t>(std::ranges::find(models_, model) - models_.begin())});
  }
  modes.histories.push_back(std::move(band));
}

Plan TrackPage::plan(const std::string& name, const Track& track) const {
  const bool geodetic = track.anchor.has_value(), high = recording_.axes() == 3;
  Plan plan{
      .title = "Track " + name, .x_label = geodetic ? "east, m" : "x, m", .y_label = geodetic ? "north, m" : "y, m"};
  if (name == "all rows") plan.title = "Track";
  const auto put = [high](PlanTrace& trace, const Position& at) {
    trace.x.push_back(at[0]);
    trace.y.push_back(at[1]);
    if (high) trace.z.push_back(at[2]);
  };
  const auto add = [&](const std::string& of, PlanTrace::Shape shape, std::size_t from) {
    const auto x = track.rows.column(from), y = track.rows.column(from + 1), z = track.rows.column(from + 2);
    PlanTrace trace{.name = of, .group = of, .shape = shape};
    for (std::size_t k = 0; k < x.size(); ++k)
      if (!std::isnan(x[k]) && !std::isnan(y[k])) put(trace, {x[k], y[k], z[k]});
    if (!trace.x.empty()) plan.traces.push_back(std::move(trace));
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
        if (mark.filter == f) put(trace, mark.position);
      if (!trace.x.empty()) plan.traces.push_back(std::move(trace));
    }
  };
  for (const auto& [at, names] : stations_)
    plan.traces.push_back({list_of(names), measurement_name, PlanTrace::Shape::crosses, {at[0]}, {at[1]}});
  crosses("rejected by", track.rejections);
  crosses("restart of", track.restarts);
  if (track.rejections.size() == most_marks || track.restarts.size() == most_marks)
    plan.note = fmt::format("Only the first {} rejections and restarts are marked.", most_marks);
  plan.focus = usual_bounds(plan, 10.0);
  if (geodetic) plan.graticule = graticule(*track.anchor, plan);
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
    if (!trace.x.empty()) plan.traces.push_back(std::move(trace));
  }
  plan.focus = usual_bounds(plan, 2.0);
  if (frame) plan.graticule = graticule(frame->origin(), plan);
  return plan;
}

}  // namespace sigmax::apps
