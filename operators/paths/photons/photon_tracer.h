// Traces photons: paths from the lights that leave their power at every vertex that reflects light in more than single directions.
#pragma once

#include "core/emitter/emission_sampler.h"
#include "core/sampling/sampler.h"
#include "core/scene/scene.h"
#include "operators/paths/photons/photon_map.h"
#include "operators/paths/photons/photon_settings.h"
#include "operators/paths/walk/walk_settings.h"
#include "operators/watch.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace neumann {

// The power of the photons on their way, in W, as the mean of the channels. The power that goes on from vertex j
// (vertex 0 emits it) arrives at vertex j + 1 or leaves the scene, and the power that arrives goes on or is absorbed.
struct PhotonPower {
    std::vector<double> went_on, arrived;  // by vertex; arrived[0] is 0
    double escaped(std::size_t j) const { return went_on[j] - (j + 1 < arrived.size() ? arrived[j + 1] : 0.0); }
    double absorbed(std::size_t j) const { return arrived[j] - (j < went_on.size() ? went_on[j] : 0.0); }
};

class PhotonTracer {
public:
    // Keeps a reference to the scene. Photons of bounce 1 are kept only if settings.gather is set, because otherwise
    // the walks from the camera take light samples for direct light.
    PhotonTracer(const Scene& scene, const WalkSettings& walk, const PhotonSettings& settings, SamplerKind sampler,
                 std::uint64_t seed);

    struct Photons {
        std::vector<Photon> caustic, others;  // if settings.gather, `others` has all photons
        std::vector<std::uint64_t> rays;      // for each bounce and the rest
        std::uint64_t given_up = 0;
        PhotonPower power;
        bool reach_something = false;  // some path met a surface
    };
    // Traces the photons of a pass; returns nothing if `stop` returned true. The same on any number of threads.
    std::optional<Photons> trace(
        std::uint64_t pass, const std::function<bool()>& stop = [] { return false; }) const;

    // Traces at_once paths of a pass from number `first` on, a multiple of at_once. Calls visit(j, path, walker,
    // is_caustic) for each path at its j-th vertex, and rays(j, n) to count the n rays that lead there. Returns the
    // number of paths given up. Defined in photon_paths.h.
    static constexpr std::uint32_t at_once = 64;
    struct Workspace;
    template <class Visit, class CountRays, class Observer>
    std::uint64_t trace_group(std::uint64_t pass, std::uint32_t first, Workspace& work, const Visit& visit, const CountRays& rays,
                              const Observer& observer) const;

private:
    // The number of paths that are stratified together, and the pixel number for their random numbers.
    static constexpr std::uint32_t net = 4096, pixel = 0xfffffffeu;

    const Scene* scene_;
    WalkSettings walk_;
    PhotonSettings settings_;
    SamplerKind sampler_;
    std::uint64_t seed_;
    EmissionSampler emission_;
    SobolPoints points_;
};

}  // namespace neumann
