// T through sides without unknowns. A ray that meets a mirror, glass or another side that is not diffuse is reflected
// there and goes on (links.h): a chain of m links, a sample of T_m = T (R' T)^m, where R' is the reflection on such
// sides. Each link is a bounce, so the terms on the sides that have unknowns are
//
//     f_{k+1} = R Σ_m T_m f_{k−m},   T_0 = T
//
// and K^i keeps its meaning. The directions at the links are sampled from the materials, without cells of directions.
#pragma once

#include "operators/fields/matrix/links.h"
#include "operators/fields/matrix/patch_field.h"
#include "operators/fields/matrix/row_tracing.h"

#include <array>
#include <span>
#include <vector>

namespace neumann {

// `from` is the unknown at which the chain's light arrives, and `to` the unknown that the ray sees after its last link,
// or PatchSpace::nothing() if it leaves the scene or is absorbed.
struct Chain {
    std::uint32_t from, to;
    float share;  // part that the ray has in the mean over the cell of `from`
    std::uint32_t links;
    std::size_t first;  // number of the first link
};

class Chains {
public:
    // `rays` is the number of rays of each facet, a power of two. Keeps references to the scene and the space.
    Chains(const Scene& scene, const PatchSpace& space, std::uint32_t rays, std::uint64_t seed, int bounces);

    // Follows a ray of the space's RayTable that sees no unknown. May be called for rays of different facets at the
    // same time. finish() must follow the last call.
    void follow(const BlindRay& ray);
    void finish();

    bool empty() const { return chains_.empty(); }
    int longest() const { return longest_; }
    std::uint64_t rays() const { return links_.size(); }  // number of rays cast, one at each link

    std::span<const Chain> all() const { return chains_; }
    // The weight of a chain after each of its links.
    std::span<const std::array<float, 3>> weights(const Chain& chain) const { return {&links_[chain.first], chain.links}; }

    // Adds Σ_{m>0} T_m f, where field(m) points to the f that chains of m links see, or is null for 0.
    template <int C, class Field>
    void add(const Field& field, IncidentVector<C>& means) const {
        for (const Chain& chain : chains_) {
            const ExitantVector<C>* const f = field(static_cast<int>(chain.links));
            if (!f) continue;
            const std::array<float, 3>& weight = weights(chain).back();
            means.col(chain.from) += double{chain.share} * to_channels<C>(Rgb(weight[0], weight[1], weight[2])) * f->col(chain.to);
        }
    }

private:
    struct OfFacet {
        std::vector<Chain> chains;
        std::vector<std::array<float, 3>> links;
    };

    const PatchSpace* space_;
    Links follow_;
    SobolPoints points_;
    std::uint64_t seed_;
    int longest_ = 0;
    std::vector<OfFacet> of_facet_;  // until finish()
    std::vector<Chain> chains_;
    std::vector<std::array<float, 3>> links_;
};

}  // namespace neumann
