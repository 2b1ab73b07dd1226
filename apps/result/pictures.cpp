#include "result/pictures.hpp"

#include <spawn.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <set>

#include "result/report.hpp"
#include "support/output.hpp"
#include "support/scratch.hpp"

namespace sigmax::apps {
namespace {

// Colours and dashes as report.js has them.
constexpr std::array colours = {"#0072b2", "#d55e00", "#009e73", "#b0508a", "#a87400", "#3d8fc4", "#5d3fa0", "#6b6b00"};
constexpr std::array dashes = {"1", "(8,3)", "(2,3)", "(9,3,2,3)", "(14,4)", "(5,5)", "(3,3,9,3)", "(1,5)"};
constexpr const char* ink = "#1a1a1a";
constexpr const char* grey = "#7a7a7a";
constexpr const char* small = "font ',8' textcolor '#5c5c5c'";

// ColorBrewer's YlGnBu and PuOr: orange is below zero.
constexpr const char* growing =
    "set palette defined (0 '#fbfdd0', 1 '#edf8b1', 2 '#c7e9b4', 3 '#7fcdbb', 4 '#41b6c4', 5 '#1d91c0', 6 '#225ea8', 7 "
    "'#253494', 8 '#0d2163')";
constexpr const char* about_zero =
    "set palette defined (0 '#b35806', 1 '#e08214', 2 '#fdb863', 3 '#fee0b6', 4 '#f7f7f7', 5 '#d8daeb', 6 '#b2abd2', 7 "
    "'#8073ac', 8 '#542788')";

constexpr const char* all_pictures =
    "set encoding utf8\n"
    "set minussign\n"
    "set border 3 linecolor '#5c5c5c'\n"
    "set tics nomirror out scale 0.6\n"
    "set grid linecolor '#d5d5d5' linetype 1 linewidth 0.5\n"
    "set autoscale xfix\n";

constexpr double letter_cm = 0.165;  // the width of most, in the font that pictures have

/// The room for the plot itself and for what stands around it, in cm.
struct Frame {
  double left = 1.5, width = 13.8, right = 0.7;
  double height = 5.6, below = 1.45;  ///< with numbers and label of the axis
};

using Groups = std::vector<ReportGroup>;

/// Makes the script of one picture.
class Script {
 public:
  explicit Script(const Groups& groups) : groups_(groups) {}

  template <class... Arguments>
  void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    text_ += fmt::format(format, std::forward<Arguments>(arguments)...) + "\n";
  }

  bool hidden(const std::string& group) const {
    const auto found = find(group);
    return found != groups_.end() && !found->shown;
  }

  std::string colour(const std::string& group, std::size_t fallback) const {
    const auto found = find(group);
    if (found == groups_.end()) return colours[fallback % colours.size()];
    if (found->neutral) return found == groups_.begin() ? grey : ink;
    return colours[number(group) % colours.size()];
  }

  std::string line(const std::string& group, std::size_t fallback, int dash = -1) const {
    const std::size_t own = dash >= 0 ? static_cast<std::size_t>(dash) : group.empty() ? fallback : number(group);
    return fmt::format("lines linecolor '{}' dashtype {} linewidth 1.8", colour(group, fallback),
                       dashes[own % dashes.size()]);
  }

  /// Rows of numbers that gnuplot plots by the name that this returns.
  std::string data(const std::vector<std::vector<double>>& columns) {
    std::string name = fmt::format("$data{}", ++blocks_);
    text_ += name + " << END\n";
    for (std::size_t k = 0; k < columns.front().size(); ++k) {
      for (const auto& column : columns) text_ += std::isfinite(column[k]) ? fmt::format("{:.7g} ", column[k]) : "NaN ";
      text_ += "\n";
    }
    text_ += "END\n";
    return name;
  }

  /// One more element of the plot, with what the legend calls it, if anything.
  void plot(const std::string& element, const std::string& title = "") {
    widest_ = std::max(widest_, display_width(title));
    titles_ += title.empty() ? 0U : 1U;
    elements_.push_back(element + (title.empty() ? " notitle" : " title " + in_gnuplot(title)));
  }

