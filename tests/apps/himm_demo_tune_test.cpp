#include <complex>

#include <nlohmann/json.hpp>

#include "apps/recordings.hpp"
#include "shell/text.hpp"

namespace himm_demo_tune_test {

using support::degree;

/// A target with noise on its acceleration of 1 m/s² that is seen to 20 m, every second or so many; the truth beside
/// it.
std::string recording(std::size_t rows, bool truth, std::size_t step = 1) {
  std::mt19937_64 generator(3);
  std::normal_distribution<double> normal;
  std::ostringstream text;
  text.precision(10);
  text << "time_s,x_m,y_m" << (truth ? ",true_x_m,true_y_m" : "") << "\n";
  std::array<double, 2> x{}, v{80.0, -40.0};
  for (std::size_t k = 0; k < rows; ++k) {
    text << k * step;
    for (std::size_t second = 0; second < step; ++second)
      for (std::size_t i = 0; i < 2; ++i) {
        const double w = normal(generator);
        x[i] += v[i] + 0.5 * w;
        v[i] += w;
      }
    for (const double each : x) text << "," << each + 20.0 * normal(generator);
    if (truth) text << "," << x[0] << "," << x[1];
    text << "\n";
  }
  return text.str();
}

program::Ending tune(const Arguments& arguments) {
  return program::run(SIGMAX_HIMM_DEMO, Arguments{"tune"} + arguments);
}

bool cannot_tune() { return tune({"no.csv"}).output.find("built without an optimiser") != std::string::npos; }

Arguments quickly(const std::string& file, const Arguments& more = {}) {
  return Arguments{file} + words("--set filters=imm --models dwna --starts 1 --folds 2") + more;
}

/// The number after "key = " or "key = [".
double value_in(const std::string& toml, const std::string& key) {
  const auto at = toml.find("\n" + key + " = ");
  if (at == std::string::npos) return std::nan("");
  const auto from = toml.find_first_of("0123456789", at + key.size() + 3);
  return std::stod(toml.substr(from));
}

class Tune : public InDirectory {
 protected:
  void SetUp() override {
    if (cannot_tune()) GTEST_SKIP() << "built without NLopt";
  }

  /// The settings that `tune` writes.
  std::string fitted(const Arguments& arguments) const {
    program::succeeded(tune(arguments + Arguments{"--out", best}));
    return contents(best);
  }

