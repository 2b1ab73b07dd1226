#include <nlohmann/json.hpp>

#include "apps/campaigns.hpp"

namespace himm_demo_reproduce_test {

class HimmDemoReproduce : public InDirectory {};

TEST_F(HimmDemoReproduce, ItsErrorsAreThoseOfSimulate) {
  campaign(directory.path() / "all", words("reproduce --runs 6 --seed 3"));
  const auto rows = rows_of(directory.path() / "all" / "filters.csv");
  for (const std::string preset : {"paper_text", "released"}) {
    campaign(directory.path() / preset,
             words("simulate --runs 6 --seed 3 --scenario 2 --group 1 --preset " + preset) +
                 setting({"filters=[imm_correct,imm_released,himm,himm_selected,himm_5,gpb2,viterbi]",
                          "filter.imm_correct.imm_mixing=correct", "filter.himm_5.sigma_w=5"}));
    const auto simulated = nlohmann::json::parse(contents(directory.path() / preset / "summary.json")).at("results");
    const std::string reading = preset == "released" ? "released" : "own";
    const std::map<std::string, std::string> names = {{"measurement", "measurement"},
                                                      {"imm", "imm_correct"},
                                                      {"imm_released", "imm_released"},
                                                      {"himm_" + reading, "himm"},
                                                      {"himm_selected", "himm_selected"},
                                                      {"himm_" + reading + "_5", "himm_5"},
                                                      {"gpb2", "gpb2"},
                                                      {"viterbi", "viterbi"}};
    for (const auto& [name, simulated_as] : names) {
      const auto row = row_with(rows, {{"preset", preset}, {"scenario", "2"}, {"group", "1"}, {"filter", name}});
      for (const std::string key : {"rmse_before_x_m", "rmse_during_y_m", "rmse_after_z_m"}) {
        const double expected = simulated.at(simulated_as).at(key);
        EXPECT_NEAR(std::stod(row.at(key)), expected, 1e-9 * expected) << preset << " " << name << " " << key;
      }
    }
  }
}

TEST_F(HimmDemoReproduce, AFigureIsOfThoseErrorsAndTheirIntervalsHoldTogether) {
  campaign(directory.path(), {"reproduce", "--runs", "8"});
  const auto errors = rows_of(directory.path() / "filters.csv");
  const auto figures = rows_of(directory.path() / "figures.csv");
  const std::map<std::string, std::string> where = {{"preset", "released"}, {"scenario", "1"}, {"group", "1"}};
  const auto error = [&](const std::string& filter) {
    auto keys = where;
    keys["filter"] = filter;
    return std::stod(row_with(errors, keys).at("rmse_during_y_m"));
  };
  auto keys = where;
  keys.insert({{"sentence", "1"}, {"reading", "released"}, {"imm", "released"}, {"phase", "during"}, {"axis", "y"}});
  const auto figure = row_with(figures, keys);
  EXPECT_NEAR(std::stod(figure.at("value")), error("himm_released") / error("imm_released") - 1.0, 1e-9);

  // The same figure is one of 9 of sentence 1 and one of 18 of the first of section VI.E: wider by the quantiles of
  // Student's t with 7 degrees of freedom, 4.7309 at 1 − 0.025/18 (and 4.0294 at 1 − 0.025/9).
  keys["sentence"] = "31";
  const auto wider = row_with(figures, keys);
  const auto width = [](const auto& row) {
    return std::stod(row.at("value_upper")) - std::stod(row.at("value_lower"));
  };
  EXPECT_EQ(wider.at("value"), figure.at("value"));
  EXPECT_GT(width(wider), 1.1 * width(figure));
  EXPECT_LT(width(wider), 1.25 * width(figure));
}

TEST_F(HimmDemoReproduce, ASeededPartIsAsRecorded) {
  campaign(directory.path(), {"reproduce", "--runs", "10"});
  const auto rows = rows_of(directory.path() / "filters.csv");
  struct Recorded {
    const char *preset, *scenario, *group, *filter;
    double before_x, during_y, after_z;
  };
  for (const auto& recorded :
       {Recorded{"paper_text", "1", "1", "imm", 6.742985, 11.68266, 5.146152},
        Recorded{"paper_text", "1", "3", "himm_own", 6.33649, 19.96841, 5.970429},
        Recorded{"paper_text", "2", "1", "himm_own_5", 741.7164, 1079.54, 675.0493},
        Recorded{"paper_text", "2", "4", "gpb2", 1564.274, 2215.572, 1327.469},
        Recorded{"released", "1", "1", "imm_released", 7.446165, 12.13101, 5.998656},
        Recorded{"released", "1", "2", "himm_released", 5.754072, 12.49916, 4.626061},
        Recorded{"released", "2", "3", "himm_selected", 709.8293, 731.2975, 739.8275},
        Recorded{"released", "2", "4", "viterbi", 1690.3, 2178.498, 1394.644},
        Recorded{"released", "1", "4", "imm_released_most_likely", 17.88785, 28.8118, 17.72906}}) {
    const auto row = row_with(rows, {{"preset", recorded.preset},
                                     {"scenario", recorded.scenario},
                                     {"group", recorded.group},
                                     {"filter", recorded.filter}});
    for (const auto& [key, value] : {std::pair{"rmse_before_x_m", recorded.before_x},
                                     {"rmse_during_y_m", recorded.during_y},
                                     {"rmse_after_z_m", recorded.after_z}})
      EXPECT_NEAR(std::stod(row.at(key)), value, 1e-4 * value) << recorded.filter;
  }
}

TEST_F(HimmDemoReproduce, TheNumberOfThreadsChangesNoByte) {
  const auto one = campaign(directory.path() / "1", {"reproduce", "--runs", "3", "--threads", "1"});
  const auto three = campaign(directory.path() / "3", {"reproduce", "--runs", "3", "--threads", "3"});
  EXPECT_EQ(results(directory.path() / "1"), results(directory.path() / "3"));
  EXPECT_EQ(one.substr(0, one.find("\nWrote ")), three.substr(0, three.find("\nWrote ")));
  const auto none = program::run(SIGMAX_HIMM_DEMO, {"reproduce", "--runs", "3"});
  EXPECT_EQ(none.output, one.substr(0, one.find("\nWrote "))) << "nothing depends on --out";
}

TEST_F(HimmDemoReproduce, KilledAndStartedAgainItEndsWithTheSameBytes) {
  const Arguments arguments = {"reproduce", "--runs", "5", "--threads", "2"};
  campaign(directory.path() / "whole", arguments);
  campaign_with_kills(directory.path() / "killed", arguments);
  EXPECT_EQ(results(directory.path() / "killed"), results(directory.path() / "whole"));
}

TEST_F(HimmDemoReproduce, ShardsMergeIntoTheSameBytes) {
  const Arguments arguments = {"reproduce", "--runs", "3"};
  campaign(directory.path() / "whole", arguments);
  for (const std::string shard : {"1/2", "2/2"})
    campaign(directory.path() / shard.substr(0, 1), arguments + Arguments{"--shard", shard});
  const auto merge = [&](const Arguments& parts) {
    return program::run(SIGMAX_HIMM_DEMO,
                        arguments + Arguments{"--merge"} + parts + Arguments{"--out", directory.path() / "merged"});
  };
  const auto half = merge({directory.path() / "1"});
  EXPECT_EQ(half.status, 3);
  EXPECT_TRUE(says(half.output, {"24 of 48 cells are missing, the first is number 1"}));
  const auto whole = program::succeeded(merge({directory.path() / "1", directory.path() / "2"}));
  EXPECT_EQ(results(directory.path() / "merged"), results(directory.path() / "whole"));
}

TEST_F(HimmDemoReproduce, RanksGiveTheSameBytes) {
  if (!has_mpirun()) GTEST_SKIP() << "there is no mpirun";
  const Arguments arguments = {"reproduce", "--runs", "3"};
  campaign(directory.path() / "whole", arguments);
  const auto ending = run_in_ranks(arguments + Arguments{"--quiet", "--out", directory.path() / "ranks"});
  if (ending.output.find("this build has no MPI") != std::string::npos) {
    EXPECT_NE(ending.status, 0);
    GTEST_SKIP() << "this build has no MPI, and says so";
  }
  ASSERT_EQ(ending.status, 0) << ending.output;
  EXPECT_EQ(results(directory.path() / "ranks"), results(directory.path() / "whole"));
}

}  // namespace himm_demo_reproduce_test
