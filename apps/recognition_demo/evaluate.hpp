#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "recognition_demo/data_table.hpp"
#include "recognition_demo/learned_model.hpp"

namespace sigmax::apps {

/// The options of `recognition_demo evaluate`.
struct EvaluateOptions {
  std::string file;
  DataOptions data;
  LearningOptions learning;
  std::size_t folds = 10;
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: as many as the machine has
  std::string out;
  bool quiet = false;
  std::string command;  ///< as typed, for the record
};

/// Cross-validation of every kind of classifier on the same folds.
void evaluate_and_report(const EvaluateOptions& options);

}  // namespace sigmax::apps
