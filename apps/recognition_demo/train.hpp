#pragma once

#include <string>
#include <vector>

#include "recognition_demo/data_table.hpp"
#include "recognition_demo/learned_model.hpp"

namespace sigmax::apps {

/// The options of `recognition_demo train`.
struct TrainOptions {
  std::string file;
  DataOptions data;
  LearningOptions learning;
  std::vector<std::string> kinds;  ///< of `kind_names`
  std::string model;               ///< the file to write
};

/// Learns a model from all rows of a file and writes it.
void train_and_report(const TrainOptions& options);

/// "101 rows, 7 classes, 16 features (15 categorical, 1 numeric)".
std::string described(const DataTable& data);

/// "Laplace's rule; the share of the rows as prior", and what else was chosen.
std::string described(const LearningOptions& options);

}  // namespace sigmax::apps
