// The filters that have names, and the models that a filter can have, in himm_demo.

#include <sigmax/estimation/coordinated_turn.hpp>
#include <sigmax/estimation/start.hpp>
#include <sigmax/estimation/unscented.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>

#include "apps/manoeuvring_targets.hpp"
#include "support/enveloped.hpp"

namespace himm_demo_filters_test {

/// What a name stands for, in the restatement's terms.
struct Named {
  std::string name;
  restatement::Options options;
  bool independent = false;
};

std::vector<Named> named_filters() {
  using restatement::MixedCovariance, restatement::Options;
  const auto filter = [](restatement::Kind kind) {
    return [kind](auto change) {
      Options options = usual(kind);
      change(options);
      return options;
    };
  };
  const auto imm = filter(restatement::Kind::imm), himm = filter(restatement::Kind::himm);
  const auto as_it_is = [](Options&) {};
  const auto second_order = [](Options& own) { own.order = restatement::Order::second_order; };
  const auto common_start = [](Options& own) { own.common_start = true; };
  const auto reading = [&](MixedCovariance of) { return himm([of](Options& own) { own.mixed_covariance = of; }); };
  return {
      {"imm", imm(as_it_is)},
      {"imm_correct", imm(as_it_is)},
      {"imm_released", imm([](Options& own) { own.mixing_weights = restatement::Weights::released; })},
      {"imm_as_printed", imm([](Options& own) { own.output_spread_omitted = true; })},
      {"gpb1", imm(common_start)},
      {"gpb2", imm(second_order)},
      {"static_random", imm(as_it_is), true},
      {"himm", himm(as_it_is)},
      {"himm_selected", reading(MixedCovariance::selected)},
      {"himm_own", reading(MixedCovariance::own)},
      {"himm_own_recentred", himm(as_it_is)},
      {"himm_released", reading(MixedCovariance::released)},
      {"himm_envelope", himm([](Options& own) {
         own.mixed_covariance = MixedCovariance::envelope;
         own.envelope = support::enveloped;
       })},
      {"himm_global", himm(common_start)},
      {"himm_possibility", himm([](Options& own) { own.possibilistic = true; })},
      {"viterbi", himm(second_order)},
      {"static_fuzzy", himm(as_it_is), true},
  };
}

program::Ending himm_demo(const Arguments& arguments, const Arguments& sets = {}) {
  return program::run(SIGMAX_HIMM_DEMO, arguments + setting(sets));
}

TEST(HimmDemoFilters, EveryNamedOneEqualsThePlainRestatement) {
  const auto points = accelerating_target();
  const auto found = estimates(csv(points), given + Arguments{"filters=all"});
  for (const auto& [name, options, independent] : named_filters()) {
    SCOPED_TRACE(name);
    const auto filter = restated(options, {}, 3, independent ? restatement::identity(2) : restatement::Matrix{});
    expect_restated(of_filter(found, name), filter, start_time, detections(points));
  }
  // The one that the restatement does not know: the estimate of the more likely mode, with the IMM's weights.
  const auto imm = of_filter(found, "imm");
  const auto likely = of_filter(found, "imm_most_likely");
  ASSERT_EQ(imm.size(), likely.size());
  for (std::size_t k = 0; k < imm.size(); ++k) EXPECT_EQ(imm[k].at("weight_dwna"), likely[k].at("weight_dwna"));
  EXPECT_EQ(found.size(), points.size() * (named_filters().size() + 1)) << "all names are known here";
}

std::string estimates_of(const std::string& text, const Arguments& sets) { return tracked(text, sets).estimates; }

TEST(HimmDemoFilters, AMeasurementThatTheGateTurnsAwayIsAsOneThatWasMissed) {
  auto points = turning_target();
  std::string missed = csv(points);
  const auto row = missed.find("\n60,");
  missed.replace(row, missed.find('\n', row + 1) - row, "\n60,,");
  points[60].z[1] += 30000.0;
  for (const std::string filters : {"filters=[imm,himm]", "filters=[gpb2,viterbi]"}) {
    const auto gated = estimates_of(csv(points), {filters, "sigma_position_m=5", "gate_probability=0.9999999"});
    EXPECT_EQ(gated, estimates_of(missed, {filters, "sigma_position_m=5"}));
    EXPECT_NE(gated, estimates_of(csv(points), {filters, "sigma_position_m=5"}));
  }
}

TEST(HimmDemoFilters, AfterALongGapATrackStartsAsIfNew) {
  auto points = turning_target();
  for (std::size_t k = 50; k < points.size(); ++k) points[k].time += 100.0;
  const std::vector<Point> later(points.begin() + 50, points.end());
  const auto all = estimates_of(csv(points), {"filters=imm", "restart_after_s=20"});
  const auto own = estimates_of(csv(later), {"filters=imm"});
  const auto first = own.find('\n');
  EXPECT_EQ(all.substr(all.find("\n153,")), own.substr(first));
  EXPECT_EQ(all.find("\n152,"), std::string::npos) << "three points make the start";
  EXPECT_TRUE(says(estimates_of(csv(points), {"filters=imm"}), {"\n152,"}));
}

TEST(HimmDemoFilters, AltitudesOutOfThisWorldDoNotMoveTheTrack) {
  const std::string file = recorded("adsb_inflight_refuelling.csv");
  if (file.empty()) GTEST_SKIP() << "no recordings in " << SIGMAX_DATA;
  const std::string text = contents(file);
  std::string missed = text;
  for (const std::string time : {"5899.0", "6011.0", "7455.0"}) {  // 107,700, 53,900 and 92,000 ft
    const auto row = missed.find("\n" + time + ",3b7777,");
    ASSERT_NE(row, std::string::npos);
    missed.replace(row, missed.find('\n', row + 1) - row, "\n" + time + ",3b7777,,,,,,");
  }
  const std::vector<std::string> sets = {"sigma_position_m=[100,100,30]", "gate_probability=0.99999"};
  EXPECT_EQ(estimates_of(text, sets), estimates_of(missed, sets));
}

TEST(HimmDemoFilters, EveryModelWithEveryMemberTracksOnTwoAxesAndThree) {
  for (const auto& points : {turning_target(), accelerating_target()})
    for (const std::string member : {"ekf", "ukf", "ckf"}) {
      const auto found = tracked(
          csv(points), {"models=[dwna,dwpa,cwna,cwpa,singer,ou_position,ou_velocity,known_turn,ct]",
                        "sigma_w=[1,1,1,1,5,1000,100,1,1]", "member=" + member, "filters=[imm,himm,gpb2,viterbi]"});
      EXPECT_FALSE(says(found.output, {"nan"})) << found.output;
    }
}

TEST(HimmDemoFilters, ALinearModelIsTheSameWhateverTheMember) {
  const auto by = [text = csv(turning_target())](const std::string& member) {
    return estimates_of(text, {"models=[cwna,singer]", "member=" + member});
  };
  for (const std::string member : {"ekf", "ukf", "ckf"}) EXPECT_EQ(by(member), by("kf"));
}

TEST(HimmDemoFilters, WhatIsPrintedOfTheirSettingsReadsBackAsTheSame) {
  const TemporaryDirectory directory;
  const std::vector<std::vector<std::string>> cases = {
      {"filters=all"},
      {"models=[singer,ou_velocity,ou_position]", "tau_s=[7,30,0.1]", "sigma_w=[2,3,4]"},
      {"models=[known_turn,known_turn,cwna]", "turn_deg_s=[3,-2.7,0]", "filters=[gpb2]"},
      {"models=[ct,cwpa]", "turn_drift_deg_s=0.3", "start_sigma_turn_deg_s=4.1", "member=ckf"},
      {"filters=[fast]", "filter.fast.kind=fuzzy", "filter.fast.scheme=second_order", "likelihood=possibility"},
      {"filters=[imm]", "gate_probability=0.99", "restart_after_s=12.5"},
      {"filters=[imm]", "output_spread=omitted", "output=most_likely", "scheme=common_start"},
      {"filters=[imm,himm]", "sojourn_s=[100,12.5]", "smooth=true"},
      {"filters=[himm]", "radar_measurement=polar", "member=ukf"},
  };
  for (const auto& sets : cases) {
    const auto first = program::succeeded(himm_demo({"simulate", "--print-config"}, sets));
    const auto again = himm_demo({"simulate", "--print-config", "--config", directory.write("c.toml", first.output)});
    EXPECT_EQ(again.output, first.output);
  }
  const auto turns = himm_demo({"simulate", "--print-config"}, cases[3]);
  EXPECT_TRUE(says(turns.output, {"models = [\"ct\", \"cwpa\"]\n", "turn_drift_deg_s = [0.3, 0.3]\n",
                                  "member = \"ckf\"\n", "start_sigma_turn_deg_s = 4.1\n"}));
}

}  // namespace himm_demo_filters_test
