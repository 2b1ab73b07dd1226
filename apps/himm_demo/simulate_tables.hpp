#pragma once

#include "himm_demo/simulate_report.hpp"
#include "support/result_table.hpp"

namespace sigmax::apps {

/// Which figures of the filters a table shows.
enum class Figures {
  rmse,        ///< by phase and axis
  nees,        ///< by phase
  cross_time,  ///< of the mode
  overview,    ///< a few, for many filters
  all          ///< of all runs, for files
};

/// A row for the measurement, where it has such figures, and for each filter.
ResultTable figures(const SimulateReport& report, Figures which);

/// A row for each phase: the difference by axis, and what the paper claims of it.
ResultTable differences(const SimulateReport& report, const Comparison& comparison);

}  // namespace sigmax::apps
