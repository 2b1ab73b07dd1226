#include "himm_demo/mode_filter_implementation.hpp"

namespace sigmax::apps {

template class ModeFilter<AnyBank<2>>;

}  // namespace sigmax::apps
