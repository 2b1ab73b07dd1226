#include "apps/recognition_demo_support.hpp"
#include "apps/temporary_directory.hpp"

namespace {

constexpr std::size_t modes = 5;
constexpr double T = 2.0, R = 2500.0, Q = 25.0;
constexpr std::array<double, modes> inputs = {0.0, 3 * 9.80665, -3 * 9.80665, 5 * 9.80665, -5 * 9.80665};

/// Position and velocity: mean, and covariance pxx, pxv, pvv.
struct Estimate {
  double x, v, xx, xv, vv;
};

/// One Kalman step with a known acceleration; returns the likelihood of the measurement.
double step(Estimate& e, double acceleration, double z) {
  e.x += T * e.v + 0.5 * T * T * acceleration;
  e.v += T * acceleration;
  const double xx = e.xx + 2.0 * T * e.xv + T * T * e.vv, xv = e.xv + T * e.vv, vv = e.vv;
  const double g = 0.5 * T * T, h = T;
  e.xx = xx + g * g * Q;
  e.xv = xv + g * h * Q;
  e.vv = vv + h * h * Q;
  const double S = e.xx + R, nu = z - e.x, kx = e.xx / S, kv = e.xv / S;
  e.x += kx * nu;
  e.v += kv * nu;
  e = {e.x, e.v, e.xx - kx * kx * S, e.xv - kx * kv * S, e.vv - kv * kv * S};
  return std::exp(-0.5 * nu * nu / S) / std::sqrt(2.0 * std::numbers::pi * S);
}

/// IMM and HIMM in plain loops, without logarithms; the weights after every sample from the third on.
class Filter {
 public:
  Filter(bool fuzzy, double z1, double z2) : fuzzy_(fuzzy) {
    estimates_.fill({z2, (z2 - z1) / T, R, R / T, 2.0 * R / (T * T)});
    weights_ = Numbers(modes, fuzzy ? 1.0 : 1.0 / modes);
  }

  const Numbers& take(double z) {
    Numbers prior(modes, 0.0);
    std::array<Estimate, modes> mixed;
    for (std::size_t j = 0; j < modes; ++j) {
      Numbers in(modes);
      for (std::size_t l = 0; l < modes; ++l) {
        in[l] = weights_[l] * (l == j ? 0.9 : 0.025) / (fuzzy_ ? 0.9 : 1.0);
        prior[j] = fuzzy_ ? std::max(prior[j], in[l]) : prior[j] + in[l];
      }
      mixed[j] = fuzzy_ ? selected(in, j) : matched(divided(in, prior[j]));
    }
    for (std::size_t j = 0; j < modes; ++j) {
      estimates_[j] = mixed[j];
      prior[j] *= step(estimates_[j], inputs[j], z);
    }
    return weights_ = divided(prior, fuzzy_ ? greatest(prior) : sum(prior));
  }

 private:
  Estimate matched(const Numbers& in) const {
    Estimate m{0, 0, 0, 0, 0};
    for (std::size_t l = 0; l < modes; ++l) {
      m.x += in[l] * estimates_[l].x;
      m.v += in[l] * estimates_[l].v;
    }
    for (std::size_t l = 0; l < modes; ++l) {
      const Estimate& e = estimates_[l];
      m.xx += in[l] * (e.xx + (e.x - m.x) * (e.x - m.x));
      m.xv += in[l] * (e.xv + (e.x - m.x) * (e.v - m.v));
      m.vv += in[l] * (e.vv + (e.v - m.v) * (e.v - m.v));
    }
    return m;
  }

  /// The reading `own_recentred` of (57), and ties stay with j.
  Estimate selected(const Numbers& in, std::size_t j) const {
    std::size_t l = j;
    for (std::size_t i = modes; i-- > 0;)
      if (in[i] > in[l] * (1.0 + 1e-9)) l = i;
    const Estimate &best = estimates_[l], &own = estimates_[j];
    const double dx = best.x - own.x, dv = best.v - own.v;
    return {best.x, best.v, own.xx + dx * dx, own.xv + dx * dv, own.vv + dv * dv};
  }

  bool fuzzy_;
  std::array<Estimate, modes> estimates_;
  Numbers weights_;
};

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
    Filter imm(false, position(1), position(2)), himm(true, position(1), position(2));
    Numbers sigma(3, 0.0), max(3, 0.0), sigma_max(3, 0.0), max_sigma(3, 0.0);
    EXPECT_EQ(sample(2).at("imm_cv"), "");
    for (std::size_t k = 3; k <= 30; ++k) {
      const Numbers p = imm.take(position(k)), pi = himm.take(position(k));
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

TEST_F(RecognitionDemoManoeuvre, TheNumberOfThreadsChangesNoByte) {
  for (const std::string threads : {"1", "3"})
    recognition_demo_succeeds(
        {"manoeuvre", "--runs", "20", "--quiet", "--threads", threads, "--out", directory.path() / threads});
  for (const char* file : {"samples.csv", "runs.csv", "curves.csv"})
    EXPECT_EQ(contents(directory.path() / "1" / file), contents(directory.path() / "3" / file)) << file;
}

TEST_F(RecognitionDemoManoeuvre, SaysWhichTargetsMaxInferenceCanNeverPrefer) {
  const std::string output = recognition_demo({"manoeuvre", "--runs", "2"}).output;
  EXPECT_TRUE(
      says(output, {"max, of the HIMM can never prefer the airliner", "max, of the HIMM can never prefer the bomber"}));
  EXPECT_EQ(output.find("can never prefer the fighter"), std::string::npos) << output;
  EXPECT_EQ(output.find("sigma, of the IMM can never prefer"), std::string::npos) << output;
}

}  // namespace
