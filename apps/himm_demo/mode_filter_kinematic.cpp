#include "himm_demo/mode_filter_implementation.hpp"

namespace sigmax::apps {

template class ModeFilter<KinematicBank<2>>;
template class ModeFilter<KinematicBank<3>>;

}  // namespace sigmax::apps
