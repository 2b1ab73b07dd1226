#pragma once

#include "recognition_demo/learned_model.hpp"

namespace sigmax::apps {

/// Reads the rows of a file in the code of a model, and keeps what there is to say of them.
class RowReader {
 public:
  /// The model must outlive the reader. What it does not know is missing, or else an InputError. Throws InputError for
  /// a column of the model that the file does not have.
  RowReader(const LearnedModel& model, const CsvReader& reader, bool unseen_is_missing);

  bool has_truth() const { return label_.has_value(); }

  Readings readings(const CsvRow& row);

  /// The class of a row, if it is given.
  std::optional<std::size_t> truth(const CsvRow& row);

  /// How many cells held what the model does not know.
  std::size_t unseen_cells() const { return unseen_cells_; }

  /// Says which cells count as missing, and of which columns the numbers seem to be in another unit than those that
  /// were learned: where one bin has 60 % more of them, of 20 or more. Returns
  /// whether there are such columns.
  bool say_otherwise(Result& result) const;

 private:
  struct Column {
    std::size_t index;
    std::vector<double> binned;  // numbers by bin
  };

  std::size_t reading(const CsvRow& row, std::size_t i);
  std::size_t unseen(const CsvRow& row, std::size_t column, const std::string& expected, const std::string& advice);
  std::size_t place(const CsvRow& row, std::size_t column, const std::vector<std::string>& names, const char* what);

  const LearnedModel& model_;
  MissingWords missing_;
  bool unseen_is_missing_;
  std::optional<std::size_t> label_;
  std::vector<std::string> classes_;
  std::vector<Column> columns_;
  std::size_t unseen_cells_ = 0;
  std::string first_unseen_;
};

}  // namespace sigmax::apps
