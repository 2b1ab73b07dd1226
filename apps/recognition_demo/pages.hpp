#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <sigmax/recognition/evaluation.hpp>

#include "recognition_demo/contest.hpp"
#include "recognition_demo/learned_model.hpp"
#include "support/report.hpp"

namespace sigmax::apps {

/// A page begun: title, command, and the contestants as what is switched on and off.
Report page_of_contest(std::string title, const OutputOptions& output, const std::vector<Contestant>& contestants);

/// Shares of right decisions over the reports, one curve a contestant.
LineChart accuracy_chart(const std::vector<Score>& scores, const std::string& what_is_counted = "reports");

/// Probability or possibility of each pattern over the reports of one run, a chart for each pattern.
View support_view(std::string name, const std::vector<std::string>& patterns,
                  const std::vector<Contestant>& contestants, std::size_t truth, const std::vector<Readings>& reports);

/// Rows of the data by true and decided class.
HeatMap confusion_map(const std::string& classifier, const std::vector<std::string>& classes,
                      const ConfusionMatrix& confusion, std::size_t foldings);

/// What was learned of some features: p(value|class), and the possibility that it is turned into; the most telling
/// features first.
std::vector<Panel> relation_maps(const LearnedModel& model, std::size_t most);

}  // namespace sigmax::apps
