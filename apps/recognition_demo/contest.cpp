#include "recognition_demo/contest.hpp"

#include <sigmax/core/transform.hpp>
#include <sigmax/recognition/decision.hpp>

#include "table/csv.hpp"

namespace sigmax::apps {
namespace {

/// Calls see(belief in the patterns) after each report. What would exclude every pattern is passed over; returns how
/// many reports were.
template <class See>
std::size_t observe_all(const Contestant& contestant, const std::vector<Readings>& reports, const See& see) {
  std::size_t refused = 0;
  const auto observe = [&](const auto& classifier) {
    Belief belief{classifier.prior()};
    for (const Readings& report : reports) {
      try {
        classifier.observe(belief, report);
      } catch (const std::domain_error&) {
        ++refused;
      }
      if constexpr (std::is_same_v<decltype(belief), Belief<Random>>)
        if (const auto& patterns = contestant.pattern_given_state) {
          see(Belief<Random>{compose(*patterns, belief.distribution())});
          continue;
        }
      see(belief);
    }
  };
  std::visit(observe, contestant.classifier);
  return refused;
}

/// 1 if the greatest value is that of `truth` alone, 1/n if n values tie, else 0; ties as `decide` has them.
double credit_of(std::span<const double> logs, std::size_t truth) {
  const double greatest = *std::ranges::max_element(logs);
  if (!ties(logs[truth], greatest)) return 0.0;
  return 1.0 / static_cast<double>(std::ranges::count_if(logs, [=](double log) { return ties(log, greatest); }));
}

/// How far the patterns differ about a feature: the mean distance of two patterns' distributions.
double telling(const Relation<Random, Random>& relation) {
  const std::size_t patterns = relation.from().size();
  double distance = 0.0;
  for (std::size_t a = 0; a < patterns; ++a)
    for (std::size_t b = 0; b < a; ++b)
      for (std::size_t value = 0; value < relation.to().size(); ++value)
        distance += std::abs(relation(a, value) - relation(b, value));
  return patterns < 2 ? 0.0 : distance / static_cast<double>(patterns * (patterns - 1));
}

}  // namespace

std::vector<double> numbers_of(const AnyBelief& belief) {
  return std::visit(
      [](const auto& one) {
        const auto distribution = one.distribution();
        return std::vector<double>{distribution.values().begin(), distribution.values().end()};
      },
      belief);
}

Trace follow(const Contestant& contestant, std::size_t truth, const std::vector<Readings>& reports) {
  Trace trace;
  trace.refused = observe_all(contestant, reports, [&](const auto& belief) {
    trace.credit.push_back(credit_of(belief.logs(), truth));
    if (trace.credit.size() == reports.size()) trace.belief = numbers_of(belief);
  });
  return trace;
}

Beliefs beliefs_over(const Contestant& contestant, const std::vector<Readings>& reports) {
  Beliefs beliefs;
  observe_all(contestant, reports, [&](const auto& belief) { beliefs.push_back(numbers_of(belief)); });
  return beliefs;
}

Result result_of_contest(std::string title, const OutputOptions& output, const std::vector<Contestant>& contestants) {
  constexpr std::size_t widest_words = 120;  // longer lines are hard to read
  Result result(output);
  result.words_width = output.wide ? widest_words : terminal_width;
  result.page.title = std::move(title);
  for (const Contestant& contestant : contestants) result.page.groups.push_back({.name = contestant.name});
  return result;
}

std::vector<double> counted_from(std::size_t first, std::size_t count) {
  return each_below(count, [=](std::size_t i) { return static_cast<double>(first + i); });
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
                    .greatest_y = 1.05};
    for (std::size_t i = 0; i < contestants.size(); ++i)
      chart.curves.push_back({contestants[i].name, contestants[i].name,
                              each(beliefs[i], [&](const auto& belief) { return belief[pattern]; })});
    charts.emplace_back(std::move(chart));
  }
  return charts;
}

std::vector<Panel> relation_maps(const std::vector<Relation<Random, Random>>& learned, std::size_t most) {
  constexpr std::size_t most_values = 30;  // of a feature, and classes
  std::vector<std::pair<double, const Relation<Random, Random>*>> all;
  for (const auto& relation : learned)
    if (std::max(relation.to().size(), relation.from().size()) <= most_values)
      all.emplace_back(telling(relation), &relation);
  std::ranges::stable_sort(all, [](const auto& a, const auto& b) { return a.first > b.first; });
  all.resize(std::min(most, all.size()));
  return each(all, [](const auto& one) {
    const auto& relation = *one.second;
    const auto possible = to_possibility(relation, RatioScale{});
    return Panel(map_of(relation, "What was learned of " + relation.to().name(),
                        "probability of the value, given the class", [&](std::size_t c, std::size_t value) {
                          return fmt::format("possibility {} on the ratio scale", sized_text(possible(c, value), 2));
                        }));
  });
}

}  // namespace sigmax::apps