  /// The picture: above the plot its title and what its numbers are, below it legend and note. Its script is empty if
  /// nothing is plotted.
  Picture finished(const std::string& title, const std::string& numbers, const std::string& note, const Frame& frame,
                   std::string_view command = "plot") const {
    constexpr double above = 1.9, legend_line = 0.47, note_line = 0.4, edge = 0.2;
    if (elements_.empty()) return {title, ""};
    const double wide = frame.left + frame.width + frame.right, bottom = above + frame.height;
    const auto fit = static_cast<std::size_t>(wide / (letter_cm * static_cast<double>(widest_) + 1.7));
    const auto columns = std::clamp<std::size_t>(fit, 1, std::max<std::size_t>(titles_, 1));
    const std::size_t rows = (titles_ + columns - 1) / columns;
    const double legend = legend_line * static_cast<double>(rows);
    std::vector<std::string> notes;
    if (!note.empty()) notes = lines_of(note, static_cast<std::size_t>(0.95 * wide / (8.0 / 9.0 * letter_cm)));
    const double high = bottom + frame.below + legend + note_line * static_cast<double>(notes.size()) + 0.2;
    const auto at = [&](double x, double y) {
      return fmt::format("screen {:.5f}, screen {:.5f}", x / wide, 1.0 - y / high);
    };
    std::string text = all_pictures;
    if (command == "plot")  // margins are no bounds in space
      text +=
          fmt::format("set margins at screen {:.5f}, screen {:.5f}, screen {:.5f}, screen {:.5f}\n", frame.left / wide,
                      (frame.left + frame.width) / wide, 1.0 - bottom / high, 1.0 - above / high);
    text += fmt::format("set label {} at {} font ',11'\n", in_gnuplot(title), at(edge, 0.45));
    text += fmt::format("set label {} at {} textcolor '#5c5c5c'\n", in_gnuplot(numbers), at(edge, 0.98));
    text += fmt::format("set key at {} center top horizontal Left reverse samplen 3 width 4 maxrows {} maxcols {}\n",
                        at(0.5 * wide, bottom + frame.below - 0.1), rows, columns);
    for (std::size_t i = 0; i < notes.size(); ++i)
      text += fmt::format("set label {} at {} {}\n", in_gnuplot(notes[i]),
                          at(edge, bottom + frame.below + legend + note_line * (static_cast<double>(i) + 0.5)), small);
    return {title, fmt::format("{}{}{} {}\n", text, text_, command, fmt::join(elements_, ", \\\n  ")), wide, high};
  }

 private:
  Groups::const_iterator find(const std::string& group) const {
    return std::ranges::find(groups_, group, &ReportGroup::name);
  }

  /// Which of the groups that are not neutral it is; the first if it is none.
  std::size_t number(const std::string& group) const {
    const auto found = find(group);
    if (found == groups_.end() || found->neutral) return 0;
    return static_cast<std::size_t>(
        std::count_if(groups_.begin(), found, [](const ReportGroup& one) { return !one.neutral; }));
  }

