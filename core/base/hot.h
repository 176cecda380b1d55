// For the few functions in which the time is spent: compiled with all they call, for plain x86-64 and for processors with AVX2, and
// chosen between at run time: walks take 10% less time. The bits are the same, because no multiplication is fused with an addition
// (-ffp-contract=off). NEUMANN_FLAT: compiled with all they call, once, where AVX2 was measured to gain 2% or less.
//
// A file that needs such a function and not its speed defines NEUMANN_SMALL, and is compiled in a fraction of the time.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(NEUMANN_SMALL)
#define NEUMANN_HOT [[gnu::flatten, gnu::target_clones("default", "arch=x86-64-v3")]]
#define NEUMANN_FLAT [[gnu::flatten]]
#else
#define NEUMANN_HOT
#define NEUMANN_FLAT
#endif
