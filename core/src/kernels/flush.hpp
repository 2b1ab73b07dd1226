#pragma once

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace sigmax::kernels {

/// While it lives, results of this thread's arithmetic that are smaller than the least normal number become zero; then
/// everything is as it was. On some processors arithmetic is a hundred times as slow on such numbers. Where the
/// machine offers no such mode nothing changes but the time.
class FlushedSubnormals {
 public:
#if defined(__SSE2__)
  FlushedSubnormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | _MM_FLUSH_ZERO_ON); }
  ~FlushedSubnormals() { _mm_setcsr(before_); }
#else
  FlushedSubnormals() = default;
#endif
  FlushedSubnormals(const FlushedSubnormals&) = delete;
  FlushedSubnormals& operator=(const FlushedSubnormals&) = delete;

 private:
  unsigned before_ = 0;
};

}  // namespace sigmax::kernels
