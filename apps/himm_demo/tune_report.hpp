#pragma once

#include <string>
#include <vector>

#include "himm_demo/tune_diagnosis.hpp"
#include "himm_demo/tune_fit.hpp"

namespace sigmax::apps {

/// What a filter's innovations say, as tables and sentences.
std::string text_of(const Diagnosis& diagnosis, std::size_t width);

/// The candidates with both figures, and what was chosen.
std::string text_of(const TunedFilter& tuned, Objective objective, std::size_t width);

/// "best", "simple", both, or neither.
std::string remark_of(const TunedFilter& tuned, std::size_t candidate);

/// A setting that differs; "–" where there is none.
struct Change {
  std::string key;
  std::string before, best, simple;
};
std::vector<Change> changes(const TunedFilter& tuned);

/// The settings that differ: before, best and simple.
std::string changes_of(const TunedFilter& tuned, std::size_t width);

}  // namespace sigmax::apps
