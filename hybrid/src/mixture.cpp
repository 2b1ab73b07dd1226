#include <sigmax/hybrid/mixture.hpp>

#include <algorithm>
#include <cmath>

#include <sigmax/estimation/dense.hpp>
#include <sigmax/hybrid/envelope.hpp>

namespace sigmax {

double EntryPrior::variance(const std::string& component, double scale) const {
  const double sigma = component == "omega" ? turn_rate : component.back() == 'z' ? vertical * scale : scale;
  return sigma * sigma;
}

double EntryPrior::root_mean_square() const {
  double sum = 0.0;
  for (const double scale : scales) sum += scale * scale;
  return std::sqrt(sum / static_cast<double>(scales.size()));
}

namespace detail {

Correspondence::Correspondence(const std::vector<std::string>& receiver, const std::vector<std::string>& source) {
  for (const auto& component : receiver) {
    const auto found = std::find(source.begin(), source.end(), component);
    in_source.push_back(found == source.end() ? -1 : static_cast<int>(found - source.begin()));
  }
}

void Mixture::mean_of(const Part& part, double* mean) const {
  const double lacking = augmentation == StateAugmentation::unbiased ? 1.0 : 0.0;
  for (int i = 0; i < size(); ++i) {
    const int at = part.place(i);
    mean[i] = at >= 0 ? part.estimate.mean[at] : lacking * receiver.mean[i];
  }
}

void Mixture::add_covariance(const Part& part, double weight, double* covariance) const {
  const int n = size(), m = part.estimate.n;
  const double* const P = part.estimate.covariance;
  for (int k = 0; k < n; ++k) {
    double* const column = covariance + k * n;
    const int at = part.place(k);
    if (at >= 0) {
      for (int i = k; i < n; ++i)
        if (const int row = part.place(i); row >= 0) column[i] += weight * P[row + at * m];
    } else if (augmentation == StateAugmentation::unbiased) {
      for (int i = k; i < n; ++i)
        if (part.place(i) < 0) column[i] += weight * receiver.covariance[i + k * n];
    } else if (augmentation != StateAugmentation::zero) {
      column[k] += weight * receiver.covariance[k + k * n];
    }
  }
}

void Mixture::read(const Part& part, View result) const {
  mean_of(part, result.mean);
  std::fill_n(result.covariance, size() * size(), 0.0);
  add_covariance(part, 1.0, result.covariance);
  mirror_lower(result.covariance, size());
}

void match_moments(const Mixture& mixture, const double* weights, const double* covariance_weights, View result,
                   OutputSpread spread) {
  const int n = mixture.size();
  Scratch<32> mean(n);
  std::fill_n(result.mean, n, 0.0);
  std::fill_n(result.covariance, n * n, 0.0);
  for (std::size_t l = 0; l < mixture.parts.size(); ++l) {
    if (!(weights[l] > 0.0)) continue;
    mixture.mean_of(mixture.parts[l], mean);
    for (int i = 0; i < n; ++i) result.mean[i] += weights[l] * mean[i];
  }
  for (std::size_t l = 0; l < mixture.parts.size(); ++l) {
    const double weight = covariance_weights[l];
    if (!(weight > 0.0)) continue;
    mixture.add_covariance(mixture.parts[l], weight, result.covariance);
    if (spread == OutputSpread::omitted) continue;
    mixture.mean_of(mixture.parts[l], mean);
    for (int i = 0; i < n; ++i) mean[i] -= result.mean[i];
    for (int k = 0; k < n; ++k)
      for (int i = k; i < n; ++i) result.covariance[i + k * n] += weight * mean[i] * mean[k];
  }
  mirror_lower(result.covariance, n);
}

double match_envelope(const Mixture& mixture, const double* weights, View result) {
  const int n = mixture.size();
  Scratch<> mean(n), covariance(n * n);
  thread_local Envelope envelope;  // keeps its memory
  envelope.clear(n);
  for (std::size_t l = 0; l < mixture.parts.size(); ++l) {
    if (!(weights[l] > 0.0)) continue;
    mixture.read(mixture.parts[l], {mean, covariance, n});
    envelope.add(weights[l], {mean, covariance, n});
  }
  return envelope.match(result);
}

void collapse(const Selection& rule, const Mixture& mixture, const double* weights, std::size_t winner, View result) {
  if (rule.mixed_covariance == MixedCovariance::envelope)
    match_envelope(mixture, weights, result);
  else
    mixture.read(mixture.parts[winner], result);
}

void collapse(const MomentMatching& rule, const Mixture& mixture, const double* weights, std::size_t, View result) {
  match_moments(mixture, weights, weights, result, rule.output_spread);
}

void mix(const Selection& rule, const Mixture& mixture, const double* weights, const double*, std::size_t favoured,
         ConstView own, View result) {
  if (rule.mixed_covariance == MixedCovariance::envelope) return collapse(rule, mixture, weights, favoured, result);
  const int n = mixture.size();
  const std::size_t winner = select(
      mixture.parts.size(), [&](std::size_t l) { return std::log(weights[l]); }, favoured, rule.mixing_tie);
  mixture.read(mixture.parts[winner], result);
  if (rule.mixed_covariance == MixedCovariance::selected) return;
  std::copy_n(own.covariance, n * n, result.covariance);
  if (rule.mixed_covariance == MixedCovariance::own) return;
  Scratch<32> first(n);
  mixture.mean_of(mixture.parts[0], first);
  const double* const from = rule.mixed_covariance == MixedCovariance::released ? first.data() : own.mean;
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < n; ++i) result.covariance[i + k * n] += (result.mean[i] - from[i]) * (result.mean[k] - from[k]);
}

void mix(const MomentMatching& rule, const Mixture& mixture, const double* weights, const double* transposed,
         std::size_t, ConstView, View result) {
  match_moments(mixture, weights, rule.mixing_weights == MixingWeights::correct ? weights : transposed, result);
}

}  // namespace detail
}  // namespace sigmax
