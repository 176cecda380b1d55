// How much memory there is, so that what cannot fit is refused before the machine starts to swap. In bytes.
#pragma once

#include <unistd.h>

namespace neumann {

inline double physical_memory() {
    return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

// What the process may use of it: less where its control group, such as a container's, is allowed less.
double usable_memory();

// What work that grows by itself takes at most, unless it is told otherwise: half of that.
inline double default_memory() { return 0.5 * usable_memory(); }

}  // namespace neumann
