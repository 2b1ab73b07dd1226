#pragma once

#include "hybrid/banks.hpp"
#include "support/smoother_restatement.hpp"

/// What filters and their smoothers know of a flight, in plain terms.
namespace sigmax::support {

/// A scan of any number of axes.
struct Row {
  double dt;
  std::optional<Gaussian<Eigen::Dynamic, 3>> z;
};
inline std::vector<Row> rows_of(const std::vector<Scan>& scans) {
  std::vector<Row> rows;
  for (const Scan& scan : scans) {
    rows.push_back({scan.dt, std::nullopt});
    if (scan.z) rows.back().z = Gaussian<Eigen::Dynamic, 3>{scan.z->mean, scan.z->covariance};
  }
  return rows;
}

/// What is known of one time, at that time or at the end.
struct Moment {
  Estimates estimates;
  std::vector<double> logs;
  std::size_t winner = 0;
  State output;
};

/// Of the start and of every row; and what was recorded, in the restatement's terms.
struct Flight {
  std::vector<Moment> filtered, smoothed;
  std::vector<restatement::smoothing::Step> steps;
};

/// Seen by a position, or by another sensor.
template <class Filter, class... Sensor>
Flight flown(Filter& filter, const std::vector<Row>& rows, const Sensor&... sensor) {
  std::vector record{filter.recorded(0.0)};
  for (const Row& row : rows) {
    row.z ? filter.step(row.dt, {row.z->mean, row.z->covariance}, sensor...) : filter.step(row.dt);
    record.push_back(row.z ? filter.recorded(row.dt, {row.z->mean, row.z->covariance}, sensor...)
                           : filter.recorded(row.dt));
  }
  Flight flight;
  const auto moment = [&](const auto& state) {
    const auto logs = state.belief.logs();
    return Moment{state.estimates, {logs.begin(), logs.end()}, state.most_likely_mode, filter.estimate(state)};
  };
  for (std::size_t k = 0; k < record.size(); ++k) {
    flight.filtered.push_back(moment(record[k].state));
    const Moment& now = flight.filtered.back();
    flight.steps.push_back({record[k].dt, restate(now.estimates), now.logs, std::nullopt});
    if (k > 0 && rows[k - 1].z) flight.steps[k].seen = {entries(rows[k - 1].z->mean), dense(rows[k - 1].z->covariance)};
  }
  for (const auto& state : smooth(filter, record)) flight.smoothed.push_back(moment(state));
  return flight;
}
inline Flight flown(const TargetChoice& choice, const Estimates& start, const std::vector<Row>& rows) {
  AnyFilter filter(choice, start);
  Flight flight;
  filter.do_with([&](auto& one) { flight = flown(one, rows); });
  return flight;
}

}  // namespace sigmax::support
