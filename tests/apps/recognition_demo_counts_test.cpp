#include "apps/recognition_demo_support.hpp"

namespace recognition_demo_counts_test {

class RecognitionDemoCounts : public InDirectory {};

TEST_F(RecognitionDemoCounts, AreLearnedAsTheyStand) {
  const std::string model = directory.path() / "model.json";
  const auto counts =
      directory.write("counts.csv",
                      "class,feature,lower,upper,count\n"
                      "slow,airspeed,0,100,30\nslow,airspeed,100,300,10\nslow,turn,-8,2,10\nslow,turn,2,8,40\n"
                      "fast,airspeed,0,100,10\nfast,airspeed,100,300,90\nfast,turn,-8,2,25\nfast,turn,2,8,75\n");
  const auto ending = recognition_demo_succeeds(
      {"train", counts, "--label", "class", "--counts", "--smoothing", "0", "--equal-prior", "--model", model});
  EXPECT_TRUE(says(ending.output, {"slow, 50 counted", "every class equally plausible before"}));
  const auto data = directory.write("reports.csv", "airspeed,turn\n99,2.2\n100,\n");
  recognition_demo_succeeds({"classify", model, data, "--quiet", "--out", directory.path() / "out"});
  // p(airspeed|class) is 0.75, 0.25 and 0.1, 0.9, p(turn|class) 0.2, 0.8 and 0.25, 0.75; π of two values by either
  // transform is p/greatest or p itself, and 1.
  const std::map<std::string, std::array<double, 2>> fast = {
      {"sigma", {0.1 * 0.75 / (0.75 * 0.8 + 0.1 * 0.75), 0.9 / 1.15}},
      {"max, ratio scale", {0.1 / 0.9, 1.0}},
      {"max, Dubois-Prade", {0.1, 1.0}}};
  std::size_t compared = 0;
  for (const auto& row : rows_of(directory.path() / "out" / "predictions.csv")) {
    const double expected = fast.at(row.at("classifier"))[std::stoul(row.at("line")) - 2];
    EXPECT_CLOSE(std::stod(row.at("fast")), expected, 1e-12) << row.at("classifier");
    ++compared;
  }
  EXPECT_EQ(compared, 6U);
}

}  // namespace recognition_demo_counts_test