  const Groups& groups_;
  std::string text_;
  std::vector<std::string> elements_;
  std::size_t titles_ = 0, widest_ = 0;
  int blocks_ = 0;
};

bool any_finite(const std::vector<double>& values) {
  return std::ranges::any_of(values, [](double value) { return std::isfinite(value); });
}

/// x and numbers of a curve; a joined one goes on over its gaps.
std::vector<std::vector<double>> rows_of(const LineChart& chart, const Curve& curve) {
  std::vector<std::vector<double>> columns(4);
  for (std::size_t k = 0; k < chart.x.size(); ++k) {
    const double value = curve.values[k];
    if (chart.joined && !std::isfinite(value)) continue;
    columns[0].push_back(chart.x[k]);
    columns[1].push_back(value);
    columns[2].push_back(curve.lower.empty() ? value : curve.lower[k]);
    columns[3].push_back(curve.upper.empty() ? value : curve.upper[k]);
  }
  return columns;
}

void mark(const LineChart& chart, Script& script) {
  for (const Marked& one : chart.shaded) {
    if (one.from < one.to)
      script.say(
          "set object rectangle from {}, graph 0 to {}, graph 1 behind fillcolor '#f0ead6' fillstyle solid noborder",
          one.from, one.to);
    else
      script.say("set arrow from {0}, graph 0 to {0}, graph 1 nohead back linecolor '#b09a50'", one.from);
    script.say("set label {} at {}, graph 1.035 {}", in_gnuplot(one.label), one.from, small);
  }
  for (const Marked& one : chart.expected) {
    constexpr const char* style = "fillcolor '#007800' fillstyle transparent solid 0.12 noborder";
    script.say("set object rectangle from graph 0, first {} to graph 1, first {} behind {}", one.from, one.to, style);
    script.plot(fmt::format("keyentry with boxes {}", style), one.label);
  }
}

/// Areas above each other, the last one lowest as in a page, of means where there are more rows than a picture shows.
void stack(const LineChart& chart, Script& script) {
  constexpr std::size_t most = 400;
  const std::size_t period = 1 + chart.x.size() / most;
  std::vector<std::vector<double>> sums{{}, {}};  // x, and the upper end of the curve below
  std::vector<std::pair<std::string, std::string>> areas;
  for (std::size_t i = chart.curves.size(); i-- > 0;) {
    std::vector<double> x, values;
    double mean = 0.0;
    for (std::size_t k = 0, taken = 0; k < chart.x.size(); ++k) {
      if (!std::isfinite(chart.curves[i].values[k])) continue;
      mean += (chart.curves[i].values[k] - mean) / static_cast<double>(++taken);
      if (taken < period) continue;
      x.push_back(chart.x[k]);
      values.push_back(mean + (values.size() < sums[1].size() ? sums[1][values.size()] : 0.0));
      mean = 0.0;
      taken = 0;
    }
    sums = {std::move(x), std::move(values)};
    areas.emplace_back(
        script.data(sums) +
            fmt::format(" using 1:2 with filledcurves x1 fillcolor '{}' fillstyle solid 0.7", script.colour("", i)),
        chart.curves[i].name);
  }
  for (auto area = areas.rbegin(); area != areas.rend(); ++area) script.plot(area->first, area->second);
}

Picture drawn(const LineChart& chart, const Groups& groups) {
  Script script(groups);
  script.say("set xlabel {} textcolor '#5c5c5c'", in_gnuplot(chart.x_label));
  const bool begins = chart.greatest_y || chart.least_y != 0.0;
  script.say("set yrange [{}:{}]",
             begins              ? fmt::format("{}", chart.least_y)
             : chart.logarithmic ? "*"
                                 : "*<0",
             chart.greatest_y    ? fmt::format("{}", *chart.greatest_y)
             : chart.logarithmic ? "*"
                                 : "0<*");
  if (chart.logarithmic) script.say("set logscale y");
  if (chart.period > 0.0 && chart.greatest_y) {  // numbers that begin again
    std::string tics;
    for (double at = 0.0; at < *chart.greatest_y; at += chart.period / 8.0)
      tics += fmt::format("{}'{}' {}", tics.empty() ? "" : ", ", std::fmod(at, chart.period), at);
    script.say("set ytics ({})", tics);
  }
  if (chart.stacked && !chart.curves.empty() && !script.hidden(chart.curves.front().group)) {
    mark(chart, script);
    stack(chart, script);
    return script.finished(chart.title, chart.y_label, chart.note, {});
  }
  std::vector<std::pair<std::string, std::string>> lines;
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const Curve& curve = chart.curves[i];
    if (script.hidden(curve.group) || !any_finite(curve.values)) continue;
    const std::string data = script.data(rows_of(chart, curve)), colour = script.colour(curve.group, i);
    if (!curve.lower.empty())
      script.plot(
          data + fmt::format(" using 1:3:4 with filledcurves fillcolor '{}' fillstyle transparent solid 0.18", colour));
    lines.emplace_back(data + " using 1:2 with " +
                           (curve.dots ? fmt::format("points pointtype 7 pointsize 0.3 linecolor '{}'", colour)
                                       : script.line(curve.group, i, curve.dash)),
                       curve.name);
  }
  if (!lines.empty()) mark(chart, script);
  for (std::size_t k = 0; k < chart.remarks.size(); ++k)
    script.say("set label {} at {}, graph 1.035 center {}", in_gnuplot(chart.remarks[k]), chart.x[k], small);
  for (const auto& [line, title] : lines) script.plot(line, title);
  return script.finished(chart.title, chart.y_label, chart.note, {});
}

