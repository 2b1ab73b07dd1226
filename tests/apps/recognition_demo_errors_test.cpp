#include <gtest/gtest.h>

#include "apps/recognition_demo_support.hpp"
#include "apps/temporary_directory.hpp"
#include "support/text.hpp"

namespace sigmax::apps {
namespace {

constexpr const char* good_csv = "colour,size,kind\nred,1,a\nblue,2,b\nred,3,a\nblue,4,b\n";
constexpr const char* good_model = R"({"format": "sigmax recognition model", "version": 1, "label": "kind",
 "kinds": ["sigma", "max"], "smoothing": 1, "misread": 0, "equal_prior": false,
 "classes": [{"name": "a", "rows": 2}, {"name": "b", "rows": 2}],
 "features": [{"name": "colour", "values": ["blue", "red"], "counts": [[0, 2], [2, 0]]},
              {"name": "size", "cuts": [2.5], "counts": [[1, 1], [1, 1]]}]})";

/// The good model with one thing changed.
std::string model_with(const std::string& old_text, const std::string& new_text) {
  std::string text = good_model;
  const auto at = text.find(old_text);
  EXPECT_NE(at, std::string::npos) << old_text;
  return text.replace(at, old_text.size(), new_text);
}

struct Case {
  std::string name;
  std::string data;
  std::string model;
  std::vector<std::string> arguments;  ///< with DATA, MODEL and OUT for the paths
  int status;
  std::vector<std::string> said;

  friend void PrintTo(const Case& test, std::ostream* text) { *text << test.name; }
};

const std::vector<std::string> train = {"train", "DATA", "--label", "kind", "--model", "OUT"};
const std::vector<std::string> evaluate = {"evaluate", "DATA", "--label", "kind", "--out", "OUT"};
const std::vector<std::string> classify = {"classify", "MODEL", "DATA", "--out", "OUT"};

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// Twenty rows with a number each.
std::string many_rows() {
  std::string rows;
  for (int i = 0; i < 20; ++i)
    rows += (i % 2 == 0 ? "red," : "blue,") + std::to_string(i) + (i % 3 == 0 ? ",a\n" : ",b\n");
  return rows;
}

