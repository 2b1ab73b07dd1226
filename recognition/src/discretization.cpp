#include <sigmax/recognition/discretization.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
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
  std::vector<double> cuts = ascending;
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  cuts.erase(cuts.begin());
  if (cuts.size() < bins) return Discretization{std::move(cuts)};  // each value has a bin
  cuts.clear();
  double before = ascending.front();
  for (std::size_t j = 1; j < bins; ++j) {
    const double value = ascending[j * ascending.size() / bins];
    // A value at two ranks, the end below counted as one, fills a bin, which then ends at the next greater value.
    const auto end = value == before ? std::upper_bound(ascending.begin(), ascending.end(), value) : ascending.end();
    const double cut = value == before ? (end == ascending.end() ? infinity : *end) : value;
    if (cut > (cuts.empty() ? ascending.front() : cuts.back()) && std::isfinite(cut)) cuts.push_back(cut);
    before = value;
  }
  return Discretization{std::move(cuts)};
}

}  // namespace sigmax
