#include "recognition_demo/encounter_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "support/csv.hpp"
#include "support/input.hpp"
#include "support/numbers.hpp"

namespace sigmax::apps {
namespace {

constexpr std::array<const char*, 4> features = {"altitude_layer_ft_agl", "airspeed_kt", "vertical_rate_ft_per_min",
                                                 "turn_rate_deg_per_s"};

/// Bins of one feature, as one class has them.
struct Layers {
  std::vector<double> lower, upper, count;
};

std::size_t column_of(const CsvReader& reader, std::initializer_list<std::string_view> names) {
  for (const auto name : names)
    if (const auto found = reader.find(name)) return *found;
  return reader.column(*names.begin());  // throws
}

}  // namespace

EncounterData read_encounter(const std::string& file) {
  CsvReader reader = open_csv(file);
  const std::size_t klass = reader.column("class"), feature = reader.column("feature");
  const std::size_t lower = reader.column("lower"), upper = reader.column("upper"), count = reader.column("count");
  std::vector<std::string> classes;
  std::map<std::pair<std::string, std::size_t>, Layers> all;
  for (CsvRow row; reader.next(row);) {
    const std::string name{trimmed(row[klass])};
    if (name.empty()) throw row.error(klass, "the name of a class");
    if (std::find(classes.begin(), classes.end(), name) == classes.end()) classes.push_back(name);
    const auto known = std::find(features.begin(), features.end(), trimmed(row[feature]));
    if (known == features.end()) continue;
    Layers& layers = all[{name, static_cast<std::size_t>(known - features.begin())}];
    const double begin = row.number(lower), end = row.number(upper), times = row.number(count);
    if (!layers.upper.empty() && layers.upper.back() != begin)
      throw row.error(lower, fmt::format("{}, where the bin before ends", layers.upper.back()));
    if (!(end > begin)) throw row.error(upper, fmt::format("a number above {}", begin));
    if (times < 0.0) throw row.error(count, "a count that is not negative");
    layers.lower.push_back(begin);
    layers.upper.push_back(end);
    layers.count.push_back(times);
  }
  if (classes.size() < 2)
    throw InputError(message(
        {.where = reader.file(), .found = fmt::format("{} classes", classes.size()), .expected = "at least two"}));

  std::vector<Discretization> bins;
  std::vector<RandomVariable> variables;
  for (std::size_t i = 0; i < features.size(); ++i) {
    const Layers& first = all[{classes.front(), i}];
    for (const auto& name : classes) {
      const Layers& own = all[{name, i}];
      double sum = 0.0;
      for (const double times : own.count) sum += times;
      if (own.lower != first.lower || own.upper != first.upper || !(sum > 0.0))
        throw InputError(message({.where = reader.file(),
                                  .what = fmt::format("class {}, feature {}", in_quotes(name), in_quotes(features[i])),
                                  .expected = "counts, in the same bins for every class"}));
    }
    bins.emplace_back(std::vector<double>(first.lower.begin() + 1, first.lower.end()));
    variables.push_back(bins.back().variable<Random>(features[i]));
  }
  Counts counts{RandomVariable{"class", classes}, variables};
  for (std::size_t c = 0; c < classes.size(); ++c)
    for (std::size_t i = 0; i < features.size(); ++i) {
      const Layers& own = all[{classes[c], i}];
      for (std::size_t b = 0; b < own.count.size(); ++b) counts.observe_value(c, i, b, own.count[b]);
    }
  const double lowest = all[{classes.front(), 0}].lower.front();
  return {std::move(counts), std::move(bins), lowest};
}

TrackReports read_track(const std::string& file, const EncounterData& data, double every_s,
                        std::optional<double> ground_ft) {
  constexpr double longest_step_s = 15.0;
  CsvReader reader = open_csv(file);
  const std::size_t time = reader.column("time_s");
  const std::size_t altitude = column_of(reader, {"altitude_ft", "altitude_gnss_ft"});
  const std::size_t speed = column_of(reader, {"tas_kt", "groundspeed_kt"});
  const std::size_t track = reader.column("track_deg");
  const std::size_t climb = column_of(reader, {"vertical_rate_fpm", "roc_fpm"});

  struct Row {
    double time, altitude, speed, track, climb;
  };
  std::vector<Row> rows;
  const auto value = [&](const CsvRow& row, std::size_t column) { return row.optional_number(column).value_or(nan); };
  double lowest = std::numeric_limits<double>::infinity();
  for (CsvRow row; reader.next(row);) {
    rows.push_back({row.number(time), value(row, altitude), value(row, speed), value(row, track), value(row, climb)});
    if (rows.size() > 1 && rows.back().time < rows[rows.size() - 2].time)
      throw row.error(time, fmt::format("a time not before {}", rows[rows.size() - 2].time));
    if (!std::isnan(rows.back().altitude)) lowest = std::min(lowest, rows.back().altitude);
  }
  if (!std::isfinite(lowest)) throw InputError(message({.where = reader.file(), .what = "no row has an altitude"}));

  TrackReports result;
  result.rows = rows.size();
  result.ground_ft = ground_ft.value_or(lowest);
  double next = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Row& row = rows[k];
    const double above_ground = row.altitude - result.ground_ft;
    if (above_ground < data.lowest_ft) ++result.on_the_ground;
    if (row.time < next || !(above_ground >= data.lowest_ft)) continue;
    double turn_rate = nan;
    if (k > 0 && row.time > rows[k - 1].time && row.time - rows[k - 1].time <= longest_step_s)
      turn_rate = std::remainder(row.track - rows[k - 1].track, 360.0) / (row.time - rows[k - 1].time);
    const std::array<double, 4> values = {above_ground, row.speed, row.climb, turn_rate};
    TrackReport report{row.time, {}};
    for (std::size_t i = 0; i < values.size(); ++i) report.readings.push_back(data.bins[i].bin(values[i]));
    result.reports.push_back(std::move(report));
    next = row.time + every_s;
  }
  if (result.reports.empty())
    throw InputError(message(
        {.where = reader.file(),
         .what = fmt::format("no row is {} ft or more above the ground at {} ft", data.lowest_ft, result.ground_ft),
         .remedy = "give the altitude of the ground by --ground"}));
  return result;
}

}  // namespace sigmax::apps
