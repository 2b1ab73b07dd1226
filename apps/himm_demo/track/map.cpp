// The map of a track, and of all.

#include "himm_demo/track/page.hpp"
#include "himm_demo/track/track.hpp"

namespace sigmax::apps {
namespace {

constexpr std::size_t most_on_map = 8000;  // places of all tracks together

void add(const Position& at, bool high, PlanTrace& trace) {
  trace.x.push_back(at[0]);
  trace.y.push_back(at[1]);
  if (high) trace.z.push_back(at[2]);
}

/// Least and greatest x and y of all but the outermost places, with a margin, where those are so many times as far.
std::vector<double> usual_bounds(const MapChart& plan, double times) {
  std::vector<double> bounds;
  bool far = false;
  for (const auto axis : {&PlanTrace::x, &PlanTrace::y}) {
    std::vector<double> values;
    for (const PlanTrace& one : plan.traces) values.insert(values.end(), (one.*axis).begin(), (one.*axis).end());
    std::erase_if(values, [](double value) { return std::isnan(value); });  // gaps
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

/// Gives a trace every so many places by their columns; the line breaks where none is known for long.
PlanTrace TrackPage::traced(PlanTrace made, const Track& track, std::size_t from, std::size_t every) const {
  const auto x = track.rows.column(from), y = track.rows.column(from + 1), z = track.rows.column(from + 2);
  const auto times = track.rows.times();
  const double longest = static_cast<double>(every) * longest_step(times);
  double before = nan;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if ((k % every != 0 && k + 1 != x.size()) || std::isnan(x[k]) || std::isnan(y[k])) continue;
    if (times[k] - before > longest) add({nan, nan, nan}, recording_.axes() == 3, made);
    before = times[k];
    add({x[k], y[k], z[k]}, recording_.axes() == 3, made);
  }
  return made;
}

MapChart TrackPage::plan(const std::string& name, const Track& track) const {
  const bool geodetic = track.anchor.has_value();
  MapChart plan{.title = name == "all rows" ? "Track" : "Track " + name,
                .x_label = geodetic ? "east, m" : "x, m",
                .y_label = geodetic ? "north, m" : "y, m"};
  const auto put = [&](PlanTrace made) {
    if (!made.x.empty()) plan.traces.push_back(std::move(made));
  };
  put(traced({measurement_name, measurement_name, PlanTrace::Shape::dots}, track, row_at));
  if (truth_known_) put(traced({truth_name, truth_name}, track, truth_at));
  for (std::size_t f = 0; f < filters_.size(); ++f)
    put(traced({filters_[f].name, filters_[f].name}, track, column(f, position_at)));
  const auto crosses = [&](const std::string& what, const std::vector<Mark>& marks) {
    for (std::size_t f = 0; f < filters_.size(); ++f) {
      PlanTrace made{what + filters_[f].name, filters_[f].name, PlanTrace::Shape::crosses};
      for (const Mark& mark : marks)
        if (mark.filter == f) add(mark.position, recording_.axes() == 3, made);
      put(std::move(made));
    }
  };
  for (const auto& [at, names] : stations_)
    plan.traces.push_back({list_of(names), measurement_name, PlanTrace::Shape::crosses, {at[0]}, {at[1]}});
  crosses("rejected by ", track.rejections);
  crosses("restart of ", track.restarts);
  if (track.rejections.size() == most_marks || track.restarts.size() == most_marks)
    plan.note = fmt::format("Only the first {} rejections and restarts are marked.", most_marks);
  plan.focus = usual_bounds(plan, 10.0);
  return plan;
}

/// A line for each track, or its measurements where there is no estimate; in one frame, and with fewer places.
MapChart TrackPage::map_of_all() const {
  const bool geodetic = recording_.on_the_earth();
  MapChart plan{.title = "All tracks",
                .x_label = geodetic ? "east, m" : "x, m",
                .y_label = geodetic ? "north, m" : "y, m",
                .note = "A click on a track opens it."};
  const std::size_t step = 1 + kept_ / most_on_map;
  std::optional<LocalFrame> frame;
  for (const Named* const one : longest_first()) {
    const auto& [name, track] = *one;
    const bool followed = track.estimates > 0;
    PlanTrace made{.name = name, .shape = followed ? PlanTrace::Shape::line : PlanTrace::Shape::dots};
    made = traced(std::move(made), track, followed ? column(0, position_at) : row_at, step);
    if (track.anchor) {
      const LocalFrame own(*track.anchor, recording_.axes());
      if (!frame) frame = own;
      for (std::size_t k = 0; k < made.x.size(); ++k) {
        const double z = made.z.empty() || std::isnan(made.z[k]) ? 0.0 : made.z[k];
        const Position at = frame->to_local(own.to_geodetic({made.x[k], made.y[k], z}));
        made.x[k] = at[0];
        made.y[k] = at[1];
      }
    }
    made.z.clear();
    if (!made.x.empty()) plan.traces.push_back(std::move(made));
  }
  plan.focus = usual_bounds(plan, 2.0);
  return plan;
}

}  // namespace sigmax::apps
