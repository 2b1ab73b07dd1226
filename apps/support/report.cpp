#include "support/report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "support/json.hpp"
#include "support/report_assets.hpp"
#include "version.hpp"

namespace sigmax::apps {
namespace {

/// Seven digits are more than a screen shows, and half as long as all.
Json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.7g}", value).c_str(), nullptr);
}

/// All digits, as a summary has them.
Json exact(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json numbers(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(number(value));
  return list;
}

Json marked(const std::vector<Marked>& all) {
  Json list = Json::array();
  for (const Marked& one : all)
    list.push_back({{"from", number(one.from)}, {"to", number(one.to)}, {"label", one.label}});
  return list;
}

Json panel(const LineChart& chart) {
  Json json = {{"kind", "lines"},
               {"title", chart.title},
               {"x_label", chart.x_label},
               {"y_label", chart.y_label},
               {"x", numbers(chart.x)},
               {"curves", Json::array()},
               {"shaded", marked(chart.shaded)},
               {"expected", marked(chart.expected)},
               {"note", chart.note}};
  if (!chart.remarks.empty()) json["remarks"] = chart.remarks;
  if (chart.joined) json["joined"] = true;
  for (const HistoryBand& band : chart.histories) {
    Json stays = Json::array();
    for (const Stay& stay : band.stays)
      stays.push_back(
          {{"from", number(stay.from)}, {"to", number(stay.to)}, {"label", stay.label}, {"shade", stay.shade}});
    json["histories"].push_back({{"name", band.name}, {"group", band.group}, {"stays", std::move(stays)}});
  }
  if (chart.greatest_y) json["greatest_y"] = *chart.greatest_y;
  for (const Curve& curve : chart.curves) {
    Json one = {{"name", curve.name}, {"group", curve.group}, {"values", numbers(curve.values)}};
    if (!curve.lower.empty()) one["lower"] = numbers(curve.lower);
    if (!curve.upper.empty()) one["upper"] = numbers(curve.upper);
    if (curve.dash >= 0) one["dash"] = curve.dash;
    if (curve.dots) one["dots"] = true;
    json["curves"].push_back(std::move(one));
  }
  return json;
}

Json panel(const Plan& plan) {
  constexpr const char* shapes[] = {"line", "dots", "crosses"};
  Json json = {
      {"kind", "plan"},          {"title", plan.title},       {"x_label", plan.x_label},    {"y_label", plan.y_label},
      {"traces", Json::array()}, {"ellipses", Json::array()}, {"graticule", Json::array()}, {"note", plan.note}};
  if (!plan.focus.empty()) json["focus"] = numbers(plan.focus);
  for (const PlanTrace& trace : plan.traces) {
    Json one = {{"name", trace.name},
                {"group", trace.group},
                {"shape", shapes[static_cast<std::size_t>(trace.shape)]},
                {"x", numbers(trace.x)},
                {"y", numbers(trace.y)}};
    if (!trace.z.empty()) one["z"] = numbers(trace.z);
    json["traces"].push_back(std::move(one));
  }
  for (const ErrorEllipse& e : plan.ellipses)
    json["ellipses"].push_back({{"group", e.group},
                                {"x", number(e.x)},
                                {"y", number(e.y)},
                                {"semi_major", number(e.semi_major)},
                                {"semi_minor", number(e.semi_minor)},
                                {"angle_deg", number(e.angle_deg)}});
  for (const GraticuleLine& line : plan.graticule)
    json["graticule"].push_back({{"label", line.label}, {"x", numbers(line.x)}, {"y", numbers(line.y)}});
  return json;
}

Json panel(const IntervalChart& chart) {
  Json json = {{"kind", "intervals"}, {"title", chart.title},    {"x_label", chart.x_label},
               {"rows", chart.rows},  {"series", Json::array()}, {"wanted_label", chart.wanted_label},
               {"note", chart.note}};
  if (chart.reference) json["reference"] = *chart.reference;
  for (const IntervalSeries& series : chart.series) {
    Json one = {{"name", series.name},
                {"group", series.group},
                {"values", Json::array()},
                {"shown", Json::array()},
                {"wanted", marked(series.wanted)}};
    for (const Interval& value : series.values) {
      one["values"].push_back({number(value.mean), number(value.lower()), number(value.upper())});
      std::string shown = sized_text(value.mean, chart.digits);
      if (value.half_width > 0.0) shown += " ± " + sized_text(value.half_width, chart.digits);
      one["shown"].push_back(shown);
    }
    json["series"].push_back(std::move(one));
  }
  return json;
}

Json panel(const HeatMap& map) {
  Json json = {{"kind", "heat"},
               {"title", map.title},
               {"row_label", map.row_label},
               {"column_label", map.column_label},
               {"rows", map.rows},
               {"columns", map.columns},
               {"values", Json::array()},
               {"shown", Json::array()},
               {"value_label", map.value_label},
               {"diverging", map.diverging},
               {"texts", map.texts},
               {"note", map.note}};
  if (map.most) json["most"] = *map.most;
  for (std::size_t r = 0; r < map.values.size(); ++r) {
    Json cells = Json::array(), shown = Json::array();
    for (std::size_t c = 0; c < map.values[r].size(); ++c) {
      const double value = map.values[r][c];
      cells.push_back(exact(value));
      shown.push_back(sized_text(map.scale * value, map.digits, map.sign) +
                      (!map.marked.empty() && map.marked[r][c] ? "*" : ""));
    }
    json["values"].push_back(std::move(cells));
    json["shown"].push_back(std::move(shown));
  }
  return json;
}

Json panel(const ReportTable& table) {
  Json json = {{"kind", "table"}, {"title", table.title}, {"note", table.note}, {"filtered_by", table.filtered_by}};
  json.update(table.table.page());
  return json;
}

Json panel(const Words& words) {
  return {{"kind", "words"}, {"title", words.title}, {"text", words.text}, {"folded", words.folded}};
}

Json panels(const std::vector<Panel>& all) {
  Json list = Json::array();
  for (const Panel& one : all) list.push_back(std::visit([](const auto& any) { return panel(any); }, one));
  return list;
}

/// JSON that a page can hold: within its strings, and nowhere else, stand < and what else HTML could take for its own.
std::string in_page(const Json& json) {
  std::string text;
  for (const char letter : json.dump(-1, ' ', false, Json::error_handler_t::replace)) switch (letter) {
      case '<':
        text += "\\u003c";
        break;
      case '>':
        text += "\\u003e";
        break;
      case '&':
        text += "\\u0026";
        break;
      default:
        text += letter;
    }
  return text;
}

std::string in_html(std::string_view text) {
  std::string escaped;
  for (const char letter : text) {
    if (letter == '<')
      escaped += "&lt;";
    else if (letter == '&')
      escaped += "&amp;";
    else
      escaped += letter;
  }
  return escaped;
}

}  // namespace

