/// Section VI against what its authors published, and against the truth where print and derivation part.

#include <nlohmann/json.hpp>

#include "apps/temporary_directory.hpp"
#include "support/program.hpp"

namespace section_six_test {

using Json = nlohmann::json;

Json simulate(std::vector<std::string> arguments) {
  const TemporaryDirectory directory;
  arguments.insert(arguments.begin(), "simulate");
  arguments.insert(arguments.end(), {"--quiet", "--out", directory.path()});
  const auto ending = program::succeeds(SIGMAX_HIMM_DEMO, arguments);
  return Json::parse(contents(directory.path() / "summary.json"));
}

constexpr std::array<const char*, 3> axes = {"x", "y", "z"};
constexpr std::array<const char*, 3> phases = {"before", "during", "after"};

/// Root mean square over the samples of each phase (10–80, 81–130, 131–200) of the curves in the repository
/// SongJgit/FuzzyIMMFilter, figs/Error_{x,y,z}.svg (50 runs), in m.
struct Published {
  const char* filter;
  std::array<std::array<double, 3>, 3> by_axis_and_phase;
};
constexpr std::array<Published, 3> published = {{
    {"measurement", {{{14.975, 12.815, 9.683}, {20.349, 17.378, 10.716}, {22.976, 18.926, 10.442}}}},
    {"imm", {{{7.321, 8.471, 5.134}, {9.685, 12.504, 6.156}, {11.023, 10.513, 5.624}}}},
    {"himm", {{{5.923, 8.275, 4.475}, {7.922, 12.014, 5.809}, {8.969, 10.392, 4.760}}}},
}};

/// RMSE of a filter minus that of another, with the half width of its interval.
std::pair<double, double> difference(const Json& summary, const std::string& filter, const std::string& minus,
                                     const char* phase, const char* axis) {
  for (const Json& comparison : summary.at("comparisons"))
    if (comparison.at("filter") == filter && comparison.at("minus") == minus) {
      const Json& interval = comparison.at("rmse_difference_m").at(phase).at(axis);
      const double mean = interval.at("mean"), upper = interval.at("upper");
      return {mean, upper - mean};
    }
  throw std::out_of_range(filter + " − " + minus);
}

TEST(SectionSix, TheReleasedPresetReproducesThePublishedCurvesWithin10Percent) {
  const Json summary = simulate({"--preset", "released", "--scenario", "1", "--group", "1", "--runs", "400"});
  for (const auto& [filter, by_axis] : published)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t phase = 0; phase < 3; ++phase) {
        const double found =
            summary.at("results").at(filter).at(std::string("rmse_") + phases[phase] + "_" + axes[axis] + "_m");
        const double expected = by_axis[axis][phase];
        EXPECT_NEAR(found, expected, 0.1 * expected) << filter << ", " << axes[axis] << " " << phases[phase];
      }
  // There, against the baseline with transposed weights, HIMM is better on every axis in every phase.
  for (const char* phase : phases)
    for (const char* axis : axes) {
      const auto [estimate, half_width] = difference(summary, "himm", "imm", phase, axis);
      EXPECT_LT(estimate + half_width, 0.0) << phase << " " << axis;
    }
}

TEST(SectionSix, AgainstTheCorrectImmHimmIsWorseWhileTheTargetManoeuvres) {
  const Json summary = simulate({"--preset", "released", "--runs", "100"});
  for (const char* axis : axes) {
    const auto [estimate, half_width] = difference(summary, "himm", "imm_correct", "during", axis);
    EXPECT_GT(estimate - half_width, 0.0) << axis;
  }
}

TEST(SectionSix, AsPrintedHimmIsWorseThanTheCorrectImmBeforeAndAfterTheManoeuvre) {
  const Json summary = simulate({"--preset", "paper_text", "--runs", "100"});
  for (const char* phase : {"before", "after"})
    for (const char* axis : axes) {
      const auto [estimate, half_width] = difference(summary, "himm", "imm", phase, axis);
      EXPECT_GT(estimate - half_width, 0.0) << phase << " " << axis;
    }
}

}  // namespace section_six_test
