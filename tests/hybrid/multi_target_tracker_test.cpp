#include "hybrid/banks.hpp"

namespace multi_target_tracker_test {

constexpr double sigma = 20.0, speed = 300.0;

AnyDetection at(double time, double x, double y, std::size_t tag = 0) {
  AnyDetection detection = AnyDetection::position(time, std::array{x, y}, std::array{sigma * sigma, sigma * sigma});
  detection.tag = tag;
  return detection;
}

TargetChoice choice_of(bool fuzzy, std::vector<MotionChoice> motions = {calm(), turning()}) {
  TargetChoice choice{.axes = 2, .fuzzy = fuzzy, .motions = std::move(motions)};
  choice.models = choice.motions.size() == 1 ? std::vector<std::string>{"one"} : std::vector<std::string>{"a", "b"};
  const double other = fuzzy ? 0.5 : 0.1;
  choice.transition =
      choice.motions.size() == 1 ? Rows{{1.0}} : Rows{{fuzzy ? 1.0 : 0.9, other}, {other, fuzzy ? 1.0 : 0.9}};
  return choice;
}

/// Rules by which the first scan begins all tracks, and none ends.
MultiTargetRules without_ends(double detection_probability, double clutter_density) {
  return {.detection_probability = detection_probability,
          .gate_probability = 1.0,
          .clutter_density = clutter_density,
          .deletion = 0.0,
          .explained = 1e-300,
          .duplicate_scans = 1000,
          .tentative_scans = 1000};
}

const std::vector<AssociationChoice> four{{false, false}, {false, true}, {true, true}, {true, false}};

std::size_t confirmed(const MultiTargetTracker& tracker) {
  const auto tracks = tracker.tracks();
  return static_cast<std::size_t>(std::ranges::count_if(tracks, &TrackedTarget::confirmed));
}

/// Joint PDA with integrated existence of targets with nearly constant velocity in the plane, as textbooks write it, by
/// all events; or the best event of all, and the possibilistic Bernoulli existence.
struct Textbook {
  struct Target {
    Eigen::Vector4d x;
    Eigen::Matrix4d P;
    double absent, present;
  };
  bool fuzzy;
  MultiTargetRules rules;
  std::vector<Target> targets;

  void begin(double x, double y) {
    Eigen::Vector4d variances(sigma * sigma, sigma * sigma, 0.25 * speed * speed, 0.25 * speed * speed);
    const double birth = rules.birth_existence;
    targets.push_back({{x, y, 0.0, 0.0}, variances.asDiagonal(), fuzzy ? 1.0 : 1.0 - birth, birth});
  }

  void scan(double T, const std::vector<Eigen::Vector2d>& z) {
    const double P_D = rules.detection_probability, s = std::pow(rules.survival_per_s, T);
    const double d0 = fuzzy ? (1.0 - P_D) / P_D : 1.0 - P_D, d1 = fuzzy ? 1.0 : P_D;
    const std::size_t n = targets.size(), m = z.size();
    Eigen::Matrix4d F = Eigen::Matrix4d::Identity();
    F(0, 2) = F(1, 3) = T;
    Eigen::Matrix4d Q = Eigen::Matrix4d::Identity() * T;  // of white noise of the density 1, over any time
    Q.topLeftCorner<2, 2>() *= T * T / 3.0;
    Q(0, 2) = Q(1, 3) = Q(2, 0) = Q(3, 1) = T * T / 2.0;
    Rows weights(n, Numbers(m + 1)), sums = weights;
    for (std::size_t i = 0; i < n; ++i) {
      Target& t = targets[i];
      t.x = F * t.x;
      t.P = F * t.P * F.transpose() + Q;
      t.absent = fuzzy ? std::max(t.absent, t.present * (1.0 - s) / s) : 1.0 - s * t.present;
      t.present = fuzzy ? t.present : s * t.present;
      weights[i][m] = fuzzy ? std::max(t.absent, t.present * d0) : t.absent + t.present * d0;
      for (std::size_t j = 0; j < m; ++j) {
        const Eigen::Matrix2d S = t.P.topLeftCorner<2, 2>() + sigma * sigma * Eigen::Matrix2d::Identity();
        const Eigen::Vector2d nu = z[j] - t.x.head<2>();
        const double likelihood =
            std::exp(-0.5 * nu.dot(S.inverse() * nu)) / (2.0 * std::numbers::pi * std::sqrt(S.determinant()));
        weights[i][j] = t.present * d1 * likelihood / *rules.clutter_density;
      }
    }
    std::vector<std::size_t> event(n, 0);  // counts through all, m is none
    do {
      double weight = 1.0;
      for (std::size_t i = 0; i < n; ++i) {
        weight *= weights[i][event[i]];
        for (std::size_t k = 0; k < i; ++k) weight *= event[i] == event[k] && event[i] != m ? 0.0 : 1.0;
      }
      for (std::size_t i = 0; i < n; ++i) {
        double& sum = sums[i][event[i]];
        sum = fuzzy ? std::max(sum, weight) : sum + weight;
      }
      for (std::size_t i = 0; i < n && (event[i] = (event[i] + 1) % (m + 1)) == 0;) ++i;
    } while (std::ranges::any_of(event, [](std::size_t j) { return j != 0; }));
    for (std::size_t i = 0; i < n; ++i) update(targets[i], sums[i], weights[i][m], d0, z);
  }

