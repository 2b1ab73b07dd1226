#pragma once

// What tests of the other rooms include, precompiled once for all of them.

#include <sigmax/sigmax.hpp>

#include "support/matrices.hpp"
