
#include "recognition_demo/learned_model.hpp"
#include "shell/input.hpp"
#include "shell/json.hpp"

namespace sigmax::apps {
namespace {

constexpr std::string_view format_name = "sigmax recognition model";
constexpr int format_version = 1;

/// A place in a model file, for its own value and for messages: "model.json: features[2].counts[0]".
struct Node {
  const Json& json;
  std::string file;
  std::string path{};

  Node at(const std::string& key) const {
    const std::string its_path = path.empty() ? key : path + "." + key;
    if (!json.is_object()) throw error("an object");
    const auto found = json.find(key);
    if (found == json.end()) throw InputError("{}: there is no {}", file, in_quotes(its_path));
    return {*found, file, its_path};
  }
  /// Of as many as are given, or expected.
  std::vector<Node> list(std::string_view of_what, std::optional<std::size_t> size = std::nullopt) const {
    if (!json.is_array()) throw error(fmt::format("a list of {}", of_what));
    if (size && json.size() != *size)
      throw InputError("{}: {}: found {} {}, expected {}", file, in_quotes(path), json.size(), of_what, *size);
    return each_below(json.size(), [&](std::size_t i) { return Node{json[i], file, fmt::format("{}[{}]", path, i)}; });
  }
  std::string text() const {
    if (!json.is_string() || json.get<std::string>().empty()) throw error("a text that is not empty");
    return json.get<std::string>();
  }
  bool boolean() const {
    if (!json.is_boolean()) throw error("true or false");
    return json.get<bool>();
  }
  double number() const {
    if (!json.is_number()) throw error("a number");
    return json.get<double>();
  }
  double number(double least, double below, std::string_view expected) const {
    const double value = number();
    if (!(value >= least && value < below)) throw error(expected);
    return value;
  }
  bool has(const std::string& key) const { return json.is_object() && json.contains(key); }

  InputError error(std::string_view expected, std::string_view remedy = {}) const {
    const std::string found = json.is_structured() ? (json.is_array() ? "a list" : "an object") : json.dump();
    return InputError({.where = file,
                       .what = path.empty() ? "" : in_quotes(path),
                       .found = in_quotes(found),
                       .expected = expected,
                       .remedy = remedy});
  }
};

std::vector<std::string> names(const Node& node, std::string_view of_what) {
  std::vector<std::string> result;
  std::set<std::string> seen;
  for (const Node& each : node.list(of_what)) {
    result.push_back(each.text());
    if (!seen.insert(result.back()).second) throw each.error("names that differ");
  }
  if (result.empty()) throw node.error("at least one name");
  return result;
}

double count(const Node& node) { return node.number(0.0, 0x1p53, "a count that is not negative"); }

FeatureCode feature_code(const Node& node) {
  FeatureCode code{.name = node.at("name").text()};
  code.missing_is_value = node.has("missing_is_value") && node.at("missing_is_value").boolean();
  if (!node.has("cuts")) {
    code.values = names(node.at("values"), "values");
    if (code.missing_is_value && std::ranges::find(code.values, "missing") != code.values.end())
      throw node.at("values").error("no value 'missing' beside missing_is_value");
    return code;
  }
  std::vector<double> cuts;
  for (const Node& each : node.at("cuts").list("numbers")) {
    cuts.push_back(each.number());
    if (cuts.size() > 1 && cuts[cuts.size() - 2] >= cuts.back()) throw each.error("cuts in ascending order");
  }
  code.bins = Discretization{cuts};
  return code;
}

Json parsed(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  const auto first = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  if (first < text.size() && text[first] != '{' && text[first] != '[')
    throw InputError(
        "{}: is no model: found {}, expected JSON as `recognition_demo train` writes it; the model comes first, then "
        "the data",
        path.native(), in_quotes(text.substr(first, text.find('\n', first) - first)));
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    // Its words are "[json.exception.parse_error.101] parse error at line 3, column 1: …".
    std::string what = error.what();
    if (const auto place = what.find("] "); place != std::string::npos) what = what.substr(place + 2);
    throw InputError({.where = path.native(),
                      .what = what,
                      .expected = "a model as `recognition_demo train` writes it",
                      .remedy = "train it again if the file was cut off"});
  } catch (const Json::exception&) {  // a number as 1e400
    throw InputError(
        "{}: holds a number that no double can hold: expected a model as `recognition_demo train` writes it",
        path.native());
  }
}

}  // namespace

