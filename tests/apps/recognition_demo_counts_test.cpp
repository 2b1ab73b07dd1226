#include "apps/recognition_demo_support.hpp"

namespace recognition_demo_counts_test {

class RecognitionDemoCounts : public InDirectory {};

TEST_F(RecognitionDemoCounts, AreLearnedAsPlainLoopsDo) {
  const std::string model = directory.path() / "model.json";
  const auto ending =
      recognition_demo_succeeds({"train", directory.write("counts.csv", counts_csv()), "--label", "class", "--counts",
                                 "--smoothing", "0", "--equal-prior", "--model", model});
  EXPECT_TRUE(says(ending.output, {"slow, 100 counted", "every class equally plausible before"}));
  const auto data = directory.write("reports.csv",
                                    "altitude_layer_ft_agl,airspeed_kt,vertical_rate_ft_per_min,turn_rate_deg_per_s\n"
                                    "100,90,300,2.2\n1050,99,-10,7\n1100,100,,0\n");
  recognition_demo_succeeds({"classify", model, data, "--quiet", "--out", directory.path() / "out"});

  const std::map<std::string, std::vector<std::size_t>> bins = {{"altitude_layer_ft_agl", {0, 1, 1}},
                                                                {"airspeed_kt", {0, 0, 1}},
                                                                {"vertical_rate_ft_per_min", {1, 0}},
                                                                {"turn_rate_deg_per_s", {1, 1, 0}}};
  std::size_t compared = 0;
  for (const auto& row : rows_of(directory.path() / "out" / "predictions.csv")) {
    const std::string& name = row.at("classifier");
    const std::size_t report = std::stoul(row.at("line")) - 2;
    Numbers belief(2, 1.0);
    for (const auto& [feature, table] : counts) {
      if (report >= bins.at(feature).size()) continue;  // an empty cell
      for (std::size_t c = 0; c < 2; ++c) {
        const Numbers p = divided(table[c], sum(table[c]));
        const Numbers numbers = name == "sigma" ? p : name == "max, ratio scale" ? by_ratio(p) : by_dubois_prade(p);
        belief[c] *= numbers[bins.at(feature)[report]];
      }
    }
    belief = divided(belief, name == "sigma" ? sum(belief) : greatest(belief));
    EXPECT_CLOSE((Numbers{std::stod(row.at("slow")), std::stod(row.at("fast"))}), belief, 1e-9) << name;
    ++compared;
  }
  EXPECT_EQ(compared, 9U);
}

}  // namespace recognition_demo_counts_test
