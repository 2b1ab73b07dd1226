#include "himm_demo/mode_filter_implementation.hpp"

namespace sigmax::apps {

template class ModeFilter<AnyBank<3>>;

}  // namespace sigmax::apps
