#pragma once

#include "result/pictures.hpp"
#include "support/test.hpp"

namespace sigmax::apps {

inline bool has_gnuplot() {
  try {
    need_gnuplot();
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace sigmax::apps
