// Situations with their truth: as a file, or evaluated on many runs.

#include "himm_demo/associate/associate.hpp"
#include "himm_demo/associate/situations.hpp"
#include "study/study.hpp"

namespace sigmax::apps {
namespace {

constexpr int plane_axes = 2;

/// What the tracks of a situation need to know of its targets.
struct Needs {
  std::optional<double> greatest_speed{};  ///< in m/s
  std::vector<std::string> sets{};
};
Needs needs_of(std::string_view situation) {
  if (situation == "meeting") return {3.0, {"sigma_w=0.1", "models=[dwna]"}};
  return situation == "dense" ? Needs{100.0} : Needs{};
}

std::vector<Scan> drawn(const AssociateOptions& options, std::uint64_t seed) {
  const auto place = std::ranges::find(situation_names, options.situation) - situation_names.begin();
  const Visibility visibility{options.rules.detection_probability, options.clutter, options.radars};
  return simulate(static_cast<Situation>(place), seed, visibility).scans;
}

/// Writes a situation as a recording, and prints the command that reads it.
void write_situation(const AssociateOptions& options) {
  if (options.output.out.empty()) throw UsageError("--simulate needs --out DIR for its file, or --runs N");
  const std::string name = options.situation + ".csv";
  refuse_to_overwrite(options.output, {options.filters.config}, {name});
  ResultFiles files(options.output);
  const bool polar = options.radars > 0;
  std::string text = polar ? "time_s,sensor,range_m,azimuth_deg,sigma_range_m,sigma_azimuth_deg,sensor_x_m,sensor_y_m"
                           : "time_s,x_m,y_m,sigma_position_m";
  text += ",label,true_x_m,true_y_m\n";
  std::size_t detections = 0;
  const auto scans = drawn(options, options.seed);
  for (const Scan& scan : scans)
    for (const Row& row : scan) {
      const AnyDetection& seen = row.detection;
      const double sigma = std::sqrt(seen.variance(0));
      text += polar ? fmt::format("{},{},", seen.time, row.sensor) : fmt::format("{},", seen.time);
      if (!row.measured())
        text += polar ? ",,,,," : ",,";
      else if (polar)
        text += fmt::format("{},{},{},{},{},{}", seen.z[0], seen.z[1] / degree, sigma,
                            std::sqrt(seen.variance(1)) / degree, seen.origin[0], seen.origin[1]);
      else
        text += fmt::format("{},{},{}", seen.z[0], seen.z[1], sigma);
      text += row.truth ? fmt::format(",{},{},{}\n", row.track, (*row.truth)[0], (*row.truth)[1]) : ",,,\n";
      if (row.measured()) ++detections;
    }
  files.write(name, text);
  const Needs needs = needs_of(options.situation);
  std::string command = fmt::format("himm_demo associate {} --labels label", in_shell(options.output.out + "/" + name));
  if (needs.greatest_speed) command += fmt::format(" --greatest-speed {}", *needs.greatest_speed);
  for (const std::string& set : needs.sets) command += " --set " + set;
  Result result(options.output);
  result.facts("situation", options.situation, "seed", options.seed, "scans", scans.size(), "detections", detections);
  result.say("Situation {}, seed {}: {} scans, {} detections", options.situation, options.seed, scans.size(),
             detections);
  result.say("Associate them by {}", command);
  result.page.title = "Situation " + options.situation;
  result.publish(files);
}

/// A figure of the runs, ± 95 %: the root mean square of GOSPA and its parts, the mean of others.
Cell averaged(std::vector<double> values, Score::Figure figure) {
  if (figure <= Score::false_targets) {
    for (double& value : values) value *= value;
    return sqrt(Statistic::mean(values, std::vector<double>(values.size(), 1.0))).interval();
  }
  if (figure == Score::targets) return values.front();
  std::erase_if(values, [](double value) { return std::isnan(value); });
  return values.empty() ? Cell() : Cell(mean_interval(values));
}

void evaluate(const AssociateOptions& options, const std::vector<FilterSettings>& filters) {
  std::vector<std::pair<NamedAssociation, FilterSettings>> contestants;
  for (const NamedAssociation& association : associations)
    for (const FilterSettings& filter : filters) contestants.emplace_back(association, filter);
  refuse_to_overwrite(options.output, {options.filters.config}, {"associations.csv"});
  const auto work = [&](std::size_t run) {
    const auto scans = drawn(options, options.seed + run);
    Study::Row row;
    for (const auto& contestant : contestants) {
      const FilterSettings& filter = contestant.second;
      MultiTargetTracker tracker = tracker_for(options, filter, plane_axes, contestant.first.choice);
      Scorer scorer(plane_axes);
      for (const Scan& scan : scans) {
        tracker.scan(each(
            scan, [&](const Row& seen) { return with_sensor_noise(filter, seen.sensor, seen.detection, plane_axes); }));
        scorer.add(tracker.time(), scan, confirmed_of(tracker));
      }
      const Score score = scorer.score(options.cutoff);
      row.insert(row.end(), score.values.begin(), score.values.end());
    }
    return row;
  };
  std::vector<Study::Row> rows;  // of the runs: the figures of each contestant
  const auto add = [&](std::size_t, const Study::Row& row) { rows.push_back(row); };
  const int runs = *options.runs;
  if (!run({"runs", static_cast<std::size_t>(runs), work}, {.threads = options.threads}, options.output, add)) return;
  ResultFiles files(options.output);
  Result result(options.output);
  ResultTable table;
  for (std::size_t i = 0; i < contestants.size(); ++i)
    table.row_of(fields_of(fmt::format("{} {}", contestants[i].first.name, contestants[i].second.name),
                           [&](Score::Figure figure) {
                             const auto place = i * Score::figures + figure;
                             return averaged(each(rows, [&](const auto& row) { return row[place]; }), figure);
                           }));
  result.facts("situation", options.situation, "runs", runs, "seed", options.seed, "settings_toml", as_toml(filters));
  result.say("Situation {}: {} runs, seed {}; RMS GOSPA (p = 2) and means, ± 95 %", options.situation, runs,
             options.seed);
  result.add(table, {.csv = "associations.csv", .summary = {"associations"}, .title = "Kinds of association"});
  result.page.title = fmt::format("Situation {}: {} simulated runs", options.situation, runs);
  result.page.last.emplace_back(Words{"Settings in force", as_toml(filters), true});
  result.publish(files);
}

}  // namespace

std::vector<std::string> names_of_situations() { return {situation_names.begin(), situation_names.end()}; }

void simulate_situation(AssociateOptions options) {
  if (options.radars > 0 && options.radar.sigma) throw UsageError("--radar is for a file, --radars for --simulate");
  if (!options.runs) return write_situation(options);
  FilterDefaults defaults = associate_defaults();
  // The targets of `meeting` have one motion, so that the kind of the mode does not matter.
  if (options.situation != "meeting") defaults.names = {"imm", "himm"};
  const Needs needs = needs_of(options.situation);
  options.filters.sets.insert(options.filters.sets.begin(), needs.sets.begin(), needs.sets.end());
  if (options.rules.greatest_speed == MultiTargetRules().greatest_speed)
    options.rules.greatest_speed = needs.greatest_speed.value_or(options.rules.greatest_speed);
  RecordingOptions none;
  const auto filters = filters_for(none, options.filters, std::nullopt, defaults);
  if (options.filters.print_config) return fmt::print("{}", as_toml(filters));
  evaluate(options, filters);
}

}  // namespace sigmax::apps