std::vector<Case> cases() {
  std::vector<Case> all;
  // One statement each: a single list of so many takes compilers very long.
  const auto add = [&](const char* name, std::string data, std::string model, std::vector<std::string> arguments,
                       int status, std::vector<std::string> said) {
    all.push_back({name, std::move(data), std::move(model), std::move(arguments), status, std::move(said)});
  };
  add("UnknownSubcommand", good_csv, good_model, {"learn"}, 2, {});
  add("NoLabel", good_csv, good_model, {"train", "DATA", "--model", "OUT"}, 2, {"--label is required"});
  add("UnknownKind", good_csv, good_model, with(train, {"--kinds", "fuzzy"}), 2, {"fuzzy"});
  add("NoFolds", good_csv, good_model, with(evaluate, {"--folds", "1"}), 2, {"--folds"});
  add("NegativeSmoothing", good_csv, good_model, with(train, {"--smoothing", "-1"}), 2, {"--smoothing"});
  add("EveryWithoutTrack", good_csv, good_model, {"encounter", "DATA", "--every", "5"}, 2, {"--track"});

  add("NoFile", good_csv, good_model, {"train", "absent.csv", "--label", "kind", "--model", "OUT"}, 3, {"absent.csv"});
  add("EmptyFile", "", good_model, train, 3, {"data.csv: is empty"});
  add("NoRows", "colour,size,kind\n", good_model, train, 3, {"data.csv: there is no row below the header"});
  add("LabelThatIsNoColumn", "colour,size,sort\nred,1,a\n", good_model, train, 3,
      {"there is no column 'kind'", "colour, size, sort"});
  add("AlphaOfEqualUsage", good_csv, good_model, {"esm", "--alpha", "2"}, 2, {"--alpha needs --usage dirichlet"});
  add("IgnoredThatIsNoColumn", good_csv, good_model, with(train, {"--ignore", "weight"}), 3, {"'weight'"});
  add("CategoricalThatIsNoColumn", good_csv, good_model, with(train, {"--categorical", "weight"}), 3, {"'weight'"});
  add("NoFeature", good_csv, good_model, with(train, {"--ignore", "colour", "--ignore", "size"}), 3, {"beside 'kind'"});
  add("NoClass", "colour,size,kind\nred,1,a\nblue,2,\n", good_model, train, 3,
      {"data.csv:3: column 'kind': found an empty cell, expected the name of a class"});
  add("SingleClass", "colour,size,kind\nred,1,a\nblue,2,a\n", good_model, train, 3,
      {"data.csv:2: column 'kind': found 'a' in all of 2 rows, expected at least two classes"});
  add("ConstantColumns", "colour,shape,size,leaf,kind\nred,round,1,,a\nred,long,1,?,b\n", good_model, train, 3,
      {"data.csv: found 'red' in column 'colour', '1' in column 'size', no value in column 'leaf', in all of 2 rows",
       "--ignore colour,size,leaf"});
  add("WordAmongNumbers", "colour,size,kind\n" + many_rows() + "red,large,a\n", good_model, train, 3,
      {"data.csv:22: column 'size': found 'large', expected a number, as 20 of 21 cells have", "--missing large",
       "--categorical size"});
  add("TruncatedData", "colour,size,kind\nred,1,a\nblue,2,b\nred,", good_model, evaluate, 3,
      {"data.csv:4: found 2 fields, expected 3"});
  add("OpenQuote", "colour,size,kind\n\"red,1,a\n", good_model, train, 3, {"data.csv:2", "quote"});
  add("ClassOfOneRow", "colour,size,kind\nred,1,a\nblue,2,b\nred,3,a\nblue,4,b\nred,5,c\n", good_model,
      with(evaluate, {"--folds", "2"}), 3,
      {"data.csv: column 'kind': found a single row of 'c' (line 6), expected at least two"});
  add("RareClasses", "colour,size,kind\nred,1,a\nblue,2,b\nred,3,a\nblue,4,c\n", good_model,
      with(evaluate, {"--folds", "2"}), 3, {"found a single row of 'b' (line 3), 'c' (line 5)"});
  add("MoreFoldsThanRows", good_csv, good_model, evaluate, 3,
      {"found 4 rows, expected at least as many as the 10 folds"});
  add("OutIsAFile", good_csv, good_model, {"evaluate", "DATA", "--label", "kind", "--out", "MODEL"}, 3, {"model.json"});
  add("ModelIntoNoDirectory", good_csv, good_model,
      {"train", "DATA", "--label", "kind", "--model", "nowhere/model.json"}, 3,
      {"nowhere/model.json", "cannot be written"});

  add("UnknownValue", "colour,size\nred,1\ngreen,2\n", good_model, classify, 3,
      {"data.csv:3: column 'colour': found 'green', expected a value that the model knows: blue, red"});
  add("UnknownLabel", "colour,size,kind\nred,1,a\nred,1,z\n", good_model, classify, 3,
      {"data.csv:3: column 'kind': found 'z', expected a class of the model: a, b"});
  add("WordForANumber", "colour,size\nred,1\nred,large\n", good_model, classify, 3,
      {"data.csv:3: column 'size': found 'large', expected a finite number"});
  add("MissingColumn", "colour\nred\n", good_model, classify, 3, {"there is no column 'size'"});
  add("SwappedModelAndData", good_csv, good_model, {"classify", "DATA", "MODEL"}, 3,
      {"data.csv: is no model: found 'colour,size,kind', expected JSON", "the model comes first, then the data"});
  add("HugeNumberInAModel", good_csv, model_with("[2.5]", "[1e400]"), classify, 3,
      {"model.json: holds a number that no double can hold"});
  add("MisspeltOption", good_csv, good_model, {"train", "DATA", "--lable", "kind", "--model", "OUT"}, 2,
      {"train has no option '--lable'; did you mean '--label'?"});
  add("MisspeltSubcommand", good_csv, good_model, {"clasify"}, 2, {"did you mean 'classify'?"});
  add("NegativeSeed", good_csv, good_model, {"esm", "--seed", "-1"}, 2, {"--seed", "expected a whole number from 0"});
  add("LongSeed", good_csv, good_model, {"esm", "--seed", "12345678901234567890123"}, 2, {"--seed"});
  add("MarginThatIsNoNumber", good_csv, good_model, with(classify, {"--least-margin", "nan"}), 2,
      {"--least-margin: found 'nan', expected a number in [0 - 1]"});
  add("NothingToClassify", "colour,size\n", good_model, classify, 3, {"there is no row below the header"});
  add("ModelOfAnotherVersion", good_csv, model_with("\"version\": 1", "\"version\": 2"), classify, 3,
      {"model.json: 'version': found '2', expected version 1", "train the model again"});
  add("TruncatedModel", good_csv, std::string(good_model).substr(0, 200), classify, 3,
      {"model.json: parse error at line 3, column"});
  add("NoModel", good_csv, "[1, 2]", classify, 3, {"model.json: is no model of recognition_demo"});
  add("EmptyModel", good_csv, "", classify, 3, {"model.json: parse error at line 1"});
  add("EmptyClassInAModel", good_csv, model_with("\"b\", \"rows\": 2", "\"b\", \"rows\": 0"), classify, 3,
      {"'classes[1].rows': found '0', expected a class with at least one row"});
  add("NegativeCount", good_csv, model_with("[2, 0]", "[2, -1]"), classify, 3,
      {"'features[0].counts[1][1]': found '-1', expected a count that is not negative"});
  add("MoreCountsThanRows", good_csv, model_with("[2, 0]", "[2, 1]"), classify, 3,
      {"'features[0].counts[1]'", "a sum of at most 2, the rows of class 'b'"});
  add("TooFewCounts", good_csv, model_with("[2, 0]", "[2]"), classify, 3,
      {"'features[0].counts[1]': found 1 counts, expected 2"});
  add("CutsThatDescend", good_csv, model_with("[2.5]", "[2.5, 1]"), classify, 3,
      {"'features[1].cuts[1]': found '1', expected cuts in ascending order"});
  add("ModelWithoutKinds", good_csv, model_with("\"kinds\"", "\"sorts\""), classify, 3, {"there is no 'kinds'"});
  add("ModelOfAnUnknownKind", good_csv, model_with("\"max\"]", "\"min\"]"), classify, 3,
      {"'kinds[1]': found '\"min\"', expected one of sigma, max, sigma-max"});

  add("GapBetweenBins", "class,feature,lower,upper,count\na,airspeed_kt,0,10,1\na,airspeed_kt,20,30,1\n", good_model,
      {"encounter", "DATA", "--out", "OUT"}, 3,
      {"data.csv:3: column 'lower': found '20', expected 10, where the bin before ends"});
  add("MinimumAboveMaximum", "type,variable,optimum,minimum,maximum,model,parameters\nx,v,1,2,0,norm,1|1\n", good_model,
      {"performance", "DATA", "--out", "OUT"}, 3,
      {"data.csv:2: column 'maximum': found '0', expected a number above the minimum, 2"});
  add("UnknownDensity", "type,variable,optimum,minimum,maximum,model,parameters\nx,v,1,0,2,cauchy,1|1\n", good_model,
      {"performance", "DATA", "--out", "OUT"}, 3,
      {"data.csv:2: column 'model': found 'cauchy', expected norm, gamma or beta"});
  add("TooFewParameters", "type,variable,optimum,minimum,maximum,model,parameters\nx,v,1,0,2,beta,1|1\n", good_model,
      {"performance", "DATA", "--out", "OUT"}, 3,
      {"data.csv:2: column 'parameters': found '1|1', expected 4 numbers between bars"});
  add("QuantityThatATypeLacks",
      "type,variable,optimum,minimum,maximum,model,parameters\nx,v,1,0,2,norm,1|1\ny,w,1,0,2,norm,1|1\n", good_model,
      {"performance", "DATA", "--out", "OUT"}, 3, {"type 'y' has no quantity 'v'"});
  return all;
}

