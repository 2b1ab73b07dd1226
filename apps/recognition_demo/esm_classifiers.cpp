#include "recognition_demo/esm_classifiers.hpp"

#include <utility>

#include <boost/math/distributions/beta.hpp>

#include <sigmax/core/transform.hpp>

namespace sigmax::apps {
namespace {

template <Uncertainty Pattern, Uncertainty Feature, Uncertainty Reading>
Classifier<Pattern, Feature> read_by(const Relation<Feature, Pattern>& relation,
                                     const std::vector<Relation<Reading, Feature>>& sensors) {
  std::vector<FeatureModel<Pattern, Feature>> features;
  for (const auto& sensor : sensors) features.emplace_back(relation, sensor);
  return {uninformative(relation.from()), std::move(features)};
}

/// The condition of a sensor read as the other kind.
Relation<Random, Fuzzy> of_fuzzy(const Relation<Random, Random>& sensor) { return with_fuzzy_condition(sensor); }
Relation<Fuzzy, Random> of_random(const Relation<Fuzzy, Fuzzy>& sensor) { return with_random_condition(sensor); }

/// Shares of `size` emitters on a grid of equal probability under Dirichlet(α): sticks are broken at the quantiles.
std::vector<std::vector<double>> dirichlet_grid(std::size_t size, double alpha) {
  if (size == 1) return {{1.0}};
  const std::size_t nodes = size == 2 ? 32 : 16;
  const boost::math::beta_distribution<double> first(alpha, alpha * static_cast<double>(size - 1));
  std::vector<std::vector<double>> grid;
  for (std::size_t i = 0; i < nodes; ++i) {
    const double share = boost::math::quantile(first, (static_cast<double>(i) + 0.5) / static_cast<double>(nodes));
    for (const auto& rest : dirichlet_grid(size - 1, alpha)) {
      auto& shares = grid.emplace_back(1, share);
      for (const double part : rest) shares.push_back((1.0 - share) * part);
    }
  }
  return grid;
}

/// All shares that a usage can take, equally probable.
std::vector<std::vector<double>> usage_grid(std::size_t size, const Usage& usage) {
  if (usage.kind == Usage::Kind::dirichlet) return dirichlet_grid(size, usage.parameter);
  if (usage.kind == Usage::Kind::equal) return {std::vector<double>(size, 1.0 / static_cast<double>(size))};
  std::vector<std::vector<double>> grid;
  for (std::size_t i = 0; i < size; ++i) grid.push_back(dominant_shares(size, i, usage.parameter));
  return grid;
}

}  // namespace

Contestant sigma_contestant(std::string name, const Relation<Random, Random>& emitter_given_platform,
                            const std::vector<Relation<Random, Random>>& sensors) {
  return {std::move(name), read_by(emitter_given_platform, sensors), std::nullopt, false};
}

Contestant max_contestant(std::string name, const Relation<Fuzzy, Fuzzy>& emitter_given_platform,
                          const std::vector<Relation<Fuzzy, Fuzzy>>& sensors) {
  return {std::move(name), read_by(emitter_given_platform, sensors)};
}

Contestant sigma_max_contestant(std::string name, const Relation<Fuzzy, Fuzzy>& emitter_given_platform,
                                const std::vector<Relation<Random, Random>>& sensors) {
  std::vector<Relation<Random, Fuzzy>> fuzzy;
  for (const auto& sensor : sensors) fuzzy.push_back(of_fuzzy(sensor));
  return {std::move(name), read_by(emitter_given_platform, fuzzy)};
}

Contestant max_sigma_contestant(std::string name, const Relation<Random, Random>& emitter_given_platform,
                                const std::vector<Relation<Fuzzy, Fuzzy>>& sensors) {
  std::vector<Relation<Fuzzy, Random>> random;
  for (const auto& sensor : sensors) random.push_back(of_random(sensor));
  return {std::move(name), read_by(emitter_given_platform, random)};
}

Contestant usage_aware_contestant(std::string name, const EsmWorld& world, const Usage& usage,
                                  const std::vector<Relation<Random, Random>>& sensors) {
  std::vector<std::vector<double>> usages, platforms;
  std::vector<double> prior;
  for (std::size_t c = 0; c < world.platform.size(); ++c) {
    const auto grid = usage_grid(world.carried[c].size(), usage);
    for (const auto& shares : grid) {
      usages.push_back(spread_over_emitters(world, c, shares));
      auto& platform = platforms.emplace_back(world.platform.size(), 0.0);
      platform[c] = 1.0;
      prior.push_back(1.0 / static_cast<double>(grid.size() * world.platform.size()));
    }
  }
  const RandomVariable variable{"usage", usages.size()};
  std::vector<FeatureModel<Random, Random>> features;
  for (const auto& sensor : sensors)
    features.emplace_back(Relation<Random, Random>{world.emitter, variable, usages}, sensor);
  return {std::move(name), SigmaClassifier{normalized(variable, prior), std::move(features)},
          Relation<Random, Random>{world.platform, variable, platforms}, false};
}

}  // namespace sigmax::apps
