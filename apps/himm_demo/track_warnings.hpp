#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "himm_demo/filter_settings.hpp"
#include "himm_demo/recording.hpp"

namespace sigmax::apps {

/// Where the standard conversion of a radar's measurements is out of its validity, r σ_α² / σ_r < 0.4.
class Validity {
 public:
  void add(const Fix& fix, const Polar& seen, const std::vector<FilterSettings>& filters);

  bool broken() const { return outside_ > 0; }
  std::string warning(const std::string& file) const;

 private:
  std::size_t first_line_ = 0;
  double first_value_ = 0.0;
  double first_range_ = 0.0;
  std::size_t outside_ = 0;
  std::size_t measurements_ = 0;
  double sigma_range_needed_ = 0.0;
};

/// Tracks of which a filter's gate turned many measurements away: a fifth, and at least five.
class Refusals {
 public:
  void add(const std::string& track, const FilterSettings& filter, std::size_t rejected, std::size_t measurements);

  bool any() const { return many_ > 0; }
  std::string warning(const std::string& file) const;

 private:
  std::size_t many_ = 0;  // filters on tracks
  std::string worst_track_;
  std::string worst_filter_;
  double worst_gate_ = 1.0;
  std::size_t worst_rejected_ = 0;
  std::size_t worst_measurements_ = 1;
};

/// Measurements that no filter expects: an NIS above 30 is beyond the 0.999998 quantile of χ² with three degrees of
/// freedom.
class Outliers {
 public:
  void add(std::size_t line, double nis);

  bool any() const { return count_ > 0; }
  /// `one_track`: the rows were all taken for one target's.
  std::string warning(const std::string& file, std::size_t measurements, bool one_track) const;

 private:
  std::size_t count_ = 0;
  std::size_t worst_line_ = 0;
  double worst_nis_ = 0.0;
};

}  // namespace sigmax::apps
