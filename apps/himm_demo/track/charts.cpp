#include "himm_demo/track/page.hpp"
#include "himm_demo/track/track.hpp"

#include <sigmax/estimation/chi_square.hpp>

namespace sigmax::apps {
namespace {

constexpr std::size_t most_stays = 1000;  // of a history
constexpr std::size_t most_sensors = 6;   // with a chart of their own

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

/// The unit of the recording's own speeds, whether they count or not; else m/s.
const Unit& unit_of_speeds(const RecordingReader& recording) {
  for (const std::string& header : recording.csv().names())
    for (const Unit& unit : std::span(units::speeds).subspan(1, 3))  // climbs are in the others
      if (names_unit(header, unit.suffix)) return unit;
  return units::speeds[0];
}

void put(LineChart chart, std::vector<Panel>& panels) {
  if (!chart.greatest_y && !chart.logarithmic) keep_usual(chart);
  if (!chart.curves.empty()) panels.emplace_back(std::move(chart));
}

}  // namespace

/// A time for which no line goes on without a number: ten times as long as nine of ten steps are at most.
double TrackPage::longest_step(const std::vector<double>& times) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < times.size(); ++k)
    if (times[k] > times[k - 1]) steps.push_back(times[k] - times[k - 1]);
  std::ranges::sort(steps);
  return steps.empty() ? 1.0 : 10.0 * steps[steps.size() * 9 / 10];
}

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
      view.panels.emplace_back(Words{"No estimate", tally->second.reason_without_estimates()});
    page.views.push_back(std::move(view));
  }
  if (not_shown_ > 0)
    page.verdict.push_back(fmt::format("Drawn are the first {} tracks; {} rows of others are in the tables only.",
                                       tracks_.size(), not_shown_));
  std::size_t taken = 0;
  for (const auto& [name, track] : tracks_) taken += track.rows.taken();
  if (kept_ < taken)
    page.verdict.push_back(
        fmt::format("The charts are thinned: {} of {} rows are drawn, with all peaks.", kept_, taken));
}

LineChart TrackPage::chart(const Track& track, std::string title, std::string y_label) const {
  LineChart made{.title = std::move(title),
                 .x_label = clock_ ? "time, UTC" : "time since the first row, s",
                 .y_label = std::move(y_label),
                 .x = track.rows.times(),
                 .joined = longest_step(track.rows.times()),
                 .clock = clock_};
  for (double& time : made.x) time -= track.first_time;
  for (const Mark& restart : track.restarts) {
    if (track.restarts.size() > 20) break;  // they would be a shade; the map has them
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
  Position at{};  // where x and y are not told, as before
  for (std::size_t k = 0; k < z.size(); ++k) {
    if (!std::isnan(x[k] + y[k])) at = {x[k], y[k]};
    if (!std::isnan(z[k])) z[k] = frame.to_geodetic({at[0], at[1], z[k]}).altitude_m;
  }
  return z;
}

/// How fast, which way, how high; which mode; how certain and how well it fits.
std::vector<Panel> TrackPage::charts(const Track& track) const {
  std::vector<Panel> panels;
  const bool geodetic = recording_.on_the_earth();
  const int axes = recording_.axes();
  const auto motion = [&](const char* title, const std::string& y_label, std::size_t truth, std::size_t estimate,
                          std::size_t sigma) {
    LineChart made = chart(track, title, y_label + "; band: ± 2 σ");
    const bool is_height = estimate == position_at + 2;
    const auto values = [&](std::size_t from) { return is_height ? heights(track, from) : track.rows.column(from); };
    if (estimate < error_at) add(dots(measurement_name, measurement_name, values(row_at + estimate)), made);
    add({truth_name, truth_name, values(truth)}, made);
    for (std::size_t f = 0; f < filters_.size(); ++f)
      add({filters_[f].name, filters_[f].name, values(column(f, estimate))}, made, track.rows.column(column(f, sigma)));
    return made;
  };
  if (axes == 1) put(motion("Position", "x, m", truth_at, position_at, sigma_at), panels);
  const Unit& unit = unit_of_speeds(recording_);
  LineChart speed = motion(axes == 1 ? "Velocity" : "Speed", (axes == 3 ? "in plan, " : "") + std::string(unit.words),
                           truth_moves_at, moves_at, moves_at + 1);
  for (Curve& curve : speed.curves) {
    for (auto* const values : {&curve.values, &curve.lower, &curve.upper})
      for (double& value : *values) value /= unit.value;
    for (double& lower : curve.lower) lower = axes > 1 ? std::fmax(0.0, lower) : lower;
  }
  put(std::move(speed), panels);
  LineChart course = motion("Course", geodetic ? "° clockwise from north" : "° clockwise from y", truth_moves_at + 1,
                            moves_at + 2, moves_at + 3);
  course.joined = 0.0;  // nobody knows it in between
  course.course = true;
  course.greatest_y = 360.0;
  put(std::move(course), panels);
  if (axes == 3) {
    put(motion("Height", geodetic ? "above the ellipsoid, m" : "z, m", truth_at + 2, position_at + 2, sigma_at + 2),
        panels);
    put(motion("Climb", "m/s", truth_moves_at + 2, moves_at + 4, moves_at + 5), panels);
  }
  for (std::size_t f = 0; f < filters_.size(); ++f) put(modes(track, f), panels);
  add_errors(track, panels);
  add_trust(track, panels);
  return panels;
}

/// Errors, a chart for each axis, where the truth is known; else one chart of standard deviations.
void TrackPage::add_errors(const Track& track, std::vector<Panel>& panels) const {
  LineChart sigmas = chart(track, "Standard deviations", "σ, m");
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(recording_.axes()); ++axis) {
    const std::string along = (recording_.on_the_earth() ? geodetic_names : cartesian_names)[axis];
    LineChart errors = chart(track, "Error in " + along, "error, m; band: ± 2 σ");
    add(dots(measurement_name, measurement_name, track.rows.column(row_error_at + axis)), errors);
    for (std::size_t f = 0; f < filters_.size(); ++f) {
      const std::string& filter = filters_[f].name;
      const auto sigma = track.rows.column(column(f, sigma_at + axis));
      add({filter, filter, track.rows.column(column(f, error_at + axis))}, errors, sigma);
      add({.name = filter + " " + along, .group = filter, .values = sigma, .dash = static_cast<int>(axis)}, sigmas);
    }
    if (truth_known_) put(std::move(errors), panels);
  }
  if (!truth_known_) put(std::move(sigmas), panels);
}

/// When it manoeuvred, by one filter: the weights of its modes.
LineChart TrackPage::modes(const Track& track, std::size_t filter) const {
  const FilterSettings& own = filters_[filter];
  LineChart made = chart(track, "Mode weights of " + own.name, own.fuzzy ? "possibilities" : "probabilities");
  made.coloured = true;
  made.greatest_y = 1.05;
  for (std::size_t j = 0; j < models_.size(); ++j)
    add({models_[j], own.name, track.rows.column(column(filter, weights_at + j)), {}, {}, static_cast<int>(j)}, made);
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
  put(std::move(nis), panels);
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
    put(std::move(made), panels);
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

}  // namespace sigmax::apps
