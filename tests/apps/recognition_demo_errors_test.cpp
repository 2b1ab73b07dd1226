#include "apps/recognition_demo_support.hpp"
#include "apps/refusals.hpp"

namespace recognition_demo_errors_test {

constexpr const char* good_csv = "colour,size,kind\nred,1,a\nblue,2,b\nred,3,a\nblue,4,b\n";
constexpr const char* good_model = R"({"format": "sigmax recognition model", "version": 1, "label": "kind",
 "kinds": ["sigma", "max"], "smoothing": 1, "misread": 0, "equal_prior": false,
 "classes": [{"name": "a", "rows": 2}, {"name": "b", "rows": 2}],
 "features": [{"name": "colour", "values": ["blue", "red"], "counts": [[0, 2], [2, 0]]},
              {"name": "size", "cuts": [2.5], "counts": [[1, 1], [1, 1]]}]})";

class Errors : public testing::TestWithParam<Refusal> {};

TEST_P(Errors, SayWhereAndWhatAndLeaveNothing) { expect_refused(GetParam(), SIGMAX_RECOGNITION_DEMO); }

const Refusal usual{"", "", {{"data.csv", good_csv}, {"model.json", good_model}}, 3, {}};
INSTANTIATE_TEST_SUITE_P(RecognitionDemo, Errors, testing::ValuesIn(refusals("recognition_demo_refusals.json", usual)),
                         [](const auto& one) { return one.param.name; });

TEST(RecognitionDemoErrors, TheGoodFilesOfTheseCasesAreGood) {
  const TemporaryDirectory directory;
  const auto data = directory.write("data.csv", good_csv);
  const auto model = directory.write("model.json", good_model);
  recognition_demo_succeeds({"classify", model, data});
  recognition_demo_succeeds({"train", data, "--label", "kind", "--model", directory.path() / "m.json"});
}

}  // namespace recognition_demo_errors_test
