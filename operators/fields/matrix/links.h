// Rays that go on from sides without unknowns, which are mirrors, glass and whatever else is not diffuse, until they
// meet a side that has unknowns. Each such reflection is a link.
#pragma once

#include "core/sampling/sampler.h"
#include "core/scene/scene.h"
#include "operators/fields/matrix/sides.h"
#include "operators/fields/patches/patch_space.h"

#include <algorithm>

namespace neumann {

class Links {
public:
    // A ray with more than `bounces` links is ended by Russian roulette. Keeps references to the scene and the space.
    Links(const Scene& scene, const PatchSpace& space, int bounces)
        : scene_(&scene), space_(&space), bounces_(static_cast<std::uint32_t>(std::max(bounces, 0))) {}

    // Follows a ray that has met x along w. `Reflection::sample(materials, side, back, u)` samples how it goes on,
    // where `back` is the direction to where it came from, and returns wi, weight and index as in BasicReflection.
    // Calls each(weight) at every link with the product of the weights so far, and end(hit, w, unknown, index) if the
    // ray meets an unknown along w, with the product of the indices.
    template <class Reflection, class Each, class End>
    void follow(SurfacePoint x, Vec3 w, Sampler& sampler, const Each& each, const End& end) const {
        Rgb weight(1.0);
        double index = 1.0;
        for (std::uint32_t links = 1; links <= most_links; ++links) {
            const Vec3 back = -w;
            const SurfaceSide side = scene_->materials.side(x, back);
            if (!is_glossy(side.bsdf)) return;
            const auto next = Reflection::sample(scene_->materials, side, back, sampler.next2());
            weight *= next.weight;
            index *= next.index;
            if (links > bounces_) {
                const double going_on = std::min(max_component(next.weight), 1.0);
                weight = sampler.next() < going_on ? weight / going_on : Rgb(0.0);
            }
            each(weight);
            if (is_black(weight)) return;
            w = next.wi;
            SurfacePoint hit;
            if (!scene_->geometry.first_hit(x, w, hit)) return;
            if (const std::uint32_t unknown = space_->unknown(hit, -w); unknown != space_->nothing()) {
                end(hit, w, unknown, index);
                return;
            }
            x = hit;
        }
    }

private:
    // This limit is needed because Russian roulette never ends a ray between mirrors that absorb nothing.
    static constexpr std::uint32_t most_links = 1000;

    const Scene* scene_;
    const PatchSpace* space_;
    std::uint32_t bounces_;
};

}  // namespace neumann
