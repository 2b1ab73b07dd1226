#include "sorted_boxes.hpp"

#include "support/sigmax.hpp"

namespace sorted_boxes_test {

using detail::Box;

Box drawn_box() {
  const auto number = [](int least, int end) { return *rc::gen::inRange(least, end) / 4.0; };
  const double everywhere = *rc::gen::inRange(0, 12) == 0 ? infinity : 0.0;
  return {{number(-200, 200), number(-200, 200), number(-20, 20)},
          {number(0, 40) + everywhere, number(0, 40) + everywhere, number(0, 8) + everywhere}};
}

PROPERTY(SortedBoxes, FindAllThatOverlapAndNoOther) {
  std::vector<Box> boxes(*rc::gen::inRange<std::size_t>(0, 40));
  for (Box& box : boxes) box = drawn_box();
  detail::SortedBoxes sorted;
  sorted.assign({drawn_box()});
  sorted.assign(boxes);
  const Box asked = drawn_box();
  std::vector<std::size_t> found, expected;
  sorted.overlapping(asked, found);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    if (boxes[i].overlaps(asked)) expected.push_back(i);
  RC_ASSERT(found == expected);
}

}  // namespace sorted_boxes_test
