#pragma once

#include <sigmax/core/compose.hpp>
#include <sigmax/core/update.hpp>
#include <sigmax/recognition/classifier.hpp>