void write_model(const LearnedModel& model, std::span<const std::string> kinds, const std::filesystem::path& path) {
  const Counts& counts = model.counts;
  Json json = {{"format", format_name},
               {"version", format_version},
               {"label", model.label},
               {"kinds", kinds},
               {"smoothing", model.options.smoothing},
               {"misread", model.options.misread},
               {"equal_prior", model.options.equal_prior}};
  if (!model.missing.empty()) json["missing"] = model.missing;
  for (std::size_t c = 0; c < counts.pattern().size(); ++c)
    json["classes"].push_back({{"name", counts.pattern().label(c)}, {"rows", counts.rows(c)}});
  for (std::size_t c = 0; c < model.right.size(); ++c) json["classes"][c]["right_when_left_out"] = model.right[c];
  for (std::size_t i = 0; i < model.features.size(); ++i) {
    const FeatureCode& code = model.features[i];
    Json feature = {{"name", code.name}};
    if (code.bins) feature["cuts"] = std::vector<double>(code.bins->cuts().begin(), code.bins->cuts().end());
    if (!code.bins) feature["values"] = code.values;
    if (code.missing_is_value) feature["missing_is_value"] = true;
    for (std::size_t c = 0; c < counts.pattern().size(); ++c)
      feature["counts"].push_back(std::vector<double>(counts.of(i, c).begin(), counts.of(i, c).end()));
    json["features"].push_back(feature);
  }
  std::string text;
  try {
    text = json.dump(1);
  } catch (const Json::type_error&) {  // a name that came from the data is no UTF-8
    throw InputError("{}: cannot be written: a name in the data is not UTF-8; convert the data to UTF-8",
                     path.native());
  }
  write_file(path, text + "\n");
}

ModelFile read_model(const std::filesystem::path& path) {
  const Json json = parsed(path);
  const Node root{json, path.native()};
  if (!root.has("format") || root.at("format").text() != format_name)
    throw InputError("{}: is no model of recognition_demo", path.native());
  if (root.at("version").number() != format_version)
    throw root.at("version").error(fmt::format("version {}", format_version),
                                   "train the model again with this program");

  // Whole before they are put together: if a later part of an aggregate throws, g++ 12 destroys the earlier ones twice.
  const std::string label = root.at("label").text();
  std::vector<std::string> kinds = names(root.at("kinds"), "kinds of classifiers");
  for (const Node& kind : root.at("kinds").list("kinds"))
    if (std::ranges::find(kind_names, kind.text()) == kind_names.end())
      throw kind.error(fmt::format("one of {}", fmt::join(kind_names, ", ")));
  LearningOptions options;
  options.smoothing = root.at("smoothing").number(0.0, 1e9, "a number that is not negative");
  options.misread = root.at("misread").number(0.0, 1.0, "a probability below one");
  options.equal_prior = root.at("equal_prior").boolean();

  std::vector<std::string> classes;
  std::vector<double> rows, right;
  std::set<std::string> seen;
  for (const Node& each : root.at("classes").list("classes")) {
    classes.push_back(each.at("name").text());
    if (!seen.insert(classes.back()).second) throw each.at("name").error("names that differ");
    rows.push_back(count(each.at("rows")));
    if (rows.back() == 0.0) throw each.at("rows").error("a class with at least one row");
    if (each.has("right_when_left_out"))
      right.push_back(each.at("right_when_left_out").number(0.0, std::nextafter(1.0, 2.0), "a share"));
  }
  if (classes.size() < 2) throw root.at("classes").error("at least two classes");

  const auto features = root.at("features").list("features");
  if (features.empty()) throw root.at("features").error("at least one feature");
  std::vector<FeatureCode> codes;
  std::vector<RandomVariable> variables;
  std::set<std::string> feature_names;
  for (const Node& feature : features) {
    codes.push_back(feature_code(feature));
    if (!feature_names.insert(codes.back().name).second) throw feature.at("name").error("names that differ");
    variables.emplace_back(codes.back().name, codes.back().labels());
  }
  Counts counts{RandomVariable{label, classes}, variables};
  const std::vector<std::size_t> nothing(features.size(), missing);
  for (std::size_t c = 0; c < classes.size(); ++c) counts.observe(c, nothing, rows[c]);
  for (std::size_t i = 0; i < features.size(); ++i) {
    const auto tables = features[i].at("counts").list("rows", classes.size());
    for (std::size_t c = 0; c < classes.size(); ++c) {
      const auto cells = tables[c].list("counts", variables[i].size());
      double sum = 0.0;
      for (std::size_t f = 0; f < cells.size(); ++f) {
        const double times = count(cells[f]);
        counts.observe_value(c, i, f, times);
        sum += times;
      }
      if (sum > rows[c])
        throw tables[c].error(
            fmt::format("counts with a sum of at most {}, the rows of class {}", rows[c], in_quotes(classes[c])));
      if (sum == 0.0 && options.smoothing == 0.0) throw tables[c].error("a count above zero, as there is no smoothing");
    }
  }
  auto missing_words = root.has("missing") ? names(root.at("missing"), "words") : std::vector<std::string>();
  if (right.size() < classes.size()) right.clear();  // models of old have none
  LearnedModel model{label, std::move(missing_words), std::move(codes), std::move(counts), options, std::move(right)};
  return {std::move(model), std::move(kinds)};
}

}  // namespace sigmax::apps
