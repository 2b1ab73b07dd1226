#pragma once

#include <cstddef>

#include "himm_demo/track_page.hpp"

/// What collecting and drawing a recording's page agree on.
namespace sigmax::apps::track_page {

constexpr std::size_t most_marks = 300;   // of each kind and track
constexpr std::size_t most_stays = 1000;  // of a history

/// Columns of a measurement: its position, its error and where the target was.
constexpr std::size_t plot_at = 0, plot_error_at = 3, truth_at = 6, plot_columns = 9;

/// Columns of an estimate; the weights of the models follow.
constexpr std::size_t position_at = 0, error_at = 3, sigma_at = 6, nis_at = 9, weights_at = 10;

}  // namespace sigmax::apps::track_page
