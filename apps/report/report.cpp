#include "report/report.hpp"

#include <cmath>
#include <cstdlib>

#include <nlohmann/json.hpp>

#include "version.hpp"

namespace sigmax::apps {

/// What every report holds beside its data, put into the program when it is built; empty where dygraphs or D3 was
/// missing.
namespace report_assets {
extern const std::string_view style, dygraphs, synchronizer, d3, script;
}

namespace {

/// What a report is made of as JSON. Numbers have seven digits: more than a screen shows, and half as long as all.
struct Data {
  static Json of(double value) {
    if (!std::isfinite(value)) return nullptr;
    return std::strtod(fmt::format("{:.7g}", value).c_str(), nullptr);
  }

  /// Words, counts, and what is JSON already.
  template <class Value>
  static Json of(const Value& value) {
    return value;
  }

  template <class Item>
  static Json of(const std::vector<Item>& items) {
    Json all = Json::array();
    for (const Item& item : items) all.push_back(of(item));
    return all;
  }

  /// An object of keys and values by turns.
  template <class... KeysAndValues>
  static Json object(const KeysAndValues&... all) {
    std::array<Json, sizeof...(all)> items{of(all)...};
    Json json;
    for (std::size_t i = 0; i < items.size(); i += 2)
      json[items[i].template get<std::string>()] = std::move(items[i + 1]);
    return json;
  }

  static Json of(const Marked& one) { return object("from", one.from, "to", one.to, "label", one.label); }

  static Json of(const Curve& curve) {
    Json json = object("name", curve.name, "group", curve.group, "values", curve.values);
    if (!curve.lower.empty()) json["lower"] = of(curve.lower);
    if (!curve.upper.empty()) json["upper"] = of(curve.upper);
    if (curve.dash >= 0) json["dash"] = curve.dash;
    if (curve.dots) json["dots"] = true;
    return json;
  }

  static Json of(const Stay& stay) {
    return object("from", stay.from, "to", stay.to, "label", stay.label, "shade", stay.shade);
  }

  static Json of(const HistoryBand& band) {
    return object("name", band.name, "group", band.group, "stays", band.stays);
  }

  static Json of(const LineChart& chart) {
    Json json =
        object("kind", "lines", "title", chart.title, "x_label", chart.x_label, "y_label", chart.y_label, "x", chart.x,
               "curves", chart.curves, "shaded", chart.shaded, "expected", chart.expected, "note", chart.note);
    if (!chart.remarks.empty()) json["remarks"] = chart.remarks;
    if (chart.joined > 0.0) json["joined"] = of(chart.joined);
    if (chart.coloured) json["coloured"] = true;
    if (chart.course) json["course"] = true;
    if (chart.clock) json["clock"] = *chart.clock;
    if (chart.logarithmic) json["logarithmic"] = true;
    if (!chart.histories.empty()) json["histories"] = of(chart.histories);
    if (chart.greatest_y || chart.least_y != 0.0)
      json["range"] = {chart.least_y, chart.greatest_y ? Json(*chart.greatest_y) : Json()};
    return json;
  }

  static Json of(const PlanTrace& trace) {
    constexpr const char* shapes[] = {"line", "dots", "crosses"};
    Json json = object("name", trace.name, "group", trace.group, "shape", shapes[static_cast<std::size_t>(trace.shape)],
                       "x", trace.x, "y", trace.y);
    if (!trace.z.empty()) json["z"] = of(trace.z);
    return json;
  }

  static Json of(const ErrorEllipse& e) {
    return object("group", e.group, "x", e.x, "y", e.y, "semi_major", e.semi_major, "semi_minor", e.semi_minor,
                  "angle_deg", e.angle_deg);
  }

  static Json of(const MapChart& plan) {
    Json json = object("kind", "plan", "title", plan.title, "x_label", plan.x_label, "y_label", plan.y_label, "traces",
                       plan.traces, "ellipses", plan.ellipses, "note", plan.note);
    if (!plan.focus.empty()) json["focus"] = of(plan.focus);
    return json;
  }

