#include "himm_demo/track_page.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "himm_demo/track_page_columns.hpp"
#include "support/missing.hpp"

namespace sigmax::apps {
using namespace track_page;

namespace {

constexpr std::size_t most_tracks = 8;
constexpr std::size_t most_rows = 9000;  // of all series of a page together

}  // namespace

TrackPage::Track::Track(std::size_t filters, std::size_t columns, std::size_t most)
    : plots(plot_columns, std::max(most, 4 * plot_columns)),
      estimates(filters, Thinned(columns, std::max(most, 4 * columns))),
      histories(filters) {}

TrackPage::TrackPage(const std::vector<FilterSettings>& filters, const RecordingReader& recording, bool truth_known)
    : filters_(filters), recording_(recording), truth_known_(truth_known), models_(model_names(filters)) {}

/// How many rows each series may keep.
std::size_t TrackPage::room() const {
  return most_rows / ((filters_.size() + 1) * std::max<std::size_t>(1, tracks_.size()));
}

TrackPage::Track* TrackPage::track_of(const Fix& fix) {
  if (const auto found = tracks_.find(fix.track); found != tracks_.end()) return &found->second;
  if (tracks_.size() == most_tracks) return nullptr;
  Track& track = tracks_.try_emplace(fix.track, filters_.size(), columns(), room()).first->second;
  track.first_time = fix.time_s;
  for (auto& [name, other] : tracks_) {
    other.plots.limit(room());
    for (Thinned& estimates : other.estimates) estimates.limit(room());
  }
  return &track;
}

void TrackPage::measured(const Fix& fix, const std::optional<Vector<3>>& position,
                         const std::optional<Geodetic>& anchor) {
  Track* const track = track_of(fix);
  if (!track) {
    ++not_shown_;
    return;
  }
  if (anchor) track->anchor = anchor;
  track->last_position = position;
  if (!position && !fix.truth) return;
  std::vector<double> row(plot_columns, nan);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    if (position && !fix.missing[i]) row[plot_at + i] = (*position)(axis);
    if (fix.truth) row[truth_at + i] = (*fix.truth)(axis);
    if (position && fix.truth && !fix.missing[i]) row[plot_error_at + i] = (*position)(axis) - (*fix.truth)(axis);
  }
  track->plots.add(fix.time_s, row);
}

void TrackPage::estimated(const Fix& fix, const Said& said) {
  Track* const track = track_of(fix);
  if (!track) return;
  std::vector<double> row(columns(), nan);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(recording_.axes()); ++axis) {
    row[position_at + axis] = said.told.mean[axis];
    if (fix.truth) row[error_at + axis] = said.told.mean[axis] - (*fix.truth)(static_cast<Eigen::Index>(axis));
    row[sigma_at + axis] = std::sqrt(said.told.variance[axis]);
  }
  row[nis_at] = said.nis.value_or(nan);
  const auto& own = filters_[said.filter].models;
  for (std::size_t j = 0; j < own.size(); ++j)
    row[weights_at + static_cast<std::size_t>(std::find(models_.begin(), models_.end(), own[j]) - models_.begin())] =
        said.weights[j];
  track->estimates[said.filter].add(said.time, row);
}

void TrackPage::rejected(const Fix& fix, std::size_t filter) {
  Track* const track = track_of(fix);
  if (track && track->last_position && track->rejections.size() < most_marks)
    track->rejections.push_back({fix.time_s, filter, *track->last_position});
}

void TrackPage::restarted(const Fix& fix, std::size_t filter) {
  Track* const track = track_of(fix);
  if (track && track->restarts.size() < most_marks)
    track->restarts.push_back({fix.time_s, filter, track->last_position.value_or(Vector<3>::Constant(nan))});
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
  for (const auto& [name, track] : tracks_) page.views.push_back(view_of(name.empty() ? "all rows" : name, track));
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

}  // namespace sigmax::apps
