#pragma once

/// Everything of sigmax::core.
///
/// Const use is safe from several threads at once, as of the standard library's containers: nothing is cached behind a
/// const, copies share only what never changes, and no verb keeps a state of its own.

#include <sigmax/core/algebra.hpp>
#include <sigmax/core/belief.hpp>
#include <sigmax/core/chain.hpp>
#include <sigmax/core/check.hpp>
#include <sigmax/core/choices.hpp>
#include <sigmax/core/compose.hpp>
#include <sigmax/core/condition.hpp>
#include <sigmax/core/distribution.hpp>
#include <sigmax/core/forward_backward.hpp>
#include <sigmax/core/hybrid_distribution.hpp>
#include <sigmax/core/induced.hpp>
#include <sigmax/core/likelihood.hpp>
#include <sigmax/core/logarithm.hpp>
#include <sigmax/core/matching.hpp>
#include <sigmax/core/mean_interval.hpp>
#include <sigmax/core/measure.hpp>
#include <sigmax/core/network.hpp>
#include <sigmax/core/network/bif.hpp>
#include <sigmax/core/network/compose.hpp>
#include <sigmax/core/network/explanation.hpp>
#include <sigmax/core/network/graphviz.hpp>
#include <sigmax/core/network/measure.hpp>
#include <sigmax/core/network/query.hpp>
#include <sigmax/core/network/transform.hpp>
#include <sigmax/core/outcomes.hpp>
#include <sigmax/core/relation.hpp>
#include <sigmax/core/route.hpp>
#include <sigmax/core/rows.hpp>
#include <sigmax/core/sample.hpp>
#include <sigmax/core/scaled_number.hpp>
#include <sigmax/core/table.hpp>
#include <sigmax/core/tie.hpp>
#include <sigmax/core/transform.hpp>
#include <sigmax/core/uncertainty.hpp>
#include <sigmax/core/update.hpp>
#include <sigmax/core/variable.hpp>
