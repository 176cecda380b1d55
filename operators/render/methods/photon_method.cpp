#include "operators/render/from_paths/photon_sampler.h"
#include "operators/render/methods/method.h"
#include "operators/render/methods/option_makers.h"

namespace neumann::method {

std::vector<MethodOption> Photon::own_options() {
    return {
        whole<std::uint32_t>(
            "photons", "N", "For photon: the number of paths from the lights in a pass (a replicate)", 1, 1u << 28,
            [](const Photon& m) { return m.photons; }, [](Photon& m, std::uint32_t n) { m.photons = n; }),
        option(
            "radius", "R",
            "For photon: the radius within which photons are read in the first pass, in the scene's units; smaller in later ones; "
            "default by "
            "a pilot",
            [](const Photon& m) { return m.radius; }, [](Photon& m, double r) { m.radius = r; }, above_zero("a length above 0")),
        flag(
            "gather", "For photon: sample one more reflection before the map is read (final gathering)",
            [](const Photon& m) { return m.gather; }, [](Photon& m, bool on) { m.gather = on; })};
}

std::shared_ptr<const PathMethod> Photon::prepare(const Preparing& in) const {
    return std::make_shared<const PhotonPaths>(std::make_shared<const PhotonPilot>(
        in.scene, PhotonChoice{photons, radius, gather}, in.settings.sampler, in.settings.seed, in.memory, in.watch));
}

void Photon::complete(const SamplingSettings& settings, const Film&) {
    photons = as<PhotonPaths>(settings.method)->pilot().settings.paths;
}

}  // namespace neumann::method
