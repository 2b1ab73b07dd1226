#include <sigmax/tuning/search.hpp>

#include <boost/random/sobol.hpp>
#include <nlopt.hpp>

namespace sigmax {
namespace {

using Point = std::vector<double>;
using Function = std::function<double(const Point&)>;

/// To 2 % of a logarithm, or until the function was asked `most` times. It draws no random numbers.
void descend(Function function, const FitSearch& space, const Point& start, std::size_t most) {
  const auto n = static_cast<unsigned>(start.size());
  nlopt::opt optimiser(n == 1 ? nlopt::LN_SBPLX : nlopt::LN_BOBYQA, n);
  optimiser.set_lower_bounds(space.lower);
  optimiser.set_upper_bounds(space.upper);
  Point step = space.step;  // which has to fit twice between the bounds
  for (std::size_t i = 0; i < step.size(); ++i) step[i] = std::min(step[i], 0.4 * (space.upper[i] - space.lower[i]));
  optimiser.set_initial_step(step);
  optimiser.set_xtol_abs(0.02);
  optimiser.set_ftol_abs(1e-5);
  optimiser.set_maxeval(static_cast<int>(most));
  const auto ask = [](const Point& at, Point&, void* asked) { return (*static_cast<Function*>(asked))(at); };
  optimiser.set_min_objective(ask, &function);
  Point at = start;
  double least = 0.0;
  try {
    optimiser.optimize(at, least);
  } catch (const std::runtime_error&) {  // rounding, or its model broke down: what was found before counts
  }
}

}  // namespace

Fit search(const std::vector<FitParameter>& parameters, const Function& loss, const SearchOptions& options) {
  const std::size_t n = parameters.size(), samples = options.samples * n;
  return fit(parameters, loss, [&](const auto& function, const FitSearch& space) {
    std::vector<std::pair<double, Point>> asked;
    const Function remembered = [&](const Point& at) { return asked.emplace_back(function(at), at).first; };
    remembered(space.start);
    boost::random::sobol sequence(n);
    sequence.discard(options.seed * samples * n);
    for (std::size_t k = 0; k < samples; ++k) {
      Point at(n);
      for (std::size_t i = 0; i < n; ++i)
        at[i] = space.lower[i] + (space.upper[i] - space.lower[i]) * (static_cast<double>(sequence()) * 0x1p-64);
      remembered(at);
    }
    const auto best_first = [&] { std::ranges::stable_sort(asked, {}, [](const auto& one) { return one.first; }); };
    best_first();
    auto starts = asked;
    starts.resize(std::min(options.starts, asked.size()));
    for (const auto& start : starts) descend(remembered, space, start.second, options.local * (n + 1));
    best_first();
    for (std::size_t round = 0; round < options.rounds; ++round) {  // from there with new models of it
      const auto [before, start] = asked.front();
      descend(remembered, space, start, options.local * (n + 1));
      best_first();
      if (!(before - asked.front().first > 1e-4)) break;
    }
  });
}

}  // namespace sigmax
