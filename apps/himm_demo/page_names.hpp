#pragma once

namespace sigmax::apps {

/// Names that the charts of a page share beside those of the filters.
inline constexpr const char* measurement_name = "measurement";
inline constexpr const char* truth_name = "truth";

}  // namespace sigmax::apps
