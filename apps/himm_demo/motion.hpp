#pragma once

#include <string>
#include <vector>

#include <sigmax/hybrid/motion_choice.hpp>

namespace sigmax::apps {

using Motion = MotionChoice;

/// The numbers in TOML.
std::string toml_list(const std::vector<double>& numbers);

/// Distinct names of the models: a second dwna is dwna_2.
std::vector<std::string> names_of(const std::vector<Motion>& motions);

}  // namespace sigmax::apps
