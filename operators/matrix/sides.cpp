#include "operators/matrix/sides.h"

#include "core/base/error.h"

#include <algorithm>

namespace neumann {

std::vector<SideDirections> side_directions(const Scene& scene) {
    for (const Bsdf& bsdf : scene.materials.bsdfs())
        if (lobe(bsdf).kind != Lobe::Kind::diffuse)
            throw InputError("a surface reflects otherwise than diffusely; only diffuse scenes become matrices");
    std::vector<SideDirections> sides;
    for (std::uint32_t shape = 0; shape < scene.geometry.shapes().size(); ++shape) {
        const SurfacePoint somewhere{{}, {}, 0.0, shape, 0};
        const bool emits = scene.emitters.is_emitter(somewhere);
        sides.push_back(
            {emits || scene.materials.at(somewhere, true) ? 1u : 0u, scene.materials.at(somewhere, false) ? 1u : 0u, emits});
    }
    return sides;
}

bool is_grey(const Scene& scene) {
    const auto& bsdfs = scene.materials.bsdfs();
    return scene.emitters.is_grey() && std::all_of(bsdfs.begin(), bsdfs.end(), [](const Bsdf& b) { return is_grey(b); });
}

}  // namespace neumann
