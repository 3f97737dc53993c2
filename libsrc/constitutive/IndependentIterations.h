#pragma once

/// Before a loop over points whose arrays do not overlap: the compiler may vectorise it without checking.
/// (Local __restrict pointers are not enough for g++ where a loop has ten arrays.)
#if defined(__clang__)
#define CAISSON_INDEPENDENT_ITERATIONS _Pragma("clang loop vectorize(assume_safety)")
#else
#define CAISSON_INDEPENDENT_ITERATIONS _Pragma("GCC ivdep")
#endif
