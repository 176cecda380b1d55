#include "operators/fields/matrix/light_vector.h"

#include "core/base/hot.h"
#include "core/emitter/light_sampler.h"
#include "core/sampling/sampler.h"

#include <oneapi/tbb/parallel_for.h>
#include <array>

namespace neumann {

namespace {

// Each use of the seed has independent random numbers.
constexpr std::uint64_t direct_stream = 0x6469726563ull, emitted_stream = 0x656d697474ull;

template <class Each>
void for_facets(const PatchSpace& space, const SomeFacets& some, const Each& each) {
    const std::size_t all = some ? some->size() : space.facets().size();
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, all, 32), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) each(some ? (*some)[i] : static_cast<std::uint32_t>(i));
    });
}

struct Segment {
    SurfacePoint from, to;
};

// Adds the mean incident radiance from the lights to the cells of a facet.
template <int C>
NEUMANN_HOT void light_facet(const LightSampler& lights, const PatchSpace& space, const SobolPoints& points, std::uint64_t seed,
                             std::uint32_t number, IncidentVector<C>& means) {
    const Facet& facet = space.facets()[number];
    Sampler sampler(points, seed ^ direct_stream, number);
    constexpr std::uint32_t packet = RayCaster::packet_size;
    std::array<Segment, packet> segments;
    std::array<Rgb, packet> light;
    std::array<std::uint32_t, packet> arrives_in;
    std::uint32_t waiting = 0;
    const auto look = [&] {
        const std::uint32_t seen = space.geometry().visible(
            waiting,
            [&](std::size_t i) { return std::pair<const SurfacePoint&, const SurfacePoint&>(segments[i].from, segments[i].to); },
            RayCaster::Rays::alike);
        for (std::uint32_t i = 0; i < waiting; ++i)
            if (seen >> i & 1u) means.col(arrives_in[i]) += to_channels<C>(light[i]);
        waiting = 0;
    };
    const double of_sample = inv_pi * facet.cells.size() / points.size();
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        sampler.start(i);
        const Vec2 u = sampler.next2();
        const SurfacePoint x = space.patches().point(facet.patch, sampler.next2());
        const Frame frame = space.frame(facet, x);
        const LightSample y = lights.sample({x.position, frame.n}, u);
        const Vec3 wi = frame.to_local(y.w);
        if (!(y.pdf > 0.0) || !(wi.z > 0.0)) continue;
        segments[waiting] = {x, y.point};
        light[waiting] = y.weight * (of_sample * wi.z);
        arrives_in[waiting] = facet.first + facet.cells.cell(wi);
        if (++waiting == packet) look();
    }
    look();
}

}  // namespace

template <int C>
ExitantVector<C> emitted_light(const Scene& scene, const PatchSpace& space, const SomeFacets& facets) {
    ExitantVector<C> Le = ExitantVector<C>::zero(space.size());
    const SobolPoints points(16);
    for_facets(space, facets, [&](std::uint32_t f) {
        const Facet& facet = space.facets()[f];
        if (!facet.front) return;
        Sampler sampler(points, emitted_stream, f);
        for (std::uint32_t cell = 0; cell < facet.cells.size(); ++cell) {
            Rgb sum(0.0);
            for (std::uint32_t i = 0; i < points.size(); ++i) {
                sampler.start(i);
                const Vec2 u = sampler.next2();
                const SurfacePoint p = space.patches().bare_point(facet.patch, sampler.next2());
                if (!scene.emitters.is_emitter(p.shape)) return;
                sum += scene.emitters.emitted(p, space.frame(facet, p).to_world(facet.cells.direction(cell, u)));
            }
            Le.col(facet.first + cell) = to_channels<C>(sum / static_cast<double>(points.size()));
        }
    });
    return Le;
}

template <int C>
IncidentVector<C> arriving_light(const Scene& scene, const ReflectionMatrix<C>& R, std::uint32_t samples, std::uint64_t seed,
                                 const SomeFacets& facets) {
    const PatchSpace& space = R.space();
    IncidentVector<C> means = IncidentVector<C>::zero(space.size());
    if (scene.emitters.empty()) return means;
    const SobolPoints points(samples);
    const LightSampler lights(scene.geometry, scene.emitters, LightChoice::mixed, LightPlace::near_projected);
    for_facets(space, facets, [&](std::uint32_t f) {
        if (!(R.reflectance().col(f) == 0.0).all()) light_facet<C>(lights, space, points, seed, f, means);
    });
    return means;
}

double rays_that_meet_lights(const Scene& scene, std::uint32_t rays) {
    // The rays of patches cannot hit these lights.
    if (scene.emitters.has_environment() || scene.emitters.has_delta_lights()) return 0.0;
    double all = 0.0, lights = 0.0;
    for (std::uint32_t shape = 0; shape < scene.geometry.shapes().size(); ++shape) {
        const double area = scene.geometry.area(shape);
        all += area;
        if (scene.emitters.is_emitter(shape)) lights += area;
    }
    return all > 0.0 ? rays * lights / all : 0.0;
}

template ExitantVector<1> emitted_light<1>(const Scene&, const PatchSpace&, const SomeFacets&);
template ExitantVector<4> emitted_light<4>(const Scene&, const PatchSpace&, const SomeFacets&);
template IncidentVector<1> arriving_light<1>(const Scene&, const ReflectionMatrix<1>&, std::uint32_t, std::uint64_t,
                                             const SomeFacets&);
template IncidentVector<4> arriving_light<4>(const Scene&, const ReflectionMatrix<4>&, std::uint32_t, std::uint64_t,
                                             const SomeFacets&);

}  // namespace neumann