  static Json of(const Interval& value) { return {of(value.mean), of(value.lower()), of(value.upper())}; }

  static Json of(const IntervalChart& chart) {
    Json series = Json::array();
    for (const IntervalSeries& one : chart.series) {
      std::vector<std::string> shown;
      for (const auto& [mean, half_width] : one.values)
        shown.push_back(sized_text(mean, chart.digits) +
                        (half_width > 0.0 ? " ± " + sized_text(half_width, chart.digits) : ""));
      series.push_back(
          object("name", one.name, "group", one.group, "values", one.values, "shown", shown, "wanted", one.wanted));
    }
    Json json = object("kind", "intervals", "title", chart.title, "x_label", chart.x_label, "rows", chart.rows,
                       "series", series, "wanted_label", chart.wanted_label, "note", chart.note);
    if (chart.reference) json["reference"] = *chart.reference;
    return json;
  }

  static Json of(const HeatMap& map) {
    std::vector<std::vector<std::string>> shown(map.values.size());
    for (std::size_t r = 0; r < shown.size(); ++r)
      for (std::size_t c = 0; c < map.values[r].size(); ++c) shown[r].push_back(shown_in(map, r, c));
    const Json exact = map.values;  // of which null stands for those that are not finite
    Json json = object("kind", "heat", "title", map.title, "row_label", map.row_label, "column_label", map.column_label,
                       "rows", map.rows, "columns", map.columns, "values", exact, "shown", shown, "value_label",
                       map.value_label, "diverging", map.diverging, "texts", map.texts, "note", map.note);
    if (map.most) json["most"] = *map.most;
    return json;
  }

  static Json of(const ReportTable& table) {
    Json json = object("kind", "table", "title", table.title, "note", table.note);
    json.update(table.table.page());
    return json;
  }

  static Json of(const Words& words) {
    return object("kind", "words", "title", words.title, "text", words.text, "folded", words.folded);
  }

  static Json of(const Panel& panel) {
    return std::visit([](const auto& any) { return of(any); }, panel);
  }

  static Json of(const ReportGroup& group) {
    return object("name", group.name, "neutral", group.neutral, "shown", group.shown);
  }

  static Json of(const View& view) { return object("name", view.name, "panels", view.panels); }
};

/// Text in which what HTML could take for its own stands as these say.
std::string escaped(std::string_view text, std::string_view less, std::string_view greater,
                    std::string_view ampersand) {
  std::string result;
  for (const char letter : text)
    result += letter == '<' ? less : letter == '>' ? greater : letter == '&' ? ampersand : std::string_view(&letter, 1);
  return result;
}

}  // namespace

void HeatMap::fill(const std::function<Cell(std::size_t row, std::size_t column)>& cell) {
  values.assign(rows.size(), {});
  texts = {};
  marked = {};
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t c = 0; c < columns.size(); ++c) {
      Cell one = cell(r, c);
      values[r].push_back(one.value);
      if (!one.text.empty()) texts.resize(rows.size(), std::vector<std::string>(columns.size()));
      if (one.marked) marked.resize(rows.size(), std::vector<bool>(columns.size()));
      if (!texts.empty()) texts[r][c] = std::move(one.text);
      if (!marked.empty()) marked[r][c] = one.marked;
    }
}

std::string shown_in(const HeatMap& map, std::size_t row, std::size_t column) {
  const std::string number = sized_text(map.scale * map.values[row][column], map.digits, map.sign);
  return !map.marked.empty() && map.marked[row][column] ? number + "*" : number;
}

