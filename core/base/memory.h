// How much memory the machine has, so that what cannot fit is refused before it starts to swap.
#pragma once

#include <unistd.h>

namespace neumann {

// In bytes.
inline double physical_memory() {
    return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

}  // namespace neumann