/// Whether there are too many traces to name them, and one is to be clicked at.
bool crowded(const Plan& plan) { return plan.traces.size() > 12; }

/// Traces in plan or in space, `columns` of their coordinates.
void plot_traces(const Plan& plan, const char* columns, Script& script) {
  for (std::size_t i = 0; i < plan.traces.size(); ++i) {
    const PlanTrace& one = plan.traces[i];
    if (script.hidden(one.group) || !any_finite(one.x)) continue;
    const std::string data = script.data({one.x, one.y, one.z.empty() ? one.x : one.z});
    const bool dots = one.shape == PlanTrace::Shape::dots;
    const std::string look = one.shape == PlanTrace::Shape::line
                                 ? script.line(one.group, i)
                                 : fmt::format("points pointtype {} pointsize {} linecolor '{}'", dots ? 7 : 2,
                                               dots ? 0.3 : 0.7, script.colour(one.group, i));
    script.plot(fmt::format("{} using {} with {}", data, columns, look), crowded(plan) ? "" : one.name);
  }
}

Picture drawn(const Plan& plan, const Groups& groups) {
  Script script(groups);
  script.say("set xlabel {} textcolor '#5c5c5c'\nset size ratio -1", in_gnuplot(plan.x_label));
  const auto b = plan.bounds();
  const double margin = 0.1 * std::max(b[1] - b[0], b[3] - b[2]);
  const double west = b[0] - margin, east = b[1] + margin, south = b[2] - margin, north = b[3] + margin;
  if (!(west < east || south < north)) return {plan.title, ""};
  script.say("set xrange [{}:{}]\nset yrange [{}:{}]", west, east, south, north);
  for (const GraticuleLine& line : plan.graticule) {
    const bool parallel = std::abs(line.x.back() - line.x.front()) > std::abs(line.y.back() - line.y.front());
    std::optional<std::size_t> at;  // a parallel is named where it comes in from the west, a meridian where it goes out
    for (std::size_t k = 0; k < line.x.size() && !(at && parallel); ++k)
      if (line.x[k] > west && line.x[k] < east && line.y[k] > south && line.y[k] < north) at = k;
    if (!at) continue;
    script.plot(script.data({line.x, line.y}) + " using 1:2 with lines linecolor '#a8a8a8' dashtype (1,3)");
    script.say("set label {} at {}, {} offset 0.3, 0.4 {}", in_gnuplot(line.label), line.x[*at], line.y[*at], small);
  }
  for (const ErrorEllipse& one : plan.ellipses)
    if (!script.hidden(one.group))
      script.say(
          "set object ellipse center {}, {} size {}, {} angle {} back fillcolor '{}' fillstyle transparent solid 0.15 "
          "border linecolor '{}'",
          one.x, one.y, 2.0 * one.semi_major, 2.0 * one.semi_minor, one.angle_deg, script.colour(one.group, 0),
          script.colour(one.group, 0));
  plot_traces(plan, "1:2", script);
  constexpr double widest = 13.0, highest = 9.0;
  const double ratio = (east - west) / std::max(north - south, 1e-9);
  Frame frame{.left = 2.0,
              .width = std::clamp(highest * ratio, 4.0, widest),
              .height = std::clamp(widest / std::max(ratio, 1e-9), 3.0, highest)};
  frame.right = 15.0 - frame.left - frame.width;  // for legend and note
  return script.finished(plan.title, plan.y_label, crowded(plan) ? "" : plan.note, frame);
}

/// The same from above and aside, if heights are known.
Picture in_space(Plan plan, const Groups& groups) {
  std::erase_if(plan.traces, [](const PlanTrace& one) { return !any_finite(one.z); });
  Script script(groups);
  script.say("set xlabel {}\nset ylabel {}\nset zlabel 'up, m' rotate parallel offset -2, 0", in_gnuplot(plan.x_label),
             in_gnuplot(plan.y_label));
  script.say("set origin 0, 0.08\nset border 31\nset xyplane 0\nset view 62, 32, 1.0, 1.25\nset tics font ',8'");
  script.say("set xtics offset -0.3, -0.4\nset ytics offset 0.8, -0.3");
  plot_traces(plan, "1:2:3", script);
  return script.finished(plan.title + ", in space", "", "", {.height = 9.0}, "splot");
}

