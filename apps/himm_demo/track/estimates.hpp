#pragma once

#include <sigmax/earth/earth_target.hpp>

#include "himm_demo/filters/settings.hpp"
#include "report/result.hpp"

namespace sigmax::apps {

/// estimates.csv: a row for each filter and step.
class EstimatesFile {
 public:
  /// Without files it keeps nothing.
  EstimatesFile(ResultFiles* files, const std::vector<FilterSettings>& filters, const RecordingReader& recording,
                bool iso_times);

  explicit operator bool() const { return file_ && *file_; }
  void write(const std::string& track, const FilterSettings& filter, const EarthPoint& point) {
    track_ = track;
    if (*this) file_->write(each(cells_, [&](const auto& cell) { return cell(point, filter); }));
  }

 private:
  std::vector<std::function<Cell(const EarthPoint&, const FilterSettings&)>> cells_;
  std::string track_;
  std::optional<RowFile> file_;
};

}  // namespace sigmax::apps
