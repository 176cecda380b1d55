#include "operators/fields/matrix/link_light.h"

#include <bit>
#include <cmath>

namespace neumann {

// The results of the paths of a part.
struct LinkShares {
    struct Contribution {
        std::uint32_t unknown;
        std::size_t bounce;
        Rgb radiance;
    };
    std::vector<Contribution> shares;
    std::vector<PowerOfTerm> power;
    std::uint64_t rays = 0;

    void pack(PackedNumbers& to) const {
        to.numbers(shares);
        to.numbers(power);
        to.number(rays);
    }
    static LinkShares unpacked(UnpackedNumbers& from) {
        return {from.numbers<Contribution>(), from.numbers<PowerOfTerm>(), from.number<std::uint64_t>()};
    }
};

namespace {

// Each use of the seed has independent random numbers.
constexpr std::uint64_t pilot_stream = 0x6c696e6b70696cull, light_stream = 0x6c696e6b6c69ull;
constexpr std::uint32_t least_net = 8, largest_net = 4096;
constexpr double pilot_share = 1.0 / 16.0;
// The part of the samples that is spread evenly over the area of all reflectors. The pilot can miss a spot of sun on a
// reflector, whose light would then come as a few samples of any weight; with this part no sample weighs more than
// 1 / even_share times what an even one would.
constexpr double even_share = 0.25;
// The approximate number of rays of a sample: the shadow ray, and those of the links.
constexpr double rays_of_sample = 4.0;

LinkShares trace(const LinkLight& light, std::size_t part, const PatchSpace& space, int bounces) {
    LinkShares found;
    found.power.resize(static_cast<std::size_t>(bounces) + 1);
    found.rays = light.trace(part, found.power, [&](const LinkArrival& a) {
        const Facet& facet = space.facets()[space.facet_of(a.unknown)];
        const double etendue = space.patches().area(facet.patch) * pi / facet.cells.size() * a.index * a.index;
        // Reflection weights the power that falls on a surface by the cosine with the shading normal.
        const double cosine = glm::dot(space.frame(facet, a.x).n, a.wi), of_surface = std::abs(glm::dot(a.x.normal, a.wi));
        if (!(cosine > 0.0)) return;
        found.shares.push_back(
            {a.unknown, std::min(a.bounce, static_cast<std::size_t>(bounces) + 1), a.power * (cosine / of_surface) / etendue});
    });
    return found;
}

}  // namespace

LinkLight::LinkLight(const Scene& scene, const PatchSpace& space, double rays, std::uint64_t seed, int bounces)
    : space_(&space),
      geometry_(&scene.geometry),
      lights_(scene.geometry, scene.emitters, LightChoice::mixed, LightPlace::near_projected),
      links_(scene, space, bounces),
      seed_(seed ^ light_stream) {
    if (lights_.empty()) return;
    find_reflectors(scene);
    divide(rays / rays_of_sample, seed);
}

void LinkLight::find_reflectors(const Scene& scene) {
    for (std::uint32_t patch = 0; patch < space_->patches().size(); ++patch)
        for (const bool front : {true, false})
            if (space_->facet(patch, front) == space_->facets().size() &&
                is_glossy(scene.materials.at(space_->patches().chart(patch).shape(), front)))
                reflectors_.push_back({patch, front});
}

// Distributes the samples in proportion to the power that a few of them find, and partly by area.
void LinkLight::divide(double samples, std::uint64_t seed) {
    const auto net_of = [](double wanted) {
        return std::bit_ceil(static_cast<std::uint32_t>(std::clamp(wanted, double{least_net}, double{largest_net})));
    };
    const std::uint32_t pilot = net_of(pilot_share * samples / static_cast<double>(std::max<std::size_t>(reflectors_.size(), 1)));
    const SobolPoints points(pilot);
    std::vector<double> power(reflectors_.size());
    oneapi::tbb::parallel_for(std::size_t{0}, reflectors_.size(), [&](std::size_t i) {
        Sampler sampler(points, seed ^ pilot_stream, static_cast<std::uint32_t>(i));
        light(reflectors_[i], sampler, 0, pilot, pilot,
              [&](const SurfacePoint&, const Vec3&, const Rgb& begun) { power[i] += mean_component(begun); });
    });
    double all_power = 0.0, all_area = 0.0;
    for (std::size_t i = 0; i < reflectors_.size(); ++i) {
        all_power += power[i];
        all_area += space_->patches().area(reflectors_[i].patch);
    }
    for (std::uint32_t i = 0; i < reflectors_.size(); ++i) {
        const double even = space_->patches().area(reflectors_[i].patch) / all_area,
                     share = all_power > 0.0 ? (1.0 - even_share) * power[i] / all_power + even_share * even : even,
                     wanted = std::max(samples * share, double{least_net});
        const std::uint32_t net = net_of(wanted), nets = static_cast<std::uint32_t>(std::ceil(wanted / net));
        points_.try_emplace(net, net);
        for (std::uint32_t n = 0; n < nets; ++n) parts_.push_back({i, n * net, net, nets * net});
    }
}

template <int C>
ArrivingByLinks<C> arriving_by_links(const Scene& scene, const RowShare& rows, double rays, std::uint64_t seed, int bounces,
                                     const Watch& watch) {
    const PatchSpace& space = rows.space();
    ArrivingByLinks<C> result;
    result.radiance.assign(static_cast<std::size_t>(bounces) + 2, IncidentVector<C>::zero(space.size()));
    result.power.resize(static_cast<std::size_t>(bounces) + 1);
    const LinkLight light(scene, space, rays, seed, bounces);
    light.for_parts([&](std::size_t part) { return trace(light, part, space, bounces); },
                    [&](const LinkShares& found) {
                        result.rays += found.rays;
                        for (const LinkShares::Contribution& s : found.shares)
                            result.radiance[s.bounce].col(s.unknown) += to_channels<C>(s.radiance);
                        for (std::size_t k = 0; k < result.power.size(); ++k) result.power[k] += found.power[k];
                    },
                    watch, &rows);
    return result;
}

template ArrivingByLinks<1> arriving_by_links<1>(const Scene&, const RowShare&, double, std::uint64_t, int, const Watch&);
template ArrivingByLinks<4> arriving_by_links<4>(const Scene&, const RowShare&, double, std::uint64_t, int, const Watch&);

}  // namespace neumann