void keep_usual(LineChart& chart) {
  std::vector<double> usual;
  double least = 0.0, greatest = 0.0;
  for (const Curve& curve : chart.curves)
    for (const auto* const values : {&curve.values, &curve.lower, &curve.upper})
      for (std::size_t k = 0; k < values->size(); ++k) {
        const double value = (*values)[k];
        least = std::fmin(least, value);
        greatest = std::fmax(greatest, value);
        if (std::isfinite(value) && k >= std::min<std::size_t>(10, values->size() / 4)) usual.push_back(value);
      }
  if (usual.empty()) return;
  std::ranges::sort(usual);
  const std::size_t cut = usual.size() / 200;  // 0.5 % at each end
  const double low = std::min(0.0, usual[cut]);
  double high = std::max(0.0, usual[usual.size() - 1 - cut]);
  for (const Marked& expected : chart.expected) high = std::max(high, expected.to);
  if (low == high || greatest - least <= 2.0 * (high - low)) return;
  const double margin = 0.15 * (high - low);
  chart.least_y = std::max(least, low - margin);
  chart.greatest_y = std::min(greatest, high + margin);
  chart.note = fmt::format("The axis is cut; numbers and bands go from {} to {}.", sized_text(least, 1),
                           sized_text(greatest, 1));
}

Json ResultTable::json() const {
  Json all = Json::object();
  for (const auto& row : rows_) {
    if (row.empty()) continue;
    Json& one = all[std::get<std::string>(row.front().value())] = Json::object();
    for (std::size_t i = 1; i < row.size(); ++i)
      if (!columns_[i].key.empty() && row[i].value().index() != 0) one[columns_[i].key] = as_json(row[i]);
  }
  return all;
}

Json ResultTable::page() const {
  Json columns = Json::array(), rows = Json::array();
  for (const ResultColumn& column : columns_)
    if (!column.header.empty())
      columns.push_back(Data::object("header", column.full_header(), "group", column.group, "left",
                                     column.align == Align::left, "key", column.key));
  for (const auto& row : rows_) {
    Json cells = Json::array();
    for (std::size_t i = 0; i < row.size(); ++i)
      if (!columns_[i].header.empty())
        cells.push_back({{"text", shown_in(columns_[i], row[i])}, {"value", as_json(row[i])}});
    rows.push_back(std::move(cells));
  }
  return {{"columns", std::move(columns)}, {"rows", std::move(rows)}};
}

Json as_json(const Cell& cell) {
  const auto* const interval = std::get_if<Interval>(&cell.value());
  if (interval == nullptr)
    return std::visit(
        [](const auto& value) {
          if constexpr (std::is_constructible_v<Json, decltype(value)>) return Json(value);
          return Json();
        },
        cell.value());
  const bool open = without_bounds(*interval);
  return {{"mean", interval->mean},
          {"lower", open ? Json() : Json(interval->lower())},
          {"upper", open ? Json() : Json(interval->upper())}};
}

std::string dumped(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

bool has_reports() { return !report_assets::script.empty(); }

Json data_of(const Report& report) {
  return Data::object("title", report.title, "verdict", report.verdict, "command", report.command, "version", version,
                      "groups", report.groups, "panels", report.panels, "chooser", report.chooser, "views",
                      report.views, "last", report.last);
}

std::string html(const Report& report) {
  if (!has_reports()) throw std::logic_error("a report without its drawing code");
  // Within the strings of JSON, and nowhere else, stand < and what else HTML could take for its own.
  const std::string data = escaped(dumped(data_of(report)), "\\u003c", "\\u003e", "\\u0026");
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n"
      "<main id=\"page\"><noscript>This report is drawn by JavaScript.</noscript></main>\n"
      "<script type=\"application/json\" id=\"data\">{}</script>\n",
      escaped(report.title, "&lt;", ">", "&amp;"), report_assets::style, data);
  for (const std::string_view code :
       {report_assets::dygraphs, report_assets::synchronizer, report_assets::d3, report_assets::script})
    page += fmt::format("<script>\n{}\n</script>\n", code);
  return page + "</body>\n</html>\n";
}

}  // namespace sigmax::apps
