#include <boost/math/distributions/normal.hpp>
#include <nlohmann/json.hpp>

#include "apps/recognition_demo_support.hpp"
#include "support/random.hpp"

namespace recognition_demo_aircraft_test {

/// What a subcommand says of a file, by its name and as the standard input.
std::pair<std::string, std::string> said_of(const std::string& subcommand, const std::filesystem::path& file) {
  const auto run = [&](const std::string& name) {
    const auto ending =
        program::succeeds("/bin/sh", {"-c", "exec \"$0\" \"$1\" \"$2\" --runs 20 --quiet <\"$3\"",
                                      program::chosen(SIGMAX_RECOGNITION_DEMO), subcommand, name, file});
    const std::string words = ending.on_one_line();
    return words.substr(words.find("seed"));  // the name of the file comes before
  };
  return {run(file), run("-")};
}

class RecognitionDemoEncounter : public InDirectory {};

TEST_F(RecognitionDemoEncounter, ReadsTheStandardInput) {
  const auto [named, piped] = said_of("encounter", directory.write("counts.csv", counts_csv()));
  EXPECT_EQ(named, piped);
}

TEST_F(RecognitionDemoEncounter, TwoAircraftAreNotTakenForOne) {
  const auto data = directory.write("counts.csv", counts_csv());
  const auto track = directory.write("track.csv",
                                     "time_s,icao24,altitude_ft,groundspeed_kt,track_deg,vertical_rate_fpm\n"
                                     "0,ae01,110,20,0,0\n4,ae01,200,90,10,300\n5,ae02,1150,120,350,-10\n");
  const auto refused = recognition_demo({"encounter", data, "--track", track});
  EXPECT_TRUE(says(refused.output, {"track.csv:4: column 'icao24': found 'ae02', expected 'ae01', as in the rows "
                                    "before: one aircraft; write each aircraft to a file of its own"}));
}

TEST_F(RecognitionDemoEncounter, ARecordingIsReadIntoBinsAndClassifiedAsPlainLoopsDo) {
  const auto data = directory.write("counts.csv", counts_csv());
  // On the ground (10 ft above it) at 0 s; 5 s is too soon after 4 s; at 14 s the track turns through north by 20° in 9
  // s; at 40 s nothing is known of climb, and the row before is too long ago for a turn rate.
  const auto track =
      directory.write("track.csv",
                      "time_s,altitude_ft,groundspeed_kt,track_deg,vertical_rate_fpm\n"
                      "0,110,20,0,0\n4,200,90,10,300\n5,1150,120,350,-10\n14,1150,99,10,-10\n40,100,400,0,\n"
                      "41,1200,400,0,\n");
  recognition_demo_succeeds({"encounter", data, "--track", track, "--ground", "100", "--every", "10", "--quiet",
                             "--out", directory.path() / "out"});
  const auto reports = rows_of(directory.path() / "out" / "reports.csv");
  const std::vector<TextRow> expected = {{{"time_s", "4"},
                                          {"altitude_layer_ft_agl", "below 1000"},
                                          {"airspeed_kt", "below 100"},
                                          {"vertical_rate_ft_per_min", "0 and above"},
                                          {"turn_rate_deg_per_s", "2 and above"}},
                                         {{"time_s", "14"},
                                          {"altitude_layer_ft_agl", "1000 and above"},
                                          {"airspeed_kt", "below 100"},
                                          {"vertical_rate_ft_per_min", "below 0"},
                                          {"turn_rate_deg_per_s", "2 and above"}},
                                         {{"time_s", "41"},
                                          {"altitude_layer_ft_agl", "1000 and above"},
                                          {"airspeed_kt", "100 and above"},
                                          {"vertical_rate_ft_per_min", ""},
                                          {"turn_rate_deg_per_s", "below 2"}}};
  EXPECT_EQ(reports, expected);

  Numbers p(2, 1.0), ratio(2, 1.0), dubois_prade(2, 1.0);
  for (const auto& report : reports)
    for (const auto& [feature, table] : counts) {
      const std::string& label = report.at(feature);
      if (label.empty()) continue;
      const std::size_t b = label.starts_with("below") ? 0 : 1;
      for (std::size_t c = 0; c < 2; ++c) {
        const Numbers row = divided(table[c], sum(table[c]));
        p[c] *= row[b];
        ratio[c] *= by_ratio(row)[b];
        dubois_prade[c] *= by_dubois_prade(row)[b];
      }
    }
  const auto summary = nlohmann::json::parse(contents(directory.path() / "out" / "summary.json")).at("classifiers");
  const auto found = [&](const char* name) {
    const auto& belief = summary.at(name).at("belief_after_all");
    return Numbers{belief.at("slow").get<double>(), belief.at("fast").get<double>()};
  };
  EXPECT_CLOSE(found("sigma"), divided(p, sum(p)), 1e-9);
  EXPECT_CLOSE(found("max, ratio scale"), divided(ratio, greatest(ratio)), 1e-9);
  EXPECT_CLOSE(found("max, Dubois-Prade"), divided(dubois_prade, greatest(dubois_prade)), 1e-9);
}

/// Two types and two quantities, normal.
struct Type {
  std::array<double, 2> minimum, optimum, maximum, mean, deviation;
};
constexpr std::array<Type, 2> types = {
    {{{1, 10}, {2, 20}, {4, 40}, {2, 21}, {0.7, 8}}, {{2, 12}, {3, 15}, {5, 50}, {3.2, 25}, {0.9, 10}}}};

double triangle(const Type& type, std::size_t q, double x) {
  if (x <= type.minimum[q] || x >= type.maximum[q]) return 0.0;
  if (x < type.optimum[q]) return (x - type.minimum[q]) / (type.optimum[q] - type.minimum[q]);
  return (type.maximum[q] - x) / (type.maximum[q] - type.optimum[q]);
}

class RecognitionDemoPerformance : public InDirectory {};

TEST_F(RecognitionDemoPerformance, ReadsTheStandardInput) {
  const auto file = directory.write("performance.csv",
                                    "type,variable,optimum,minimum,maximum,model,parameters\n"
                                    "a,speed,2,1,3,norm,2|0.5\nb,speed,3,2,4,norm,3|0.5\n");
  const auto [named, piped] = said_of("performance", file);
  EXPECT_EQ(named, piped);
}

TEST_F(RecognitionDemoPerformance, TheSameQuantityBothWaysEqualsPlainLoopsOnTheSameDraws) {
  constexpr std::size_t bins = 12, runs = 150;
  constexpr double least = 0.05;
  std::ostringstream text;
  text << "type,variable,optimum,minimum,maximum,model,parameters\n";
  for (std::size_t c = 0; c < 2; ++c)
    for (std::size_t q = 0; q < 2; ++q)
      text << "t" << c << ",q" << q << ',' << types[c].optimum[q] << ',' << types[c].minimum[q] << ','
           << types[c].maximum[q] << ",norm," << types[c].mean[q] << '|' << types[c].deviation[q] << '\n';
  const auto data = directory.write("performance.csv", text.str());
  const auto ending =
      recognition_demo_succeeds({"performance", data, "--bins", std::to_string(bins), "--runs", std::to_string(runs),
                                 "--seed", "3", "--least", "0.05", "--quiet", "--out", directory.path() / "out"});

  using Normal = boost::math::normal_distribution<>;
  std::array<Numbers, 2> cuts;                  // by quantity
  std::array<std::array<Numbers, 2>, 2> p, pi;  // by quantity and type
  for (std::size_t q = 0; q < 2; ++q) {
    double low = infinity, high = -low;
    for (const Type& type : types) {
      low = std::min(low, boost::math::quantile(Normal(type.mean[q], type.deviation[q]), 0.001));
      high = std::max(high, boost::math::quantile(Normal(type.mean[q], type.deviation[q]), 0.999));
    }
    for (std::size_t i = 1; i < bins; ++i) cuts[q].push_back(low + (high - low) * static_cast<double>(i) / bins);
    for (std::size_t c = 0; c < 2; ++c)
      for (std::size_t b = 0; b < bins; ++b) {
        const double from = b == 0 ? -1e9 : cuts[q][b - 1], to = b + 1 == bins ? 1e9 : cuts[q][b];
        const Normal normal(types[c].mean[q], types[c].deviation[q]);
        p[q][c].push_back(cdf(normal, to) - cdf(normal, from));
        const double top = types[c].optimum[q];
        const double supremum =
            from <= top && top <= to ? 1.0 : std::max(triangle(types[c], q, from), triangle(types[c], q, to));
        pi[q][c].push_back(std::max(least, supremum));
      }
  }
  Numbers sigma(2, 0.0), max(2, 0.0);  // accuracy after each quantity
  for (std::size_t run = 0; run < runs; ++run) {
    RandomStream random(3, run);
    const std::size_t truth = random.uniform() < 0.5 ? 0 : 1;
    Numbers belief(2, 1.0), possible(2, 1.0);
    for (std::size_t q = 0; q < 2; ++q) {
      const double value = quantile(Normal(types[truth].mean[q], types[truth].deviation[q]), random.uniform());
      const auto b = static_cast<std::size_t>(
          std::count_if(cuts[q].begin(), cuts[q].end(), [&](double cut) { return value >= cut; }));
      for (std::size_t c = 0; c < 2; ++c) {
        belief[c] *= p[q][c][b];
        possible[c] *= pi[q][c][b];
      }
      const auto credit = [&](const Numbers& of) {
        const double difference = std::log(of[truth] / of[1 - truth]);
        return std::abs(difference) <= 1e-9 ? 0.5 : difference > 0.0 ? 1.0 : 0.0;
      };
      sigma[q] += credit(belief) / runs;
      max[q] += credit(possible) / runs;
    }
  }
  std::map<std::string, Numbers> found;
  for (const auto& row : rows_of(directory.path() / "out" / "curves.csv"))
    found[row.at("classifier")].push_back(std::stod(row.at("accuracy")));
  EXPECT_CLOSE(found.at("sigma, p of the density"), sigma, 1e-9);
  EXPECT_CLOSE(found.at("max, π of the triangle"), max, 1e-9);
}

}  // namespace recognition_demo_aircraft_test
