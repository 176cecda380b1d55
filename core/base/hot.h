// For the few functions in which the time is spent: compiled with all they call, for plain x86-64 and for processors with AVX2, and
// chosen between at run time. The bits are the same, because no multiplication is fused with an addition (-ffp-contract=off).
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define NEUMANN_HOT [[gnu::flatten, gnu::target_clones("default", "arch=x86-64-v3")]]
#else
#define NEUMANN_HOT
#endif
