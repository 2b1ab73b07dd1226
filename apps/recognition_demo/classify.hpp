#pragma once

#include <cstddef>
#include <string>

namespace sigmax::apps {

/// The options of `recognition_demo classify`.
struct ClassifyOptions {
  std::string model;
  std::string file;
  bool explain = false;
  std::size_t rows = 5;       ///< how many rows to show
  double least_margin = 0.0;  ///< decisions with a smaller margin are rejected
  std::string out;
  bool quiet = false;
  std::string command;  ///< as typed, for the record
};

/// Classifies the rows of a file by a model, one after the other, in memory that does not grow with the file.
void classify_and_report(const ClassifyOptions& options);

}  // namespace sigmax::apps
