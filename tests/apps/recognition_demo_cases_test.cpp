#include "apps/recognition_demo_support.hpp"

namespace recognition_demo_cases_test {

const std::filesystem::path shared = std::filesystem::path(SIGMAX_DATA) / "..";

/// What is printed of a table of the cases, or of the data; without warnings if none is expected.
std::string evaluated(const std::filesystem::path& file, const std::string& label) {
  return recognition_demo_succeeds({"evaluate", shared / file, "--label", label, "--foldings", "2", "--wide"}).output;
}

class RecognitionDemoCases : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(shared / "cases"))
      GTEST_SKIP() << shared / "cases"
                   << " is absent";
  }
};

TEST_F(RecognitionDemoCases, OfRowsThatDependOnNothingNothingIsSaid) {
  for (const char* file : {"cases/reco_hour_false_alarm.csv", "cases/reco_smote_silent.csv"})
    EXPECT_EQ(evaluated(file, "y").find("warning"), std::string::npos) << file;
}

TEST_F(RecognitionDemoCases, IntervalsSayThatTheyDoNotCountTheTrainingRows) {
  EXPECT_TRUE(says(evaluated("cases/reco_xor_seed104.csv", "z"),
                   {"without the\nvariation of the training rows", "because, trained on these rows, it is"}));
}

TEST_F(RecognitionDemoCases, CalibrationIsInTheTable) {
  const std::string said = evaluated("cases/reco_breast_overconfident.csv", "target");
  EXPECT_TRUE(
      says(said, {"log-loss", "shares' log-loss", "calibration error, %", "0.660"}));  // the entropy of 357 : 212
}

TEST_F(RecognitionDemoCases, AConstantColumnIsLeftOut) {
  EXPECT_TRUE(
      says(evaluated("data/recognition/mushroom.csv", "edible"),
           {"column 'veil_type' holds 'p' in all of 8123 rows and is left out", "21 features", "Use max, ratio"}));
}

}  // namespace recognition_demo_cases_test
