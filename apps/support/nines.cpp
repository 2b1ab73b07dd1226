#include "support/nines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/ranges.h>

#include "support/error.hpp"

namespace sigmax::apps {

namespace {

constexpr std::size_t few = 20, again = 3, most_different = 8, most_codes = 3;

std::string sentence(std::string_view column, std::size_t cells, const std::vector<std::string>& words) {
  return fmt::format("column {}: {} {} {}, far from the others; if {} for no value, give --missing={}",
                     in_quotes(column), cells, cells == 1 ? "cell is" : "cells are", fmt::join(words, " or "),
                     words.size() == 1 ? "that stands" : "these stand", fmt::join(words, ","));
}

/// Whether a number is written as 99, -999.0, -99.9 or 8888.
bool is_code(std::string_view cell, double number) {
  const std::string_view digits = cell.substr(cell.starts_with('-') ? 1 : 0),
                         whole = digits.substr(0, digits.find('.'));
  const char first = digits[0];
  return std::abs(number) >= 77.0 && first >= '7' && first <= '9' && whole.find_first_not_of(first) == whole.npos &&
         digits.find_first_not_of(std::string(".0") + first) == digits.npos;
}

/// Whether a number is not just the next one, as 999 where others are 1000.
bool is_gap(double gap, double next) { return gap > 0.05 * std::abs(next); }

}  // namespace

void Nines::see(std::string_view cell, double number) {
  for (auto* const end : {&low_, &high_}) {
    const double outwards = end == &low_ ? -number : number;
    if (end->size() > most_codes && outwards < end->rbegin()->first) continue;
    const auto [told, is_new] = end->try_emplace(outwards);
    if (is_new) told->second.word = cell;
    ++told->second.cells;
    if (end->size() > most_codes + 1) end->erase(std::prev(end->end()));
  }
  if (different_.size() <= most_different) different_.insert(number);
  const auto add_others = [&](double other, std::size_t cells) {
    others_ += cells;
    least_ = std::min(least_, other);
    greatest_ = std::max(greatest_, other);
  };
  constexpr std::array ends = {-2147483648.0, -32768.0, 32767.0, 65535.0, 2147483647.0, 4294967295.0};
  const bool is_end = std::ranges::find(ends, number) != ends.end() || std::abs(number) >= 1e20;
  if ((is_code(cell, number) || is_end) && (word_.empty() || std::abs(number) > std::abs(number_))) {
    if (!word_.empty()) add_others(number_, std::exchange(cells_, 0));  // a smaller one is such, as 77 of ages is
    word_ = cell;
    number_ = number;
  }
  if (cell == word_)
    ++cells_;
  else
    add_others(number, 1);
}

std::string Nines::doubt_of(std::string_view column, const End& end, double other_end) const {
  std::vector<std::string> words;
  std::size_t cells = 0;
  bool codes = different_.size() > most_different;
  for (auto told = end.begin(); told != end.end() && std::next(told) != end.end(); ++told) {
    const double next = std::next(told)->first;
    if (told->second.cells < again || (told->first == 0.0 && !asks_for_zero_)) break;
    words.push_back(told->second.word);
    cells += told->second.cells;
    codes = codes || told->second.word == word_;
    const bool are_few = words.size() == 1 || told->second.word == word_ || others_ + cells_ >= 9 * cells;
    const double gap = told->first - next;
    if (codes && are_few && gap > next + other_end && is_gap(gap, next) && others_ + cells_ >= few + cells)
      return sentence(column, cells, words);
  }
  return {};
}

std::string Nines::doubt(std::string_view column) const {
  const double beyond = std::max(number_ - greatest_, least_ - number_);
  const bool is_far = beyond > greatest_ - least_ && is_gap(beyond, greatest_);
  const bool is_great = number_ < 0.0 ? least_ > 0.1 * number_ : greatest_ < 0.1 * number_;
  if (!word_.empty() && others_ >= few && (is_far || is_great)) return sentence(column, cells_, {word_});
  if (low_.size() < 2) return {};
  const auto& [farthest, told] = *low_.begin();
  const std::string_view bare = std::string_view(told.word).substr(0, told.word.find('.'));
  const bool is_none = bare == "-1" || bare == "-9" || bare == "-99" || bare == "-999";
  const double next = -std::next(low_.begin())->first;  // of places: -1 beside 0 is a scatter about it
  const bool is_alone = asks_for_zero_ ? next >= 0.0 : next > 0.0;
  if (different_.size() > most_different && is_none && told.cells >= again && is_alone)
    return fmt::format(
        "column {}: {} cells are {}, the only ones below 0; if that stands for no value, give --missing={}",
        in_quotes(column), told.cells, told.word, told.word);
  const std::string above = doubt_of(column, high_, low_.begin()->first);
  return above.empty() ? doubt_of(column, low_, high_.begin()->first) : above;
}

}  // namespace sigmax::apps
