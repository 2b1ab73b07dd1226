// What a target keeps of its life: tags, the record that is smoothed, and both in other coordinates.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include <sigmax/hybrid/target.hpp>

#include "hybrid/laws.hpp"

namespace sigmax {
namespace {

using namespace support;

using PlotType = Plot<PositionSensor<2>>;

State one_point_start(const Gaussian<2>& z) {
  State start{Vector<6>::Zero(), SquareMatrix<6>::Zero()};
  start.mean.head<2>() = z.mean;
  start.covariance.topLeftCorner<2, 2>() = z.covariance;
  start.covariance.diagonal().tail<4>() << 4e4, 4e4, 400.0, 400.0;
  return start;
}

/// The manoeuvring target at absolute times, each with a tag; one measurement in ten is of something else, and from one
/// on all are, so that the target is lost and starts again.
std::vector<PlotType> plots(std::size_t count, std::size_t lost_from) {
  std::vector<PlotType> result;
  double time = 0.0;
  for (const Scan& scan : manoeuvring_target(count)) {
    time += std::max(scan.dt, 0.05);
    const std::size_t tag = 1000 + 3 * result.size();
    if (!scan.z) {
      result.emplace_back(time, tag);
      continue;
    }
    auto z = *scan.z;
    if (result.size() % 10 == 7) z.mean.array() += 3000.0;
    if (result.size() >= lost_from) z.mean(0) += 20e3;
    result.emplace_back(time, z, tag);
  }
  return result;
}

template <class Order, Uncertainty Kind>
auto recording_target(std::size_t buffer = 0, const Interaction<Kind>& interaction = {}) {
  TargetRules rules{0.999, 3, 1e9, buffer};
  rules.record = true;
  return Target{vector_filter<Order, Kind>(interaction), one_point_start, rules};
}

template <class State>
void require_same_state(const State& found, const State& expected, double tolerance) {
  for (std::size_t j = 0; j < expected.estimates.size(); ++j) {
    ASSERT_PRED_FORMAT3(near_matrix, found.estimates[j].mean, expected.estimates[j].mean, tolerance);
    ASSERT_PRED_FORMAT3(near_matrix, found.estimates[j].covariance, expected.estimates[j].covariance, tolerance);
    ASSERT_PRED_FORMAT3(near, found.belief.log(j), expected.belief.log(j), tolerance);
  }
  ASSERT_EQ(found.most_likely_mode, expected.most_likely_mode);
}

template <class Order, Uncertainty Kind>
void smooths_what_was_told() {
  using Recorded = decltype(std::declval<Filter<Order, Kind>>().recorded(0.0));
  auto target = recording_target<Order, Kind>();
  std::vector<std::vector<Recorded>> segments;
  std::vector<std::pair<std::size_t, bool>> told;
  std::vector<double> times;
  for (const PlotType& plot : plots(80, 40))
    target.take(plot, [&](const PlotType& each, bool is_start) {
      told.push_back({each.tag, is_start});
      if (is_start) segments.emplace_back();
      const double dt = is_start ? 0.0 : target.time() - times.back();
      times.push_back(target.time());
      segments.back().push_back(target.filter().measured() ? target.filter().recorded(dt, each.seen->z)
                                                           : target.filter().recorded(dt));
    });
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(target.starts(), 2U);
  std::vector<HybridEstimate<VectorBank, Kind>> expected;
  for (const auto& segment : segments)
    for (const auto& state : smooth(target.filter(), segment)) expected.push_back(state);

  std::size_t k = 0;
  target.smoothed([&](const auto& kept, const auto& state) {
    ASSERT_LT(k, told.size());
    ASSERT_EQ(kept.tag, told[k].first);
    ASSERT_EQ(kept.is_start, told[k].second);
    ASSERT_EQ(kept.time, times[k]);
    require_same_state(state, expected[k], 1e-12);
    ++k;
  });
  EXPECT_EQ(k, told.size());
}

TEST(TargetRecord, IsSmoothedFromStartToStartAsTheFiltersOwnRecordIs) {
  smooths_what_was_told<Interacting, Random>();
  smooths_what_was_told<Interacting, Fuzzy>();
  smooths_what_was_told<SecondOrder, Fuzzy>();
}

TEST(TargetRecord, HasTheNisOfEachMeasurementThatWasTaken) {
  auto target = recording_target<Interacting, Random>();
  std::vector<std::optional<double>> expected;
  for (const PlotType& plot : plots(30, 15))
    target.take(plot, [&](const PlotType&, bool) {
      expected.push_back(target.filter().measured() ? std::optional(target.filter().nis()) : std::nullopt);
    });
  std::size_t k = 0, measured = 0;
  target.smoothed([&](const auto& kept, const auto&) {
    ASSERT_EQ(kept.nis, expected[k++]);
    if (kept.nis) ++measured;
  });
  EXPECT_EQ(k, expected.size());
  EXPECT_GT(measured, 15U);
  EXPECT_LT(measured, k);
}

TEST(TargetRecord, IsEmptyUnlessItIsAskedFor) {
  Target target{vector_filter<Interacting, Random>(), one_point_start};
  for (const PlotType& plot : plots(10, 10)) target.take(plot);
  target.smoothed([](const auto&, const auto&) { FAIL(); });
}

template <class Order, Uncertainty Kind>
void retrodicts_its_record() {
  constexpr std::size_t late_by = 4;
  const auto all = plots(28, 14);
  const auto fresh = recording_target<Order, Kind>(late_by);
  auto in_order = fresh;
  for (const PlotType& plot : all) in_order.take(plot);
  ASSERT_GE(in_order.starts(), 2U);
  std::vector<std::size_t> tags;
  std::vector<HybridEstimate<VectorBank, Kind>> expected;
  in_order.smoothed([&](const auto& kept, const auto& state) {
    tags.push_back(kept.tag);
    expected.push_back(state);
  });
  std::mt19937 generator(1);
  for (int shuffle = 0; shuffle < 20; ++shuffle) {
    std::vector<std::size_t> order(all.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    for (std::size_t k = 1; k + late_by < order.size(); k += late_by) {  // shuffled within groups, but for the first
      const auto from = order.begin() + static_cast<std::ptrdiff_t>(k);
      const std::size_t turn = generator() % late_by;
      std::rotate(from, from + static_cast<std::ptrdiff_t>(turn), from + late_by);
    }
    auto shuffled = fresh;
    for (const std::size_t k : order) shuffled.take(all[k]);
    std::size_t k = 0;
    shuffled.smoothed([&](const auto& kept, const auto& state) {
      ASSERT_LT(k, tags.size());
      ASSERT_EQ(kept.tag, tags[k]);
      for (std::size_t j = 0; j < 3; ++j) {
        ASSERT_EQ(state.estimates[j].mean, expected[k].estimates[j].mean);
        ASSERT_EQ(state.belief.log(j), expected[k].belief.log(j));
      }
      ++k;
    });
    ASSERT_EQ(k, tags.size());
  }
}

TEST(TargetRecord, OfLatePlotsIsThatOfTheRightOrderToTheBit) {
  retrodicts_its_record<Interacting, Random>();
  retrodicts_its_record<SecondOrder, Fuzzy>();
}

TEST(TargetRecord, AFailedPlotLeavesItAsItWas) {
  auto target = recording_target<Interacting, Random>(3);
  const auto all = plots(20, 20);
  for (std::size_t k = 0; k < 12; ++k) target.take(all[k]);
  const auto tags_of = [](const auto& one) {
    std::vector<std::size_t> tags;
    one.smoothed([&](const auto& kept, const auto&) { tags.push_back(kept.tag); });
    return tags;
  };
  const auto before = tags_of(target);
  Gaussian<2> bad = all[0].seen->z;
  bad.covariance *= -1e6;
  for (const double time : {all[10].time, all[13].time})
    EXPECT_TRUE(throws<std::domain_error>([&] { target.take(time, bad); }, {"not positive"}));
  EXPECT_EQ(tags_of(target), before);
}

/// A turn of the axes, whose lengths it leaves, and a new origin.
const SquareMatrix<2> turned{{0.8, -0.6}, {0.6, 0.8}};
const Vector<2> moved(5000.0, -3000.0);

PlotType in_other_coordinates(const PlotType& plot) {
  if (!plot.seen) return plot;
  const auto& z = plot.seen->z;
  return {plot.time, {turned * z.mean + moved, turned * z.covariance * turned.transpose()}, plot.tag};
}

template <class Order, Uncertainty Kind>
void goes_on_in_other_coordinates() {
  const Interaction<Kind> interaction{Lift::unbiased};  // borrowing variances alone knows of axes
  auto target = recording_target<Order, Kind>(0, interaction), expected = target;
  std::size_t told = 0;
  bool there = false;
  for (const PlotType& plot : plots(35, 35)) {
    if (!there && told > 20) there = target.transform(turned, moved);
    expected.take(in_other_coordinates(plot), [&](const PlotType&, bool) { ++told; });
    target.take(there ? in_other_coordinates(plot) : plot);
  }
  ASSERT_TRUE(there);
  ASSERT_EQ(target.starts(), 1U);
  require_same_state(target.filter().state(), expected.filter().state(), 1e-8);

  std::vector<HybridEstimate<VectorBank, Kind>> smoothed;
  expected.smoothed([&](const auto&, const auto& state) { smoothed.push_back(state); });
  std::size_t k = 0;
  target.smoothed([&](const auto&, const auto& state) { require_same_state(state, smoothed[k++], 1e-7); });
  EXPECT_EQ(k, smoothed.size());
}

TEST(TargetRecord, InOtherCoordinatesItIsThatOfMeasurementsInThem) {
  goes_on_in_other_coordinates<Interacting, Random>();
  goes_on_in_other_coordinates<Interacting, Fuzzy>();
  goes_on_in_other_coordinates<SecondOrder, Random>();
}

TEST(TargetRecord, IsToldInOtherCoordinatesBackToTheLastStartOnly) {
  auto target = recording_target<Interacting, Random>(0, {Lift::unbiased});
  for (const PlotType& plot : plots(80, 40)) target.take(plot);
  ASSERT_EQ(target.starts(), 2U);
  std::vector<State> before;
  std::vector<bool> starts;
  target.smoothed([&](const auto& kept, const auto& state) {
    before.push_back(state.estimates[2]);
    starts.push_back(kept.is_start);
  });
  ASSERT_TRUE(target.transform(turned, moved));
  const auto last_start = static_cast<std::size_t>(starts.rend() - std::find(starts.rbegin(), starts.rend(), true) - 1);
  std::size_t k = 0;
  target.smoothed([&](const auto&, const auto& state) {
    State expected = before[k];
    if (k++ >= last_start) transform(turned, moved, expected);
    ASSERT_PRED_FORMAT3(near_matrix, state.estimates[2].mean, expected.mean, 1e-9);
    ASSERT_PRED_FORMAT3(near_matrix, state.estimates[2].covariance, expected.covariance, 1e-7);
  });
}

TEST(TargetRecord, WhatWaitsOrIsBufferedKeepsATargetWhereItIs) {
  Target waiting{vector_filter<Interacting, Random>(), one_point_start};
  EXPECT_FALSE(waiting.transform(turned, moved)) << "it has not started";
  const auto all = plots(20, 20);
  waiting.take(all[0]);
  EXPECT_TRUE(waiting.transform(turned, moved));
  EXPECT_EQ(waiting.take(in_other_coordinates(all[1])), Verdict::accepted);
  EXPECT_EQ(waiting.take(all[2]), Verdict::rejected);
  const auto before = waiting.filter();
  EXPECT_FALSE(waiting.transform(turned, moved)) << "the rejected one is in the old coordinates";
  require_same<Interacting, Random>(waiting.filter(), before);

  auto buffered = recording_target<Interacting, Random>(2);
  for (const PlotType& plot : all) buffered.take(plot);
  EXPECT_FALSE(buffered.transform(turned, moved));
}

}  // namespace
}  // namespace sigmax
