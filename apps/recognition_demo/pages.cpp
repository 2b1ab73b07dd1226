#include "recognition_demo/pages.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include <sigmax/core/transform.hpp>
#include <sigmax/core/witness.hpp>

namespace sigmax::apps {
namespace {

constexpr std::size_t most_values = 30;  // of a feature, and classes, in a heat map

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

std::vector<double> counted_from(std::size_t first, std::size_t count) {
  std::vector<double> numbers(count);
  std::iota(numbers.begin(), numbers.end(), static_cast<double>(first));
  return numbers;
}

LineChart accuracy_chart(const std::vector<Score>& scores, const std::string& what_is_counted, std::size_t first) {
  LineChart chart{.title = "Right decisions",
                  .x_label = what_is_counted,
                  .y_label = "share of the runs that are right; ties share the credit",
                  .x = counted_from(first, scores.front().accuracy.size()),
                  .curves = {}};
  for (const Score& score : scores) chart.curves.push_back({score.name, score.name, score.accuracy});
  return chart;
}

std::vector<Panel> support_charts(const std::vector<std::string>& patterns, const std::vector<Contestant>& contestants,
                                  const std::vector<Beliefs>& beliefs, const std::vector<double>& x,
                                  const std::string& x_label, std::optional<std::size_t> truth) {
  std::vector<Panel> charts;
  for (std::size_t pattern = 0; pattern < patterns.size(); ++pattern) {
    LineChart chart{.title = patterns[pattern] + (pattern == truth ? ", the truth" : ""),
                    .x_label = x_label,
                    .y_label = "probability or possibility",
                    .x = x,
                    .curves = {},
                    .greatest_y = 1.05};
    for (std::size_t i = 0; i < contestants.size(); ++i) {
      chart.curves.push_back({contestants[i].name, contestants[i].name, {}});
      for (const auto& belief : beliefs[i]) chart.curves.back().values.push_back(belief[pattern]);
    }
    charts.emplace_back(std::move(chart));
  }
  return charts;
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

LineChart reliability_chart(const std::string& classifier, const Reliability& reliability, bool fuzzy,
                            std::size_t foldings) {
  LineChart chart{.title = "Reliability of " + classifier,
                  .x_label = fuzzy ? "possibility of a class" : "probability of a class",
                  .y_label = "share of such classes that are the true one",
                  .x = {},
                  .curves = {{.name = "share, ± 95 %", .values = {}},
                             {.name = fuzzy ? "bound: not more often than possible" : "calibrated", .values = {}}},
                  .greatest_y = 1.15,
                  .note = "Above each point: how many classes of rows had such a degree.",
                  .joined = true};
  Curve& share = chart.curves[0];
  const auto add = [&](double degree, double value, double lower, double upper, std::string remark) {
    chart.x.push_back(degree);
    chart.curves[1].values.push_back(degree);
    share.values.push_back(value);
    share.lower.push_back(lower);
    share.upper.push_back(upper);
    chart.remarks.push_back(std::move(remark));
  };
  const double nan = std::nan("");
  add(0.0, nan, nan, nan, "");
  for (const auto& bin : reliability.bins(static_cast<double>(foldings)))
    add(bin.mean_degree, bin.share, bin.lower, bin.upper, fmt::format("{:.{}f}", bin.count, foldings == 1 ? 0 : 1));
  add(1.0, nan, nan, nan, "");
  return chart;
}

double telling(const Relation<Random, Random>& relation) {
  const std::size_t patterns = relation.from().size();
  double distance = 0.0;
  for (std::size_t a = 0; a < patterns; ++a)
    for (std::size_t b = 0; b < a; ++b)
      for (std::size_t value = 0; value < relation.to().size(); ++value)
        distance += std::abs(relation(a, value) - relation(b, value));
  return patterns < 2 ? 0.0 : distance / static_cast<double>(patterns * (patterns - 1));
}

std::vector<Panel> relation_maps(const std::vector<Relation<Random, Random>>& learned, std::size_t most) {
  std::vector<std::pair<double, const Relation<Random, Random>*>> all;
  for (const auto& relation : learned)
    if (std::max(relation.to().size(), relation.from().size()) <= most_values)
      all.emplace_back(telling(relation), &relation);
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Panel> maps;
  for (std::size_t i = 0; i < std::min(most, all.size()); ++i) maps.emplace_back(relation_map(*all[i].second));
  return maps;
}

HeatMap witness_map(const Relation<Fuzzy, Fuzzy>& reading_given_feature,
                    const Relation<Fuzzy, Fuzzy>& feature_given_pattern) {
  const auto witnessed = compose_with_witness(reading_given_feature, feature_given_pattern);
  const auto& relation = witnessed.relation();
  HeatMap map{.title = fmt::format("What may be read of each {}", relation.from().name()),
              .row_label = relation.from().name(),
              .column_label = relation.to().name(),
              .rows = labels_of(relation.from()),
              .columns = labels_of(relation.to()),
              .values = {},
              .value_label = "possibility by max inference"};
  for (std::size_t c = 0; c < map.rows.size(); ++c) {
    auto& values = map.values.emplace_back();
    auto& texts = map.texts.emplace_back();
    for (std::size_t value = 0; value < map.columns.size(); ++value) {
      values.push_back(relation(c, value));
      texts.push_back(relation(c, value) > 0.0
                          ? fmt::format("through {}", feature_given_pattern.to().label(witnessed.winner(c, value)))
                          : "through nothing");
    }
  }
  return map;
}

}  // namespace sigmax::apps
