#include "recognition_demo/contest.hpp"

#include <sigmax/core/transform.hpp>

namespace sigmax::apps {

Result result_of_contest(std::string title, const OutputOptions& output, const std::vector<std::string>& contestants) {
  constexpr std::size_t widest_words = 120;  // longer lines are hard to read
  Result result(output);
  result.words_width = output.wide ? widest_words : terminal_width;
  result.page.title = std::move(title);
  for (const std::string& name : contestants) result.page.groups.push_back({.name = name});
  return result;
}

std::vector<Panel> relation_maps(const TableModel& model) {
  constexpr std::ptrdiff_t most = 6;
  // How far the patterns differ about a feature: the mean distance of two patterns' distributions.
  const auto telling = [](const Relation<Random, Random>& relation) {
    double distance = 0.0;
    for (std::size_t a = 0; a < relation.from().size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        for (std::size_t value = 0; value < relation.to().size(); ++value)
          distance += std::abs(relation(a, value) - relation(b, value));
    return distance;
  };
  auto all = learned_relations(model.counts, model.options.smoothing);
  std::erase_if(all, [](const auto& one) {
    constexpr std::size_t most_values = 30;  // of a feature, and classes
    return std::max(one.to().size(), one.from().size()) > most_values;
  });
  std::ranges::stable_sort(all, std::greater{}, telling);
  if (std::ssize(all) > most) all.erase(all.begin() + most, all.end());
  return each(all, [](const auto& relation) {
    HeatMap map{.title = "What was learned of " + relation.to().name(),
                .row_label = relation.from().name(),
                .column_label = relation.to().name(),
                .rows = labels_of(relation.from()),
                .columns = labels_of(relation.to()),
                .value_label = "probability of the value, given the class"};
    const auto possible = to_possibility(relation, RatioScale{});
    map.fill([&](std::size_t c, std::size_t value) {
      return HeatMap::Cell{relation(c, value),
                           fmt::format("possibility {} on the ratio scale", sized_text(possible(c, value), 2))};
    });
    return Panel(std::move(map));
  });
}

}  // namespace sigmax::apps