  void update(Target& t, Numbers beta, double none, double d0, const std::vector<Eigen::Vector2d>& z) const {
    const std::size_t m = z.size();
    double all = 0.0;
    for (const double b : beta) all = fuzzy ? std::max(all, b) : all + b;
    for (double& b : beta) b /= all;
    const double absent = t.absent / none * beta[m];
    beta[m] *= t.present * d0 / none;  // of what is left, the target exists
    const auto best = static_cast<std::size_t>(std::ranges::max_element(beta) - beta.begin());
    const double present = fuzzy ? beta[best] : std::accumulate(beta.begin(), beta.end(), 0.0);
    const double total = fuzzy ? std::max(absent, present) : absent + present;
    t.absent = absent / total;
    t.present = present / total;
    for (std::size_t j = 0; j <= m; ++j) beta[j] = fuzzy ? j == best : beta[j] / present;
    const Eigen::Matrix2d S = t.P.topLeftCorner<2, 2>() + sigma * sigma * Eigen::Matrix2d::Identity();
    const Eigen::Matrix<double, 4, 2> K = t.P.leftCols<2>() * S.inverse();
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (std::size_t j = 0; j < m; ++j) {
      const Eigen::Vector2d nu = z[j] - t.x.head<2>();
      mean += beta[j] * nu;
      spread += beta[j] * nu * nu.transpose();
    }
    t.x += K * mean;
    t.P += -(1.0 - beta[m]) * K * S * K.transpose() + K * (spread - mean * mean.transpose()) * K.transpose();
  }
};

/// One, two and three targets that cross, with a false detection near them.
TEST(MultiTargetTracker, IsTheTextbooksJointPdaAndItsMaximum) {
  std::mt19937_64 generator(3);
  std::normal_distribution<double> normal;
  for (const bool fuzzy : {false, true})
    for (const double P_D : {0.9, 0.6, 1.0})
      for (std::size_t n = 1; n <= 3; ++n) {
        const MultiTargetRules rules = without_ends(P_D, 3e-5);
        MultiTargetTracker tracker{choice_of(n == 2, {motion("cwna", 1.0)}), {fuzzy, fuzzy}, rules};
        Textbook textbook{fuzzy, rules, {}};
        for (int k = 0; k < 9; ++k) {
          std::vector<AnyDetection> scan;
          std::vector<Eigen::Vector2d> z;
          for (std::size_t i = 0; i < n; ++i) {
            const double y = 70.0 * static_cast<double>(i) * (4.0 - k) + sigma * normal(generator);
            if (k % 4 == 3 && i == 0 && P_D < 1.0) continue;
            z.emplace_back(100.0 * k + sigma * normal(generator), y);
          }
          if (k > 0) z.emplace_back(100.0 * k - 60.0, 40.0 * normal(generator));
          std::ranges::sort(z, {}, [](const Eigen::Vector2d& each) { return each(0); });  // as tracks are numbered
          for (const auto& each : z) scan.push_back(at(k, each(0), each(1)));
          tracker.scan(scan);
          if (k == 0)
            for (const auto& each : z) textbook.begin(each(0), each(1));
          else
            textbook.scan(1.0, z);
          const auto tracks = tracker.tracks(k);
          ASSERT_EQ(tracks.size(), n);
          for (std::size_t i = 0; i < n; ++i) {
            const auto& [x, P, absent, present] = textbook.targets[i];
            ASSERT_CLOSE(tracks[i].existence, present, 1e-10);
            ASSERT_CLOSE(tracks[i].necessity, fuzzy ? 1.0 - absent : present, 1e-10);
            ASSERT_CLOSE(tracks[i].point.mean, (std::span{x.data(), 4}), 1e-9);
            ASSERT_CLOSE(tracks[i].point.covariance, (std::span{P.data(), 16}), 1e-9);
          }
        }
      }
}

/// Two detections at times of their own: the filter's hypotheses at the later one, mixed mode by mode.
template <class Kind>
void mixes(bool fuzzy) {
  const MultiTargetRules rules = without_ends(0.8, 1e-5);
  MultiTargetTracker tracker{choice_of(fuzzy), {}, rules};
  tracker.scan(std::array{at(0.0, 0.0, 0.0)});
  const AnyDetection first = at(1.0, 130.0, 20.0), second = at(1.4, 140.0, -60.0);
  tracker.scan(std::array{first, second});
  Gaussian<6> start{Vector<6>::Zero(), SquareMatrix<6>::Zero()};
  start.covariance.diagonal() << sigma * sigma, sigma * sigma, 22500, 22500, 625, 625;
  const Variable<Kind> mode{"mode", {"a", "b"}};
  const InteractingMultipleModel filter{std::tuple{dwna<2>(1.0), dwpa<2>(4.0)},
                                        Relation<Kind, Kind>{mode, mode, choice_of(fuzzy).transition}, start};
  std::vector parts(3, filter);
  const auto z = [](const AnyDetection& from) {
    return Gaussian<2>{Vector<2>(from.z.data()), sigma * sigma * SquareMatrix<2>::Identity()};
  };
  parts[0].step(1.0, z(first));
  const double first_evidence = parts[0].log_evidence();
  parts[0].step(1.4 - 1.0);
  parts[1].step(1.4, z(second));
  parts[2].step(1.4);
  const Numbers weights{0.8 * std::exp(first_evidence) / 1e-5, 0.8 * std::exp(parts[1].log_evidence()) / 1e-5, 0.2};
  auto expected = filter.state();
  Numbers of_mode(2, 0.0);
  for (std::size_t j = 0; j < 2; ++j) {
    auto mixed = expected.estimates[j];
    mixed.mean.setZero();
    mixed.covariance.setZero();
    for (std::size_t k = 0; k < 3; ++k) of_mode[j] += weights[k] * parts[k].belief()[j];
    for (std::size_t k = 0; k < 3; ++k)
      mixed.mean += weights[k] * parts[k].belief()[j] / of_mode[j] * parts[k].estimates()[j].mean;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto part = parts[k].estimates()[j];
      const Eigen::VectorXd off = part.mean - mixed.mean;
      mixed.covariance += weights[k] * parts[k].belief()[j] / of_mode[j] * (part.covariance + off * off.transpose());
    }
  }
  expected.belief.assign([&](std::size_t j) { return std::log(of_mode[j]); });
  expected.most_likely_mode = of_mode[0] > of_mode[1] ? 0 : 1;
  const auto output = filter.estimate(expected);
  const TargetPoint found = tracker.tracks().at(0).point;
  EXPECT_EQ(found.time, 1.4);
  EXPECT_CLOSE(found.weights, expected.belief.distribution().values(), 1e-12);
  EXPECT_CLOSE(found.mean, (std::span{output.mean.data(), 6}), 1e-9);
  EXPECT_CLOSE(found.covariance, (std::span{output.covariance.data(), 36}), 1e-9);
}

