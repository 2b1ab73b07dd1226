#include "shell/random.hpp"

#include <algorithm>

#include <Random123/philox.h>

namespace sigmax::apps {

std::size_t RandomStream::index(std::size_t size) {
  return std::min(size - 1, static_cast<std::size_t>(uniform() * static_cast<double>(size)));
}

std::size_t RandomStream::draw(std::span<const double> probabilities) {
  const double u = uniform();
  double sum = 0.0;
  std::size_t last = 0;
  for (std::size_t i = 0; i < probabilities.size() && sum <= u; ++i)
    if (probabilities[i] > 0.0) sum += probabilities[last = i];
  return last;
}

void RandomStream::refill() {
  const r123::Philox4x64::ctr_type random = r123::Philox4x64{}({{blocks_++, stream_, 0, 0}}, {{seed_, 0}});
  block_ = {random[0], random[1], random[2], random[3]};
  used_ = 0;
}

}  // namespace sigmax::apps
