#pragma once

// What most tests include, precompiled once for all of them.

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <atomic>
#include <bit>
#include <cerrno>
#include <chrono>
#include <concepts>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <limits>
#include <list>
#include <map>
#include <memory>
#include <new>
#include <numbers>
#include <numeric>
#include <optional>
#include <ostream>
#include <random>
#include <set>
#include <stdexcept>
#include <thread>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "support/property.hpp"
#include "support/throws.hpp"
#include "support/type_names.hpp"

namespace sigmax::support {

using Numbers = std::vector<double>;
using Rows = std::vector<Numbers>;

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double least_subnormal = std::numeric_limits<double>::denorm_min();
inline constexpr double degree = std::numbers::pi / 180.0;

}  // namespace sigmax::support

namespace sigmax::apps {}
namespace sigmax::laws {}

using namespace sigmax;           // as those who use it do
using namespace sigmax::support;  // and what the tests' own headers offer
using namespace sigmax::apps;
using namespace sigmax::laws;
