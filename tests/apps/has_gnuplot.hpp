#pragma once

#include <exception>

#include "support/gnuplot.hpp"

namespace sigmax::apps {

inline bool has_gnuplot() {
  try {
    Gnuplot{};
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace sigmax::apps
