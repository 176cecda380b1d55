#include "operators/render/from_paths/photon_sampler.h"
#include "operators/render/methods/method.h"

namespace neumann::method {

std::shared_ptr<const PathMethod> Photon::prepare(const Preparing& in) const {
    return std::make_shared<const PhotonPaths>(std::make_shared<const PhotonPilot>(
        in.scene, PhotonChoice{photons, radius, gather}, in.settings.sampler, in.settings.seed, in.memory, in.watch));
}

void Photon::complete(const SamplingSettings& settings, const Film&) {
    photons = as<PhotonPaths>(settings.method)->pilot().settings.paths;
}

}  // namespace neumann::method
