#pragma once

#include <sigmax/recognition/counts.hpp>
#include <sigmax/recognition/discretization.hpp>

#include "recognition_demo/contest.hpp"
#include "recognition_demo/data_table.hpp"

namespace sigmax::apps {

/// How one column of data becomes readings: an index into its values, or into bins of its numbers.
struct FeatureCode {
  std::string name;
  std::vector<std::string> values{};     ///< of a categorical feature
  std::optional<Discretization> bins{};  ///< of a numeric one
  bool missing_is_value = false;         ///< the last one

  std::size_t size() const { return (bins ? bins->size() : values.size()) + (missing_is_value ? 1 : 0); }

  std::vector<std::string> labels() const {
    std::vector<std::string> all = bins ? bins->labels() : values;
    if (missing_is_value) all.emplace_back("missing");
    return all;
  }

  /// What is read of a number, or of an index into the values; of NaN what is read where a cell is missing.
  std::size_t reading(double value) const {
    if (std::isnan(value)) return missing_is_value ? size() - 1 : missing;
    return bins ? bins->bin(value) : static_cast<std::size_t>(value);
  }
};

/// Choices that turn counts into relations, the same for every classifier.
struct LearningOptions {
  std::size_t bins = 8;
  bool equal_width = false;  ///< bins of equal width, else of equal frequency
  double smoothing = 1.0;    ///< added to every count: 1 is Laplace's rule
  double misread = 0.0;      ///< probability that a reading is another than the feature's value, spread evenly
  bool equal_prior = false;  ///< nothing is known of the class, else its share of the rows
};

/// What was learned from labelled data: the counts, and how to read further data.
struct LearnedModel {
  std::string label;
  std::vector<std::string> missing;  ///< words that stand for nothing, beside the usual ones
  std::vector<FeatureCode> features;
  Counts counts;
  LearningOptions options;
  std::vector<double> right{};  ///< of each class the share of rows that sigma was right about, left out; or empty
};

/// Says whether a row is to be learned from; the same at every call.
using RowChoice = std::function<bool(std::size_t row)>;

/// Fits bins and counts on some rows of the data, or on all.
LearnedModel learn(
    const DataTable& data, const LearningOptions& options, const RowChoice& chosen = [](std::size_t) { return true; });

/// Learns of a headed CSV file that holds counts instead of rows: the label, feature, lower, upper, count, a row for
/// each bin. Throws InputError with file, line, column and value where bins leave a gap, and for a class or a feature
/// without counts.
LearnedModel learn_counts(const std::string& file, const DataOptions& data, const LearningOptions& options);

/// One row of the data as readings, into room that is used again.
void read(const LearnedModel& model, const DataTable& data, std::size_t row, Readings& readings);

/// The options of learning, and those of the data that are learned from.
void add_learning(Subcommand app, std::string& file, DataOptions& data, LearningOptions& learning);

/// "101 rows, 7 classes, 16 features (15 categorical, 1 numeric)".
std::string described(const DataTable& data);

/// "counts smoothed by Laplace's rule; prior by the classes' shares of the rows", and what else was chosen.
std::string described(const LearningOptions& options);

/// The kinds of classifiers: "sigma", "max", "sigma-max".
inline const std::vector<std::string> kind_names = {"sigma", "max", "sigma-max"};

/// The classifiers of the named kinds, in the order of `kind_names`; those with possibilities for the ratio scale and
/// for Dubois and Prade's transform. Sigma-max classifiers that are max classifiers are left out beside these: all
/// where nothing is misread, (17), and else that of the ratio scale, since the rows of the sensor have equal maxima.
std::vector<Contestant> classifiers(const LearnedModel& model, std::span<const std::string> kinds);

/// A model as a JSON file, which appears whole or not at all, and back. `read_model` throws InputError with the file
/// and the place for what is no model, is truncated or of another version, or contradicts itself.
void write_model(const LearnedModel& model, std::span<const std::string> kinds, const std::filesystem::path& path);
struct ModelFile {
  LearnedModel model;
  std::vector<std::string> kinds;
};
ModelFile read_model(const std::filesystem::path& path);

}  // namespace sigmax::apps