TEST(MultiTargetTracker, MixesHypothesesModeByModeAtTheTimeOfTheLastDetection) {
  mixes<Random>(false);
  mixes<Fuzzy>(true);
}

TEST(MultiTargetTracker, OfOneTargetThatIsNeverMissedIsItsFilterToTheBit) {
  for (const AssociationChoice& kinds : four)
    for (const bool fuzzy : {false, true})
      for (const Scheme scheme : {Scheme::interacting, Scheme::common_start, Scheme::second_order, Scheme::histories}) {
        if (scheme == Scheme::histories && !kinds.fuzzy_pattern) continue;
        TargetChoice choice = choice_of(fuzzy);
        choice.scheme = scheme;
        MultiTargetTracker tracker{choice, kinds, without_ends(1.0, 1e-9)};
        const double v = 0.25 * speed * speed;
        choice.start = StartRule::given;
        choice.start_time_s = 0.0;
        choice.start_mean = {12e3, 8e3, 0, 0, 0, 0, 0, 0, 0};
        choice.start_covariance_diagonal = {400, 400, 400, v, v, v, 625, 625, 625};
        AnyTarget target{choice};
        tracker.scan(std::array{at(0.0, 12e3, 8e3)});
        double time = 0.1;
        for (const auto& [dt, z] : manoeuvring_target(100)) {
          time += dt;
          if (!z) continue;
          const std::array scan{
              AnyDetection::position(time, std::span(z->mean.data(), 2), std::span(z->covariance.data(), 4))};
          tracker.scan(scan);
          target.take(scan[0]);
        }
        const auto tracks = tracker.tracks();
        ASSERT_EQ(tracks.size(), 1U);
        EXPECT_EQ(tracks[0].point.mean, target.output().mean);
        EXPECT_EQ(tracks[0].point.covariance, target.output().covariance);
        EXPECT_EQ(tracks[0].point.weights, target.output().weights);
      }
}

