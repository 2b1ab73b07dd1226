#include "apps/recognition_demo_support.hpp"
#include "support/restatement.hpp"

namespace recognition_demo_manoeuvre_test {

constexpr std::size_t modes = 5;
constexpr double T = 2.0, g = 9.80665;
const restatement::Matrix R(1, 1, {2500.0});

/// The IMM or the HIMM of five known accelerations, from two measured positions on.
restatement::Filter filter_of(bool fuzzy, double z1, double z2) {
  std::vector<restatement::Model> models;
  for (const double a : {0.0, 3 * g, -3 * g, 5 * g, -5 * g}) {
    models.push_back(restatement::dwna(1, 5.0));
    models.back().input = [a](double dt) { return Numbers{0.5 * dt * dt * a, dt * a}; };
  }
  restatement::Matrix transition(modes, modes, Numbers(modes * modes, fuzzy ? 0.025 / 0.9 : 0.025));
  for (std::size_t j = 0; j < modes; ++j) transition(j, j) = fuzzy ? 1.0 : 0.9;
  const auto start = restatement::two_point_start({{z1}, R}, {{z2}, R}, T);
  return {models,
          transition,
          std::vector(modes, start),
          Numbers(modes, 1.0),
          {.kind = fuzzy ? restatement::Kind::himm : restatement::Kind::imm,
           .mixed_covariance = restatement::MixedCovariance::own_recentred}};
}

/// The weights of the modes after one more.
Numbers take(restatement::Filter& filter, double z) {
  filter.step(T, {z}, R);
  Numbers weights;
  for (const double log : filter.log_weights()) weights.push_back(std::exp(log));
  return weights;
}

/// Weak, medium and strong from the modes' weights.
Numbers manoeuvre(const Numbers& w, bool fuzzy) {
  if (fuzzy) return {w[0], std::max(w[1], w[2]), std::max(w[3], w[4])};
  return {w[0], w[1] + w[2], w[3] + w[4]};
}

// p(f|c) by (43) and π(f|c) by (46) of the authors' tables, by hand.
const Matrix random_tables = {{1.0, 0.0, 0.0}, {0.4, 0.6, 0.0}, {2.0 / 11.0, 3.0 / 11.0, 6.0 / 11.0}};
const Matrix fuzzy_tables = {{1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {1.0, 1.0, 1.0}};

void observe(Numbers& logs, const Matrix& tables, const Numbers& likelihood, bool by_max) {
  for (std::size_t c = 0; c < 3; ++c) {
    double combined = 0.0;
    for (std::size_t f = 0; f < 3; ++f) {
      const double term = likelihood[f] * tables[c][f];
      combined = by_max ? std::max(combined, term) : combined + term;
    }
    logs[c] += std::log(combined);
  }
}

Numbers belief(Numbers logs, bool by_max) {
  const double top = greatest(logs);
  for (double& log : logs) log = std::exp(log - top);
  return divided(logs, by_max ? 1.0 : sum(logs));
}

class RecognitionDemoManoeuvre : public InDirectory {};

TEST_F(RecognitionDemoManoeuvre, FiltersAndClassifiersEqualPlainLoopsOnEverySample) {
  recognition_demo_succeeds({"manoeuvre", "--runs", "8", "--quiet", "--out", directory.path()});
  const auto samples = rows_of(directory.path() / "samples.csv");
  const auto runs = rows_of(directory.path() / "runs.csv");
  ASSERT_EQ(samples.size(), 3U * 8U * 30U);
  ASSERT_EQ(runs.size(), 3U * 8U);
  const std::array<const char*, modes> labels = {"cv", "+3g", "-3g", "+5g", "-5g"};
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const auto sample = [&](std::size_t k) { return samples[30 * r + k - 1]; };
    const auto position = [&](std::size_t k) { return std::stod(sample(k).at("position_m")); };
    auto imm = filter_of(false, position(1), position(2)), himm = filter_of(true, position(1), position(2));
    Numbers sigma(3, 0.0), max(3, 0.0), sigma_max(3, 0.0), max_sigma(3, 0.0);
    EXPECT_EQ(sample(2).at("imm_cv"), "");
    for (std::size_t k = 3; k <= 30; ++k) {
      const Numbers p = take(imm, position(k)), pi = take(himm, position(k));
      Numbers found_p, found_pi;
      for (const char* label : labels) {
        found_p.push_back(std::stod(sample(k).at(std::string("imm_") + label)));
        found_pi.push_back(std::stod(sample(k).at(std::string("himm_") + label)));
      }
      ASSERT_CLOSE(found_p, p, 1e-8) << "run " << r << ", sample " << k;
      ASSERT_CLOSE(found_pi, pi, 1e-8) << "run " << r << ", sample " << k;
      if (k < 10) continue;
      observe(sigma, random_tables, manoeuvre(p, false), false);
      observe(max, fuzzy_tables, manoeuvre(pi, true), true);
      observe(sigma_max, fuzzy_tables, manoeuvre(p, false), true);
      observe(max_sigma, random_tables, manoeuvre(pi, true), false);
    }
    const auto found = [&](const std::string& name) {
      return Numbers{std::stod(runs[r].at(name + ": airliner")), std::stod(runs[r].at(name + ": bomber")),
                     std::stod(runs[r].at(name + ": fighter"))};
    };
    EXPECT_CLOSE(found("sigma, of the IMM"), belief(sigma, false), 1e-6) << "run " << r;
    EXPECT_CLOSE(found("max, of the HIMM"), belief(max, true), 1e-6) << "run " << r;
    EXPECT_CLOSE(found("sigma-max, of the IMM"), belief(sigma_max, true), 1e-6) << "run " << r;
    EXPECT_CLOSE(found("max-sigma, of the HIMM"), belief(max_sigma, false), 1e-6) << "run " << r;
  }
}

TEST_F(RecognitionDemoManoeuvre, SaysWhichTargetsMaxInferenceCanNeverPrefer) {
  const std::string output = recognition_demo({"manoeuvre", "--runs", "2"}).output;
  EXPECT_TRUE(
      says(output, {"max, of the HIMM can never prefer the airliner", "max, of the HIMM can never prefer the bomber"}));
  EXPECT_EQ(output.find("can never prefer the fighter"), std::string::npos) << output;
  EXPECT_EQ(output.find("sigma, of the IMM can never prefer"), std::string::npos) << output;
}

}  // namespace recognition_demo_manoeuvre_test
