// What recordings look like that nobody made for this program: units, tabs, clocks, sentinels, several sensors at once.

#include <nlohmann/json.hpp>

#include "apps/recordings.hpp"

namespace himm_demo_real_input_test {

/// A case of himm_demo_recordings.json, which says what its fields are.
struct Case {
  std::string name;
  nlohmann::json fields;

  std::string text(const char* key) const { return fields.value(key, ""); }
  std::vector<std::string> words(const char* key) const { return fields.value(key, std::vector<std::string>{}); }

  /// The same but for what that field tells, and without what is expected of it.
  Case changed_by(const char* key) const {
    Case other{name + " " + key, fields.at(key)};
    for (const char* same : {"rows", "where", "with"})
      if (fields.contains(same) && !other.fields.contains(same)) other.fields[same] = fields[same];
    return other;
  }
  friend void PrintTo(const Case& test, std::ostream* text) { *text << test.fields.at("rows"); }
};

std::vector<Case> cases() {
  std::ifstream file(SIGMAX_SOURCE "/tests/apps/himm_demo_recordings.json");
  const auto table = nlohmann::ordered_json::parse(file, nullptr, true, true);  // with comments
  std::vector<Case> result;
  for (const auto& [name, fields] : table.items()) result.push_back({name, fields});
  return result;
}

std::string recording_of(const Case& test) {
  const auto& rows = test.fields.at("rows");
  if (rows.is_string()) return rows;
  const std::string clock =
      "function clock(t) { if (seconds) return t; t %= 86400; "
      "return sprintf(\"%02d:%02d:%02d\", t / 3600, t / 60 % 60, t % 60) } ";
  const std::string begin =
      "BEGIN { OFS = \",\"; OFMT = CONVFMT = \"%.17g\"; n = 30; " + test.text("where") + "; print \"";
  const std::string below = "\"; for (k = 0; k < n; ++k) print ";
  return program::succeeds("/usr/bin/awk",
                           {clock + begin + rows[0].get<std::string>() + below + rows[1].get<std::string>() + " }"})
      .output;
}

void expect_same(const std::vector<TextRow>& rows, const std::vector<TextRow>& others,
                 const std::vector<std::string>& columns) {
  ASSERT_EQ(rows.size(), others.size());
  ASSERT_FALSE(rows.empty());
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (const auto& column : columns)
      EXPECT_CLOSE(number(rows[k].at(column)), number(others[k].at(column)), 1e-9) << column << " of row " << k;
}

/// Tracks a case, whose options a shell parts into words, and sees what it says and writes, but for its other way.
std::string tracked_as_told(const Case& test) {
  SCOPED_TRACE(test.name);
  const TemporaryDirectory directory;
  directory.write("real.csv", recording_of(test));
  const auto ending = program::succeeds(
      "/bin/sh", {"-c", "cd \"$1\"; exec \"$0\" track real.csv --quiet --out out " + test.text("with"),
                  program::chosen(SIGMAX_HIMM_DEMO), directory.path()});
  const std::string output = ending.on_one_line();
  std::string written = contents(directory.path() / "out" / "estimates.csv");
  for (const auto& words : test.words("says")) EXPECT_TRUE(says(output, {words}));
  for (const auto& words : test.words("never")) EXPECT_FALSE(says(output, {words})) << output;
  for (const auto& words : test.words("once")) EXPECT_EQ(output.find(words), output.rfind(words)) << output;
  for (const auto& words : test.words("writes")) EXPECT_TRUE(says(written, {words}));
  const std::string summary = contents(directory.path() / "out" / "summary.json");
  for (const auto& words : test.words("tells")) EXPECT_TRUE(says(summary, {words}));
  for (const auto& words : test.words("conceals")) EXPECT_FALSE(says(summary, {words}));
  const auto found = rows(written);
  EXPECT_EQ(found.size(), test.fields.value("estimates", found.size()));
  const auto last = test.fields.value("last", nlohmann::json::object());
  for (const auto& [column, value] : last.items()) {
    const std::string& cell = found.back().at(column);
    if (value.is_string())
      EXPECT_EQ(cell, value);
    else
      EXPECT_NEAR(number(cell), value.get<double>(), 1e-6) << column;
  }
  return written;
}

class RealInput : public testing::TestWithParam<Case> {};

TEST_P(RealInput, IsTakenAsItIsMeant) {
  const Case& test = GetParam();
  const std::string written = tracked_as_told(test);
  if (test.fields.contains("unlike")) EXPECT_NE(written, tracked_as_told(test.changed_by("unlike")));
  if (!test.fields.contains("as")) return;
  const std::string other = tracked_as_told(test.changed_by("as"));
  if (test.fields.contains("columns"))
    expect_same(rows(written), rows(other), test.words("columns"));
  else
    EXPECT_EQ(written, other);
}

INSTANTIATE_TEST_SUITE_P(HimmDemo, RealInput, testing::ValuesIn(cases()),
                         [](const auto& test) { return test.param.name; });

TEST(HimmDemoRealInput, TwoSensorsMayMeasureAtOneTime) {
  std::string both = "time_s,sensor,x_m,y_m\n", once = "time_s,x_m,y_m\n";
  for (int k = 0; k < 30; ++k) {
    for (const char* sensor : {",a,", ",b,"}) both += exact(k) + sensor + exact(10 * k) + ",7\n";
    once += exact(k) + "," + exact(10 * k) + ",7\n";
  }
  const auto found = estimates(both);
  const auto alone = estimates(once);
  EXPECT_EQ(number(found.back().at("time_s")), 29.0);
  EXPECT_NEAR(number(found.back().at("x_m")), 290.0, 1e-6);
  EXPECT_LT(number(found.back().at("sigma_x_m")), number(alone.back().at("sigma_x_m")));
}

TEST(HimmDemoRealInput, AHeightMayBeMissing) {
  const auto with = [](bool all) {
    return estimates(recording("time_s,x_m,y_m,z_m", [&](int k) {
      return exact(k) + "," + exact(10 * k) + ",7," + (all || k % 3 != 2 || k <= 5 ? exact(100 + 2 * k) : "");
    }));
  };
  const auto missing = with(false), whole = with(true);
  // As a height that is measured, but to nothing: what is known across is the same.
  for (const auto& row : missing) {
    EXPECT_NEAR(number(row.at("x_m")), 10.0 * number(row.at("time_s")), 1e-6);
    EXPECT_NEAR(number(row.at("z_m")), 100.0 + 2.0 * number(row.at("time_s")), 1e-6);
  }
  EXPECT_GT(number(missing.back().at("sigma_z_m")), 1.05 * number(whole.back().at("sigma_z_m")));
  EXPECT_LT(number(missing.back().at("sigma_x_m")), 1.05 * number(whole.back().at("sigma_x_m")));
}

double bend(int k) { return k < 15 ? 20.0 * k : 20.0 * k + 2.0 * (k - 15) * (k - 15) + (k % 4) - 1.5; }

TEST(HimmDemoRealInput, OneAxisIsATrackWhoseOtherAxisIsNeverSeen) {
  const auto one = recording("time_s,x_m", [](int k) { return exact(k) + "," + exact(bend(k)); });
  const auto blind = recording("time_s,x_m,y_m", [](int k) {  // but for the three points of the start
    return exact(k) + "," + exact(bend(k)) + (k < 3 ? ",5" : ",");
  });
  // Only the envelope (A-1) of the whole state is another one where there are more components.
  for (const char* set : {"smooth=true", "filters=[imm_released,imm_most_likely,gpb1,gpb2,static_random]",
                          "filters=[himm,himm_selected,himm_own,himm_released,himm_global,viterbi,static_fuzzy]",
                          "filters=[imm_histories,himm_histories]"}) {
    const Arguments settings = {set};
    const auto found = tracked(one, settings);
    EXPECT_TRUE(says(found.output, {"30 rows, 30 measurements, 1 axis"}));
    EXPECT_TRUE(says(tracked(blind, settings).output, {"30 measurements (27 along some axes only), 2 axes"}));
    const auto line = rows(found.estimates);
    expect_same(line, estimates(blind, settings),
                {"x_m", "vx_mps", "sigma_x_m", "sigma_vx_mps", "nis", "weight_dwna", "weight_dwpa"});
    EXPECT_EQ(line.back().at("y_m") + line.back().at("vy_mps") + line.back().at("sigma_y_m"), "");
  }
}

TEST(HimmDemoRealInput, OneAxisRestartsMeetsATruthAndMakesAPage) {
  const TemporaryDirectory directory;
  const auto one = recording("time_s,x_m,true_x_m",
                             [](int k) { return exact(k) + "," + exact(k < 15 ? k : 1e4 + k) + "," + exact(k); });
  const auto found = tracked(one, {"gate_probability=0.999"}, {"--report", directory.path() / "page.html"});
  EXPECT_TRUE(says(found.output, {"after rejections in a row: imm 1, himm 1"}));
  EXPECT_TRUE(says(found.output, {"measurement    30  7071.07 imm"}));  // every other row is 10 km off
  const std::string page = contents(directory.path() / "page.html");
  EXPECT_TRUE(says(page, {"Error in x"}));
  EXPECT_EQ(page.find("Error in y"), std::string::npos);
}

TEST(HimmDemoRealInput, EachAxisOfAPositionMayBeMissing) {
  const auto by_turns = recording("time_s,x_m,y_m", [](int k) {
    if (k < 3) return exact(k) + "," + exact(bend(k)) + ",7";
    return exact(k) + (k % 2 == 0 ? "," + exact(bend(k)) + "," : ",," + exact(3.0 * k));
  });
  const auto x_alone =
      recording("time_s,x_m", [](int k) { return exact(k) + (k < 3 || k % 2 == 0 ? "," + exact(bend(k)) : ","); });
  // With one model the axes know nothing of each other.
  const Arguments one_model = {"filters=[imm]", "models=[dwpa]", "transition_probability=[[1]]"};
  expect_same(estimates(by_turns, one_model), estimates(x_alone, one_model),
              {"x_m", "vx_mps", "ax_mps2", "sigma_x_m", "sigma_vx_mps"});
}

TEST(HimmDemoRealInput, NoNameCommandsTheTerminal) {
  const TemporaryDirectory directory;
  const std::string clear = "\x1B[2J\xC2\x9B\x31m";
  const auto hostile = recording("time_s,sensor,ship,x" + clear + ",y_m", [&](int k) {
    return exact(k) + ",radar" + clear + ",ship" + clear + "," + exact(k == 20 ? 1e5 : k) + ",7";
  });
  const std::string file = directory.write("real" + clear + ".csv", hostile);
  const std::vector<std::string> columns = {"--columns", "x_m=x" + clear};
  const std::string key = R"(sensor."radar\u001B[2J\u009B1m".sigma_position_m)";
  const auto run = [&](std::vector<std::string> more) {
    const auto ending = program::run(SIGMAX_HIMM_DEMO, Arguments{"track", file, "--columns", "x_m=x" + clear} + more);
    EXPECT_EQ(ending.output.find('\x1B'), std::string::npos) << ending.output;
    EXPECT_EQ(ending.output.find("\xC2\x9B"), std::string::npos) << ending.output;
    return ending;
  };
  const auto whole =
      program::succeeded(run({"--track-id", "ship", "--out", directory.path() / ("out" + clear), "--set", key + "=3",
                              "--set", "filters=[himm_histories]", "--set", "explain=true"}));
  EXPECT_TRUE(
      says(whole.on_one_line(), {R"(radar\x1B[2J\x9B1m 30)", R"(x\x1B[2J\x9B1m in m)", R"(of ship\x1B[2J\x9B1m)",
                                 R"(to )", R"(out\x1B[2J\x9B1m)", R"(real\x1B[2J\x9B1m.csv:22: 1 outlier)"}));
  // Files keep the bytes.
  EXPECT_TRUE(says(contents(directory.path() / ("out" + clear) / "estimates.csv"), {",ship" + clear + ","}));
  EXPECT_EQ(run({"--set", "a" + clear + "=3"}).status, 3);
  EXPECT_EQ(run({"--track-id", "none" + clear}).status, 3);
  EXPECT_EQ(run({"--set", key + "=-3"}).status, 3);
  const auto settings =
      program::succeeded(run({"--set", key + "=3", "--set", R"(filters=["imm a","himm\u0007"])", "--print-config"}));
  EXPECT_EQ(run({"--config", directory.write("same.toml", settings.output), "--print-config"}).output, settings.output);
}

}  // namespace himm_demo_real_input_test
