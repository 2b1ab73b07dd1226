#pragma once

/// Everything of sigmax.

#include <sigmax/core/algebra.hpp>
#include <sigmax/core/belief.hpp>
#include <sigmax/core/compose.hpp>
#include <sigmax/core/distribution.hpp>
#include <sigmax/core/induced.hpp>
#include <sigmax/core/likelihood.hpp>
#include <sigmax/core/relation.hpp>
#include <sigmax/core/uncertainty.hpp>
#include <sigmax/core/update.hpp>
#include <sigmax/core/variable.hpp>
#include <sigmax/estimation/chi_square.hpp>
#include <sigmax/estimation/fixed_step_model.hpp>
#include <sigmax/estimation/gaussian.hpp>
#include <sigmax/estimation/kalman.hpp>
#include <sigmax/estimation/kinematic_model.hpp>
#include <sigmax/estimation/metrics.hpp>
#include <sigmax/estimation/model.hpp>
#include <sigmax/estimation/radar.hpp>
#include <sigmax/estimation/start.hpp>
#include <sigmax/hybrid/bank.hpp>
#include <sigmax/hybrid/collapse.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>
#include <sigmax/hybrid/jump_markov_system.hpp>
#include <sigmax/hybrid/lift.hpp>
#include <sigmax/recognition/classifier.hpp>
