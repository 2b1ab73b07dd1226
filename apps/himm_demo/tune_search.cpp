#include "himm_demo/tune_search.hpp"

#include <stdexcept>

#ifdef SIGMAX_NLOPT
#include <nlopt.hpp>
#endif

namespace sigmax::apps {

#ifdef SIGMAX_NLOPT

bool can_search() { return true; }

void search(const std::function<double(const std::vector<double>&)>& function, const FitSearch& from,
            std::size_t most) {
  const auto n = static_cast<unsigned>(from.start.size());
  nlopt::opt optimiser(n == 1 ? nlopt::LN_SBPLX : nlopt::LN_BOBYQA, n);
  optimiser.set_lower_bounds(from.lower);
  optimiser.set_upper_bounds(from.upper);
  optimiser.set_initial_step(from.step);
  optimiser.set_xtol_abs(0.02);
  optimiser.set_ftol_abs(1e-5);
  optimiser.set_maxeval(static_cast<int>(most));
  using Function = std::function<double(const std::vector<double>&)>;
  const auto ask = [](const std::vector<double>& at, std::vector<double>&, void* asked) {
    return (*static_cast<const Function*>(asked))(at);
  };
  Function asked = function;
  optimiser.set_min_objective(ask, &asked);
  std::vector<double> at = from.start;
  double least = 0.0;
  try {
    optimiser.optimize(at, least);
  } catch (const std::runtime_error&) {  // rounding, or its model broke down: what was found before counts
  }
}

#else

bool can_search() { return false; }

void search(const std::function<double(const std::vector<double>&)>&, const FitSearch&, std::size_t) {
  throw std::logic_error("this build has no NLopt");
}

#endif

}  // namespace sigmax::apps
