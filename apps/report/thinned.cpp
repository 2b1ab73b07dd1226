#include "report/thinned.hpp"

#include <cmath>

#include "shell/text.hpp"

namespace sigmax::apps {

Thinned::Thinned(std::size_t columns, std::size_t most, std::vector<std::size_t> watched)
    : columns_(columns), most_(most), watched_(std::move(watched)) {
  if (watched_.empty() || most < 4 * watched_.size()) throw std::invalid_argument("rows cannot be thinned to so few");
}

void Thinned::add(double time, const std::vector<double>& values) {
  if (values.size() != columns_) throw std::invalid_argument("a row of another number of columns");
  if (stretches_.empty() || in_last_ == length_) {
    stretches_.emplace_back();
    in_last_ = 0;
  }
  Stretch& last = stretches_.back();
  kept_ -= last.size();
  last.push_back({time, values});
  ++in_last_;
  ++taken_;
  if (last.size() > 4 * watched_.size()) keep_extremes(last);
  kept_ += last.size();
  while (kept_ > most_) halve();
}

void Thinned::limit(std::size_t most) {
  most_ = std::max(most, 4 * watched_.size());
  while (kept_ > most_) halve();
}

/// Makes one stretch of every two.
void Thinned::halve() {
  std::vector<Stretch> joined;
  if (stretches_.size() % 2 == 0) in_last_ += length_;
  kept_ = 0;
  for (std::size_t i = 0; i < stretches_.size(); i += 2) {
    Stretch rows = std::move(stretches_[i]);
    if (i + 1 < stretches_.size())
      rows.insert(rows.end(), std::make_move_iterator(stretches_[i + 1].begin()),
                  std::make_move_iterator(stretches_[i + 1].end()));
    keep_extremes(rows);
    kept_ += rows.size();
    joined.push_back(std::move(rows));
  }
  stretches_ = std::move(joined);
  length_ *= 2;
}

void Thinned::keep_extremes(Stretch& rows) const {
  std::vector<bool> extreme(rows.size(), false);
  if (!rows.empty()) extreme[0] = true;
  for (const std::size_t column : watched_) {
    std::size_t least = rows.size(), greatest = rows.size();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double value = rows[i].values[column];
      if (std::isnan(value)) continue;
      if (least == rows.size() || value < rows[least].values[column]) least = i;
      if (greatest == rows.size() || value > rows[greatest].values[column]) greatest = i;
    }
    if (least < rows.size()) extreme[least] = extreme[greatest] = true;
  }
  Stretch kept;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (extreme[i]) kept.push_back(std::move(rows[i]));
  rows = std::move(kept);
}

std::vector<double> Thinned::times() const {
  std::vector<double> times;
  for (const Stretch& rows : stretches_)
    for (const Row& row : rows) times.push_back(row.time);
  return times;
}

std::vector<double> Thinned::column(std::size_t i) const {
  std::vector<double> values;
  for (const Stretch& rows : stretches_)
    for (const Row& row : rows) values.push_back(row.values.at(i));
  return values;
}

}  // namespace sigmax::apps
