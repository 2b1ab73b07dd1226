#pragma once

#include "himm_demo/filters/settings.hpp"
#include "report/result.hpp"

namespace sigmax::apps {

/// estimates.csv: a row for each filter and step.
class EstimatesFile {
 public:
  /// A step of a filter, and where on the Earth it is, if it is there.
  struct Estimate {
    const std::string& track;
    const FilterSettings& filter;
    const TargetPoint& point;
    const std::optional<Geodetic>& place;
  };

  /// Without files it keeps nothing.
  EstimatesFile(ResultFiles* files, const std::vector<FilterSettings>& filters, const RecordingReader& recording,
                bool iso_times);

  explicit operator bool() const { return file_ && *file_; }
  void write(const Estimate& estimate) {
    if (*this) file_->write(each(cells_, [&](const auto& cell) { return cell(estimate); }));
  }

 private:
  std::vector<std::function<Cell(const Estimate&)>> cells_;
  std::optional<RowFile> file_;
};

}  // namespace sigmax::apps
