#include "shell/settings.hpp"

#include "apps/temporary_directory.hpp"

namespace settings_test {

using Strings = std::vector<std::string>;
using Matrix = std::vector<Numbers>;

/// Settings of a file "c.toml" with this text.
Settings from_file(std::string_view text, const Strings& sets = {}) {
  const TemporaryDirectory directory;
  return Settings::read(directory.write("c.toml", text), sets);
}

Settings from_sets(const Strings& sets) { return Settings::read({}, sets); }

/// The message without the directory of the file.
template <class Error = InputError, class Call>
std::string refusal(Call&& call) {
  const std::string text = message_of<Error>(call);
  const auto file = text.find("c.toml");
  return file == std::string::npos ? text : text.substr(file);
}

TEST(Settings, ReadsEveryTypeFromAFile) {
  const Settings settings = from_file(R"(
sigma_w = 5
start_time_s = -0.5
quiet = true
augmentation = "zero"
models = ["dwna", "dwpa"]
origin = [52, 4.5, 0]
transition = [[1, 0.5], [0.5, 1]]
)");
  EXPECT_EQ(settings.get<double>("sigma_w"), 5.0);
  EXPECT_EQ(settings.get<double>("start_time_s"), -0.5);
  EXPECT_EQ(settings.get<bool>("quiet"), true);
  EXPECT_EQ(settings.get<std::string>("augmentation"), "zero");
  EXPECT_EQ(settings.get<Strings>("models"), (Strings{"dwna", "dwpa"}));
  EXPECT_EQ(settings.get<Numbers>("origin"), (Numbers{52, 4.5, 0}));
  EXPECT_EQ(settings.get<Numbers>("sigma_w"), Numbers{5});
  EXPECT_EQ(settings.get<Matrix>("transition"), (Matrix{{1, 0.5}, {0.5, 1}}));
  settings.refuse_unknown();
}

TEST(Settings, AbsentKeysAreNothingOrTheirDefault) {
  const Settings settings;
  EXPECT_FALSE(settings.has("a"));
  const auto is_absent = [&](const auto& fallback) {
    EXPECT_EQ(settings.get<std::decay_t<decltype(fallback)>>("a"), std::nullopt);
    EXPECT_EQ(settings.get("a", fallback), fallback);
  };
  is_absent(1.5);
  is_absent(true);
  is_absent(std::string("b"));
  is_absent(Strings{"b", "c"});
  is_absent(Numbers{1, 2});
  is_absent(Matrix{{1}, {2}});
}

TEST(Settings, SetsOverrideTheFileAndEarlierSets) {
  const Settings settings = from_file("a = 1\nb = 2\n", {"a=3", "b=4", "b=5", "c=6"});
  EXPECT_EQ(settings.get<double>("a"), 3.0);
  EXPECT_EQ(settings.get<double>("b"), 5.0);
  EXPECT_EQ(settings.get<double>("c"), 6.0);
  EXPECT_EQ(settings.names(), (Strings{"a", "b", "c"}));
}

TEST(Settings, SetsTakeTomlAndBareWords) {
  const Settings settings =
      from_sets({" word = zero ", "snake=borrowed_variance", "number=-1e-3", "flag=false", "string=\"a b\"",
                 "literal='it'", "words=[dwna, \"dwpa\",dwna-2]", "rows=[[1,0.5],[0.5,1]]", "umlaut=größe",
                 "escape=\"a\\\"b c\"", "table={kind=imm, sigma_w = .3}", "points=[.25,-.5,+.5,3.,1.5]"});
  EXPECT_EQ(settings.get<std::string>("word"), "zero");
  EXPECT_EQ(settings.get<std::string>("snake"), "borrowed_variance");
  EXPECT_EQ(settings.get<double>("number"), -1e-3);
  EXPECT_EQ(settings.get<bool>("flag"), false);
  EXPECT_EQ(settings.get<std::string>("string"), "a b");
  EXPECT_EQ(settings.get<std::string>("literal"), "it");
  EXPECT_EQ(settings.get<Strings>("words"), (Strings{"dwna", "dwpa", "dwna-2"}));
  EXPECT_EQ(settings.get<Matrix>("rows"), (Matrix{{1, 0.5}, {0.5, 1}}));
  EXPECT_EQ(settings.get<std::string>("umlaut"), "größe");
  EXPECT_EQ(settings.get<std::string>("escape"), "a\"b c");
  EXPECT_EQ(settings.sub("table").get<std::string>("kind"), "imm");
  EXPECT_EQ(settings.sub("table").get<double>("sigma_w"), 0.3);
  EXPECT_EQ(settings.get<Numbers>("points"), (Numbers{0.25, -0.5, 0.5, 3.0, 1.5}));
}

TEST(Settings, NamesThePlaceOfAWrongType) {
  const Settings settings = from_file("a = 1\n  sigma_w = \"5\"\nlist = [1,\n  true]\nwhen = 2020-01-01\n");
  EXPECT_EQ(refusal([&] { settings.get("sigma_w", 1.0); }),
            "c.toml:2:13: key 'sigma_w': found the string '5', expected a number; write it as in sigma_w = 3.5");
  EXPECT_EQ(refusal([&] { settings.get<Numbers>("list"); }),
            "c.toml:4:3: key 'list': found 'true', expected a number; write it as in list = 3.5");
  EXPECT_EQ(refusal([&] { settings.get<std::string>("a"); }),
            "c.toml:1:5: key 'a': found '1', expected a string; write it as in a = \"text\"");
  EXPECT_EQ(refusal([&] { settings.get<Strings>("a"); }),
            "c.toml:1:5: key 'a': found '1', expected a string or an array of strings; write it as in a = [\"one\", "
            "\"two\"]");
  EXPECT_EQ(refusal([&] { settings.get<bool>("a"); }),
            "c.toml:1:5: key 'a': found '1', expected true or false; write it as in a = true");
  EXPECT_EQ(refusal([&] { settings.get<double>("when"); }),
            "c.toml:5:8: key 'when': found '2020-01-01', expected a number; write it as in when = 3.5");
  EXPECT_EQ(refusal([&] { settings.sub("a"); }),
            "c.toml:1:5: key 'a': found '1', expected a table; write [a], or a.KEY = value");
  EXPECT_EQ(refusal([] { from_sets({"f.x.s=[1, 2]"}).sub("f").sub("x").get<double>("s"); }),
            "--set f.x.s=[1, 2]: key 'f.x.s': found the array '[ 1, 2 ]', expected a number; write it as in s = 3.5");
  EXPECT_EQ(refusal([] { from_sets({"f.x=1"}).get<double>("f"); }),
            "--set f.x=1: key 'f': found a table, expected a number; write it as in f = 3.5");
}

TEST(Settings, RefusesNumbersThatAreNotFinite) {
  EXPECT_EQ(refusal([] { from_sets({"a=nan"}).get<double>("a"); }),
            "--set a=nan: key 'a': found 'nan', expected a finite number; write it as in a = 3.5");
  EXPECT_EQ(refusal([] { from_sets({"a=[1,-inf]"}).get<Numbers>("a"); }),
            "--set a=[1,-inf]: key 'a': found '-inf', expected a finite number; write it as in a = 3.5");
}

TEST(Settings, RefusesMatricesThatAreNone) {
  EXPECT_EQ(refusal([] { from_file("m = [[1, 2],\n [3]]").get<Matrix>("m"); }),
            "c.toml:2:2: key 'm': found the array '[ 3 ]', expected a row of 2 numbers as the first; make all rows of "
            "the same length");
  EXPECT_EQ(refusal([] { from_sets({"m=[1,2]"}).get<Matrix>("m"); }),
            "--set m=[1,2]: key 'm': found '1', expected a row, which is an array of numbers; write it as in m = "
            "[[1.0, 0.5], [0.5, 1.0]]");
  EXPECT_EQ(refusal([] { from_sets({"m=1"}).get<Matrix>("m"); }),
            "--set m=1: key 'm': found '1', expected an array of rows, each an array of numbers; write it as in m = "
            "[[1.0, 0.5], [0.5, 1.0]]");
}

TEST(Settings, AChoiceIsOneOfItsNames) {
  const Settings settings = from_sets({"augmentation=unbiased", "wrong=zerro"});
  const std::vector<std::string_view> names = {"zero", "borrowed_variance", "unbiased"};
  EXPECT_EQ(settings.choice("augmentation", names, "zero"), "unbiased");
  EXPECT_EQ(settings.choice("absent", names, "zero"), "zero");
  EXPECT_EQ(refusal([&] { settings.choice("wrong", names, "zero"); }),
            "--set wrong=zerro: key 'wrong': found the string 'zerro', expected one of zero, borrowed_variance, "
            "unbiased; did you mean 'zero'?");
}

TEST(Settings, MalformedTomlIsPlaced) {
  const std::string text = refusal([] { from_file("a = 1\nb = [1, \n"); });
  EXPECT_TRUE(text.starts_with("c.toml:2:10: is not TOML; Error while parsing array: ")) << text;
  const std::string set = refusal([] { from_sets({"a=[1"}); });
  EXPECT_TRUE(set.starts_with("--set a=[1: is not TOML; Error while parsing array: ")) << set;
  const std::string twice = refusal([] { from_file("a = 1\na = 2\n"); });
  EXPECT_TRUE(twice.starts_with("c.toml:2:")) << twice;
}

TEST(Settings, CharactersBeyondAsciiStandInCommentsAndQuotes) {
  const Settings settings =
      from_file("\xEF\xBB\xBF# σ in m/s², it's\na = \"é \\\" Ψ\" # 目標\nb = 'ü\\' # σ\n\"σ\" = 5\nc=''\n");
  EXPECT_EQ(settings.get<std::string>("a"), "é \" Ψ");
  EXPECT_EQ(settings.get<std::string>("b"), "ü\\");
  EXPECT_EQ(settings.get<double>("σ"), 5.0);

  const std::string told = ": is not TOML; put characters beyond ASCII into quotes";
  EXPECT_EQ(refusal([] { from_file("a = 1\nσ = 5\n"); }), "c.toml:2:1" + told);
  EXPECT_EQ(refusal([] { from_file("a = [\"é\", Ψ]\n"); }), "c.toml:1:11" + told);
  EXPECT_EQ(refusal([] { from_file("a = \"\"\"x\\\n§\"\"\"\n"); }), "c.toml:2:1" + told);
  EXPECT_EQ(refusal([] { from_file("a = '''x''''' # σ\nb = 5σ\n"); }), "c.toml:2:6" + told);
  EXPECT_EQ(refusal([] { from_sets({"σ=5"}); }), "--set σ=5" + told);
}

TEST(Settings, SetsThatAreNoneAreBadUsage) {
  EXPECT_EQ(refusal<UsageError>([] { from_sets({"sigma_w"}); }), "--set: found 'sigma_w', expected key=value");
  EXPECT_EQ(refusal<UsageError>([] { from_sets({"sigma_w= "}); }), "--set: found 'sigma_w= ', expected key=value");
  EXPECT_EQ(refusal<UsageError>([] { from_sets({"=5"}); }), "--set: found '=5', expected key=value");
}

TEST(Settings, ASubTableOverlaysTheRest) {
  const Settings settings =
      from_file(R"(
sigma_w = 3
augmentation = "zero"
[filter.imm]
kind = "imm"
sigma_w = 4
tau_s = 6
[filter.himm]
kind = "himm"
)",
                {"augmentation=unbiased", "filter.himm.sigma_w=5", "filter.slow.kind=himm", "tau_s=7"});
  const Settings filters = settings.sub("filter");
  EXPECT_EQ(filters.names(), (Strings{"himm", "imm", "slow"}));

