#include "recognition_demo/learning.hpp"

#include <nlohmann/json.hpp>

#include "shell/files.hpp"

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
  template <class Value>
  Value as(bool is_right, std::string_view expected) const {
    if (!is_right) throw error(expected);
    return json.get<Value>();
  }
  std::string text() const {
    return as<std::string>(json.is_string() && !json.get<std::string>().empty(), "a text that is not empty");
  }
  bool boolean() const { return as<bool>(json.is_boolean(), "true or false"); }
  double number() const { return as<double>(json.is_number(), "a number"); }
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

/// Names that differ: these, or what stands at a key of each.
std::vector<std::string> names(const Node& node, std::string_view of_what, const char* key = nullptr) {
  std::vector<std::string> result;
  for (const Node& each : node.list(of_what)) {
    const Node name = key ? each.at(key) : each;
    if (std::ranges::find(result, name.text()) != result.end()) throw name.error("names that differ");
    result.push_back(name.text());
  }
  if (result.empty()) throw node.error("at least one name");
  return result;
}

double count(const Node& node) { return node.number(0.0, 0x1p53, "a count that is not negative"); }

TableFeature feature_of(const Node& node) {
  TableFeature feature{.name = node.at("name").text()};
  feature.missing_is_value = node.has("missing_is_value") && node.at("missing_is_value").boolean();
  if (!node.has("cuts")) {
    feature.words = names(node.at("values"), "values");
    if (feature.missing_is_value && feature.find("missing"))
      throw node.at("values").error("no value 'missing' beside missing_is_value");
    return feature;
  }
  std::vector<double> cuts;
  for (const Node& each : node.at("cuts").list("numbers")) {
    cuts.push_back(each.number());
    if (cuts.size() > 1 && cuts[cuts.size() - 2] >= cuts.back()) throw each.error("cuts in ascending order");
  }
  feature.bins = Discretization{cuts};
  return feature;
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
  } catch (const Json::exception& error) {
    // Its words are "[json.exception.parse_error.101] parse error at line 3, column 1: …".
    std::string what = error.what();
    if (const auto place = what.find("] "); place != std::string::npos) what = what.substr(place + 2);
    throw InputError({.where = path.native(),
                      .what = what,
                      .expected = "a model as `recognition_demo train` writes it",
                      .remedy = "train it again if the file was cut off"});
  }
}

}  // namespace

void write_model(const SavedModel& saved, const std::filesystem::path& path) {
  const auto& [features, counts, options] = saved.model;
  Json json = {{"format", format_name},
               {"version", format_version},
               {"label", counts.pattern().name()},
               {"kinds", saved.kinds},
               {"smoothing", options.smoothing},
               {"misread", options.misread},
               {"equal_prior", options.equal_prior}};
  if (!saved.missing.empty()) json["missing"] = saved.missing;
  for (std::size_t c = 0; c < counts.pattern().size(); ++c)
    json["classes"].push_back({{"name", counts.pattern().label(c)}, {"rows", counts.rows(c)}});
  for (std::size_t i = 0; i < features.size(); ++i) {
    const TableFeature& one = features[i];
    Json feature = {{"name", one.name}};
    if (one.bins) feature["cuts"] = std::vector<double>(one.bins->cuts().begin(), one.bins->cuts().end());
    if (!one.bins) feature["values"] = one.words;
    if (one.missing_is_value) feature["missing_is_value"] = true;
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

SavedModel read_model(const std::filesystem::path& path) {
  const Json json = parsed(path);
  const Node root{json, path.native()};
  if (!root.has("format") || root.at("format").text() != format_name)
    throw InputError("{}: is no model of recognition_demo", path.native());
  if (root.at("version").number() != format_version)
    throw root.at("version").error(fmt::format("version {}", format_version),
                                   "train the model again with this program");

  const std::string label = root.at("label").text();
  std::vector<std::string> kinds = names(root.at("kinds"), "kinds of classifiers");
  for (const Node& kind : root.at("kinds").list("kinds"))
    if (std::ranges::find(kind_names, kind.text()) == kind_names.end())
      throw kind.error(fmt::format("one of {}", fmt::join(kind_names, ", ")));
  TableOptions options;
  options.smoothing = root.at("smoothing").number(0.0, 1e9, "a number that is not negative");
  options.misread = root.at("misread").number(0.0, 1.0, "a probability below one");
  options.equal_prior = root.at("equal_prior").boolean();

  std::vector<double> rows;
  std::vector<std::string> classes = names(root.at("classes"), "classes", "name");
  for (const Node& each : root.at("classes").list("classes")) {
    rows.push_back(count(each.at("rows")));
    if (rows.back() == 0.0) throw each.at("rows").error("a class with at least one row");
  }
  if (classes.size() < 2) throw root.at("classes").error("at least two classes");

  names(root.at("features"), "features", "name");
  const auto features = root.at("features").list("features");
  TableModel model{RandomVariable{label, classes}, each(features, feature_of), options};
  const std::vector<std::size_t> nothing(features.size(), missing);
  for (std::size_t c = 0; c < classes.size(); ++c) model.counts.observe(c, nothing, rows[c]);
  for (std::size_t i = 0; i < features.size(); ++i) {
    const auto tables = features[i].at("counts").list("rows", classes.size());
    for (std::size_t c = 0; c < classes.size(); ++c) {
      const auto cells = tables[c].list("counts", model.features[i].size());
      double sum = 0.0;
      for (std::size_t f = 0; f < cells.size(); ++f) {
        const double times = count(cells[f]);
        model.counts.observe_value(c, i, f, times);
        sum += times;
      }
      if (sum > rows[c])
        throw tables[c].error(
            fmt::format("counts with a sum of at most {}, the rows of class {}", rows[c], in_quotes(classes[c])));
      if (sum == 0.0 && options.smoothing == 0.0) throw tables[c].error("a count above zero, as there is no smoothing");
    }
  }
  auto missing_words = root.has("missing") ? names(root.at("missing"), "words") : std::vector<std::string>();
  return {std::move(model), std::move(kinds), std::move(missing_words)};
}

}  // namespace sigmax::apps