/// Three targets, of which one dies and one is born, among false detections; each scan in any order.
std::vector<std::vector<AnyDetection>> scans_of_three(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::vector<std::vector<AnyDetection>> scans(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double t = 2.0 * static_cast<double>(k);
    const auto see = [&](double x, double y, double late) {
      if (uniform(generator) < 0.9)
        scans[k].push_back(at(t + late, x + sigma * normal(generator), y + sigma * normal(generator), scans[k].size()));
    };
    see(-4000.0 + 100.0 * t, 0.0, 0.2);
    if (k < 30) see(4000.0 - 80.0 * t, 3000.0, 0.5);
    if (k >= 20) see(-2000.0, -4000.0 + 60.0 * t, 0.9);
    for (int c = 0; c < 4; ++c)
      scans[k].push_back(at(t + uniform(generator), 12e3 * uniform(generator) - 6e3, 12e3 * uniform(generator) - 6e3,
                            scans[k].size()));
  }
  return scans;
}

TEST(MultiTargetTracker, FindsTargetsThatAreBornAndDieWhateverTheOrderOfDetections) {
  std::mt19937_64 generator(9);
  for (const AssociationChoice& kinds : four)
    for (const bool fuzzy : {false, true}) {
      MultiTargetTracker tracker{choice_of(fuzzy), kinds}, shuffled = tracker;
      std::vector<std::size_t> found;
      for (auto scan : scans_of_three(60, 5)) {
        tracker.scan(scan);
        const auto owners = tracker.owners();
        std::ranges::shuffle(scan, generator);
        shuffled.scan(scan);
        for (const DetectionOwner& owner : shuffled.owners()) {
          EXPECT_EQ(owner.track, owners[owner.tag].track);
          EXPECT_EQ(owner.support, owners[owner.tag].support);
        }
        found.push_back(confirmed(tracker));
      }
      EXPECT_EQ(found[10], 2U);
      EXPECT_EQ(found[28], 3U);
      EXPECT_EQ(found.back(), 2U);
      const auto end = tracker.tracks(119.0), same = shuffled.tracks(119.0);
      ASSERT_EQ(end.size(), same.size());
      for (std::size_t i = 0; i < end.size(); ++i) {
        EXPECT_EQ(end[i].point.mean, same[i].point.mean);
        EXPECT_EQ(end[i].existence, same[i].existence);
        if (!end[i].confirmed) continue;
        const bool first = end[i].first_time < 10.0;
        EXPECT_NEAR(end[i].point.mean[0], first ? -4000.0 + 11880.0 : -2000.0, 60.0);
        EXPECT_NEAR(end[i].point.mean[1], first ? 0.0 : -4000.0 + 60.0 * 118.1, 60.0);
        EXPECT_EQ(end[i].point.time, 119.0);
      }
      EXPECT_EQ(tracker.finding(), std::nullopt);
      EXPECT_TRUE(tracker.exact());
    }
}

