#pragma once

#include "support/test.hpp"

/// Replaces the allocation functions of a test program by ones that count. Include it in one file of the program only.
namespace sigmax::support {

inline std::size_t allocations = 0;

/// How many allocations the action makes.
template <class Action>
std::size_t allocations_of(const Action& action) {
  const std::size_t before = allocations;
  action();
  return allocations - before;
}

}  // namespace sigmax::support

[[gnu::noinline]] void* operator new(std::size_t size) {
  ++sigmax::support::allocations;
  if (void* const memory = std::malloc(size)) return memory;
  throw std::bad_alloc{};
}
/// std::stable_sort asks this one, and gives its memory back to the delete below.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++sigmax::support::allocations;
  return std::malloc(size);
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  ++sigmax::support::allocations;
  const auto step = static_cast<std::size_t>(alignment);
  if (void* const memory = std::aligned_alloc(step, (size + step - 1) / step * step)) return memory;
  throw std::bad_alloc{};
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
