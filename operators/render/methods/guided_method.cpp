#include "core/base/error.h"
#include "operators/render/from_paths/guided_paths.h"
#include "operators/render/from_paths/sampling_settings.h"
#include "operators/render/methods/method.h"
#include "operators/render/methods/prepared.h"

#include <fmt/format.h>

#include <bit>

namespace neumann::method {

std::optional<Decisions> Guided::leaves_out() const {
    return Decisions{&LeftOut::rays_from_surfaces, &LeftOut::rays_for_light, &LeftOut::shadow_rays_in_room,
                     &LeftOut::light_samples};
}

std::optional<FieldNeeds> Guided::needs() const {
    const GuideSettings defaults;
    return FieldNeeds{
        patches.value_or(defaults.patches),
        static_cast<double>(defaults.field_rays) + TracedSeriesSettings{}.light_samples + directions.value_or(defaults.rays)};
}

// Guided methods with ever fewer rays of the tables, down to one in a cell.
std::vector<Guided> Guided::coarser() const {
    std::vector<Guided> all;
    if (directions) return all;
    for (std::uint32_t rays = GuideSettings().rays / 2; rays >= CellDistribution::cells; rays /= 2) {
        all.push_back(*this);
        all.back().directions = rays;
    }
    return all;
}

std::shared_ptr<const PathMethod> Guided::prepare(const Preparing& in) const {
    GuideSettings wanted{.bounces = in.prepared.bounces(in.settings.walk.bounces), .seed = in.prepared.seed(), .memory = in.memory};
    if (patches) wanted.patches = *patches;
    if (directions) {
        wanted.rays = *directions;
        if (!std::has_single_bit(wanted.rays) || wanted.rays < CellDistribution::cells)
            throw OptionError("directions",
                              fmt::format("{}: guided expects a power of two, at least {}", wanted.rays, CellDistribution::cells));
    }
    if (const auto made = in.prepared.of(name); made && serves(as<GuidedPaths>(made)->guide().settings(), wanted)) return made;
    return in.prepared.keep(name, std::make_shared<const GuidedPaths>(std::make_shared<const Guide>(in.scene, wanted, in.watch)));
}

void Guided::complete(const SamplingSettings& settings, const Film&) {
    const GuideSettings& taken = as<GuidedPaths>(settings.method)->guide().settings();
    patches = taken.patches;
    directions = taken.rays;
}

}  // namespace neumann::method
