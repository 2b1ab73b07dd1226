// What himm_demo says to input that is wrong, and what it leaves behind: nothing.

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>
#include <iterator>
#include <ostream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>

#include "apps/temporary_directory.hpp"
#include "support/program.hpp"

namespace sigmax::apps {
namespace {

const std::string good = "time_s,x_m,y_m\n0,0,0\n1,1,2\n2,2,4\n3,3,6\n4,4,8\n";
const std::string polar = "time_s,range_m,azimuth_deg,elevation_deg\n0,9,1,1\n";

/// In the arguments FILE and CONFIG stand for the two files, DIR for the directory that they are in; `--out DIR/out` is
/// added.
struct Case {
  std::string name;
  std::string file;
  std::vector<std::string> parts;  ///< of the message
  std::vector<std::string> arguments = {"track", "FILE"};
  std::string config = {};
  int status = 3;

  friend void PrintTo(const Case& c, std::ostream* text) { *text << c.name; }
};

std::vector<std::string> with(std::vector<std::string> more) {
  std::vector<std::string> arguments = {"track", "FILE"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

std::vector<std::string> set(const std::string& setting) { return with({"--set", setting}); }

std::vector<Case> cases() {
  const std::vector<std::string> configured = with({"--config", "CONFIG"});
  return {
      // Rows: file, line and column, what was found and expected, and what to do.
      {"RaggedRow",
       "time_s,x_m,y_m\n0,1,2\n1,3\n2,3,4\n",
       {"input.csv:3: ", "found 2 fields", "expected 3 as in the header", "add or drop commas"}},
      {"TooManyFields", "time_s,x_m,y_m\n0,1,2\n1,3,4,5\n", {"input.csv:3: ", "found 4 fields", "expected 3"}},
      {"NonNumber",
       "time_s,x_m,y_m\n0,1,2\n1,one,3\n",
       {"input.csv:3: column 'x_m'", "found 'one'", "expected a finite number", "leave the cell empty"}},
      {"NotANumber",
       "time_s,x_m,y_m\n0,1,2\n1,2,nan\n",
       {"input.csv:3: column 'y_m'", "found 'nan'", "expected a finite number", "leave the cell empty"}},
      {"Infinity",
       "time_s,x_m,y_m\n0,1,-inf\n",
       {"input.csv:2: column 'y_m'", "found '-inf'", "expected a finite number", "leave the cell empty"}},
      {"TooLargeANumber",
       "time_s,x_m,y_m\n0,1e999,2\n",
       {"input.csv:2: column 'x_m'", "found '1e999'", "expected a finite number"}},
      {"HalfAPlace",
       "time_s,latitude_deg,longitude_deg\n0,1,2\n1,3,\n",
       {"input.csv:3: column 'longitude_deg'", "found an empty cell", "expected a number",
        "fill the cell or empty them all"}},
      {"NoTime",
       "time_s,x_m,y_m\n,1,2\n",
       {"input.csv:2: column 'time_s'", "found an empty cell", "expected a number of seconds, or a date", "correct"}},
      {"NoDate",
       "time_s,x_m,y_m\n2016-02-30T00:00:00Z,1,2\n",
       {"input.csv:2: column 'time_s'", "found '2016-02-30T00:00:00Z'", "2016-01-12T13:02:11.218Z", "correct"}},
      {"RepeatedTime",
       "time_s,x_m,y_m\n0,1,2\n0,3,4\n",
       {"input.csv:3: column 'time_s'", "found '0'", "expected a time after that of the row before, 0",
        "--on-bad-time skip"}},
      {"BackwardTime",
       "time_s,x_m,y_m\n7.5,1,2\n7,3,4\n",
       {"input.csv:3: column 'time_s'", "found '7'", "expected a time after that of the row before, 7.5", "sort"}},
      {"Latitude",
       "time_s,latitude_deg,longitude_deg\n0,91,4\n",
       {"input.csv:2: column 'latitude_deg'", "found '91'", "expected latitude 91°, expected −90° to 90°", "correct"}},
      {"Longitude",
       "time_s,latitude_deg,longitude_deg,altitude_m\n0,1,400,3\n",
       {"input.csv:2: column 'longitude_deg'", "found '400'", "−360° to 360°", "correct"}},
      {"Range",
       polar + "1,-3,1,1\n",
       {"input.csv:3: column 'range_m'", "found '-3'", "expected a range above 0 m", "empty those of a missed"}},
      {"Azimuth",
       polar + "1,3,361,1\n",
       {"input.csv:3: column 'azimuth_deg'", "found '361'", "−360 to 360", "correct"}},
      {"Elevation",
       polar + "1,3,1,90.5\n",
       {"input.csv:3: column 'elevation_deg'", "found '90.5'", "−90 to 90", "correct"}},
      {"PositionAndRange",
       "time_s,sensor,x_m,y_m,range_m,azimuth_deg\n0,a,1,2,3,4\n",
       {"input.csv:2: column 'range_m'", "found '3'", "expected an empty cell", "give each sensor a row"}},
      {"NoSensor",
       "time_s,sensor,x_m,y_m\n0,,1,2\n",
       {"input.csv:2: column 'sensor'", "found an empty cell", "the name of the row's sensor", "fill the cell"}},
      {"NoTrack",
       "time_s,id,x_m,y_m\n0, ,1,2\n",
       {"input.csv:2: column 'id'", "found an empty cell", "expected", "fill the cell"},
       with({"--track-id", "id"})},
      {"TooFewRows",
       "time_s,x_m,y_m\n0,1,2\n1,2,3\n",
       {"input.csv: ", "found 2 rows, 2 of them measurements", "expected at least three", "give more rows"}},
      {"NothingSelected", good, {"input.csv: no row has x_m=77", "see how"}, with({"--select", "x_m=77"})},

      // Files.
      {"Empty", "", {"input.csv: is empty", "expected a line with the names of the columns", "written whole"}},
      {"OpenQuote",
       "time_s,x_m,y_m\n0,1,2\n1,\"3,4\n",
       {"input.csv:3: ", "the quote opened here is not closed at the end of the file",
        "see whether the file is whole"}},
      {"CutOffRow",
       "time_s,x_m,y_m\n0,1,2\n1,2",
       {"input.csv:3: ", "found 2 fields", "expected 3", "the file ends within this line"}},
      {"ZeroByte",
       std::string("time_s,x_m,y_m\n0,\0,2\n", 21),
       {"input.csv:2: ", "found a zero byte", "expected UTF-8 text"}},
      {"Utf16", "\xFF\xFEt", {"input.csv: ", "found UTF-16 text", "expected UTF-8", "convert it"}},
      {"TwoColumnsOfOneName",
       "time_s,x_m,y_m,x_m\n0,1,2,3\n",
       {"input.csv:1: ", "two columns are named 'x_m'", "rename one"}},
      {"OtherSeparators", "time_s;x_m;y_m\n0;1;2\n", {"input.csv: ", "no column 'time_s'", "separate them by commas"}},
      {"OneAxis",
       "time_s,y_m\n0,1\n",
       {"input.csv:1: ", "found time_s, y_m", "expected time_s,x_m[,y_m[,z_m]], or",
        "map other headers with --columns"}},
      {"NoTimeColumn",
       "t,x_m,y_m\n0,1,2\n",
       {"input.csv:1: there is no column time_s", "found t, x_m, y_m", "expected time_s,", "--columns"}},
      {"SeveralKinds",
       "time_s,x_m,y_m,latitude_deg,longitude_deg\n",
       {"input.csv:1: there are columns of several kinds", "found time_s, x_m", "expected", "rename"}},
      {"SensorsWithoutNames",
       "time_s,x_m,y_m,range_m,azimuth_deg\n",
       {"input.csv:1: ", "no column sensor", "found time_s, x_m", "expected", "add one"}},
      {"SensorsOfTwoAndThreeAxes",
       "time_s,sensor,x_m,y_m,z_m,range_m,azimuth_deg\n",
       {"input.csv:1: ", "found time_s", "expected both z_m and elevation_deg, or none", "as many axes"}},
      {"NoSuchColumn",
       good,
       {"input.csv: there is no column 'id'", "the columns are time_s, x_m, y_m"},
       with({"--track-id", "id"})},
      {"NoFile",
       good,
       {"absent.csv: cannot be read: No such file", "see whether its name"},
       {"track", "DIR/absent.csv"}},
      {"DirectoryForAFile", good, {"DIR: ", "found a directory", "expected a file", "name one of"}, {"track", "DIR"}},
      {"DirectoryForSettings",
       good,
       {"DIR: ", "found a directory", "expected a file", "name one of"},
       with({"--config", "DIR"})},
      {"DirectoryAsStandardInput",
       good,
       {"standard input: cannot be read: Is a directory"},
       {"/bin/sh", "-c", "exec \"$1\" track - --out \"$2/out\" <\"$2\"", "sh", "PROGRAM", "DIR"}},

      // Settings: the key and its place, what was found and expected, and what to do.
      {"PossibilityRow",
       good,
       {"settings.toml:1:26: key 'transition_possibility'", "found the array '[ [ 1.0, 0.5 ], [ 0.5, 0.75 ] ]'",
        "expected a maximum of 1 in every row; that of row 2 (from dwpa) is 0.75", "divide that row by 0.75"},
       configured,
       "transition_possibility = [[1.0, 0.5], [0.5, 0.75]]\n"},
      {"ProbabilityRow",
       good,
       {"--set transition_probability=[[1,0.5],[0.5,0.5]]: key 'transition_probability'", "found the array",
        "expected a sum of 1 in every row; that of row 1 (from dwna) is 1.5", "divide that row by 1.5"},
       set("transition_probability=[[1,0.5],[0.5,0.5]]")},
      {"NegativeProbability",
       good,
       {"key 'transition_probability'", "expected numbers between 0 and 1", "correct row 2"},
       set("transition_probability=[[1,0],[-0.5,1.5]]")},
      {"TransitionOfOtherSize",
       good,
       {"key 'transition_probability'", "expected 3 rows of 3 numbers", "give a row for each"},
       with({"--set", "models=[dwna,dwna,dwpa]", "--set", "transition_probability=[[1,0],[0,1]]"})},
      {"IndefiniteStart",
       good,
       {"settings.toml:3:29: key 'start_covariance_diagonal'", "found the array '[ 1, 1, 1, 1, -4, 1, 1, 1, 1 ]'",
        "expected variances that are not negative", "give the squares of standard deviations"},
       configured,
       "start = \"given\"\nstart_mean = [0,0,0,0,0,0,0,0,0]\nstart_covariance_diagonal = [1,1,1,1,-4,1,1,1,1]\n"},
      {"IndefiniteMeasurement",
       good,
       {"settings.toml:2:20: key 'sensor.lidar.sigma_position_m'", "found '0'", "expected positive standard deviations",
        "give a small one rather than 0"},
       configured,
       "[sensor.lidar]\nsigma_position_m = 0\n"},
      {"UnknownKey",
       good,
       {"settings.toml:2:1: unknown key 'sigma_positon_m'", "did you mean 'sigma_position_m'?"},
       configured,
       "lift = \"zero\"\nsigma_positon_m = 3\n"},
      {"UnknownKeyOfATable",
       good,
       {"settings.toml:2:1: unknown key 'filter.himm.lft'", "did you mean 'filter.himm.lift'?"},
       configured,
       "[filter.himm]\nlft = \"zero\"\n"},
      {"WrongType",
       good,
       {"settings.toml:1:11: key 'sigma_w'", "found the string 'three'", "expected a number or an array of numbers",
        "write it as in sigma_w = [1.0, 2.0]"},
       configured,
       "sigma_w = \"three\"\n"},
      {"WrongChoice",
       good,
       {"--set lift=zerro: key 'lift'", "found the string 'zerro'", "expected one of zero,", "did you mean 'zero'?"},
       set("lift=zerro")},
      {"SettingNotANumber",
       good,
       {"--set sigma_range_m=nan: key 'sigma_range_m'", "found 'nan'", "expected a finite number", "write it as in"},
       set("sigma_range_m=nan")},
      {"CutOffSettings", good, {"settings.toml:1:14: is not TOML; ", "array"}, configured, "sigma_w = [3,"},
      {"GivenStartWithoutMean",
       good,
       {"key 'start_mean'", "found the default '[]'", "expected nine numbers"},
       set("start=given")},

      // Output.
      {"UnwritableOut",
       good,
       {"input.csv/out: the directory cannot be created: Not a directory", "choose another place"},
       with({"--out", "FILE/out"})},
      {"FullDisk",
       good,
       {"/out/", ": cannot be written: File too large", "make room there, or choose another place"},
       {"/bin/sh", "-c", "ulimit -f 1; exec \"$1\" track \"$2/input.csv\" --out \"$2/out\"", "sh", "PROGRAM", "DIR"}},
      {"FullDiskOfSimulate",
       good,
       {"out/", "cannot be written: File too large", "make room there, or choose another place"},
       {"/bin/sh", "-c", "ulimit -f 1; exec \"$1\" simulate --runs 1 --out \"$2/out\"", "sh", "PROGRAM", "DIR"}},
      {"FullStandardOutput",
       good,
       {"standard output: cannot be written: No space left on device", "make room there"},
       {"/bin/sh", "-c", "exec \"$1\" track \"$2/input.csv\" >/dev/full", "sh", "PROGRAM", "DIR"}},

      // Usage.
      {"UnknownSubcommand", good, {"there is no subcommand 'trak'; did you mean 'track'?"}, {"trak"}, "", 2},
      {"UnknownOption", good, {"--unheard-of", "--help"}, with({"--unheard-of"}), "", 2},
      {"UnknownPreset", good, {"--preset", "--help"}, {"simulate", "--preset", "printed"}, "", 2},
      {"NoInputFile", good, {"file is required", "--help"}, {"track"}, "", 2},
      {"SettingWithoutValue", good, {"--set: found 'lift', expected key=value"}, set("lift"), "", 2},
      {"TwoNumbersForARadar", good, {"--radar", "--help"}, with({"--radar", "1,2"}), "", 2},
      {"RadarOnTwoAxes", good, {"--radar needs three axes"}, with({"--radar", "1,2,3"}), "", 2},
      {"RadarOnARadar", polar, {"--radar measures positions"}, with({"--radar", "1,2,3"}), "", 2},
      {"RadarNowhere", good, {"--radar-at is for --radar"}, with({"--radar-at", "1,2,3"}), "", 2},
      {"RadarBesideTheTruth",
       "time_s,x_m,y_m,z_m,true_x_m,true_y_m,true_z_m\n",
       {"--radar takes positions as the truth"},
       with({"--radar", "1,2,3"}),
       "",
       2},
      {"OriginOfCartesianInput", good, {"--origin is for geodetic input"}, with({"--origin", "52,4,0"}), "", 2},
      {"OriginBeyondThePole",
       "time_s,latitude_deg,longitude_deg\n",
       {"--origin: latitude 95°"},
       with({"--origin", "95,4,0"}),
       "",
       2},
      {"AzimuthOfCartesianInput", good, {"--azimuth-from is for radar"}, with({"--azimuth-from", "north"}), "", 2},
      {"AzimuthFromWest", polar, {"--azimuth-from", "--help"}, with({"--azimuth-from", "west"}), "", 2},
      {"UnknownUnit",
       "time_s,x_furlong,y_m\n",
       {"input.csv:1: its columns are of no kind", "column 'x_furlong': name its unit: _m, _km, _ft, _nmi or _mi"}},
      {"UnknownUnitOfAName",
       good,
       {"there is no name 'x_yd'", "name its unit: _m, _km"},
       with({"--columns", "x_yd=x_m"}),
       "",
       2},
      {"BearingsAlone",
       "time_s,azimuth_deg\n0,1\n1,2\n2,3\n3,4\n",
       {"bearings do not tell where a target starts", "start = \"given\"", "start_mean"}},
      {"UnknownName", good, {"there is no name 'what'", "time_s", "x_m"}, with({"--columns", "what=x_m"}), "", 2},
      {"SelectionWithoutValue", good, {"--select: 'x_m' is not COLUMN=VALUE"}, with({"--select", "x_m"}), "", 2},
  };
}

std::string replaced(std::string text, const std::string& word, const std::string& by) {
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + by.size()))
    text.replace(at, word.size(), by);
  return text;
}

/// Everything under the directory that a program may have written.
std::vector<std::string> files_in(const std::filesystem::path& out) {
  std::vector<std::string> files;
  std::error_code absent;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(out, absent))
    files.push_back(entry.path().filename());
  return files;
}

class BadInput : public testing::TestWithParam<Case> {};

TEST_P(BadInput, IsExplainedAndNothingIsWritten) {
  const Case& c = GetParam();
  const TemporaryDirectory directory;
  const std::string file = directory.write("input.csv", c.file);
  const std::string config = directory.write("settings.toml", c.config);
  const auto fill = [&](const std::string& text) {
    const std::string filled = replaced(replaced(text, "FILE", file), "CONFIG", config);
    return replaced(replaced(filled, "DIR", directory.path()), "PROGRAM", program::chosen(SIGMAX_HIMM_DEMO));
  };
  std::vector<std::string> arguments;
  std::transform(c.arguments.begin(), c.arguments.end(), std::back_inserter(arguments), fill);
  std::string program = SIGMAX_HIMM_DEMO;
  if (!arguments.empty() && arguments[0] == "/bin/sh") {
    program = arguments[0];
    arguments.erase(arguments.begin());
  } else if (arguments.size() > 1 && c.status == 3 && c.name != "UnwritableOut") {
    arguments.insert(arguments.end(), {"--out", directory.path() / "out"});
  }
  const auto ending = program::run(program, arguments);
  EXPECT_EQ(ending.status, c.status) << ending.output;
  for (const auto& part : c.parts)
    EXPECT_NE(ending.output.find(fill(part)), std::string::npos) << "no '" << fill(part) << "' in: " << ending.output;
  if (c.status == 3) {
    EXPECT_TRUE(ending.output.find("himm_demo: ") != std::string::npos) << ending.output;
    const auto lines = std::count(ending.output.begin(), ending.output.end(), '\n');
    EXPECT_TRUE(lines == 1 || c.name.starts_with("FullDisk")) << ending.output;  // what was found is printed first
  }
  EXPECT_EQ(files_in(directory.path() / "out"), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(HimmDemo, BadInput, testing::ValuesIn(cases()),
                         [](const auto& test) { return test.param.name; });

/// Starts the program with an open pipe as its standard input, signals it when it has begun to write, and waits.
class Interrupted : public testing::TestWithParam<int> {};

TEST_P(Interrupted, LeavesNoHalfWrittenFile) {
  const TemporaryDirectory directory;
  const std::string out = directory.path() / "out";
  const std::string complaints = directory.path() / "complaints", himm_demo = program::chosen(SIGMAX_HIMM_DEMO);
  std::array<int, 2> input{};
  ASSERT_EQ(::pipe(input.data()), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::alarm(100);  // a program that waits for ever ends as well
    std::signal(GetParam(), SIG_DFL);
    ::dup2(input[0], STDIN_FILENO);
    ::close(input[1]);
    ::dup2(::open(complaints.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    ::execl(himm_demo.c_str(), "himm_demo", "track", "-", "--out", out.c_str(), static_cast<char*>(nullptr));
    ::_exit(127);
  }
  ::close(input[0]);
  ASSERT_EQ(::write(input[1], good.data(), good.size()), static_cast<ssize_t>(good.size()));
  int status = 0;
  pid_t ended = 0;
  // The reader waits for more input, so what is written stays unfinished until the signal.
  while (files_in(out).empty() && (ended = ::waitpid(child, &status, WNOHANG)) == 0) std::this_thread::yield();
  ASSERT_EQ(ended, 0) << "it ended before it was interrupted: " << contents(complaints);
  ::kill(child, GetParam());
  ::waitpid(child, &status, 0);
  ::close(input[1]);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 128 + GetParam());
  EXPECT_EQ(contents(complaints), "himm_demo: interrupted; unfinished output was removed\n");
  EXPECT_EQ(files_in(out), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(HimmDemo, Interrupted, testing::Values(SIGINT, SIGTERM, SIGHUP),
                         [](const auto& test) { return std::string("BySIG") + ::sigabbrev_np(test.param); });

}  // namespace
}  // namespace sigmax::apps
