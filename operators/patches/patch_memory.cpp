#include "operators/patches/patch_memory.h"

#include "core/base/error.h"
#include "core/base/memory.h"

#include <fmt/format.h>

namespace neumann {

namespace {
constexpr double part_of_memory = 0.5;
}

void check_patch_memory(std::size_t patches, std::uint64_t rays, double bytes_of_patch) {
    const double fitting = part_of_memory * physical_memory() / bytes_of_patch, all = static_cast<double>(patches);
    if (all > fitting)
        throw InputError(fmt::format(
            "{} patches of {} rays need about {:.1f} GiB, the machine has {:.1f}; at most {:.0f} patches of as many rays fit",
            patches, rays, all * bytes_of_patch / 0x1p30, physical_memory() / 0x1p30, fitting));
}

}  // namespace neumann