class Errors : public testing::TestWithParam<Case> {};

TEST_P(Errors, SayWhereAndWhatAndLeaveNothing) {
  const Case& one = GetParam();
  const TemporaryDirectory directory;
  const auto data = directory.write("data.csv", one.data);
  const auto model = directory.write("model.json", one.model);
  const auto out = directory.path() / "out";
  std::vector<std::string> arguments = one.arguments;
  for (auto& argument : arguments)
    argument = argument == "DATA"    ? data.string()
               : argument == "MODEL" ? model.string()
               : argument == "OUT"   ? out.string()
                                     : argument;
  const auto ending = recognition_demo(arguments);
  EXPECT_EQ(ending.status, one.status) << ending.output;
  for (const auto& words : one.said)
    EXPECT_NE(ending.output.find(words), std::string::npos) << words << "\n" << ending.output;
  if (one.status == 3) {
    EXPECT_TRUE(ending.output.starts_with("recognition_demo: ")) << ending.output;
    EXPECT_EQ(std::count(ending.output.begin(), ending.output.end(), '\n'), 1) << ending.output;
  }
  EXPECT_FALSE(std::filesystem::is_regular_file(out));
  if (std::filesystem::exists(out)) {
    EXPECT_TRUE(std::filesystem::is_empty(out));
  }
  EXPECT_EQ(contents(model), one.model);
}

INSTANTIATE_TEST_SUITE_P(RecognitionDemo, Errors, testing::ValuesIn(cases()),
                         [](const auto& one) { return one.param.name; });

TEST(RecognitionDemoErrors, TheGoodFilesOfTheseCasesAreGood) {
  const TemporaryDirectory directory;
  const auto data = directory.write("data.csv", good_csv);
  const auto model = directory.write("model.json", good_model);
  const auto ending = recognition_demo({"classify", model, data});
  EXPECT_EQ(ending.status, 0) << ending.output;
  EXPECT_EQ(recognition_demo({"train", data, "--label", "kind", "--model", directory.path() / "m.json"}).status, 0);
}

TEST(RecognitionDemoErrors, EverySubcommandHasTwoExamplesInItsHelp) {
  for (const std::string subcommand :
       {"esm", "regimes", "manoeuvre", "encounter", "performance", "train", "classify", "evaluate"}) {
    const auto help = recognition_demo({subcommand, "--help"});
    EXPECT_EQ(help.status, 0);
    for (const std::string& line : lines_of(help.output, any_width)) EXPECT_LE(display_width(line), 80U) << line;
    std::size_t examples = 0;
    const std::string start = "\n  recognition_demo " + subcommand;
    for (auto at = help.output.find(start); at != std::string::npos; at = help.output.find(start, at + 1)) ++examples;
    EXPECT_EQ(examples, 2U) << help.output;
  }
  EXPECT_TRUE(recognition_demo({"--version"}).output.starts_with("recognition_demo "));
}

}  // namespace
}  // namespace sigmax::apps
