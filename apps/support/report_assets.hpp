#pragma once

#include <string_view>

/// What every report holds beside its data, put into the program when it is built; empty where dygraphs or D3 was
/// missing.
namespace sigmax::apps::report_assets {

extern const std::string_view style, dygraphs, synchronizer, d3, script;

}  // namespace sigmax::apps::report_assets
