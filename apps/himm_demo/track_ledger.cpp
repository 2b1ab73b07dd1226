#include "himm_demo/track_ledger.hpp"

#include <algorithm>
#include <utility>

#include <sigmax/estimation/chi_square.hpp>

#include "himm_demo/fix_reading.hpp"
#include "himm_demo/track_page.hpp"
#include "support/output.hpp"

namespace sigmax::apps {
namespace {

template <class Add>
void add_by_part(SumsByPart& sums, std::optional<double> roll, const Add& add) {
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (parts[p].holds(roll)) add(sums[p]);
}

}  // namespace

TrackLedger::TrackLedger(const TrackOptions& options, const std::vector<FilterSettings>& filters, int axes,
                         TrackSinks sinks)
    : options_(options), filters_(filters), axes_(axes), sinks_(sinks) {
  outcome.filters.resize(filters.size());
  for (std::size_t f = 0; f < filters.size(); ++f)
    for (auto& part : outcome.filters[f].sums) part.weights.assign(filters[f].models.size(), 0.0);
  for (std::size_t m = 0; m < usual_nis_.size(); ++m)
    usual_nis_[m] = chi_square_quantile(0.95, static_cast<double>(m + 1));
}

void TrackLedger::read(const Fix& fix, bool has_sensors) {
  ++outcome.rows;
  if (fix.measured()) ++outcome.measurements;
  if (fix.partly()) ++outcome.partial;
  if (fix.bearing) ++outcome.bearings;
  if (!has_sensors) return;
  ++outcome.sensors[fix.sensor];
  const auto known = [&](std::optional<double> Accuracy::*sigma) {
    return std::any_of(filters_.begin(), filters_.end(), [&](const FilterSettings& filter) {
      return (filter.accuracy_of(fix.sensor).*sigma).has_value();
    });
  };
  if (fix.moving() && !known(&Accuracy::velocity_mps)) ++outcome.velocity_unknown[fix.sensor];
  if (fix.range_rate && !known(&Accuracy::range_rate_mps)) ++outcome.range_rate_unknown[fix.sensor];
}

void TrackLedger::measured(const Fix& fix, const std::optional<Vector<3>>& position,
                           const std::optional<Geodetic>& anchor) {
  if (fix.seen) outcome.validity.add(fix, *fix.seen, filters_);
  if (fix.truth && fix.whole())
    add_by_part(outcome.raw, fix.roll_deg, [&](Sums& sums) {
      const Vector<3> error = *position - *fix.truth;
      for (std::size_t axis = 0; axis < 3; ++axis) sums.error[axis].add(error(static_cast<Eigen::Index>(axis)));
    });
  if (sinks_.page) sinks_.page->measured(fix, position, anchor);
}

void TrackLedger::said(const Fix& fix, const Said& said) {
  if (sinks_.estimates) sinks_.estimates->write(said.line);
  if (sinks_.page) sinks_.page->estimated(fix, said);
  if (fix.predicted) return;
  const int quantities = measured_quantities(fix, filters_[said.filter].accuracy_of(fix.sensor), axes_);
  add_by_part(outcome.filters[said.filter].sums, fix.roll_deg, [&](Sums& sums) {
    ++sums.count;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(axes_); ++axis) {
      sums.sigma[axis].add_square(said.own.variance[axis]);
      if (fix.truth) sums.error[axis].add(said.own.mean[axis] - (*fix.truth)(static_cast<Eigen::Index>(axis)));
    }
    for (std::size_t j = 0; j < sums.weights.size(); ++j) sums.weights[j] += said.weights[j];
    if (said.nis) sums.nis.add(*said.nis, usual_nis_[static_cast<std::size_t>(quantities) - 1]);
  });
}

void TrackLedger::stepped(const Fix& fix, const std::vector<Tally>& before, const std::vector<Tally>& after,
                          std::optional<double> least) {
  std::size_t refusing = 0;  // filters whose gate turns the measurement away
  for (std::size_t f = 0; f < filters_.size(); ++f) {
    const bool rejected = after[f].rejected > before[f].rejected;
    if (rejected) ++refusing;
    if (sinks_.page && rejected) sinks_.page->rejected(fix, f);
    if (sinks_.page && before[f].starts > 0 && after[f].starts > before[f].starts) sinks_.page->restarted(fix, f);
  }
  if (refusing == filters_.size() && outcome.refused_by_all++ == 0) outcome.first_refused_line = fix.line;
  if (least) outcome.outliers.add(fix.line, *least);
}

void TrackLedger::ended(const std::string& track, const std::vector<Tally>& tallies, std::size_t measurements) {
  bool started = true;
  for (std::size_t f = 0; f < filters_.size(); ++f) {
    outcome.filters[f].rejected += tallies[f].rejected;
    outcome.refusals.add(track, filters_[f], tallies[f].rejected, measurements);
    outcome.filters[f].restarts += tallies[f].starts > 0 ? tallies[f].starts - 1 : 0;
    started = started && tallies[f].starts > 0;
  }
  if (!started) outcome.never_started.push_back(track);
}

void TrackLedger::history(const std::string& track, std::size_t filter, std::vector<ModeStay> stays) {
  if (filters_[filter].explain) outcome.filters[filter].histories[track] = std::move(stays);
}

}  // namespace sigmax::apps
