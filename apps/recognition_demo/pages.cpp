#include "recognition_demo/pages.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include <sigmax/core/transform.hpp>
#include <sigmax/recognition/counts.hpp>

namespace sigmax::apps {
namespace {

constexpr std::size_t most_values = 30;  // of a feature, and classes, in a heat map

/// How far the classes differ about a feature: mean distance of two classes' distributions.
double telling(const Relation<Random, Random>& relation) {
  const std::size_t classes = relation.from().size();
  double distance = 0.0;
  for (std::size_t a = 0; a < classes; ++a)
    for (std::size_t b = 0; b < a; ++b)
      for (std::size_t value = 0; value < relation.to().size(); ++value)
        distance += std::abs(relation(a, value) - relation(b, value));
  return classes < 2 ? 0.0 : distance / static_cast<double>(classes * (classes - 1));
}

template <class Variable>
std::vector<std::string> labels_of(const Variable& variable) {
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < variable.size(); ++i) labels.push_back(variable.label(i));
  return labels;
}

HeatMap relation_map(const Relation<Random, Random>& relation) {
  const auto possible = to_possibility(relation, RatioScale{});
  HeatMap map{.title = "What was learned of " + relation.to().name(),
              .row_label = relation.from().name(),
              .column_label = relation.to().name(),
              .rows = labels_of(relation.from()),
              .columns = labels_of(relation.to()),
              .values = {},
              .value_label = "probability of the value, given the class"};
  for (std::size_t c = 0; c < map.rows.size(); ++c) {
    auto& values = map.values.emplace_back();
    auto& texts = map.texts.emplace_back();
    for (std::size_t value = 0; value < map.columns.size(); ++value) {
      values.push_back(relation(c, value));
      texts.push_back(fmt::format("possibility {} on the ratio scale", sized_text(possible(c, value), 2)));
    }
  }
  return map;
}

}  // namespace

Report page_of_contest(std::string title, const OutputOptions& output, const std::vector<Contestant>& contestants) {
  Report page{.title = std::move(title), .command = output.command};
  for (const Contestant& contestant : contestants) page.groups.push_back({.name = contestant.name});
  return page;
}

LineChart accuracy_chart(const std::vector<Score>& scores, const std::string& what_is_counted) {
  LineChart chart{.title = "Right decisions",
                  .x_label = what_is_counted,
                  .y_label = "share of the runs that are right; ties share the credit",
                  .x = std::vector<double>(scores.front().accuracy.size()),
                  .curves = {}};
  std::iota(chart.x.begin(), chart.x.end(), 1.0);
  for (const Score& score : scores) chart.curves.push_back({score.name, score.name, score.accuracy});
  return chart;
}

View support_view(std::string name, const std::vector<std::string>& patterns,
                  const std::vector<Contestant>& contestants, std::size_t truth, const std::vector<Readings>& reports) {
  View view{std::move(name), {}};
  for (std::size_t pattern = 0; pattern < patterns.size(); ++pattern) {
    LineChart chart{.title = patterns[pattern] + (pattern == truth ? ", the truth" : ""),
                    .x_label = "reports",
                    .y_label = "probability or possibility",
                    .x = std::vector<double>(reports.size()),
                    .curves = {},
                    .greatest_y = 1.05};
    std::iota(chart.x.begin(), chart.x.end(), 1.0);
    for (const Contestant& contestant : contestants) chart.curves.push_back({contestant.name, contestant.name, {}});
    view.panels.emplace_back(std::move(chart));
  }
  for (std::size_t count = 1; count <= reports.size(); ++count) {
    const std::vector<Readings> so_far(reports.begin(), reports.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t i = 0; i < contestants.size(); ++i) {
      const Trace trace = follow(contestants[i], truth, so_far);
      for (std::size_t pattern = 0; pattern < patterns.size(); ++pattern)
        std::get<LineChart>(view.panels[pattern]).curves[i].values.push_back(trace.belief[pattern]);
    }
  }
  return view;
}

HeatMap confusion_map(const std::string& classifier, const std::vector<std::string>& classes,
                      const ConfusionMatrix& confusion, std::size_t foldings) {
  HeatMap map{.title = classifier,
              .row_label = "true class",
              .column_label = "decided class",
              .rows = classes,
              .columns = classes,
              .values = {},
              .value_label = foldings == 1 ? "rows" : "rows, mean of the foldings",
              .digits = foldings == 1 ? 0 : 1};
  for (std::size_t truth = 0; truth < classes.size(); ++truth) {
    auto& row = map.values.emplace_back();
    for (std::size_t c = 0; c < classes.size(); ++c) row.push_back(confusion(truth, c) / static_cast<double>(foldings));
  }
  return map;
}

std::vector<Panel> relation_maps(const LearnedModel& model, std::size_t most) {
  std::vector<std::pair<double, Relation<Random, Random>>> all;
  for (std::size_t i = 0; i < model.features.size(); ++i) {
    auto relation = learned_relation(model.counts, i, model.options.smoothing);
    if (std::max(relation.to().size(), relation.from().size()) > most_values) continue;
    const double how = telling(relation);
    all.emplace_back(how, std::move(relation));
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Panel> maps;
  for (std::size_t i = 0; i < std::min(most, all.size()); ++i) maps.emplace_back(relation_map(all[i].second));
  return maps;
}

}  // namespace sigmax::apps
