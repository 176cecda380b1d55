#include "core/base/error.h"
#include "operators/render/from_paths/corrected_sampler.h"
#include "operators/render/methods/method.h"
#include "operators/render/methods/prepared.h"

#include <fmt/format.h>

#include <bit>

namespace neumann::method {

std::optional<FieldNeeds> Corrected::needs() const {
    const ApproximationSettings defaults;
    return FieldNeeds{patches.value_or(defaults.patches),
                      2.0 * directions.value_or(defaults.rays) + CellDistribution::cells + FieldRaster::rays_of_facet};
}

std::vector<Corrected> Corrected::coarser() const {
    constexpr std::size_t fewest_patches = 250;
    std::vector<Corrected> all;
    if (patches) return all;
    for (std::size_t n = ApproximationSettings().patches / 2; n >= fewest_patches; n /= 2) {
        all.push_back(*this);
        all.back().patches = n;
    }
    return all;
}

// If the pilot takes at most a twelfth of the rays.
void Corrected::expect_samples(double samples, const Film& film) {
    constexpr double part_of_rays = 1.0 / 12.0, walks_of_sample = 2.0;
    const double pixels = static_cast<double>(film.crop_width) * film.crop_height,
                 rays = samples / walks_of_sample * pixels * CorrectedPaths::rays_of_sample;
    if (!adaptive && CorrectedPaths::rays_of_allocation(pixels) <= part_of_rays * rays) adaptive = LeastError::of_all;
}

std::shared_ptr<const PathMethod> Corrected::prepare(const Preparing& in) const {
    ApproximationSettings wanted{
        .bounces = in.prepared.bounces(in.settings.walk.bounces), .seed = in.prepared.seed(), .memory = in.memory};
    if (patches) wanted.patches = *patches;
    if (directions) {
        wanted.rays = *directions;
        if (!std::has_single_bit(wanted.rays))
            throw OptionError("directions", fmt::format("{}: corrected expects a power of two", wanted.rays));
    }
    if (const auto made = in.prepared.of(name); made && serves(as<CorrectedPaths>(made)->approximation().settings(), wanted))
        return made;
    const auto approximation = std::make_shared<const Approximation>(in.scene, wanted, in.watch);
    return in.prepared.keep(name, std::make_shared<const CorrectedPaths>(
                                      approximation, std::make_shared<const CausticAim>(in.scene, wanted.bounces, wanted.seed,
                                                                                        approximation->tables(), in.watch)));
}

void Corrected::complete(const SamplingSettings& settings, const Film&) {
    const ApproximationSettings& taken = as<CorrectedPaths>(settings.method)->approximation().settings();
    patches = taken.patches;
    directions = taken.rays;
}

}  // namespace neumann::method
