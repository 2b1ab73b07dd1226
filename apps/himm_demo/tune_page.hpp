#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "himm_demo/tune_diagnosis.hpp"
#include "himm_demo/tune_fit.hpp"
#include "result/report.hpp"

namespace sigmax::apps {

/// What tuning found for one filter, and its innovations before and, if that is better, with the best settings.
struct TuneFindings {
  Diagnosis before;
  std::optional<Diagnosis> after;
  TunedFilter tuned;
};

/// Everything that was found as data.
nlohmann::ordered_json summary_of(const TuneOptions& options, const TuneData& data,
                                  const std::vector<TuneFindings>& all);

/// The same as a page, a view for each filter: innovations before and after with their bands, what is lost in each
/// fold, and the settings.
Report page_of(const std::string& heading, const TuneOptions& options, const TuneData& data,
               const std::vector<TuneFindings>& all);

}  // namespace sigmax::apps
