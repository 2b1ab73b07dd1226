#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <sigmax/core/relation.hpp>
#include <sigmax/recognition/evaluation.hpp>
#include <sigmax/recognition/reliability.hpp>

#include "recognition_demo/contest.hpp"
#include "recognition_demo/learned_model.hpp"
#include "result/report.hpp"

namespace sigmax::apps {

template <class Variable>
std::vector<std::string> labels_of(const Variable& variable) {
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < variable.size(); ++i) labels.push_back(variable.label(i));
  return labels;
}

/// Shares of right decisions over the reports, one curve a contestant, from the report with number `first` on.
LineChart accuracy_chart(const std::vector<Score>& scores, const std::string& what_is_counted = "reports",
                         std::size_t first = 1);

/// first, first + 1, …: so many numbers.
std::vector<double> counted_from(std::size_t first, std::size_t count);

/// Probability or possibility of each pattern over reports at `x`, a chart for each pattern, from the beliefs of each
/// contestant.
std::vector<Panel> support_charts(const std::vector<std::string>& patterns, const std::vector<Contestant>& contestants,
                                  const std::vector<Beliefs>& beliefs, const std::vector<double>& x,
                                  const std::string& x_label, std::optional<std::size_t> truth = std::nullopt);

/// Rows of the data by true and decided class.
HeatMap confusion_map(const std::string& classifier, const std::vector<std::string>& classes,
                      const ConfusionMatrix& confusion, std::size_t foldings);

/// What was believed of the classes of rows against how often that was true. The diagonal is calibration, or the bound
/// that possibilities are.
LineChart reliability_chart(const std::string& classifier, const Reliability& reliability, bool fuzzy,
                            std::size_t foldings);

/// What was learned of features: p(value|class), and the possibility that it is turned into. Of many values none are
/// shown; the most telling features come first, and no more than `most`.
std::vector<Panel> relation_maps(const std::vector<Relation<Random, Random>>& learned, std::size_t most);

/// How far the patterns differ about a feature: the mean distance of two patterns' distributions.
double telling(const Relation<Random, Random>& relation);

/// π(reading|pattern) through the feature, and the value of the feature through which it is most possible.
HeatMap witness_map(const Relation<Fuzzy, Fuzzy>& reading_given_feature,
                    const Relation<Fuzzy, Fuzzy>& feature_given_pattern);

}  // namespace sigmax::apps
