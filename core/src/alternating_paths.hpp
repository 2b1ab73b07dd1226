#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include <sigmax/core/choices.hpp>
#include <sigmax/core/tie.hpp>

namespace sigmax::detail {

/// The assignment of least cost, by successive shortest paths (Jonker and Volgenant, Computing 38, 1987), and its
/// alternating paths. It grows row by row, with potentials that prove it to be optimal.
///
/// A node is a row that is to leave what it has, or `outside`, where free columns are and rows without one. A path goes
/// from a row to whoever has the column that the row takes; from outside to a row whose column stays free. Lengths are
/// reduced costs, none of which is negative: cost − potential of the row − potential of the column.
class AlternatingPaths {
 public:
  /// Makes all rows choose, at least total cost; of those that tie the first. `costs` must outlive this. Returns the
  /// row that finds nothing, or `no_column`.
  std::size_t assign(const Choices& costs) {
    costs_ = &costs;
    fixed_ = 0;
    choice_.assign(costs.rows(), undecided);
    owner_.assign(costs.columns(), no_column);
    row_potential_.assign(costs.rows(), 0.0);
    column_potential_.assign(costs.columns(), 0.0);
    distance_.assign(costs.rows() + 1, infinity);
    step_.resize(costs.rows() + 1);
    for (std::size_t row = 0; row < costs.rows(); ++row)
      if (!add(row)) return row;
    for (; fixed_ < costs.rows(); ++fixed_) prefer_first(fixed_);
    fixed_ = 0;
    return no_column;
  }

  std::size_t choice(std::size_t row) const { return choice_[row]; }
  double cost(std::size_t row) const {
    if (choice_[row] == no_column) return costs_->none(row);
    const auto entries = costs_->entries(row);
    return entries.value(AnyEntries(entries).place_of(choice_[row]));
  }

  /// What is lost if a column stays free.
  double price(std::size_t column) const { return -column_potential_[column]; }

  /// The node that loses something if a row takes this column, or none.
  std::size_t loser(std::size_t column) const {
    return column == no_column || owner_[column] == no_column ? outside() : owner_[column];
  }
  std::size_t outside() const { return choice_.size(); }

  /// How much more than its potential a choice costs.
  double reduced(std::size_t row, std::size_t column, double cost) const {
    const double length = cost - row_potential_[row] - (column == no_column ? 0.0 : column_potential_[column]);
    return length > 0.0 ? length : 0.0;
  }

  /// Shortest paths from a node to all others; `distance` tells how long they are.
  void search_all(std::size_t from) { search(from, no_column, infinity); }
  double distance(std::size_t node) const { return distance_[node]; }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr std::size_t undecided = no_column - 1;

  struct Step {
    std::size_t node, column;  // who goes this way, and what it takes
  };

  /// Returns `to` if it was reached. Before all rows have chosen, paths end outside.
  std::size_t search(std::size_t from, std::size_t to, double limit) {
    for (const std::size_t node : reached_) distance_[node] = infinity;
    reached_.clear();
    heap_.clear();
    relax(from, 0.0, {no_column, no_column});
    while (!heap_.empty()) {
      std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
      const double distance = heap_.back().first;
      const std::size_t node = heap_.back().second;
      heap_.pop_back();
      if (node == to) return to;
      if (distance > distance_[node]) continue;
      const auto go = [&](std::size_t next, double length, std::size_t column) {
        if (distance + length <= limit) relax(next, distance + length, {node, column});
      };
      if (node == outside()) {
        for (std::size_t row = fixed_; row < choice_.size(); ++row)
          go(row, choice_[row] == no_column ? 0.0 : -column_potential_[choice_[row]], no_column);
        continue;
      }
      const auto entries = costs_->entries(node);
      for (std::size_t k = 0; k < entries.size(); ++k)
        if (const std::size_t column = entries.index(k); column != choice_[node])
          go(loser(column), reduced(node, column, entries.value(k)), column);
      if (choice_[node] != no_column) go(outside(), reduced(node, no_column, costs_->none(node)), no_column);
    }
    return no_column;
  }

  void relax(std::size_t node, double distance, Step step) {
    if (node < fixed_ || distance >= distance_[node]) return;
    if (distance_[node] == infinity) reached_.push_back(node);
    distance_[node] = distance;
    step_[node] = step;
    heap_.emplace_back(distance, node);
    std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
  }

  /// A row more takes what is cheapest for all, and the potentials say why.
  bool add(std::size_t row) {
    double& potential = row_potential_[row];
    potential = costs_->none(row);
    const auto entries = costs_->entries(row);
    for (std::size_t k = 0; k < entries.size(); ++k)
      potential = std::min(potential, entries.value(k) - column_potential_[entries.index(k)]);
    if (potential == infinity || search(row, outside(), infinity) == no_column) return false;
    const double length = distance_[outside()];
    for (const std::size_t node : reached_) {
      if (node == outside() || distance_[node] >= length) continue;
      row_potential_[node] += length - distance_[node];
      if (node != row) column_potential_[choice_[node]] -= length - distance_[node];
    }
    shift(row, outside());
    return true;
  }

  /// Gives a row the first column by which nothing is lost, while the rows before it keep theirs.
  void prefer_first(std::size_t row) {
    const auto entries = costs_->entries(row);
    for (std::size_t k = 0; k < entries.size() && entries.index(k) < choice_[row]; ++k) {
      const std::size_t column = entries.index(k), first = loser(column);
      const double length = reduced(row, column, entries.value(k));
      if (length > tie_tolerance || first < fixed_) continue;
      if (search(first, row, tie_tolerance - length) == no_column) continue;
      shift(first, row);
      take(row, column);
      return;
    }
  }

  void take(std::size_t row, std::size_t column) {
    if (const std::size_t before = choice_[row]; before < undecided && owner_[before] == row)
      owner_[before] = no_column;
    choice_[row] = column;
    if (column != no_column) owner_[column] = row;
  }

  /// Moves along the path that was found, from its end: everybody finds free what it takes.
  void shift(std::size_t from, std::size_t to) {
    for (std::size_t node = to; node != from; node = step_[node].node)
      if (step_[node].node != outside()) take(step_[node].node, step_[node].column);
  }

  const Choices* costs_ = nullptr;
  std::size_t fixed_ = 0;  // rows before this one keep what they have
  std::vector<std::size_t> choice_, owner_;
  std::vector<double> row_potential_, column_potential_, distance_;
  std::vector<Step> step_;
  std::vector<std::size_t> reached_;
  std::vector<std::pair<double, std::size_t>> heap_;
};

}  // namespace sigmax::detail