  const std::string best = (directory.path() / "best.toml").string();
};

TEST_F(Tune, FindsTheNoisesThatMadeTheRecordingAndTrackTakesThem) {
  const auto file = directory.write("flight.csv", recording(400, false));
  const auto ending = program::succeeded(tune(quickly(file, {"--out", best})));
  EXPECT_TRUE(says(ending.output, {"optimistic sensor"}));
  const std::string after = ending.output.substr(ending.output.find("with the best settings"));
  EXPECT_EQ(after.find("optimistic"), std::string::npos) << ending.output;
  std::istringstream lines(ending.output.substr(0, ending.output.find("\nWrote ")));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(display_width(line), 80U) << line;
  const std::string toml = contents(best);
  EXPECT_NEAR(value_in(toml, "sigma_position_m"), 20.0, 2.0) << toml;
  EXPECT_NEAR(value_in(toml, "sigma_w"), 1.0, 0.3) << toml;
  program::succeeds(SIGMAX_HIMM_DEMO, {"track", file, "--config", best});
}

TEST_F(Tune, GivesTheSameSettingsOnAnyNumberOfThreads) {
  const auto file = directory.write("flight.csv", recording(120, false));
  std::vector<std::string> found;
  for (const std::string threads : {"1", "3"}) {
    found.push_back(fitted(words("--set filters=himm --starts 2 --folds 2 --models dwna,dwna+dwpa") +
                           Arguments{file, "--threads", threads}));
  }
  EXPECT_EQ(found[0], found[1]);
}

TEST_F(Tune, JudgesByTheTruthIfAsked) {
  const auto file = directory.write("flight.csv", recording(300, true));
  const auto by_rmse = program::succeeded(tune(quickly(file, {"--truth", "--out", best})));
  EXPECT_TRUE(says(by_rmse.output, {"RMSE against the truth"}));
  // what the RMSE tells is the ratio of the noises, 1 to 20, and the sensors stay at 10 m
  EXPECT_NEAR(value_in(contents(best), "sigma_w"), 0.5, 0.25) << contents(best);
  EXPECT_EQ(value_in(contents(best), "sigma_position_m"), 10.0);
}

TEST_F(Tune, KeepsWhatItIsTold) {
  const auto file = directory.write("flight.csv", recording(120, false));
  const auto ending = program::succeeded(tune(quickly(file, {"--keep", "models,sensors"})));
  EXPECT_TRUE(says(ending.output, {"No setting changes"}));
}

TEST_F(Tune, SaysWhichColumnsAndRowsDoNotCount) {
  std::istringstream lines(recording(60, false));
  std::string text;
  for (std::string line; std::getline(lines, line);) text += line + (text.empty() ? ",vx_mps\n" : ",80\n");
  const auto file = directory.write("flight.csv", text + text.substr(text.rfind('\n', text.size() - 2) + 1));
  const auto ending = program::succeeded(tune(quickly(file, {"--keep", "models,sensors", "--on-bad-time", "skip"})));
  EXPECT_TRUE(says(ending.on_one_line(), {"flight.csv: Not used: vx_mps (give --set sigma_velocity_mps=…)",
                                          "not after that of the row before: 1"}));
}

/// The recording with lines changed: the numbers of a row, and which it is.
std::string changed(const std::string& text, const std::function<void(std::vector<double>&, std::size_t)>& change) {
  std::istringstream lines(text);
  std::ostringstream result;
  result.precision(10);
  std::string line;
  std::getline(lines, line);
  result << line << "\n";
  for (std::size_t k = 0; std::getline(lines, line); ++k) {
    std::vector<double> numbers;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) numbers.push_back(std::stod(cell));
    change(numbers, k);
    for (std::size_t i = 0; i < numbers.size(); ++i) result << (i == 0 ? "" : ",") << numbers[i];
    result << "\n";
  }
  return result.str();
}

TEST_F(Tune, SetsAsideWhatNoFilterExpectsAndTrackGatesIt) {
  const std::set<std::size_t> stray = {60, 61, 200, 333};
  const auto text = changed(recording(400, false), [&](std::vector<double>& row, std::size_t k) {
    if (stray.contains(k)) row[1] += 4000.0;
  });
  const auto file = directory.write("flight.csv", text);
  const auto page = (directory.path() / "p.html").string();
  program::succeeded(tune(quickly(file, {"--out", best, "--report", page})));
  const std::string toml = contents(best);
  EXPECT_NEAR(value_in(toml, "sigma_position_m"), 20.0, 2.0) << toml;
  EXPECT_NEAR(value_in(toml, "sigma_w"), 1.0, 0.3) << toml;
  EXPECT_TRUE(says(contents(page), {"held out, by fold"}));
  const auto tracked = program::succeeds(SIGMAX_HIMM_DEMO, {"track", file, "--config", best});
  EXPECT_TRUE(says(tracked.on_one_line(), {"Measurements that the gate turned away: imm 4"}));
}

TEST_F(Tune, FitsNoSigmaBelowTheRoundingOfItsColumn) {
  const auto text = changed(recording(200, false), [](std::vector<double>& row, std::size_t k) {
    row = {row[0], 50.0 * static_cast<double>(k / 20), 0.0};  // a target that mostly stands where it stood
  });
  const auto ending = program::succeeded(
      tune(quickly(directory.write("flight.csv", text), {"--out", best, "--set", "sigma_position_m=40"})));
  EXPECT_TRUE(says(ending.output, {"no less: its column is rounded"}));
  EXPECT_NEAR(value_in(contents(best), "sigma_position_m"), 50.0 / std::sqrt(12.0), 0.01);
}