/// Radars at two places, and bearings from a third.
TEST(MultiTargetTracker, TakesWhatSensorsAtSeveralPlacesSee) {
  const std::array<std::array<double, 3>, 3> places{{{0, 0, 0}, {20e3, 0, 0}, {10e3, -5e3, 0}}};
  std::mt19937_64 generator(2);
  std::normal_distribution<double> normal;
  MultiTargetTracker tracker{choice_of(true), {}};
  for (int k = 0; k < 45; ++k) {
    const auto& place = places[static_cast<std::size_t>(k % 3)];
    const Vector<2> off(5e3 + 100.0 * k - place[0], 10e3 + 50.0 * k - place[1]);
    const double azimuth = std::atan2(off(1), off(0)) + 1e-3 * normal(generator);
    AnyDetection seen = AnyDetection::bearing(k, radians(azimuth), radians(1e-3), place);
    if (k % 3 < 2)
      seen = AnyDetection::polar(k, std::array{off.norm() + 10.0 * normal(generator), azimuth}, std::array{100.0, 1e-6},
                                 place);
    seen.tag = static_cast<std::size_t>(k);
    tracker.scan(std::array{seen});
    EXPECT_EQ(tracker.owners().at(0).tag, seen.tag);
    EXPECT_EQ(tracker.owners()[0].begins, k == 0);
    EXPECT_EQ(tracker.owners()[0].track, 1U) << k;
  }
  const auto tracks = tracker.tracks();
  ASSERT_EQ(tracks.size(), 1U);
  EXPECT_TRUE(tracks[0].confirmed);
  EXPECT_EQ(tracks[0].detected, 45U);
  EXPECT_EQ(tracks[0].point.tag, 44U);
  EXPECT_NEAR(tracks[0].point.mean[0], 9400.0, 30.0);
  EXPECT_NEAR(tracks[0].point.mean[1], 12200.0, 30.0);
}

TEST(MultiTargetTracker, EndsTheYoungerOfTwoTracksOfOneTarget) {
  MultiTargetTracker tracker{choice_of(false), {}, {.clutter_density = 1e-8, .deletion = 0.0, .tentative_scans = 100}};
  tracker.scan(std::array{at(0.0, 0.0, 0.0), at(0.0, 5.0, 5.0)});
  for (int k = 1; k < 20; ++k) tracker.scan(std::array{at(k, 100.0 * k, 0.0)});
  ASSERT_EQ(tracker.tracks().size(), 1U);
  EXPECT_EQ(tracker.tracks()[0].number, 1U);
}

/// A far outlier takes no part in the volume by which clutter is estimated.
TEST(MultiTargetTracker, FindsTheSameTracksBesideAnOutlier) {
  std::array<MultiTargetTracker, 2> trackers{MultiTargetTracker{choice_of(false)},
                                             MultiTargetTracker{choice_of(false)}};
  std::size_t k = 0;
  for (auto scan : scans_of_three(60, 5)) {
    trackers[0].scan(scan);
    if (++k == 20) scan.push_back(at(scan.front().time, 1e9, 0.0));
    trackers[1].scan(scan);
  }
  const auto expected = trackers[0].tracks(), tracks = trackers[1].tracks();
  ASSERT_EQ(tracks.size(), expected.size());
  for (std::size_t i = 0; i < tracks.size(); ++i)
    EXPECT_NEAR(tracks[i].point.mean[0], expected[i].point.mean[0], 0.1) << i;
}

TEST(MultiTargetTracker, SaysWhatContradictsTheData) {
  const auto found = [](const MultiTargetRules& rules, std::size_t blind, std::string_view words) {
    MultiTargetTracker tracker{choice_of(false), {}, rules};
    std::size_t k = 0;
    for (const auto& scan : scans_of_three(60, 5))
      tracker.scan(++k % blind != 0 ? scan : std::vector{AnyDetection::missed(scan.back().time)});
    return says(tracker.finding().value_or(""), {words});
  };
  EXPECT_TRUE(found({.clutter_density = 1.0}, 100, "stay unexplained; set a clutter density"));
  EXPECT_TRUE(found({.clutter_density = 1e-12}, 100, "stay unexplained; set a clutter density"));
  EXPECT_TRUE(found({}, 3, "but P_D is 0.9; set a detection probability of 0.6"));
  EXPECT_TRUE(found({.confirmation = 1.0}, 100, "no track was confirmed in 60 scans of "));
}