void limit_axis(LineChart& chart) {
  std::vector<double> all;
  for (const Curve& curve : chart.curves)
    std::copy_if(curve.values.begin(), curve.values.end(), std::back_inserter(all),
                 [](double value) { return std::isfinite(value); });
  if (all.empty()) return;
  std::sort(all.begin(), all.end());
  double usual = 3.0 * all[all.size() / 2];
  for (const Marked& expected : chart.expected) usual = std::max(usual, 2.0 * expected.to);
  if (all.back() <= 2.0 * usual) return;
  chart.greatest_y = usual;
  chart.note = fmt::format("The axis is cut; the greatest value is {}.", sized_text(all.back(), 1));
}

bool has_reports() { return !report_assets::script.empty(); }

Json data_of(const Report& report) {
  Json data = {{"title", report.title}, {"verdict", report.verdict}, {"command", report.command}, {"version", version}};
  data["groups"] = Json::array();
  for (const ReportGroup& group : report.groups)
    data["groups"].push_back({{"name", group.name}, {"neutral", group.neutral}, {"shown", group.shown}});
  data["panels"] = panels(report.panels);
  data["chooser"] = report.chooser;
  data["views"] = Json::array();
  for (const View& view : report.views) data["views"].push_back({{"name", view.name}, {"panels", panels(view.panels)}});
  data["last"] = panels(report.last);
  return data;
}

std::string html(const Report& report) {
  if (!has_reports()) throw std::logic_error("a report without its drawing code");
  std::string page = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  page += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  page += "<meta name=\"color-scheme\" content=\"light dark\">\n";
  page += fmt::format("<title>{}</title>\n<style>\n", in_html(report.title));
  page += report_assets::style;
  page +=
      "</style>\n</head>\n<body>\n<main id=\"page\"><noscript>This report is drawn by JavaScript.</noscript></main>\n";
  page += "<script type=\"application/json\" id=\"data\">";
  page += in_page(data_of(report));
  page += "</script>\n";
  for (const std::string_view code :
       {report_assets::dygraphs, report_assets::synchronizer, report_assets::d3, report_assets::script}) {
    page += "<script>\n";
    page += code;
    page += "\n</script>\n";
  }
  page += "</body>\n</html>\n";
  return page;
}

}  // namespace sigmax::apps