TEST_F(Tune, FindsTheNoisesWhereFixesAreHoursApart) {
  const auto text = changed(recording(150, false), [](std::vector<double>& row, std::size_t) { row[0] *= 7200.0; });
  const auto toml = fitted(quickly(directory.write("collar.csv", text)));
  EXPECT_NEAR(value_in(toml, "sigma_position_m"), 20.0, 4.0) << toml;
  EXPECT_NEAR(7200.0 * 7200.0 * value_in(toml, "sigma_w"), 1.0, 0.4) << toml;
}

TEST_F(Tune, TurnsVelocitiesOfRowsWithoutAPlaceIntoTheFrame) {
  std::mt19937_64 generator(3);
  std::normal_distribution<double> normal;
  std::string text = "time_s,latitude_deg,longitude_deg,speed_mps,course_deg\n";
  const double degree_m = 111300.0, shrunk_m = degree_m * 0.5;  // at 60°, along a parallel
  for (int k = 0; k < 300; ++k)
    text += k % 2 == 0 ? fmt::format("{},{:.8f},{:.8f},,\n", 2 * k, 60.0 + 5.0 * normal(generator) / degree_m,
                                     4.0 + (460.0 * k + 5.0 * normal(generator)) / shrunk_m)
                       : fmt::format("{},,,{:.3f},90\n", 2 * k, 230.0 + 0.3 * normal(generator));
  const auto toml = fitted(quickly(directory.write("flight.csv", text), {"--set", "sigma_velocity_mps=0.3"}));
  EXPECT_NEAR(value_in(toml, "sigma_velocity_mps"), 0.4, 0.2) << toml;
}

TEST_F(Tune, TakesNoEvenMotionForRounding) {
  const auto text = changed(recording(120, false), [](std::vector<double>& row, std::size_t k) {
    const double noise = std::cos(7.0 * static_cast<double>(k * k));
    row = {row[0], 45.0 * row[0] + 0.3 * noise, 0.4 * noise - 40.0 * row[0]};
  });
  const auto ending = program::succeeded(tune(quickly(directory.write("flight.csv", text))));
  EXPECT_EQ(ending.output.find("its column is rounded"), std::string::npos) << ending.output;
}

TEST_F(Tune, LeavesASigmaAsItIsWhoseColumnsNeverChange) {
  const auto text =
      changed(recording(100, false), [](std::vector<double>& row, std::size_t) { row[1] = row[2] = 7.0; });
  const auto ending = program::succeeded(tune(quickly(directory.write("flight.csv", text))));
  EXPECT_TRUE(says(ending.on_one_line(), {"all rows: a column never changes, which no noise does"}));
  EXPECT_EQ(ending.output.find("sigma_position_m"), std::string::npos) << ending.output;
}

TEST_F(Tune, TriesModelsOfContinuousTimeWhereStepsVaryOrVelocitiesCount) {
  const auto text = changed(recording(120, false), [](std::vector<double>& row, std::size_t k) {
    row[0] += k % 3 == 0 ? 0.6 : 0.0;  // steps of 1, 0.4 and 1.6 s
  });
  const Arguments few = words("--set filters=imm --starts 1 --folds 2");
  const auto ending = program::succeeded(tune(few + Arguments{directory.write("flight.csv", text), "--out", best}));
  EXPECT_TRUE(says(ending.output, {"cwna+cwpa"}));
  const auto asked = program::succeeded(tune(few + Arguments{directory.path() / "flight.csv", "--models", "dwna"}));
  EXPECT_EQ(asked.output.find("cwna"), std::string::npos) << asked.output;
  const auto moving = directory.write(
      "moving.csv", apps::recording(
                        "time_s,x_m,y_m,vx_mps,vy_mps",
                        [](int k) { return fmt::format("{},{},{},{},7", k, 20 * k + k % 3, 7 * k, 20 + k % 2); }, 90));
  const Arguments counts = {"--set", "sigma_velocity_mps=1", moving};
  EXPECT_TRUE(says(program::succeeded(tune(few + counts)).output, {"cwna+cwpa"}));
}

