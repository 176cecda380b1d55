#include "operators/fields/matrix/chains.h"

#include "operators/pointwise/basic_reflection.h"

#include <algorithm>

namespace neumann {

namespace {

constexpr std::uint64_t chain_stream = 0x636861696e73ull;

}  // namespace

Chains::Chains(const Scene& scene, const PatchSpace& space, std::uint32_t rays, std::uint64_t seed, int bounces)
    : space_(&space), follow_(scene, space, bounces), points_(rays), seed_(seed ^ chain_stream), of_facet_(space.facets().size()) {}

void Chains::follow(const BlindRay& ray) {
    OfFacet& facet = of_facet_[ray.facet];
    Sampler sampler(points_, seed_, ray.facet);
    sampler.start(ray.number);
    Chain chain{ray.from, space_->nothing(), static_cast<float>(ray.share), 0, facet.links.size()};
    follow_.follow<BasicReflection>(
        *ray.sight.hit, ray.sight.w, sampler,
        [&](const Rgb& weight) {
            facet.links.push_back({static_cast<float>(weight.r), static_cast<float>(weight.g), static_cast<float>(weight.b)});
            ++chain.links;
        },
        [&](const SurfacePoint&, const Vec3&, std::uint32_t unknown, double) { chain.to = unknown; });
    if (chain.links > 0) facet.chains.push_back(chain);
}

void Chains::finish() {
    std::size_t chains = 0, links = 0;
    for (const OfFacet& facet : of_facet_) {
        chains += facet.chains.size();
        links += facet.links.size();
    }
    chains_.reserve(chains);
    links_.reserve(links);
    for (OfFacet& facet : of_facet_) {
        for (Chain& chain : facet.chains) {
            longest_ = std::max(longest_, static_cast<int>(chain.links));
            chain.first += links_.size();
            chains_.push_back(chain);
        }
        links_.insert(links_.end(), facet.links.begin(), facet.links.end());
        facet = {};
    }
    of_facet_.clear();
}

}  // namespace neumann
