// The division of the unknowns among processes: connected parts of space, with about as many rays each.
#pragma once

#include "operators/fields/patches/patch_space.h"

#include <cstdint>
#include <vector>

namespace neumann {

struct Ownership {
    std::vector<std::uint32_t> facets;  // numbers of this process's facets
    // The unknowns are numbered anew, those of process 0 first. `first` has the first number of each process, and at
    // the end how many there are.
    std::vector<std::uint32_t> first;
    std::vector<std::uint32_t> number;  // the new number of each unknown
};

// Cuts the patches, in Morton's order of their centres, into parts of equal numbers of rays. Both sides of a patch stay
// together. The result is the same on every process. G. M. Morton, A computer oriented geodetic data base, 1966.
Ownership share_out(const PatchSpace& space, std::uint32_t rays, int processes, int rank);

}  // namespace neumann