TEST_F(Tune, FindsTheNoiseOfVelocitiesBesideThatOfATargetWhichTurns) {
  std::mt19937_64 generator(5);
  std::normal_distribution<double> normal;
  const auto noise = [&](double sigma) { return sigma * std::complex(normal(generator), normal(generator)); };
  const std::complex<double> rate(0.0, -0.07), turned = std::exp(rate);  // each second
  std::complex<double> x, v(20.0);
  const auto row = [&](int k) {
    const auto w = noise(0.5), seen = (x += v * (turned - 1.0) / rate + w / 2.0 + noise(0.144)) + noise(8.0);
    const auto told = (v = v * turned + w) + noise(0.5);
    return fmt::format("{},{},{},{},{}", k, seen.real(), seen.imag(), told.real(), told.imag());
  };
  const auto file = directory.write("flight.csv", apps::recording("time_s,x_m,y_m,vx_mps,vy_mps", row, 500));
  const auto toml =
      fitted(words("--set filters=imm --starts 1 --set sigma_velocity_mps=1 --models known_turn") + Arguments{file});
  EXPECT_NEAR(value_in(toml, "sigma_velocity_mps"), 0.5, 0.1) << toml;
  EXPECT_NEAR(value_in(toml, "sigma_w"), 0.5, 0.1) << toml;
}

/// Of recordings of which a fit once made a filter 1.5 to 2.4 times worse than its defaults.
TEST_F(Tune, IsNeverWorseThanWhatItBeganWithAsWritten) {
  const std::string file = SIGMAX_DATA "/../cases/tune_himm_worse_sky_40774f.csv";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no recording " << file;
  const auto summary = (directory.path() / "s.json").string();
  const auto found = [&](const Arguments& more) {
    program::succeeded(tune(Arguments{file, "--summary", summary} + more));
    return nlohmann::json::parse(contents(summary)).at("filters").at("himm").at("candidates");
  };
  const auto first = found(Arguments{"--out", best} + words("--set filters=himm"));
  double least = first.at("as before").at("fitted").get<double>(), fitted = least;
  for (const auto& [name, candidate] : first.items())
    if (candidate.at("remark").get<std::string>().starts_with("best")) fitted = candidate.at("fitted").get<double>();
  EXPECT_LE(fitted, least);
  const auto again =
      found(Arguments{"--config", best} + words("--set filters=himm --keep models,sensors,transition,augmentation"));
  EXPECT_NEAR(again.at("as before").at("fitted").get<double>(), fitted, 1e-9) << "what was written is what was scored";
}

TEST_F(Tune, TellsTheErrorOfEachNumberAndWhichTheRowsDoNotTell) {
  const auto ending = program::succeeded(tune(quickly(directory.write("flight.csv", recording(300, false)))));
  const std::string after = ending.output.substr(ending.output.find("standard error"));
  EXPECT_TRUE(says(after, {"sigma_w of dwna", "± 0.", "sigma_position_m"}));
  EXPECT_EQ(after.find("not identifiable"), std::string::npos) << after;
  std::mt19937_64 generator(5);
  std::normal_distribution<double> noise(0.0, 20.0);  // of a target that flies straight, without noise of its own
  const auto straight = changed(recording(60, false), [&](std::vector<double>& row, std::size_t) {
    row = {row[0], 80.0 * row[0] + noise(generator), noise(generator)};
  });
  const auto flat = program::succeeded(tune(quickly(directory.write("straight.csv", straight))));
  EXPECT_TRUE(says(flat.output, {"not identifiable from these rows"}));
}

struct Refusal {
  std::vector<std::string> arguments;
  int status;
  std::string words;
};

