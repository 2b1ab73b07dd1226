#include "support/nines.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "support/error.hpp"

namespace sigmax::apps {

namespace {
constexpr std::size_t most_different = 8;
}

void Nines::End::see(std::string_view cell, double other) {
  if (other > number) {
    next = number;
    number = other;
    word = cell;
    cells = 0;
  } else if (other < number && other > next) {
    next = other;
  }
  if (other == number) ++cells;
}

void Nines::see(std::string_view cell, double number) {
  low_.see(cell, -number);
  high_.see(cell, number);
  if (different_.size() <= most_different) different_.insert(number);
  const bool is_nines = std::abs(number) >= 99.0 && cell.find_first_not_of("-.09") == cell.npos &&
                        cell.substr(0, cell.find('.')).find('0') == cell.npos;
  constexpr std::array ends = {-2147483648.0, -32768.0, 32767.0, 65535.0, 2147483647.0, 4294967295.0};
  const bool is_end = std::ranges::find(ends, number) != ends.end() || std::abs(number) >= 1e20;
  if (word_.empty() && (is_nines || is_end)) {
    word_ = cell;
    number_ = number;
  }
  if (cell == word_) {
    ++cells_;
  } else {
    ++others_;
    least_ = std::min(least_, number);
    greatest_ = std::max(greatest_, number);
  }
}

std::string Nines::doubt(std::string_view column) const {
  constexpr std::size_t few = 20, again = 3;
  const auto sentence = [&](std::size_t cells, std::string_view word) {
    return fmt::format("column {}: {} {} {}, far from the others; if that stands for no value, give --missing={}",
                       in_quotes(column), cells, cells == 1 ? "cell is" : "cells are", word, word);
  };
  const bool is_far = std::max(number_ - greatest_, least_ - number_) > greatest_ - least_;
  const bool is_great = number_ < 0.0 ? least_ > 0.1 * number_ : greatest_ < 0.1 * number_;
  if (!word_.empty() && others_ >= few && (is_far || is_great)) return sentence(cells_, word_);
  const double low = -low_.number, high = high_.number, next_low = -low_.next, next_high = high_.next;
  if (different_.size() <= most_different) return {};
  const auto comes_again = [&](const End& end) {  // but zero, of which others ask
    return end.number != 0.0 && end.cells >= again && others_ + cells_ >= few + end.cells;
  };
  if (comes_again(high_) && high - next_high > next_high - low) return sentence(high_.cells, high_.word);
  if (comes_again(low_) && next_low - low > high - next_low) return sentence(low_.cells, low_.word);
  return {};
}

}  // namespace sigmax::apps
