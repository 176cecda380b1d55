// How much memory there is, in bytes, so that what cannot fit is refused before the machine starts to swap.
#pragma once

#include <unistd.h>

namespace neumann {

inline double physical_memory() {
    return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

// What the process may use of the memory: less if its control group, such as a container's, is limited.
double usable_memory();

// The memory that work which grows by itself takes at most by default: half of that.
inline double default_memory() { return 0.5 * usable_memory(); }

}  // namespace neumann
