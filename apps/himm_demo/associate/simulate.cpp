// Situations with their truth: as a file, or evaluated on many runs.

#include "himm_demo/associate/associate.hpp"
#include "study/study.hpp"

namespace sigmax::apps {
namespace {

constexpr int plane_axes = 2;

const Situation& situation_of(const AssociateOptions& options) {
  return *std::ranges::find(situations, options.situation, &Situation::name);
}

/// Writes a situation as a recording, and prints the command that reads it.
void write_situation(const AssociateOptions& options) {
  if (options.output.out.empty()) throw UsageError("--simulate needs --out DIR for its file, or --runs N");
  const std::string name = options.situation + ".csv";
  refuse_to_overwrite(options.output, {options.filters.config}, {name});
  ResultFiles files(options.output);
  const bool polar = options.radars > 0;
  std::vector<std::string> keys = {"time_s", "x_m", "y_m", "sigma_position_m"};
  if (polar)
    keys = {"time_s",     "sensor",    "range_m", "azimuth_deg", "sigma_range_m", "sigma_azimuth_deg",
            "sensor_x_m", "sensor_y_m"};
  keys.insert(keys.end(), {"label", "true_x_m", "true_y_m"});
  RowFile file(files, name, keys);
  std::size_t detections = 0;
  const auto scans = simulate(options, options.seed).scans;
  for (const Scan& scan : scans)
    for (const Row& row : scan) {
      const AnyDetection& seen = row.detection;
      const double sigma = std::sqrt(seen.variance(0)), across = std::sqrt(seen.variance(1)) / degree;
      std::vector<Cell> cells = {seen.z[0], seen.z[1], sigma};
      if (polar) cells = {seen.z[0], seen.z[1] / degree, sigma, across, seen.origin[0], seen.origin[1]};
      if (!row.measured()) cells.assign(cells.size(), {});
      if (polar) cells.insert(cells.begin(), row.sensor);
      cells.insert(cells.begin(), seen.time);
      if (row.truth) cells.insert(cells.end(), {row.track, (*row.truth)[0], (*row.truth)[1]});
      cells.resize(keys.size());
      file.write(cells);
      if (row.measured()) ++detections;
    }
  const auto& [_, greatest_speed, sets] = situation_of(options);
  std::string command = fmt::format("himm_demo associate {} --labels label", in_shell(options.output.out + "/" + name));
  if (greatest_speed) command += fmt::format(" --greatest-speed {}", *greatest_speed);
  for (const std::string& set : sets) command += " --set " + set;
  if (const double probability = options.rules.detection_probability; probability != 0.9)
    command += fmt::format(" --detection-probability {}", probability);
  Result result(options.output);
  result.facts("situation", options.situation, "seed", options.seed, "scans", scans.size(), "detections", detections);
  result.say("Situation {}, seed {}: {} scans, {} detections", options.situation, options.seed, scans.size(),
             detections);
  result.text += fmt::format("Associate them by\n    {}\n", command);
  result.page.title = "Situation " + options.situation;
  result.publish(files);
}

/// A figure of the runs, ± 95 %: the root mean square of GOSPA and its parts, the mean of others.
Field averaged(ResultColumn column, std::vector<double> values) {
  const bool is_root = column.key.ends_with("_m");
  std::erase_if(values, [](double value) { return std::isnan(value); });
  if (values.empty()) return {column, {}};
  if (column.key == "targets") return {column, values.front()};
  for (double& value : values) value *= is_root ? value : 1.0;
  const Statistic mean = Statistic::mean(values, std::vector<double>(values.size(), 1.0));
  column.interval = true;
  return {column, (is_root ? sqrt(mean) : mean).interval()};
}

void evaluate(const AssociateOptions& options, const std::vector<FilterSettings>& filters) {
  std::vector<std::pair<NamedAssociation, FilterSettings>> contestants;
  for (const NamedAssociation& association : associations)
    for (const FilterSettings& filter : filters) contestants.emplace_back(association, filter);
  refuse_to_overwrite(options.output, {options.filters.config}, {"associations.csv"});
  const auto work = [&](std::size_t run) {
    const auto scans = simulate(options, options.seed + run).scans;
    Study::Row row;
    for (const auto& contestant : contestants) {
      const FilterSettings& filter = contestant.second;
      MultiTargetTracker tracker = tracker_for(options, filter, plane_axes, contestant.first.choice);
      AssociateHistory history(plane_axes);
      for (const Scan& scan : scans) {
        tracker.scan(each(
            scan, [&](const Row& seen) { return with_sensor_noise(filter, seen.sensor, seen.detection, plane_axes); }));
        history.add(tracker, scan, tracker.tracks(tracker.time()));
      }
      for (const Field& field : history.score(options.cutoff.value_or(history.usual_cutoff())))
        row.push_back(std::get<double>(field.cell.value()));
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
  for (std::size_t place = 0; const auto& [association, filter] : contestants) {
    std::vector<Field> fields = {{of_words("of", "tracks by"), fmt::format("{} {}", association.name, filter.name)}};
    for (const Field& field : AssociateHistory(plane_axes).score(1.0)) {
      fields.push_back(averaged(field.column, each(rows, [=](const Study::Row& row) { return row[place]; })));
      ++place;
    }
    table.row_of(fields);
  }
  result.facts("situation", options.situation, "runs", runs, "seed", options.seed, "settings_toml", as_toml(filters));
  result.say("Situation {}: {} runs, seed {}; RMS GOSPA (p = 2) and means, ± 95 %", options.situation, runs,
             options.seed);
  result.add(table, {.csv = "associations.csv", .summary = {"associations"}, .title = "Kinds of association"});
  result.page.title = fmt::format("Situation {}: {} simulated runs", options.situation, runs);
  result.page.last.emplace_back(Words{"Settings in force", as_toml(filters), true});
  result.publish(files);
}

}  // namespace

void simulate_situation(AssociateOptions options) {
  if (options.radars > 0 && options.radar.sigma) throw UsageError("--radar is for a file, --radars for --simulate");
  if (!options.runs) return write_situation(options);
  FilterDefaults defaults = associate_defaults();
  // The targets of `meeting` have one motion, so that the kind of the mode does not matter.
  if (options.situation != "meeting") defaults.names = {"imm", "himm"};
  const auto& [_, greatest_speed, sets] = situation_of(options);
  options.filters.sets.insert(options.filters.sets.begin(), sets.begin(), sets.end());
  if (options.rules.greatest_speed == MultiTargetRules().greatest_speed && greatest_speed)
    options.rules.greatest_speed = *greatest_speed;
  RecordingOptions none;
  const auto filters = filters_for(none, options.filters, std::nullopt, defaults);
  if (options.filters.print_config) return fmt::print("{}", as_toml(filters));
  evaluate(options, filters);
}

}  // namespace sigmax::apps