  const Settings imm = settings.overlaid_by(filters.sub("imm"));
  EXPECT_EQ(imm.get<std::string>("kind"), "imm");
  EXPECT_EQ(imm.get<double>("sigma_w"), 4.0);
  EXPECT_EQ(imm.get<std::string>("augmentation"), "unbiased");
  EXPECT_EQ(imm.get<double>("tau_s"), 7.0);

  const Settings himm = settings.overlaid_by(filters.sub("himm"));
  EXPECT_EQ(himm.get<std::string>("kind"), "himm");
  EXPECT_EQ(himm.get<double>("sigma_w"), 5.0);

  const Settings slow = settings.overlaid_by(filters.sub("slow"));
  EXPECT_EQ(slow.get<std::string>("kind"), "himm");
  EXPECT_EQ(slow.get<double>("sigma_w"), 3.0);
  EXPECT_EQ(settings.overlaid_by(filters.sub("absent")).get<double>("sigma_w"), 3.0);
  EXPECT_EQ(settings.get<double>("sigma_w"), 3.0);
  EXPECT_TRUE(settings.sub("absent").names().empty());
  settings.refuse_unknown();
}

TEST(Settings, RefusesKeysThatNobodyAskedFor) {
  const Settings settings = from_file("sigma_w = 5\nsgima_w = 5\n");
  settings.get<double>("sigma_w");
  settings.get<std::string>("augmentation");
  EXPECT_EQ(refusal([&] { settings.refuse_unknown(); }), "c.toml:2:1: unknown key 'sgima_w'; did you mean 'sigma_w'?");

  const Settings far = from_sets({"colour=red"});
  far.get<double>("sigma_w");
  far.get<std::string>("augmentation");
  EXPECT_EQ(refusal([&] { far.refuse_unknown(); }),
            "--set colour=red: unknown key 'colour'; the known ones are augmentation, sigma_w");
  EXPECT_EQ(refusal([] { from_sets({"a=1"}).refuse_unknown(); }), "--set a=1: unknown key 'a'");
}

