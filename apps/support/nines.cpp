#include "support/nines.hpp"

#include <algorithm>
#include <cmath>

#include "support/error.hpp"

namespace sigmax::apps {

void Nines::see(std::string_view cell, double number) {
  const bool is_nines = std::abs(number) >= 99.0 && cell.find_first_not_of("-.09") == cell.npos &&
                        cell.substr(0, cell.find('.')).find('0') == cell.npos;
  if (word_.empty() && (is_nines || number == -32768.0 || std::abs(number) >= 1e20)) {
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
  constexpr std::size_t few = 20;
  const bool is_far = std::max(number_ - greatest_, least_ - number_) > greatest_ - least_;
  const bool is_great = number_ < 0.0 ? least_ > 0.1 * number_ : greatest_ < 0.1 * number_;
  if (word_.empty() || others_ < few || !(is_far || is_great)) return {};
  return fmt::format("column {}: {} {} {}, far from the others; if that stands for no value, give --missing={}",
                     in_quotes(column), cells_, cells_ == 1 ? "cell is" : "cells are", word_, word_);
}

}  // namespace sigmax::apps
