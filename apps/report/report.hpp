#pragma once

#include "report/table.hpp"

namespace sigmax::apps {

/// What a report switches on and off as one: a filter, or something neutral as the measurement, drawn in grey.
struct ReportGroup {
  std::string name{};
  bool neutral = false;
  bool shown = true;  ///< when the page opens
};

/// Those that stand beside the filters.
inline constexpr const char* measurement_name = "measurement";
inline constexpr const char* truth_name = "truth";

/// Numbers from … to that are marked in a chart: along x a time that is shaded, along y where a value should be.
struct Marked {
  double from = 0.0, to = 0.0;
  std::string label{};
};

/// One curve of a chart; NaN is a gap. `lower` and `upper`, its confidence band, are empty or as long as `values`.
struct Curve {
  std::string name{};
  std::string group{};  ///< its name in the report's groups; empty for none
  std::vector<double> values{};
  std::vector<double> lower{}, upper{};
  int dash = -1;      ///< which pattern its line has; −1: that of its group
  bool dots = false;  ///< points rather than a line
};

/// What holds from … to: one of a history's pieces. `shade` tells those of the same label from others.
struct Stay {
  double from = 0.0, to = 0.0;
  std::string label{};
  std::size_t shade = 0;
};

/// A band below the curves of a chart that says which of several things holds when, as a history of modes.
struct HistoryBand {
  std::string name{}, group{};
  std::vector<Stay> stays{};
};

/// Curves over one axis, mostly time. The charts of a view are zoomed together.
struct LineChart {
  std::string title{};
  std::string x_label{};  ///< with its unit
  std::string y_label{};
  std::vector<double> x{};
  std::vector<Curve> curves{};
  std::vector<Marked> shaded{};        ///< along x
  std::vector<Marked> expected{};      ///< along y
  std::optional<double> greatest_y{};  ///< where the y axis ends, if not at the data
  std::string note{};
  std::vector<std::string> remarks{};  ///< beside the numbers at each x; empty or as long
  std::vector<HistoryBand> histories{};
  double joined = 0.0;       ///< gaps up to so long are of other curves' rows: a curve goes on over them; 0: it breaks
  bool coloured = false;     ///< each curve has a colour of its own, not that of its group
  bool logarithmic = false;  ///< along y
  bool course = false;       ///< y is an angle, whose numbers are parts of a turn
  double least_y = 0.0;      ///< where the y axis begins, if `greatest_y` says where it ends
  std::optional<double> clock{};  ///< where x begins, in seconds since 1970: its axis has clock times
};

/// The axis ends where nearly all numbers and bands after the first ones are, if some are far beyond: a bad first
/// estimate does not own it.
void keep_usual(LineChart& chart);

/// One trace of a map: a line or points, with a height where there is one.
struct PlanTrace {
  enum class Shape { line, dots, crosses };
  std::string name{}, group{};
  Shape shape = Shape::line;
  std::vector<double> x{}, y{};
  std::vector<double> z{};  ///< empty or as long as the others
};

/// Where an estimate is with 95 % confidence, in plan: centre, semi-axes, and the angle of the first one in degrees,
/// counter-clockwise from x.
struct ErrorEllipse {
  std::string group{};
  double x, y;
  double semi_major, semi_minor;
  double angle_deg;
};

/// Traces in plan, of one scale in x and y; those with heights are shown in space as well.
struct MapChart {
  std::string title{}, x_label{}, y_label{};
  std::vector<PlanTrace> traces{};
  std::vector<ErrorEllipse> ellipses{};
  std::vector<double> focus{};  ///< least and greatest x and y of what it opens with; empty: of all
  std::string note{};
};

/// A number with its interval in each row of a chart, and where it should be; both may be open or missing (NaN).
struct IntervalSeries {
  std::string name{};
  std::string group{};  ///< its name in the report's groups; empty for none
  std::vector<Interval> values{};
  std::vector<Marked> wanted{};  ///< empty or as long as the values; infinite ends are open
};

/// Numbers with their intervals below each other, those of all series side by side in each row.
struct IntervalChart {
  std::string title{};
  std::string x_label{};  ///< with its unit
  std::vector<std::string> rows{};
  std::vector<IntervalSeries> series{};
  std::optional<double> reference{};  ///< where a line stands that numbers are compared with
  std::string wanted_label{};         ///< what the shade means that says where a number should be
  int digits = 2;
  std::string note{};
};

/// A matrix as coloured cells. `values` has a row for each of `rows`; `texts`, if any, is what a cell says beside its
/// number.
struct HeatMap {
  std::string title{};
  std::string row_label{}, column_label{};
  std::vector<std::string> rows{}, columns{};
  std::vector<std::vector<double>> values{};
  std::string value_label{};  ///< with its unit
  bool diverging = false;     ///< zero is in the middle: below it is better
  int digits = 2;
  double scale = 1.0;            ///< what is shown is scale × the number: 100 for per cent
  bool sign = false;             ///< a + before what is positive
  std::optional<double> most{};  ///< the number with the strongest colour, if not the greatest of this map
  std::vector<std::vector<std::string>> texts{};
  std::vector<std::vector<bool>> marked{};  ///< cells with a star
  std::string note{};

  /// Gives all rows and columns what cell(row, column) says of them.
  struct Cell {
    double value;
    std::string text{};
    bool marked = false;
  };
  void fill(const std::function<Cell(std::size_t row, std::size_t column)>& cell);
};

/// What a cell of the map says: its number, with a star if it is marked.
std::string shown_in(const HeatMap& map, std::size_t row, std::size_t column);

/// A table with a title.
struct ReportTable {
  std::string title{};
  ResultTable table{};
  std::string note{};
};

/// Text as it is: settings, an explanation.
struct Words {
  std::string title{};
  std::string text{};
  bool folded = false;
};

using Panel = std::variant<LineChart, MapChart, IntervalChart, HeatMap, ReportTable, Words>;

/// What is shown for one choice of a report's selector.
struct View {
  std::string name{};
  std::vector<Panel> panels{};
};

/// A report as data. The drawing code shows it and computes nothing.
///
///     Report report{.title = "Scenario 1", .verdict = {"…"}, .command = options.command};
///     report.panels.push_back(HeatMap{…});
///     files.write(report_name, html(report));
struct Report {
  std::string title{};
  std::vector<std::string> verdict{};  ///< sentences
  std::string command{};
  std::vector<ReportGroup> groups{};
  std::vector<Panel> panels{};
  std::string chooser{};  ///< what is chosen: "Run", "Track"
  std::vector<View> views{};
  std::vector<Panel> last{};
};

inline constexpr const char* report_name = "report.html";
inline constexpr const char* report_data_name = "report.json";  ///< its data, for programs

/// Whether this program was built with the drawing code: with dygraphs and D3.
bool has_reports();

/// The page: data and drawing code in one file that needs no other. Text is escaped, so that every label is shown as it
/// is. Throws std::logic_error without the drawing code.
std::string html(const Report& report);

/// The page's data alone. Numbers of charts have seven digits; those of tables all.
nlohmann::ordered_json data_of(const Report& report);

}  // namespace sigmax::apps
