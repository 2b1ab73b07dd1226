#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <sigmax/estimation/consistency.hpp>

#include "himm_demo/tune/fit.hpp"
#include "result/report.hpp"

namespace sigmax::apps {

/// What one filter's innovations say of its settings.
struct Diagnosis {
  struct Part {
    std::string name;
    InnovationTally innovations{};
    double weight = 0.0;  ///< mean, of a mode
  };
  std::vector<Part> sensors;
  std::vector<Part> modes;       ///< rows of which the mode is the most likely
  std::optional<double> rmse_m;  ///< where the truth is known
};

/// Follows every track with these settings. Throws InputError where the filter fails.
Diagnosis diagnose(const TuneData& data, const FilterSettings& settings, Objective objective);

/// What tuning found for one filter, and its innovations before and, if that is better, with the best settings.
struct TuneFindings {
  Diagnosis before;
  std::optional<Diagnosis> after;
  TunedFilter tuned;
};

/// What a filter's innovations say, as tables and sentences.
std::string text_of(const Diagnosis& diagnosis, std::size_t width);

/// The candidates with both figures, what was chosen, and the settings that differ.
std::string text_of(const TunedFilter& tuned, Objective objective, std::size_t width);

/// Everything that was found as data.
nlohmann::ordered_json summary_of(const TuneOptions& options, const TuneData& data,
                                  const std::vector<TuneFindings>& all);

/// The same as a page, a view for each filter: innovations before and after with their bands, what is lost in each
/// fold, and the settings.
Report page_of(const std::string& heading, const TuneOptions& options, const TuneData& data,
               const std::vector<TuneFindings>& all);

}  // namespace sigmax::apps
