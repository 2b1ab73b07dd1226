// What a target keeps of its life: tags, the record that is smoothed, and both in other coordinates.

#include "hybrid/targets.hpp"

namespace track_manager_test {

template <class Filter>
Target<Filter> recording(const Filter& filter, std::size_t buffer = 0) {
  TargetRules rules{0.999, 3, 1e9, buffer};
  rules.record = true;
  return {filter, one_point_start, rules};
}

template <class State>
void require_same_state(const State& found, const State& expected, double tolerance) {
  for (std::size_t j = 0; j < expected.estimates.size(); ++j) {
    ASSERT_CLOSE(found.estimates[j], expected.estimates[j], tolerance);
    ASSERT_CLOSE(found.belief.log(j), expected.belief.log(j), tolerance);
  }
  ASSERT_EQ(found.most_likely_mode, expected.most_likely_mode);
}

TEST(TrackManager, IsSmoothedFromStartToStartAsTheFiltersOwnRecordIs) {
  with_every_filter([](const auto& filter) {
    auto target = recording(filter);
    std::vector<std::vector<decltype(filter.recorded(0.0))>> segments;
    std::vector<std::pair<std::size_t, bool>> told;
    std::vector<double> times;
    std::vector<std::optional<double>> nis;
    for (const Detection& detection : detections(80, 40))
      target.take(detection, [&](const Detection& each, bool is_start) {
        told.push_back({each.tag, is_start});
        if (is_start) segments.emplace_back();
        const double dt = is_start ? 0.0 : target.time() - times.back();
        times.push_back(target.time());
        const bool measured = target.filter().accepted();
        nis.push_back(measured ? std::optional(target.filter().nis()) : std::nullopt);
        segments.back().push_back(measured ? target.filter().recorded(dt, *each.position<2>(), PositionSensor<2>{})
                                           : target.filter().recorded(dt));
      });
    ASSERT_EQ(segments.size(), 2U);
    EXPECT_EQ(target.starts(), 2U);
    std::vector<std::decay_t<decltype(segments[0][0].state)>> expected;
    for (const auto& segment : segments)
      for (const auto& state : smooth(target.filter(), segment)) expected.push_back(state);

    std::size_t k = 0;
    target.smoothed([&](const auto& kept, const auto& state) {
      ASSERT_LT(k, told.size());
      ASSERT_EQ(kept.tag, told[k].first);
      ASSERT_EQ(kept.is_start, told[k].second);
      ASSERT_EQ(kept.time, times[k]);
      ASSERT_EQ(kept.nis, nis[k]);
      require_same_state(state, expected[k], 1e-12);
      ++k;
    });
    EXPECT_EQ(k, told.size());
  });
}

TEST(TrackManager, IsNotRecordedUnlessItIsAskedFor) {
  Target target{imm(), one_point_start};
  for (const Detection& detection : detections(10)) target.take(detection);
  target.smoothed([](const auto&, const auto&) { FAIL(); });
}

/// Whatever comes late by no more than the buffer, also the record.
TEST(TrackManager, OfLateDetectionsIsThatOfTheRightOrderToTheBit) {
  const auto all = detections(28, 14);
  with_every_filter([&](const auto& filter) {
    const auto fresh = recording(filter, 4);
    auto in_order = fresh;
    for (const Detection& detection : all) in_order.take(detection);
    ASSERT_GE(in_order.starts(), 2U);
    std::vector<std::size_t> tags;
    std::vector<std::decay_t<decltype(filter.state())>> expected;
    in_order.smoothed([&](const auto& kept, const auto& state) {
      tags.push_back(kept.tag);
      expected.push_back(state);
    });
    std::mt19937 generator(1);
    for (int shuffle = 0; shuffle < 20; ++shuffle) {
      auto shuffled = fresh;
      for (const Detection& detection : late(all, 1, 4, [&] { return generator() % 4; })) shuffled.take(detection);
      std::size_t k = 0;
      shuffled.smoothed([&](const auto& kept, const auto& state) {
        ASSERT_LT(k, tags.size());
        ASSERT_EQ(kept.tag, tags[k]);
        require_same_state(state, expected[k++], 0.0);
      });
      ASSERT_EQ(k, tags.size());
      ASSERT_PRED_FORMAT2(same_filter, shuffled.filter(), in_order.filter());
      ASSERT_EQ(shuffled.time(), in_order.time());
      ASSERT_EQ(shuffled.accepted_time(), in_order.accepted_time());
    }
  });
}

/// A turn of the axes, whose lengths it leaves, and a new origin.
const SquareMatrix<2> turned{{0.8, -0.6}, {0.6, 0.8}};
const Vector<2> moved(5000.0, -3000.0);

Detection in_other_coordinates(const Detection& detection) {
  const auto z = detection.position<2>();
  if (!z) return detection;
  return {detection.time, Gaussian<2>{turned * z->mean + moved, turned * z->covariance * turned.transpose()},
          detection.tag};
}

TEST(TrackManager, InOtherCoordinatesItIsThatOfMeasurementsInThem) {
  for_each(every_filter(), [](const TargetChoice& choice) {
    if (choice.scheme == Scheme::histories) return;
    AnyFilter(with(choice, StateAugmentation::unbiased))
        .do_with([](const auto& filter) {  // borrowing variances alone knows of axes
          auto target = recording(filter), expected = target;
          std::size_t told = 0;
          bool there = false;
          for (const Detection& detection : detections(35)) {
            if (!there && told > 20) there = target.transform(turned, moved);
            expected.take(in_other_coordinates(detection), [&](const Detection&, bool) { ++told; });
            target.take(there ? in_other_coordinates(detection) : detection);
          }
          ASSERT_TRUE(there);
          ASSERT_EQ(target.starts(), 1U);
          require_same_state(target.filter().state(), expected.filter().state(), 1e-8);
          std::vector<std::decay_t<decltype(filter.state())>> smoothed;
          expected.smoothed([&](const auto&, const auto& state) { smoothed.push_back(state); });
          std::size_t k = 0;
          target.smoothed([&](const auto&, const auto& state) { require_same_state(state, smoothed[k++], 1e-7); });
          EXPECT_EQ(k, smoothed.size());
        });
  });
}

TEST(TrackManager, IsToldInOtherCoordinatesBackToTheLastStartOnly) {
  auto target = recording(imm(StateAugmentation::unbiased));
  for (const Detection& detection : detections(80, 40)) target.take(detection);
  ASSERT_EQ(target.starts(), 2U);
  std::vector<Vector<2>> before;
  std::size_t last_start = 0;
  target.smoothed([&](const auto& kept, const auto& state) {
    if (kept.is_start) last_start = before.size();
    before.push_back(state.estimates[2].mean.template head<2>());
  });
  ASSERT_TRUE(target.transform(turned, moved));
  std::size_t k = 0;
  target.smoothed([&](const auto&, const auto& state) {
    const Vector<2> was = before[k], expected = k++ >= last_start ? Vector<2>(turned * was + moved) : was;
    ASSERT_CLOSE(state.estimates[2].mean.template head<2>(), expected, 1e-9);
  });
}

TEST(TrackManager, OfWhatWaitsOrIsBufferedStaysWhereItIs) {
  Target waiting{imm(), one_point_start};
  EXPECT_FALSE(waiting.transform(turned, moved)) << "it has not started";
  const auto all = detections(20);
  waiting.take(all[0]);
  EXPECT_TRUE(waiting.transform(turned, moved));
  EXPECT_EQ(waiting.take(in_other_coordinates(all[1])), Verdict::accepted);
  EXPECT_EQ(waiting.take(all[2]), Verdict::rejected);
  const auto before = waiting.filter();
  EXPECT_FALSE(waiting.transform(turned, moved)) << "the rejected one is in the old coordinates";
  EXPECT_PRED_FORMAT2(same_filter, waiting.filter(), before);

  auto buffered = recording(imm(), 2);
  for (const Detection& detection : all) buffered.take(detection);
  EXPECT_FALSE(buffered.transform(turned, moved));
}

}  // namespace track_manager_test
