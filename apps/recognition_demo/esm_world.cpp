#include "recognition_demo/esm_world.hpp"

#include <algorithm>

#include "recognition_demo/draws.hpp"

#include <sigmax/core/transform.hpp>

namespace sigmax::apps {

Relation<Random, Random> EsmWorld::equal_usage() const {
  std::vector<std::vector<double>> rows(platform.size(), std::vector<double>(emitter.size(), 0.0));
  for (std::size_t c = 0; c < rows.size(); ++c)
    for (const std::size_t f : carried[c]) rows[c][f] = 1.0 / static_cast<double>(carried[c].size());
  return {emitter, platform, rows};
}

Relation<Fuzzy, Fuzzy> EsmWorld::carries(double elsewhere) const {
  std::vector<std::vector<double>> rows(platform.size(), std::vector<double>(emitter.size(), elsewhere));
  for (std::size_t c = 0; c < rows.size(); ++c)
    for (const std::size_t f : carried[c]) rows[c][f] = 1.0;
  return {as_fuzzy(emitter), as_fuzzy(platform), rows};
}

Relation<Random, Random> EsmWorld::sensor(double hit) const {
  const std::size_t n = emitter.size();
  std::vector<std::vector<double>> rows(n, std::vector<double>(n, (1.0 - hit) / static_cast<double>(n - 1)));
  for (std::size_t f = 0; f < n; ++f) rows[f][f] = hit;
  return {reading, emitter, rows};
}

std::vector<double> spread_over_emitters(const EsmWorld& world, std::size_t platform,
                                         const std::vector<double>& shares) {
  std::vector<double> probabilities(world.emitter.size(), 0.0);
  for (std::size_t i = 0; i < shares.size(); ++i) probabilities[world.carried[platform][i]] = shares[i];
  return probabilities;
}

std::vector<double> dominant_shares(std::size_t size, std::size_t dominant, double share) {
  std::vector<double> shares(size, (1.0 - share) / static_cast<double>(size - 1));
  shares[dominant] = share;
  return shares;
}

std::vector<double> draw_usage(const EsmWorld& world, std::size_t platform, const Usage& usage, RandomStream& random) {
  const std::size_t size = world.carried[platform].size();
  std::vector<double> shares(size, 1.0 / static_cast<double>(size));
  if (usage.kind == Usage::Kind::dirichlet) shares = draw_dirichlet(random, size, usage.parameter);
  if (usage.kind == Usage::Kind::dominant) shares = dominant_shares(size, draw_index(random, size), usage.parameter);
  return spread_over_emitters(world, platform, shares);
}

EsmRun draw_run(const EsmWorld& world, const EsmTruth& truth, std::size_t reports, RandomStream& random) {
  const auto sensor = world.sensor(truth.hit);
  EsmRun run;
  run.platform = draw_index(random, world.platform.size());
  std::vector<double> usage = draw_usage(world, run.platform, truth.usage, random);
  if (truth.unlisted > 0.0) {
    const auto listed = static_cast<double>(world.carried[run.platform].size());
    const double each = truth.unlisted / (static_cast<double>(usage.size()) - listed);
    for (double& share : usage) share = (1.0 - truth.unlisted) * share;
    for (std::size_t f = 0; f < usage.size(); ++f) {
      const auto& carried = world.carried[run.platform];
      if (std::find(carried.begin(), carried.end(), f) == carried.end()) usage[f] = each;
    }
  }
  // A sensor that goes astray listens to another platform for the whole run.
  std::vector<double> heard_astray;
  if (truth.astray > 0.0 && random.uniform() < truth.astray) {
    const std::size_t step = 1 + draw_index(random, world.platform.size() - 1);
    heard_astray = draw_usage(world, (run.platform + step) % world.platform.size(), truth.usage, random);
  }
  for (std::size_t k = 0; k < reports; ++k) {
    Readings& report = run.reports.emplace_back();
    for (std::size_t s = 0; s < truth.sensors; ++s) {
      const bool astray = s > 0 && !heard_astray.empty();
      const std::size_t emitter = draw(random, astray ? heard_astray : usage);
      report.push_back(draw(random, sensor.row(emitter)));
    }
  }
  return run;
}

}  // namespace sigmax::apps
