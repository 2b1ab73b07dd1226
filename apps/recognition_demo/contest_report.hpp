#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "recognition_demo/contest.hpp"
#include "result/result.hpp"
#include "result/table.hpp"
#include "support/json.hpp"
#include "support/parallel.hpp"
#include "support/progress.hpp"
#include "support/random.hpp"

namespace sigmax::apps {

/// The options that subcommands with random draws share.
struct DrawOptions {
  std::size_t runs = 1000;
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: as many as the machine has
  OutputOptions output;
};
void add_draws(CLI::App& app, DrawOptions& options);

/// Calls add(run, draw(random, run)) for every run in order, by all threads and with a progress bar. Each run has its
/// own random numbers: those of stream `run · streams + stream`.
template <class Draw, class Add>
void for_each_draw(const DrawOptions& options, Progress& progress, const Draw& draw, const Add& add,
                   std::size_t streams = 1, std::size_t stream = 0) {
  for_each_run(
      options.runs, threads_or_all(options.threads),
      [&](std::size_t run) {
        RandomStream random(options.seed, run * streams + stream);
        return draw(random);
      },
      [&](std::size_t run, auto result) {
        progress.advance();
        add(run, result);
      });
}

/// Shares of right decisions after some numbers of reports, the belief in the truth, and each difference from the
/// first.
ResultTable scores_table(const std::vector<Score>& scores, const std::string& what_is_counted = "reports");

/// A result begun: the page has its title, and the contestants are what it switches on and off.
Result result_of_contest(std::string title, const OutputOptions& output,
                         const std::vector<Contestant>& contestants = {});

/// The table in all its places, with what it cannot say, and curves.csv: report,classifier,accuracy.
void add_scores(Result& result, const std::vector<Score>& scores, const std::string& what_is_counted = "reports");

}  // namespace sigmax::apps
