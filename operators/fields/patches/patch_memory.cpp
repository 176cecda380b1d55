#include "operators/fields/patches/patch_memory.h"

#include "core/base/error.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace neumann {

void check_patch_memory(std::size_t patches, std::uint64_t rays, double bytes_of_patch, double memory) {
    const double fitting = std::max(memory, 0.0) / bytes_of_patch, all = static_cast<double>(patches);
    if (all > fitting)
        throw InputError(
            fmt::format("{} patches of {} rays need about {:.1f} GiB, and {:.1f} may be taken; at most {:.0f} patches of "
                        "as many rays fit",
                        patches, rays, all * bytes_of_patch / 0x1p30, memory / 0x1p30, std::floor(fitting)));
}

}  // namespace neumann
