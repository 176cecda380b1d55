#include "operators/render/from_fields/field_memory.h"

#include "core/base/error.h"
#include "operators/fields/patches/patch_memory.h"

#include <fmt/format.h>

namespace neumann {

double bytes_of_fields(const FieldSettings& settings, const FieldSizes& sizes) {
    // Importance also needs T* and R* of four channels. A ray that goes on by links (operators/fields/matrix/chains.h)
    // takes 60 bytes with its links; in a room of mirrors about half of the rays do.
    const double bytes_of_ray = settings.reading == FieldReading::importance ? 48.0 : sizes.has_links ? 34.0 : 4.0;
    // A series needs about ten vectors of four channels while it is computed; then three floats per quantity, a quarter
    // of that for the coarser patches, and three times as much in all with light that comes by links.
    const double stacks = sizes.has_links ? 45.0 : 15.0;
    const double bytes_of_unknown = 320.0 + stacks * settings.replicates * (settings.bounces + 2.0);
    return 300.0 * sizes.patches + bytes_of_ray * sizes.rays + bytes_of_unknown * sizes.unknowns;
}

double bytes_of_pictures(const FieldSettings& settings, const Film& film) {
    const double quantities = settings.bounces + 2.0, pixels = static_cast<double>(film.crop_width) * film.crop_height;
    // Floats for all replicates, the difference to coarser patches and the mean, and doubles for one Estimate.
    return pixels * (3.0 * sizeof(float) * quantities * (settings.replicates + 2.0) + 9.0 * sizeof(double));
}

void check_field_memory(const FieldSettings& settings, const Film& film, const FieldSizes& sizes) {
    const double pictures = bytes_of_pictures(settings, film);
    if (pictures > settings.memory)
        throw InputError(
            fmt::format("{} bounces of {}×{} pixels need about {:.1f} GiB, and {:.1f} may be taken; take fewer bounces or a "
                        "smaller film",
                        settings.bounces, film.crop_width, film.crop_height, pictures / 0x1p30, settings.memory / 0x1p30));
    check_patch_memory(settings.patching.patches, settings.rays, bytes_of_fields(settings, sizes) / sizes.patches,
                       settings.memory - pictures);
}

}  // namespace neumann
