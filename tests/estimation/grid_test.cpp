#include "support/sigmax.hpp"

namespace grid_test {

using Place = Grid<2>::Lattice;

TEST(Grid, NumbersItsCellsRowByRow) {
  const Grid<2> grid{{-1.0, 10.0}, {1.0, 11.5}, {1.0, 0.5}};
  ASSERT_EQ(grid.size(), 6U);
  const std::vector<Vector<2>> centres{{-0.5, 10.25}, {-0.5, 10.75}, {-0.5, 11.25},
                                       {0.5, 10.25},  {0.5, 10.75},  {0.5, 11.25}};
  std::size_t i = 0;
  Grid<2>::for_each_place(grid.first(), grid.first() + grid.extent() - Place::Ones(), [&](const Place& place) {
    EXPECT_EQ(grid.place(i), place);
    EXPECT_EQ(grid.cell(place), i);
    EXPECT_CLOSE(grid.centre(i), centres[i], 1e-15);
    EXPECT_EQ(grid.place_of(centres[i]), place);
    ++i;
  });
  EXPECT_EQ(i, 6U);
}

TEST(Grid, CoversItsCornersHoweverTheStepFits) {
  const Grid<1> grid{Vector<1>{0.0}, Vector<1>{1.0}, Vector<1>{0.3}};
  EXPECT_EQ(grid.size(), 4U);
}

TEST(Grid, IsABoxOfALatticeThatGoesOn) {
  const Grid<2> grid{{-1.0, 10.0}, {1.0, 11.5}, {1.0, 0.5}};
  const Grid<2> window = grid.window({-3, 1}, {4, 2});
  EXPECT_EQ(window.size(), 16U);
  EXPECT_EQ(window.place(0), (Place{-3, 1}));
  EXPECT_CLOSE(window.centre(0), (Vector<2>{-3.5, 10.75}), 1e-15);
  EXPECT_EQ(window.place_of({-3.9, 10.6}), (Place{-3, 1}));
}

/// The two halves of cell i are 2i and 2i + 1, left and right of its centre; joined they are i again.
TEST(Grid, HalvesAndDoublesFitIntoEachOther) {
  const Grid<2> grid = Grid<2>{{-1.0, 10.0}, {1.0, 11.5}, {1.0, 0.5}}.window({-3, 0}, {1, 2});
  const Grid<2> halved = grid.halved(0);
  EXPECT_EQ(halved.size(), 2 * grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Place place = grid.place(i);
    for (const Eigen::Index side : {0, 1}) {
      const Place child{2 * place(0) + side, place(1)};
      const Vector<2> expected = grid.centre(i) + Vector<2>{side == 0 ? -0.25 : 0.25, 0.0};
      EXPECT_CLOSE(halved.centre(halved.cell(child)), expected, 1e-15);
      EXPECT_EQ(Grid<2>::half(child(0)), place(0));
    }
  }
  EXPECT_EQ(halved.doubled(0).first(), grid.first());
  EXPECT_EQ(halved.doubled(0).extent(), grid.extent());
  EXPECT_EQ(halved.doubled(0).step(), grid.step());
}

TEST(Grid, GrowsWhereAPairIsCut) {
  const Grid<1> grid =
      Grid<1>{Vector<1>{0.0}, Vector<1>{1.0}, Vector<1>{1.0}}.window(Grid<1>::Lattice{-3}, Grid<1>::Lattice{2});
  const Grid<1> doubled = grid.doubled(0);
  EXPECT_EQ(doubled.first()(0), -2);  // of −3, with its neighbour −4
  EXPECT_EQ(doubled.extent()(0), 4);  // up to 1, of 2, with its neighbour 3
}

TEST(Grid, RefusesWhatIsNoBox) {
  const auto make = [](double lower, double upper, double step) {
    return Grid<1>{Vector<1>{lower}, Vector<1>{upper}, Vector<1>{step}};
  };
  EXPECT_INVALID(("lower corner"), make(1.0, 1.0, 0.1));
  EXPECT_INVALID(("positive steps"), make(0.0, 1.0, 0.0));
  EXPECT_INVALID(("finite"), make(0.0, NAN, 0.1));
  EXPECT_INVALID(("cells"), make(0.0, 1.0, 1e-10));
}

}  // namespace grid_test