TEST(Settings, RefusesUnknownKeysOfASubTable) {
  const Settings settings = from_file("[filter.imm]\nsigma_w = 1\naugmentatoin = \"zero\"\n");
  const Settings filters = settings.sub("filter");
  EXPECT_EQ(refusal([&] { settings.refuse_unknown(); }), "c.toml:1:9: unknown key 'filter.imm'");
  const Settings imm = settings.overlaid_by(filters.sub("imm"));
  imm.get<double>("sigma_w");
  imm.get<std::string>("augmentation");
  EXPECT_EQ(refusal([&] { settings.refuse_unknown(); }),
            "c.toml:3:1: unknown key 'filter.imm.augmentatoin'; did you mean 'filter.imm.augmentation'?");
}

TEST(Settings, AskingInAnOverlayMakesAKeyKnownBelow) {
  const Settings settings = from_file("sigma_w = 5\n[filter.imm]\nkind = \"imm\"\n");
  settings.overlaid_by(settings.sub("filter").sub("imm")).get<double>("sigma_w");
  settings.sub("filter").sub("imm").get<std::string>("kind");
  settings.refuse_unknown();
}

TEST(Settings, LetsTheCallerRefuseAValue) {
  const Settings settings = from_file("sigma_w = -1\n");
  EXPECT_EQ(refusal([&] { throw settings.error("sigma_w", "a number above zero", "see --help"); }),
            "c.toml:1:11: key 'sigma_w': found '-1', expected a number above zero; see --help");
  settings.get("models", Strings{"dwna"});
  EXPECT_EQ(refusal([&] { throw settings.error("models", "two models"); }),
            "key 'models': found the default '[\"dwna\"]', expected two models");
  EXPECT_EQ(refusal([&] { throw settings.error("start_mean", "nine numbers"); }),
            "key 'start_mean': found nothing, expected nine numbers");
}

}  // namespace settings_test
