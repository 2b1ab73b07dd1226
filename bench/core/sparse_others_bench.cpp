#include <benchmark/benchmark.h>

extern "C" {
#include <GraphBLAS.h>
}

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/numbers.hpp"

/// SuiteSparse:GraphBLAS on one thread, whose products over a semiring are the compositions of sparse relations.
namespace sigmax {
namespace {

GrB_Matrix matrix_of(const Relation<Random, Random>& relation) {
  std::vector<GrB_Index> rows, columns;
  std::vector<double> values;
  for (std::size_t row = 0; row < relation.from().size(); ++row)
    relation.for_each(row, [&](std::size_t column, double value) {
      rows.push_back(row);
      columns.push_back(column);
      values.push_back(value);
    });
  GrB_Matrix matrix;
  GrB_Matrix_new(&matrix, GrB_FP64, relation.from().size(), relation.to().size());
  GrB_Matrix_build_FP64(matrix, rows.data(), columns.data(), values.data(), values.size(), GrB_PLUS_FP64);
  GrB_Matrix_wait(matrix, GrB_MATERIALIZE);
  return matrix;
}

/// `sorted` waits for rows in the order of their columns, which GraphBLAS leaves undone until somebody needs it.
void graphblas(benchmark::State& state, GrB_Semiring semiring, bool sorted) {
  const auto n = static_cast<std::size_t>(state.range(0));
  GrB_Matrix left = matrix_of(bench::sparse_transition<Random>(n, 1));
  GrB_Matrix right = matrix_of(bench::sparse_transition<Random>(n, 2));
  for (auto _ : state) {
    GrB_Matrix result;
    GrB_Matrix_new(&result, GrB_FP64, n, n);
    GrB_mxm(result, nullptr, nullptr, semiring, right, left, nullptr);
    if (sorted) GrB_Matrix_wait(result, GrB_MATERIALIZE);
    benchmark::DoNotOptimize(result);
    GrB_Matrix_free(&result);
  }
  GrB_Matrix_free(&left);
  GrB_Matrix_free(&right);
  constexpr std::size_t terms = bench::entries_of_a_row * bench::entries_of_a_row;
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(n * terms));
}

const bool registered = [] {
  GrB_init(GrB_NONBLOCKING);
  GxB_Global_Option_set(GxB_GLOBAL_NTHREADS, 1);
  const auto add = [](const char* name, GrB_Semiring semiring, bool sorted) {
    benchmark::RegisterBenchmark(name, graphblas, semiring, sorted)
        ->RangeMultiplier(10)
        ->Range(1000, 100000)
        ->Unit(benchmark::kMillisecond);
  };
  add("graphblas/max_times/sorted", GrB_MAX_TIMES_SEMIRING_FP64, true);
  add("graphblas/max_times/unsorted", GrB_MAX_TIMES_SEMIRING_FP64, false);
  add("graphblas/plus_times/sorted", GrB_PLUS_TIMES_SEMIRING_FP64, true);
  add("graphblas/plus_times/unsorted", GrB_PLUS_TIMES_SEMIRING_FP64, false);
  return true;
}();

}  // namespace
}  // namespace sigmax
