// `step` allocates nothing: every operator new of this program is counted.
#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <vector>

#include <sigmax/hybrid/fixed_interval_smoother.hpp>
#include <sigmax/hybrid/history_filter.hpp>
#include <sigmax/hybrid/mode_transition.hpp>
#include <sigmax/hybrid/target.hpp>

#include "hybrid/banks.hpp"
#include "support/allocations.hpp"

namespace sigmax {
namespace {

using support::allocations_of;

TEST(Allocation, TheCounterCounts) {
  struct alignas(64) Aligned {
    char bytes[64];
  };
  // What outlives the action cannot be optimised away.
  std::unique_ptr<int> one;
  std::vector<double> many;
  std::unique_ptr<Aligned> aligned;
  EXPECT_EQ(allocations_of([] {}), 0U);
  EXPECT_EQ(allocations_of([&] { one = std::make_unique<int>(1); }), 1U);
  EXPECT_EQ(allocations_of([&] {
              many.resize(100);
              many.resize(200);
            }),
            2U);
  EXPECT_EQ(allocations_of([&] { aligned = std::make_unique<Aligned>(); }), 1U);
}

template <Uncertainty Kind>
Relation<Kind, Kind> transition() {
  const Variable<Kind> motion{"motion", 3};
  return std::is_same_v<Kind, Random>
             ? Relation<Kind, Kind>{motion, motion, {{0.90, 0.07, 0.03}, {0.10, 0.80, 0.10}, {0.02, 0.08, 0.90}}}
             : Relation<Kind, Kind>{motion, motion, {{1.0, 0.5, 0.2}, {0.5, 1.0, 0.5}, {0.1, 0.5, 1.0}}};
}

template <class Models>
auto starts_of(const Models& models) {
  auto starts = detail::estimates_for(models);
  for_each_mode(models, [&](auto j) {
    auto& start = mode(starts, j);
    const auto n = mode(models, j).size();
    start.mean.setZero(n);
    start.mean.template head<4>() << 12000, 8000, -100, -100;
    start.covariance.setZero(n, n);
    start.covariance.diagonal().setConstant(100.0);
  });
  return starts;
}

template <Uncertainty Kind, class Models, class Order = support::Interacting>
void nothing_is_allocated(const Models& models, const Interaction<Kind>& interaction, Order = {}) {
  typename Order::template Filter<Models, Kind> filter{models, transition<Kind>(), starts_of(models), interaction};
  std::size_t measured = 0, missed = 0;
  for (const auto& scan : support::manoeuvring_target(40)) {
    if (scan.z) {
      ++measured;
      ASSERT_EQ(allocations_of([&] { filter.step(scan.dt, *scan.z); }), 0U);
      ASSERT_EQ(allocations_of([&] { filter.nis(); }), 0U);
    } else {
      ++missed;
      ASSERT_EQ(allocations_of([&] { filter.step(scan.dt); }), 0U);
    }
    ASSERT_EQ(allocations_of([&] { filter.estimate(); }), 0U);
    ASSERT_EQ(allocations_of([&] { filter.most_likely_estimate(); }), 0U);
  }
  EXPECT_GT(measured, 0U);
  EXPECT_GT(missed, 0U);
}

const VectorBank vector_bank{support::calm(1.0), support::calm(5.0), support::turning(4.0)};
const TupleBank tuple_bank{dwna<2>(1.0), dwna<2>(5.0), dwpa<2>(4.0)};

TEST(Allocation, AnImmAllocatesNothing) {
  for (const Lift lift : {Lift::zero, Lift::borrowed_variance, Lift::unbiased}) {
    nothing_is_allocated<Random>(vector_bank, {lift, {}, Tie::stay});
    nothing_is_allocated<Random>(tuple_bank, {lift, {}, Tie::stay});
  }
}

TEST(Allocation, AHimmAllocatesNothing) {
  for (const Lift lift : {Lift::zero, Lift::borrowed_variance, Lift::unbiased}) {
    nothing_is_allocated<Fuzzy>(vector_bank, {lift, {}, Tie::stay});
    nothing_is_allocated<Fuzzy>(tuple_bank, {lift, {MixedCovariance::own_recentred, Tie::first}, Tie::last});
  }
}

TEST(Allocation, AHimmByTheEnvelopeAllocatesNothingAfterTheFirstStepOfItsThread) {
  using Himm = InteractingMultipleModel<VectorBank, Fuzzy>;
  const Interaction<Fuzzy> interaction{Lift::borrowed_variance, {MixedCovariance::envelope}};
  Himm{vector_bank, transition<Fuzzy>(), starts_of(vector_bank), interaction}.step(0.1);
  nothing_is_allocated<Fuzzy>(vector_bank, interaction);
}

TEST(Allocation, ASecondOrderFilterAllocatesNothing) {
  for (const Lift lift : {Lift::zero, Lift::borrowed_variance, Lift::unbiased}) {
    nothing_is_allocated<Random>(vector_bank, {lift, {}, Tie::stay}, support::SecondOrder{});
    nothing_is_allocated<Random>(tuple_bank, {lift, {}, Tie::stay}, support::SecondOrder{});
    nothing_is_allocated<Fuzzy>(vector_bank, {lift, {}, Tie::stay}, support::SecondOrder{});
    nothing_is_allocated<Fuzzy>(tuple_bank, {lift, {}, Tie::stay}, support::SecondOrder{});
  }
}

template <Uncertainty Kind>
void smoothing_allocates_nothing() {
  InteractingMultipleModel<VectorBank, Kind> filter{vector_bank, transition<Kind>(), starts_of(vector_bank)};
  std::vector record{filter.recorded(0.0)};
  for (const auto& scan : support::manoeuvring_target(20)) {
    step(filter, scan);
    record.push_back(recorded(filter, scan));
  }
  FixedIntervalSmoother<VectorBank, Kind> smoother{filter};
  smoother.begin(record.back());
  for (std::size_t k = record.size() - 1; k-- > 0;) ASSERT_EQ(allocations_of([&] { smoother.step(record[k]); }), 0U);
}

TEST(Allocation, AStepOfTheSmootherAllocatesNothing) {
  smoothing_allocates_nothing<Random>();
  smoothing_allocates_nothing<Fuzzy>();
}

TEST(Allocation, ATargetAllocatesNothingWhateverBecomesOfAMeasurement) {
  const auto start = [](const Gaussian<2>& z) {
    Gaussian<6> result{Vector<6>::Zero(), SquareMatrix<6>::Identity()};
    result.mean.head<2>() = z.mean;
    return result;
  };
  InteractingMultipleModel<VectorBank, Fuzzy> filter{vector_bank, transition<Fuzzy>(), starts_of(vector_bank)};
  Target target{filter, 0.0, start, TargetRules{0.999, 2, 1e9, 3}};
  const Gaussian<2> z{Vector<2>{12000, 8000}, 1e4 * SquareMatrix<2>::Identity()};
  const Gaussian<2> far{Vector<2>{-12000, 8000}, 1e4 * SquareMatrix<2>::Identity()};
  std::vector<Verdict> verdicts;
  verdicts.reserve(16);
  const auto take = [&](double time, const Gaussian<2>& measured) {
    ASSERT_EQ(allocations_of([&] { verdicts.push_back(target.take(time, measured)); }), 0U);
  };
  take(1.0, z);
  take(2.0, z);
  take(1.5, z);  // late
  take(3.0, far);
  take(4.0, far);
  ASSERT_EQ(allocations_of([&] { verdicts.push_back(target.take(5.0)); }), 0U);
  EXPECT_EQ(verdicts, (std::vector{Verdict::accepted, Verdict::accepted, Verdict::accepted, Verdict::rejected,
                                   Verdict::restarted, Verdict::missed}));
}

TEST(Allocation, AnUnreachableModeAllocatesNothing) {
  const FuzzyVariable motion{"motion", 3};
  const Relation only_the_first{motion, motion, {{1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}};
  InteractingMultipleModel<VectorBank, Fuzzy> filter{vector_bank, only_the_first, starts_of(vector_bank)};
  for (int k = 0; k < 3; ++k) ASSERT_EQ(allocations_of([&] { filter.step(0.2); }), 0U);
}

TEST(Allocation, ATransitionOverAnyTimeAllocatesNothing) {
  const FuzzyVariable motion{"motion", 4};
  const TimedTransition transition{motion, rates_of_sojourns({20.0, 5.0, 3.0, 1.0})};
  Relation relation = transition(1.0);
  for (const double dt : {0.2, 0.0, 50.0}) ASSERT_EQ(allocations_of([&] { transition(dt, relation); }), 0U);
}

template <Uncertainty Kind>
void histories_allocate_nothing() {
  const VectorBank bank{support::calm(1.0), support::calm(5.0), support::turning()};
  HistoryFilter<VectorBank, Kind> filter{bank, transition<Kind>(), support::starts()};
  auto other = filter;
  for (const auto& scan : support::manoeuvring_target(40)) {
    ASSERT_EQ(allocations_of([&] { support::step(filter, scan); }), 0U);
    ASSERT_EQ(allocations_of([&] { other.restore(filter.state()); }), 0U);
  }
}

TEST(Allocation, AStepOverHistoriesAllocatesNothingNorDoesAStepBack) {
  histories_allocate_nothing<Fuzzy>();
  histories_allocate_nothing<Random>();
}

}  // namespace
}  // namespace sigmax
