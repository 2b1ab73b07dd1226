#include <sigmax/estimation/refs.hpp>

#include "support/test.hpp"

namespace {

TEST(Refs, AModelIsWhatItsTableSays) {
  const int size = 3;
  detail::MotionTable table{2, [](const void* motion) { return *static_cast<const int*>(motion); },
                            [](const void*) { return std::string("three"); }};
  const detail::ModelRef linear{&size, &table};
  EXPECT_EQ(linear.size(), 3);
  EXPECT_EQ(linear.name(), "three");
  EXPECT_TRUE(linear.linear());
  EXPECT_FALSE(linear.by_points());

  table.tangent = [](const void*, const double*, double, double*, double*, double*) {};
  const detail::ModelRef by_points{&size, &table, {3.0, 0.0, 2.0}};
  EXPECT_FALSE(by_points.linear());
  EXPECT_TRUE(by_points.by_points());
}

}  // namespace
