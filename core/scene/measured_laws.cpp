#include "core/scene/measured_laws.h"

#include "core/sampling/sampler.h"

#include <oneapi/tbb/parallel_for.h>

#include <set>

namespace neumann {

namespace {

constexpr std::uint32_t points_on_shape = 16, pairs_at_point = 64;

double mean_defect(const Geometry& geometry, std::uint32_t shape, bool front, const Bsdf& bsdf) {
    const SobolPoints sobol(points_on_shape);
    Sampler sampler(sobol, 0, shape);
    double sum = 0.0;
    for (std::uint32_t i = 0; i < points_on_shape; ++i) {
        sampler.start(i);
        const auto primitive = static_cast<std::uint32_t>(sampler.next() * geometry.primitive_count(shape));
        ShadingPoint p = shading_point(geometry.shapes()[shape], geometry.point(shape, primitive, sampler.next2()));
        if (!front) p.frame = p.frame.other_side();
        sum += reciprocity_defect(bsdf, p, pairs_at_point);
    }
    return sum / points_on_shape;
}

}  // namespace

// One direction is uniform in projected solid angle, the other one is sampled from the BSDF, and either may be ωi. A pair therefore
// has the density ½ (cosθo/π pdf(ωo → ωi) + cosθi/π pdf(ωi → ωo)), which is large wherever fs or its reverse is large.
double reciprocity_defect(const Bsdf& bsdf, const ShadingPoint& p, std::uint32_t count) {
    const SobolPoints sobol(count);
    Sampler sampler(sobol, 1, 0);
    double difference = 0.0, reflected = 0.0;
    for (std::uint32_t i = 0; i < count; ++i) {
        sampler.start(i);
        const Vec3 a = cosine_hemisphere(sampler.next2());
        const BsdfSample s = sample(bsdf, p, a, sampler.next2());
        const Vec3& b = s.wi;
        if (s.pdf == 0.0 || s.pdf == delta_pdf || b.z <= 0.0 || a.z <= 0.0) continue;
        const double cosines = a.z * b.z, density = 0.5 * (a.z * pdf(bsdf, p, a, b) + b.z * pdf(bsdf, p, b, a)) / pi;
        const double there = mean_component(eval(bsdf, p, a, b)), back = mean_component(eval(bsdf, p, b, a));
        difference += std::abs(there - back) * cosines / density;
        reflected += 0.5 * (there + back) * cosines / density;
    }
    return reflected > 0.0 ? difference / reflected : 0.0;
}

MeasuredLaws measure_laws(const Geometry& geometry, const Materials& materials) {
    struct MeasuredSide {
        std::uint32_t shape;
        bool front;
        double defect;
    };
    std::set<const Bsdf*> known;
    std::vector<MeasuredSide> sides;
    std::vector<const Bsdf*> bsdfs;
    for (std::uint32_t shape = 0; shape < geometry.shapes().size(); ++shape)
        for (const bool front : {true, false}) {
            const Bsdf* bsdf = materials.at(shape, front);
            if (!bsdf || is_lawful(*bsdf) || !has_extent(geometry.shapes()[shape]) || !known.insert(bsdf).second) continue;
            sides.push_back({shape, front, 0.0});
            bsdfs.push_back(bsdf);
        }
    oneapi::tbb::parallel_for(std::size_t{0}, sides.size(), [&](std::size_t i) {
        sides[i].defect = mean_defect(geometry, sides[i].shape, sides[i].front, *bsdfs[i]);
    });
    MeasuredLaws laws{sides.size()};
    if (!sides.empty()) laws.brightest = laws.least_reciprocal = sides.front().shape;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        if (const double albedo = max_component(largest_albedo(*bsdfs[i])); albedo > laws.largest_albedo) {
            laws.largest_albedo = albedo;
            laws.brightest = sides[i].shape;
        }
        if (sides[i].defect > laws.reciprocity_defect) {
            laws.reciprocity_defect = sides[i].defect;
            laws.least_reciprocal = sides[i].shape;
        }
    }
    return laws;
}

}  // namespace neumann
