#pragma once

#include <cstddef>
#include <random>
#include <span>
#include <vector>

namespace sigmax {

/// The fold, from 0, to which each row belongs: within every label the folds' sizes differ by at most one, and so do
/// the folds' sizes over all. Train on the rows of the other folds, test on those of one.
///
/// Rows are shuffled within their label by the generator alone (Fisher–Yates by its raw draws), so a seed gives the
/// same folds everywhere. Throws std::invalid_argument unless 2 ≤ folds ≤ number of rows.
std::vector<std::size_t> stratified_folds(std::span<const std::size_t> labels, std::size_t folds,
                                          std::mt19937_64& generator);

/// Folds that keep the rows of one group, a patient or a session, together. Groups are dealt in random order, each to
/// one of the folds with the fewest rows; no label has all its rows in one fold. Groups are 0, 1, …, labels too. Throws
/// std::invalid_argument if there are fewer groups than folds, or if no division of a hundred parts every label.
std::vector<std::size_t> grouped_folds(std::span<const std::size_t> labels, std::span<const std::size_t> groups,
                                       std::size_t folds, std::mt19937_64& generator);

}  // namespace sigmax