TEST_F(Tune, RefusesWhatCannotBeAndWritesNothing) {
  const auto file = directory.write("flight.csv", recording(60, false));
  const auto three = directory.write("three.csv", "time_s,x_m,y_m,z_m\n0,1,2,3\n");
  const auto tiny = directory.write("tiny.csv", recording(12, false));
  const auto bad = directory.write("bad.csv", "time_s,x_m,y_m\n0,1,2\n1,x,2\n");
  const auto out = (directory.path() / "best.toml").string();
  const std::vector<Refusal> refusals = {{{file, "--truth"}, 3, "no column true_x_m"},
                                         {{tiny}, 3, "there is too little to fit"},
                                         {{bad}, 3, "bad.csv:3: column 'x_m'"},
                                         {{file, three}, 3, "tune recordings of one, two and three axes apart"},
                                         {{file, "--models", "dwna+dvpa"}, 2, "did you mean 'dwpa'?"},
                                         {{file, "--keep", "noise"}, 2, "noise"},
                                         {{file, "--set", "filters=himm_possibility"}, 3, "himm_possibility"},
                                         {{file, "--set", "sigma_w=-1"}, 3, "sigma_w"},
                                         {{"-"}, 2, "standard input"}};
  for (const auto& refusal : refusals) {
    auto arguments = refusal.arguments;
    arguments.insert(arguments.end(), {"--out", out});
    const auto ending = tune(arguments);
    EXPECT_EQ(ending.status, refusal.status) << ending.output;
    EXPECT_TRUE(says(ending.output, {refusal.words}));
    EXPECT_FALSE(std::filesystem::exists(out)) << ending.output;
  }
  const auto over = tune({file, "--out", file});
  EXPECT_EQ(over.status, 2);
  EXPECT_TRUE(says(over.output, {"would write over the input"}));
}

TEST_F(Tune, ComesNearTheTrueSigmasOfARecordedLidarAndRadar) {
  const std::string file = recorded("lidar_radar.csv");
  if (file.empty()) GTEST_SKIP() << "no recordings in " SIGMAX_DATA;
  const std::string toml = fitted(quickly(file, {"--set", "sigma_w=1"}));
  const std::string lidar = toml.substr(toml.find("sensor.\"lidar\"")),
                    radar = toml.substr(toml.find("sensor.\"radar\""));
  EXPECT_NEAR(value_in(lidar, "sigma_position_m"), 0.15, 0.03) << toml;
  EXPECT_NEAR(value_in(radar, "sigma_range_m"), 0.3, 0.06) << toml;
  EXPECT_NEAR(value_in(radar, "sigma_azimuth_deg"), 1.72, 0.4) << toml;
}

TEST(HimmDemoTune, BearingsAreJudgedFromAGivenStartAndRefusedWithoutOne) {
  if (cannot_tune()) GTEST_SKIP() << "built without an optimiser";
  std::mt19937_64 generator(7);
  std::normal_distribution<double> noise(0.0, 0.1);
  const auto row = [&](int k) {
    return exact(k) + "," +
           exact(std::atan2(5000.0 - 20.0 * k, 1000.0 + 50.0 * k) / support::degree + noise(generator));
  };
  const TemporaryDirectory directory;
  const std::string file = directory.write("bearings.csv", apps::recording("time_s,azimuth_deg", row, 60));
  const auto without = tune(quickly(file));
  EXPECT_EQ(without.status, 3);
  EXPECT_TRUE(says(without.output, {"its start needs whole positions", "sensor.NAME.at=[E,N]"}));
  const auto start = setting({"start=given", "start_mean=[1000,5000,0,50,-20,0,0,0,0]", "start_time_s=-1",
                              "start_covariance_diagonal=[10000,10000,1,25,25,1,1,1,1]", "sigma_azimuth_deg=0.5"});
  const auto given =
      program::succeeded(tune(quickly(file, start + Arguments{"--out", directory.path() / "best.toml"})));
  EXPECT_EQ(given.output.find("nan"), std::string::npos) << given.output;
  EXPECT_NEAR(value_in(contents(directory.path() / "best.toml"), "sigma_azimuth_deg"), 0.1, 0.03);
}

}  // namespace himm_demo_tune_test