/// Names along an axis, in whose formats % stands for a number.
std::string tics(const std::vector<std::string>& names) {
  std::string all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::string format = names[i];
    for (auto at = format.find('%'); at != std::string::npos; at = format.find('%', at + 2)) format.insert(at, "%");
    all += fmt::format("{}{} {}", i ? ", " : "", in_gnuplot(format), i);
  }
  return "(" + all + ")";
}

double longest_cm(const std::vector<std::string>& names) { return letter_cm * static_cast<double>(widest(names)); }

Picture drawn(const HeatMap& map, const Groups& groups) {
  constexpr std::size_t most_texts = 400;
  const bool written = map.rows.size() * map.columns.size() <= most_texts;
  const double row_cm = 0.65, cell_cm = written ? 1.35 : row_cm;
  Script script(groups);
  std::vector<std::vector<double>> cells(3);
  for (std::size_t r = 0; r < map.rows.size(); ++r)
    for (std::size_t c = 0; c < map.columns.size(); ++c)
      if (std::isfinite(map.values[r][c])) {
        cells[0].push_back(static_cast<double>(c));
        cells[1].push_back(static_cast<double>(r));
        cells[2].push_back(map.scale * map.values[r][c]);
      }
  if (cells[2].empty()) return {map.title, ""};
  const auto [least, greatest] = std::ranges::minmax_element(cells[2]);
  const double end = map.most ? map.scale * *map.most : std::max({std::abs(*least), std::abs(*greatest), 1e-300});
  const double low = map.diverging ? -end : std::min(0.0, *least);
  const double high = map.diverging || map.most ? end : std::max(*greatest, low + 1e-300);
  const double name_cm = longest_cm(map.columns);
  const bool slanted = name_cm > cell_cm - 0.1;
  script.say("unset grid\nset border 0\nset tics scale 0\nset xtics {}{}", slanted ? "rotate by 40 right " : "",
             tics(map.columns));
  script.say("set ytics {}\nset cbtics scale 0.6", tics(map.rows));
  script.say("set xrange [-0.5:{0}]\nset yrange [{1}:-0.5]\nset cbrange [{2}:{3}]",
             static_cast<double>(map.columns.size()) - 0.5, static_cast<double>(map.rows.size()) - 0.5, low, high);
  script.say("{}", map.diverging ? about_zero : growing);
  for (std::size_t k = 0; k < cells[2].size() && written; ++k) {
    const double part = (cells[2][k] - low) / (high - low);
    const bool white = map.diverging ? std::abs(part - 0.5) > 0.35 : part > 0.55;
    script.say("set label {} at {}, {} center front font ',8' textcolor '{}'",
               in_gnuplot(shown_in(map, static_cast<std::size_t>(cells[1][k]), static_cast<std::size_t>(cells[0][k]))),
               cells[0][k], cells[1][k], white ? "#ffffff" : ink);
  }
  script.plot(script.data(cells) +
              " using 1:2:(0.49):(0.49):3 with boxxyerror fillstyle solid noborder linecolor palette");
  Frame frame{.width = cell_cm * static_cast<double>(map.columns.size()),
              .right = 2.2,
              .height = row_cm * static_cast<double>(map.rows.size())};
  frame.left = std::max({longest_cm(map.rows) + 0.5, slanted ? 0.77 * name_cm - 0.5 * cell_cm + 0.3 : 0.0, 1.0});
  const double text_cm = std::max(longest_cm({map.title}) * 11.0 / 9.0, longest_cm({map.value_label}));
  frame.right = std::max(frame.right, text_cm + 0.5 - frame.left - frame.width);
  frame.below = slanted ? 0.64 * name_cm + 0.7 : 0.8;
  script.say("set label {} at screen 0, graph 1 offset 1, 0.7 {}",
             in_gnuplot(fmt::format("{} \\ {}", map.row_label, map.column_label)), small);
  return script.finished(map.title, map.value_label, map.note, frame);
}

