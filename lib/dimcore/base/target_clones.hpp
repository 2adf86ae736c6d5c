#pragma once

/// For the few functions where the time goes: compiled for several instruction sets, the widest one that the
/// machine has is picked when the program starts. Sanitizers cannot run before that choice is made, so their
/// builds have the plain one only. What such a function calls is inlined, to be compiled with it.
#if defined(__x86_64__) && !defined(DIM_NO_TARGET_CLONES)
#define DIM_TARGET_CLONES __attribute__((target_clones("default", "avx2", "avx512f")))
#else
#define DIM_TARGET_CLONES
#endif
#define DIM_INLINE inline __attribute__((always_inline))
