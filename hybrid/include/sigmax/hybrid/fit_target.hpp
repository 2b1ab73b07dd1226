#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <sigmax/hybrid/any_target.hpp>

namespace sigmax {

/// How well a target with this choice predicts each of the detections, its log_score, by their tags 0, 1, …: the sum is
/// the prequential log-likelihood. NaN for detections that are no step with a measurement, and until the first start;
/// minus infinity for what is taken for another start, so that settings cannot leave it out.
///
///     double sum = 0.0;
///     for (const double score : log_scores(choice, detections)) sum += std::isnan(score) ? 0.0 : score;
///
/// `visit(point)`, if given, sees each step and start; `starts(detection)`, whether a detection may lead to a start,
/// else all may. Throws as AnyTarget does, std::invalid_argument for a tag that is not below the number of detections.
std::vector<double> log_scores(const TargetChoice& choice, std::span<const AnyDetection> detections,
                               const std::function<void(const TargetPoint&)>& visit = {},
                               const std::function<bool(const AnyDetection&)>& starts = {});

/// A log_score that no measurement can spoil alone: a share of all measurements are stray ones, of a density whose
/// logarithm is log_stray here, whatever the settings. It is log((1 − share) exp(log_score) + share exp(log_stray)),
/// the contaminated-normal likelihood, at least log(share) + log_stray.
double robust_log_score(double log_score, double share, double log_stray);

}  // namespace sigmax