/// A title as the name of a file: its letters and digits.
std::string file_name(std::string_view title) {
  std::string name;
  for (const char letter : lower_case(title))
    if ((letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9'))
      name += letter;
    else if (!name.empty() && name.back() != '_')
      name += '_';
  if (name.ends_with('_')) name.pop_back();
  return name.empty() ? "figure" : name.substr(0, 80);
}

std::string contents(const UnnamedFile& file) {
  std::string text(file.size(), ' ');
  file.read(0, std::as_writable_bytes(std::span(text)));
  return text;
}

/// What gnuplot writes when it reads the script. Throws UsageError where there is no gnuplot.
std::string drawn_by_gnuplot(const std::string& script) {
  const UnnamedFile in("gnuplot"), out("gnuplot"), complaints("gnuplot");
  in.write(0, std::as_bytes(std::span(script)));
  posix_spawn_file_actions_t streams;
  ::posix_spawn_file_actions_init(&streams);
  int to = 0;
  for (const UnnamedFile* file : {&in, &out, &complaints})
    ::posix_spawn_file_actions_adddup2(&streams, file->descriptor(), to++);
  std::string name = "gnuplot", no_settings = "-d", standard_input = "-";
  std::array<char*, 4> arguments{name.data(), no_settings.data(), standard_input.data(), nullptr};
  pid_t child = 0;
  const int failure = ::posix_spawnp(&child, name.c_str(), &streams, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&streams);
  if (failure != 0)
    throw UsageError(
        "gnuplot, which draws the plots, cannot be started: {}; install it (Debian: gnuplot-nox), or leave the plots "
        "out",
        reason(failure));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error("gnuplot failed: " + printable(contents(complaints), true));
  return contents(out);
}

}  // namespace

std::vector<Picture> pictures_of(const Report& report) {
  std::vector<Picture> pictures;
  std::set<std::string> names;
  const auto add = [&](Picture picture) {
    if (picture.script.empty()) return;
    const std::string name = file_name(picture.name);
    picture.name = name;
    for (int number = 2; !names.insert(picture.name).second; ++number)
      picture.name = fmt::format("{}_{}", name, number);
    pictures.push_back(std::move(picture));
  };
  const auto add_all = [&](const std::vector<Panel>& panels) {
    for (const Panel& one : panels)
      std::visit(
          [&](const auto& panel) {
            if constexpr (requires { drawn(panel, report.groups); }) add(drawn(panel, report.groups));
            if constexpr (requires { in_space(panel, report.groups); }) add(in_space(panel, report.groups));
          },
          one);
  };
  add_all(report.panels);
  if (!report.views.empty()) add_all(report.views.front().panels);
  add_all(report.last);
  return pictures;
}

void need_gnuplot() { drawn_by_gnuplot(""); }

std::string svg_of(const Picture& picture) {
  constexpr double pixels_per_cm = 42.0;
  return drawn_by_gnuplot(fmt::format(
      "set terminal svg size {:.0f},{:.0f} noenhanced font 'sans-serif,9' fontscale 1.45 background 'white'\n{}",
      pixels_per_cm * picture.width_cm, pixels_per_cm * picture.height_cm, picture.script));
}

std::string pdf_of(const Picture& picture) {
  std::string pdf = drawn_by_gnuplot(fmt::format("set terminal pdfcairo size {}cm,{}cm noenhanced font 'sans,9'\n{}",
                                                 picture.width_cm, picture.height_cm, picture.script));
  // The time of day becomes blanks: in the tables of a PDF places are counted.
  if (const auto from = pdf.find("/CreationDate ("); from != std::string::npos)
    std::fill(&pdf[from], &pdf[pdf.find(')', from)] + 1, ' ');
  return pdf;
}

std::string in_gnuplot(std::string_view text) {
  std::string quoted = "'";
  for (const char letter : sound_text(text)) {
    if (letter == '\'') quoted += '\'';
    quoted += static_cast<unsigned char>(letter) < ' ' || letter == '\x7F' ? ' ' : letter;
  }
  return quoted + "'";
}

void save_svg(const LineChart& chart, const std::filesystem::path& path) { write_file(path, svg_of(drawn(chart, {}))); }

}  // namespace sigmax::apps
