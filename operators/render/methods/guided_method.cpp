#include "core/base/error.h"
#include "operators/render/from_paths/guided_paths.h"
#include "operators/render/from_paths/sampling_settings.h"
#include "operators/render/methods/method.h"
#include "operators/render/methods/prepared.h"

#include <fmt/format.h>

#include <bit>

namespace neumann::method {

std::shared_ptr<const PathMethod> Guided::prepare(const Preparing& in) const {
    GuideSettings wanted{.bounces = in.prepared.bounces(in.settings.walk.bounces), .seed = in.prepared.seed(), .memory = in.memory};
    if (patches) wanted.patches = *patches;
    if (directions) {
        wanted.rays = *directions;
        if (!std::has_single_bit(wanted.rays) || wanted.rays < CellDistribution::cells)
            throw InputError(fmt::format("--directions {}: --method guided expects a power of two, at least {}", wanted.rays,
                                         CellDistribution::cells));
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
