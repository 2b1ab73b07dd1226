#include <sigmax/recognition/discretization.hpp>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

namespace sigmax {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The shortest text that reads back as the same number, so that different cuts never look alike.
std::string shown(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

/// The values that are there, in ascending order.
std::vector<double> sorted(std::span<const double> values, std::size_t bins) {
  if (bins == 0) throw std::invalid_argument("a discretization needs at least one bin");
  std::vector<double> result;
  for (const double value : values) {
    if (std::isinf(value)) throw std::invalid_argument("a discretization cannot be fitted to an infinite value");
    if (!std::isnan(value)) result.push_back(value);
  }
  if (result.empty()) throw std::invalid_argument("a discretization cannot be fitted: there is no value");
  std::sort(result.begin(), result.end());
  if (bins > 1 && result.front() == result.back())
    throw std::invalid_argument("a discretization cannot be fitted: every value is " + shown(result.front()));
  return result;
}

/// Where there are no more different values than bins, each has one.
Discretization one_each(const std::set<double>& different) {
  return Discretization{different.empty() ? std::vector<double>{}
                                          : std::vector(std::next(different.begin()), different.end())};
}

/// The values at ranks are cuts, unless that is the least, or a cut already; a value at two ranks, the end below
/// counted as one, fills a bin, which then ends at the next greater value.
bool fills_a_bin(double least, std::span<const double> at_ranks, std::size_t i) {
  return at_ranks[i] == (i == 0 ? least : at_ranks[i - 1]);
}

Discretization cut(double least, std::span<const double> at_ranks, const std::function<double(double)>& next_greater) {
  std::vector<double> cuts;
  for (std::size_t i = 0; i < at_ranks.size(); ++i) {
    const double cut = fills_a_bin(least, at_ranks, i) ? next_greater(at_ranks[i]) : at_ranks[i];
    if (cut > (cuts.empty() ? least : cuts.back()) && std::isfinite(cut)) cuts.push_back(cut);
  }
  return Discretization{std::move(cuts)};
}

constexpr std::size_t most_keys = 8192;  // in all ranges
constexpr int bits = 8;                  // by which a range is divided
constexpr std::uint64_t sign = std::uint64_t{1} << 63;

std::uint64_t key_of(double value) {
  const auto pattern = std::bit_cast<std::uint64_t>(value + 0.0);  // there is one zero
  return (pattern & sign) != 0 ? ~pattern : pattern | sign;
}

double value_of(std::uint64_t key) { return std::bit_cast<double>((key & sign) != 0 ? key & ~sign : ~key); }

}  // namespace

Discretization::Discretization(std::vector<double> cuts) : cuts_(std::move(cuts)) {
  for (std::size_t i = 0; i < cuts_.size(); ++i) {
    if (!std::isfinite(cuts_[i])) throw std::invalid_argument("a cut is a finite number, not " + shown(cuts_[i]));
    if (i > 0 && !(cuts_[i - 1] < cuts_[i]))
      throw std::invalid_argument("cuts ascend strictly, but " + shown(cuts_[i]) + " follows " + shown(cuts_[i - 1]));
  }
}

std::size_t Discretization::bin(double value) const {
  if (std::isnan(value)) return missing;
  return static_cast<std::size_t>(std::upper_bound(cuts_.begin(), cuts_.end(), value) - cuts_.begin());
}

double Discretization::lower(std::size_t bin) const {
  if (bin >= size())
    throw std::invalid_argument("there are " + std::to_string(size()) + " bins, no number " + std::to_string(bin));
  return bin == 0 ? -infinity : cuts_[bin - 1];
}

double Discretization::upper(std::size_t bin) const {
  if (bin + 1 < size()) return cuts_[bin];
  lower(bin);  // throws if there is no such bin
  return infinity;
}

std::vector<std::string> Discretization::labels() const {
  if (cuts_.empty()) return {"any"};
  std::vector<std::string> result{"below " + shown(cuts_.front())};
  for (std::size_t i = 1; i < cuts_.size(); ++i) result.push_back(shown(cuts_[i - 1]) + " to " + shown(cuts_[i]));
  result.push_back(shown(cuts_.back()) + " and above");
  return result;
}

Discretization equal_width(std::span<const double> values, std::size_t bins) {
  const std::vector<double> ascending = sorted(values, bins);
  const double low = ascending.front(), high = ascending.back();
  std::vector<double> cuts;
  for (std::size_t j = 1; j < bins; ++j) {
    const double share = static_cast<double>(j) / static_cast<double>(bins);
    cuts.push_back(low * (1.0 - share) + high * share);  // so that no difference overflows
  }
  return Discretization{std::move(cuts)};
}

Discretization equal_frequency(std::span<const double> values, std::size_t bins) {
  const std::vector<double> ascending = sorted(values, bins);
  std::set<double> different;
  for (auto value = ascending.begin(); value != ascending.end() && different.size() <= bins;
       value = std::upper_bound(value, ascending.end(), *value))
    different.insert(*value);
  if (different.size() <= bins) return one_each(different);
  std::vector<double> at_ranks;
  for (std::size_t j = 1; j < bins; ++j) at_ranks.push_back(ascending[j * ascending.size() / bins]);
  return cut(ascending.front(), at_ranks, [&](double value) {
    const auto above = std::upper_bound(ascending.begin(), ascending.end(), value);
    return above == ascending.end() ? infinity : *above;
  });
}

EqualFrequencyFit::EqualFrequencyFit(std::size_t bins)
    : bins_(bins), ranges_{{.first = 0, .free_bits = 64, .below = 0}} {
  if (bins == 0) throw std::invalid_argument("a discretization needs at least one bin");
}

void EqualFrequencyFit::count(Range& range, Key key) {
  ++range.counts[(key - range.first) >> (range.free_bits - bits)];
}

void EqualFrequencyFit::see(double value) {
  if (std::isnan(value)) return;
  if (std::isinf(value)) throw std::invalid_argument("a discretization cannot be fitted to an infinite value");
  if (first_pass_) {
    ++size_;
    least_ = std::fmin(least_, value);
    greatest_ = std::fmax(greatest_, value);
    if (different_.size() <= bins_) different_.insert(value);
  }
  if (!full_.empty()) return see_above(value);
  const Key key = key_of(value);
  const auto above = std::upper_bound(ranges_.begin(), ranges_.end(), key,
                                      [](Key wanted, const Range& range) { return wanted < range.first; });
  if (above == ranges_.begin()) return;
  Range& range = *std::prev(above);
  if (range.free_bits < 64 && (key - range.first) >> range.free_bits != 0) return;
  range.least = std::min(range.least, key);
  range.greatest = std::max(range.greatest, key);
  if (!range.counts.empty()) return count(range, key);
  range.keys.push_back(key);
  if (range.keys.size() <= most_keys / ranges_.size()) return;
  range.counts.assign(std::size_t{1} << bits, 0);
  for (const Key seen : std::exchange(range.keys, {})) count(range, seen);
}

void EqualFrequencyFit::see_above(double value) {
  const auto full = std::lower_bound(full_.begin(), full_.end(), value);  // the first that is not below the value
  if (full == full_.begin()) return;
  double& next = next_greater_[static_cast<std::size_t>(full - full_.begin()) - 1];
  next = std::fmin(next, value);
}

void EqualFrequencyFit::settle(Range& range, std::vector<Range>& next) {
  std::sort(range.keys.begin(), range.keys.end());
  const int free_bits = range.free_bits - bits;
  std::size_t below = range.below;
  std::size_t part = 0;
  for (std::size_t i = 0; i < ranks_.size(); ++i) {
    if (!std::isnan(at_ranks_[i]) || ranks_[i] < range.below) continue;
    if (range.counts.empty()) {
      if (ranks_[i] - range.below < range.keys.size()) at_ranks_[i] = value_of(range.keys[ranks_[i] - range.below]);
      continue;
    }
    while (part < range.counts.size() && ranks_[i] >= below + range.counts[part]) below += range.counts[part++];
    if (part == range.counts.size()) return;
    const Key first = range.first + (Key{part} << free_bits);
    if (range.least == range.greatest)
      at_ranks_[i] = value_of(range.least);
    else if (free_bits == 0)
      at_ranks_[i] = value_of(first);
    else if (next.empty() || next.back().first != first)
      next.push_back({.first = first, .free_bits = free_bits, .below = below});
  }
}

bool EqualFrequencyFit::wants_another_pass() {
  const bool first = std::exchange(first_pass_, false);
  if (different_.size() <= bins_) ranges_.clear();
  if (!full_.empty() || ranges_.empty()) return false;
  if (first) {
    for (std::size_t j = 1; j < bins_; ++j) ranks_.push_back(j * size_ / bins_);
    at_ranks_.assign(ranks_.size(), std::numeric_limits<double>::quiet_NaN());
  }
  std::vector<Range> next;
  for (Range& range : ranges_) settle(range, next);
  ranges_.swap(next);
  if (!ranges_.empty()) return true;
  for (std::size_t i = 0; i < at_ranks_.size(); ++i) {
    if (std::isnan(at_ranks_[i]))
      throw std::logic_error("EqualFrequencyFit: this pass had other values than those before");
    if (fills_a_bin(least_, at_ranks_, i) && (full_.empty() || full_.back() < at_ranks_[i]))
      full_.push_back(at_ranks_[i]);
  }
  next_greater_.assign(full_.size(), infinity);
  if (!first || !next.front().counts.empty()) return !full_.empty();
  for (const Key key : next.front().keys) see_above(value_of(key));
  return false;
}

Discretization EqualFrequencyFit::discretization() const {
  if (different_.size() <= bins_) return one_each(different_);
  return cut(least_, at_ranks_, [&](double value) {
    return next_greater_[static_cast<std::size_t>(std::lower_bound(full_.begin(), full_.end(), value) - full_.begin())];
  });
}

}  // namespace sigmax
