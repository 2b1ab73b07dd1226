#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>

#include <Random123/philox.h>

namespace sigmax::apps {

/// Random numbers that depend on the seed and the number of the stream alone, never on threads or on what other streams
/// drew: Philox4x64-10 (Salmon et al., SC 2011) with the key (seed, 0) and the counter (block, stream, 0, 0).
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t stream) : seed_(seed), stream_(stream) {}

  /// Uniform over the multiples of 2⁻⁵³ inside (0, 1).
  double uniform() {
    for (;;)
      if (const std::uint64_t bits = next() >> 11U; bits != 0) return static_cast<double>(bits) * 0x1p-53;
  }

  /// Standard normal, by Box and Muller's transform: the cosine of a pair of uniforms first, then its sine. Our own,
  /// since the transforms of <random> differ between standard libraries.
  double normal() {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    const double angle = 2.0 * std::numbers::pi * uniform();
    spare_ = radius * std::sin(angle);
    has_spare_ = true;
    return radius * std::cos(angle);
  }

  /// One of `size` outcomes, all equally probable.
  std::size_t index(std::size_t size) {
    return std::min(size - 1, static_cast<std::size_t>(uniform() * static_cast<double>(size)));
  }

  /// A number of events of this mean rate, up to 500: the Poisson distribution by Knuth's product of uniforms.
  std::size_t count(double mean) {
    std::size_t events = 0;
    for (double product = uniform(); product > std::exp(-mean); product *= uniform()) ++events;
    return events;
  }

  /// An outcome with these probabilities; they may miss a sum of one by rounding.
  std::size_t draw(std::span<const double> probabilities) {
    const double u = uniform();
    double sum = 0.0;
    std::size_t last = 0;
    for (std::size_t i = 0; i < probabilities.size() && sum <= u; ++i)
      if (probabilities[i] > 0.0) sum += probabilities[last = i];
    return last;
  }

 private:
  std::uint64_t next() {
    if (used_ == block_.size()) {
      block_ = r123::Philox4x64{}({{blocks_++, stream_, 0, 0}}, {{seed_, 0}});
      used_ = 0;
    }
    return block_[used_++];
  }

  std::uint64_t seed_, stream_, blocks_ = 0;
  r123::Philox4x64::ctr_type block_{};
  std::size_t used_ = block_.size();
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace sigmax::apps
