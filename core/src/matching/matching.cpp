#include <sigmax/core/matching.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include <boost/pending/disjoint_sets.hpp>

#include <sigmax/core/belief.hpp>
#include <sigmax/core/logarithm.hpp>
#include <sigmax/core/tie.hpp>

#include "approximate.hpp"

namespace sigmax::detail {

namespace {

/// Throws std::invalid_argument for NaN and +∞.
void check_weights(const Choices& log_weights) {
  for (std::size_t row = 0; row < log_weights.rows(); ++row) {
    const auto entries = log_weights.entries(row);
    for (std::size_t k = 0; k <= entries.size(); ++k) {
      const double value = k < entries.size() ? entries.value(k) : log_weights.none(row);
      if (value < -log_zero) continue;
      const std::string column = k < entries.size() ? "column " + std::to_string(entries.index(k)) : "no column";
      throw std::invalid_argument("the log weight of row " + std::to_string(row) + " and " + column + " is " +
                                  std::to_string(value) + "; expected a finite number or -inf");
    }
  }
}

/// Works cluster by cluster: rows that share columns, directly or by others.
class Matcher {
 public:
  Matcher(const Choices& weights, const AnyAlgebra& pattern, const AnyAlgebra& permutation,
          const MatchingOptions& options)
      : weights_(weights), pattern_(pattern), permutation_(permutation), options_(options), local_(weights.columns()) {
    const std::size_t rows = weights.rows();
    result_ = {0.0, weights, std::vector<std::size_t>(rows), std::vector<std::size_t>(rows, no_column), 0.0, true};
  }

  Matching run() {
    const std::size_t rows = weights_.rows();
    boost::disjoint_sets_with_storage<> sets(rows + weights_.columns());
    for (std::size_t row = 0; row < rows; ++row) {
      const auto entries = weights_.entries(row);
      for (std::size_t k = 0; k < entries.size(); ++k)
        if (entries.value(k) > log_zero) sets.union_set(rows + entries.index(k), row);
    }
    std::vector<std::pair<std::size_t, std::size_t>> by_cluster(rows);
    for (std::size_t row = 0; row < rows; ++row) by_cluster[row] = {sets.find_set(row), row};
    std::sort(by_cluster.begin(), by_cluster.end());
    for (std::size_t first = 0, end = 0; first < rows; first = end) {
      rows_.clear();
      for (; end < rows && by_cluster[end].first == by_cluster[first].first; ++end)
        rows_.push_back(by_cluster[end].second);
      take_cluster();
      find_best();
      find_marginals();
    }
    if (!with_marginals()) {
      result_.marginals.clear();
      result_.winners = result_.best;
    }
    std::sort(logs_.begin(), logs_.end());  // so that no sum depends on the order of rows
    result_.log_best = std::accumulate(logs_.begin(), logs_.end(), 0.0);
    std::sort(log_ratios_.begin(), log_ratios_.end());
    result_.log_total = result_.log_best + std::accumulate(log_ratios_.begin(), log_ratios_.end(), 0.0);
    return std::move(result_);
  }

 private:
  bool is_maximum() const { return pattern_.name == AnyAlgebra::max && permutation_.name == AnyAlgebra::max; }
  bool with_marginals() const { return options_.marginals || !is_maximum(); }

  /// The costs of the cluster's possible choices, with columns numbered anew.
  void take_cluster() {
    columns_.clear();
    costs_.clear();
    for (const std::size_t row : rows_)
      for (std::size_t k = 0; k < weights_.entries(row).size(); ++k)
        if (weights_.entries(row).value(k) > log_zero) columns_.push_back(weights_.entries(row).index(k));
    std::sort(columns_.begin(), columns_.end());
    columns_.erase(std::unique(columns_.begin(), columns_.end()), columns_.end());
    for (std::size_t c = 0; c < columns_.size(); ++c) local_[columns_[c]] = c;
    for (const std::size_t row : rows_) {
      costs_.add_row(-weights_.none(row));
      const auto entries = weights_.entries(row);
      for (std::size_t k = 0; k < entries.size(); ++k)
        if (entries.value(k) > log_zero) costs_.add(local_[entries.index(k)], -entries.value(k));
    }
  }

  void find_best() {
    if (const std::size_t failed = paths_.assign(costs_); failed != no_column)
      throw std::domain_error("row " + std::to_string(rows_[failed]) +
                              " finds no column that earlier rows can leave to it, and may not be without one");
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      logs_.push_back(-paths_.cost(row));
      const std::size_t column = paths_.choice(row);
      result_.best[rows_[row]] = column == no_column ? no_column : columns_[column];
    }
  }

  /// Of one row each choice is an event.
  EventTotals of_one_row() const {
    EventTotals result{0.0, {}};
    for (const double cost : costs_.entries(0).values) result.log_marginals.push_back(paths_.cost(0) - cost);
    result.log_marginals.push_back(paths_.cost(0) - costs_.none(0));
    result.log_total = normalize_logs(result.log_marginals, pattern_);
    return result;
  }

  EventTotals totals() {
    if (rows_.size() == 1) return of_one_row();
    const bool is_tree = rows_.size() + columns_.size() == costs_.size() + 1;  // then each pattern has one event
    const bool differ = &pattern_ != &permutation_ && !is_tree;
    if (is_maximum()) return maximize(costs_, paths_);
    if (differ && eliminates(true)) return eliminate(chain_, costs_, paths_, pattern_, permutation_);
    result_.exact = result_.exact && !differ;
    if (pattern_.name == AnyAlgebra::max) return maximize(costs_, paths_);
    if (eliminates(false)) return eliminate(chain_, costs_, paths_, pattern_, pattern_);
    result_.exact = false;
    return pass_messages(costs_, paths_, pattern_);
  }

  bool eliminates(bool keep_patterns) { return chain_.build(costs_, keep_patterns, options_.max_states); }

  void find_marginals() {
    if (!with_marginals()) return;
    const EventTotals found = totals();
    log_ratios_.push_back(found.log_total);
    for (std::size_t row = 0, entry = 0; row < rows_.size(); ++row) {
      const auto entries = weights_.entries(rows_[row]);
      const auto values = result_.marginals.values(rows_[row]);
      const double none = result_.marginals.none(rows_[row]) = found.log_marginals[costs_.size() + row];
      double greatest = none;
      for (std::size_t k = 0; k < entries.size(); ++k) {
        values[k] = entries.value(k) > log_zero ? found.log_marginals[entry++] : log_zero;
        greatest = std::max(greatest, values[k]);
      }
      std::size_t& winner = result_.winners[rows_[row]] = no_column;
      const std::size_t best = result_.best[rows_[row]];
      for (std::size_t k = 0; k < entries.size(); ++k)
        if (ties(values[k], greatest) && (winner == no_column || entries.index(k) == best)) winner = entries.index(k);
      if (best == no_column && ties(none, greatest)) winner = best;
    }
  }

  const Choices& weights_;
  const AnyAlgebra &pattern_, &permutation_;
  const MatchingOptions& options_;
  Matching result_;
  std::vector<std::size_t> local_, columns_, rows_;  // a column's number in the cluster, and back; the cluster's rows
  std::vector<double> logs_, log_ratios_;            // of each row in the best event; of each cluster's total
  Choices costs_;
  AlternatingPaths paths_;
  EventChain chain_;
};

}  // namespace

Matching match(const Choices& log_weights, const AnyAlgebra& pattern, const AnyAlgebra& permutation,
               const MatchingOptions& options) {
  check_weights(log_weights);
  return Matcher(log_weights, pattern, permutation, options).run();
}

}  // namespace sigmax::detail
