#include <sys/wait.h>

#include "apps/temporary_directory.hpp"
#include "support/sigmax.hpp"

/// Sigma inference over learned relations, with Laplace smoothing, is categorical naive Bayes as scikit-learn has it.
namespace categorical_nb_test {

/// A column as numbers, in the order in which its values appear first.
struct Column {
  std::vector<std::size_t> numbers;
  std::vector<std::string> values;
  std::map<std::string, std::size_t> number_of{};

  void append(const std::string& value) {
    const auto [found, is_new] = number_of.try_emplace(value, values.size());
    if (is_new) values.push_back(value);
    numbers.push_back(found->second);
  }
};

/// The columns of a headed file without quotes, the one named `label` first.
std::vector<std::pair<std::string, Column>> columns_of(const std::filesystem::path& path, const std::string& label) {
  const auto fields = [](const std::string& line) {
    std::vector<std::string> result;
    std::istringstream text(line.substr(0, line.find('\r')));
    for (std::string field; std::getline(text, field, ',');) result.push_back(field);
    return result;
  };
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  std::vector<std::pair<std::string, Column>> columns;
  for (const auto& name : fields(line)) columns.emplace_back(name, Column{});
  while (std::getline(file, line)) {
    const auto row = fields(line);
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i].second.append(row.at(i));
  }
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].first == label)
      std::rotate(columns.begin(), columns.begin() + static_cast<std::ptrdiff_t>(i),
                  columns.begin() + static_cast<std::ptrdiff_t>(i) + 1);
  return columns;
}

struct DataSet {
  std::string name;
  std::string label;
  friend std::ostream& operator<<(std::ostream& out, const DataSet& data) { return out << data.name; }
};

class CategoricalNB : public testing::TestWithParam<DataSet> {};

TEST_P(CategoricalNB, OfScikitLearnHasTheSamePosteriors) {
  const auto [name, label] = GetParam();
  const auto data = std::filesystem::path(SIGMAX_DATA) / "recognition" / (name + ".csv");
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "no " << data;
  const apps::TemporaryDirectory directory;
  const auto output = directory.path() / "posteriors";
  // The system's Python: that is where the Debian package python3-sklearn is.
  const std::string command =
      "/usr/bin/python3 '" SIGMAX_CATEGORICAL_NB "' '" + data.string() + "' '" + label + "' '" + output.string() + "'";
  const int status = std::system(command.c_str());
  if (WEXITSTATUS(status) == 77 || WEXITSTATUS(status) == 127) GTEST_SKIP() << "no scikit-learn: python3-sklearn";
  ASSERT_EQ(status, 0);

  const auto columns = columns_of(data, label);
  const Column& labels = columns.front().second;
  std::vector<RandomVariable> features;
  for (std::size_t i = 1; i < columns.size(); ++i) features.emplace_back(columns[i].first, columns[i].second.values);
  Counts counts{RandomVariable{label, labels.values}, features};
  const auto row = [&](std::size_t r) {
    std::vector<std::size_t> result;
    for (std::size_t i = 1; i < columns.size(); ++i) result.push_back(columns[i].second.numbers[r]);
    return result;
  };
  for (std::size_t r = 0; r < labels.numbers.size(); ++r)
    if (r % 3 != 0) counts.observe(labels.numbers[r], row(r));

  Classifier classifier{pattern_prior(counts), learned_relations(counts, 1.0)};
  std::ifstream posteriors(output, std::ios::binary);
  std::vector<double> expected(labels.values.size());
  for (std::size_t r = 0; r < labels.numbers.size(); ++r) {
    ASSERT_TRUE(posteriors.read(reinterpret_cast<char*>(expected.data()),
                                static_cast<std::streamsize>(expected.size() * sizeof(double))));
    ASSERT_CLOSE(classifier.posterior(InOrder{row(r)}).distribution().values(), expected, 1e-9) << "row " << r;
  }
  EXPECT_EQ(posteriors.peek(), std::ifstream::traits_type::eof());
}

INSTANTIATE_TEST_SUITE_P(Data, CategoricalNB,
                         testing::Values(DataSet{"mushroom", "edible"}, DataSet{"car", "LABEL"},
                                         DataSet{"letter", "letter"}),
                         [](const auto& test) { return test.param.name; });

}  // namespace categorical_nb_test
