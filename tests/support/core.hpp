#pragma once

// What tests of core include, precompiled once for all of them.

#include <sigmax/core.hpp>

#include "support/test.hpp"