TEST(MultiTargetTracker, RefusesWhatMakesNoSense) {
  TargetChoice histories = choice_of(true);
  histories.scheme = Scheme::histories;
  EXPECT_INVALID(("histories of the mode want a fuzzy pattern"), (MultiTargetTracker{histories}));
  const TargetChoice choice = choice_of(false);
  EXPECT_INVALID(("detection_probability is 1.5"), (MultiTargetTracker{choice, {}, {.detection_probability = 1.5}}));
  EXPECT_INVALID(("clutter_density is 0.0"), (MultiTargetTracker{choice, {}, {.clutter_density = 0.0}}));
  EXPECT_INVALID(("less than birth_existence"), (MultiTargetTracker{choice, {}, {.deletion = 0.1}}));
  EXPECT_INVALID(("the greatest possibility"),
                 (MultiTargetTracker{choice, {}, {.detection_possibilities = {{0.5, 0.5}}}}));
  TargetChoice possible = choice_of(true);
  possible.likelihood = LikelihoodForm::possibility;
  EXPECT_INVALID(("the possibility that a detection is false"), (MultiTargetTracker{possible, {true, true}}));
  MultiTargetTracker tracker{choice};
  tracker.scan(std::array{at(0.0, 0.0, 0.0)});
  EXPECT_INVALID(("a detection of nan s is not finite"), tracker.scan(std::array{at(not_a_number, 0.0, 0.0)}));
  EXPECT_INVALID(("is not finite"), tracker.scan(std::array{at(1.0, 0.0, not_a_number)}));
  EXPECT_INVALID(("expected 2"),
                 tracker.scan(std::array{AnyDetection::position(1.0, std::array{1.0}, std::array{1.0})}));
  EXPECT_EQ(tracker.scans(), 1U);
}

TEST(MultiTargetTracker, IsCopiedWithAllItsTracks) {
  MultiTargetTracker tracker{choice_of(false)};
  const auto scans = scans_of_three(20, 1);
  for (const auto& scan : scans) tracker.scan(scan);
  MultiTargetTracker copy = tracker, assigned{choice_of(true)};
  assigned = copy;
  tracker.scan(std::array{AnyDetection::missed(1e5)});
  EXPECT_TRUE(tracker.tracks().empty());
  EXPECT_EQ(copy.tracks().size(), assigned.tracks().size());
  copy.scan(scans[0]);  // earlier than all tracks: nobody's
  for (const DetectionOwner& owner : copy.owners()) EXPECT_TRUE(owner.begins);
}

/// Tracks end, even where the gates of those that began hold all detections, so that no day of scans fills the memory.
TEST(MultiTargetTracker, KeepsFewTracksOfFalseDetections) {
  for (const bool fuzzy : {false, true}) {
    MultiTargetTracker tracker{choice_of(true), {fuzzy, fuzzy}};
    std::mt19937_64 generator(1);
    std::uniform_real_distribution<double> uniform(-500.0, 500.0);
    std::size_t wrong = 0;
    for (int k = 0; k < 60; ++k) {
      std::vector<AnyDetection> scan;
      for (int c = 0; c < 8; ++c) scan.push_back(at(4.0 * k, uniform(generator), uniform(generator)));
      tracker.scan(scan);
      EXPECT_LE(tracker.tracks().size(), 8U * 11U);
      wrong += confirmed(tracker);
    }
    EXPECT_LE(wrong, 20U);
  }
}

/// One and three aircraft in clutter, seen by a turning radar.
TEST(MultiTargetTracker, FindsOneAndThreeAircraft) {
  for (const std::size_t aircraft : {std::size_t{1}, std::size_t{3}}) {
    std::ifstream file(SIGMAX_DATA "/../cases/plots_" + std::to_string(aircraft) + "_aircraft_clutter.csv");
    if (!file) GTEST_SKIP() << "no cases beside " << SIGMAX_DATA;
    std::vector<std::vector<AnyDetection>> scans(60);
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
      double time = 0.0, range = 0.0, from_north = 0.0, elevation = 0.0;
      ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &time, &range, &from_north, &elevation), 4);
      const double variance = std::pow(0.1 * degree, 2);
      scans.at(static_cast<std::size_t>(time / 4.0))
          .push_back(AnyDetection::polar(time, std::array{range, (90.0 - from_north) * degree, elevation * degree},
                                         std::array{900.0, variance, variance}));
    }
    for (const AssociationChoice& kinds : four)
      for (const bool fuzzy : {false, true}) {
        TargetChoice choice = choice_of(fuzzy);
        choice.axes = 3;
        MultiTargetTracker tracker{choice, kinds};
        std::map<std::size_t, std::size_t> lives;  // in how many scans
        for (const auto& scan : scans) {
          tracker.scan(scan);
          for (const TrackedTarget& each : tracker.tracks())
            if (each.confirmed) ++lives[each.number];
        }
        EXPECT_EQ(confirmed(tracker), aircraft);
        EXPECT_EQ(std::ranges::count_if(lives, [](const auto& each) { return each.second > 10; }),
                  static_cast<std::ptrdiff_t>(aircraft));
        EXPECT_EQ(tracker.finding(), std::nullopt);
      }
  }
}

}  // namespace multi_target_tracker_test
