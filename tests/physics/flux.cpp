// Laws that need no reference solution. T keeps the flux and R takes its share 1 − ρ: with the same ρ everywhere in a closed scene
// ∫ K^i Le dA = ρ^i ∫ Le dA. And K is linear: emitters add up. More such laws are in operators/experiments/known/furnace.cpp.
#include "operators/experiments/known/enclosures.h"
#include "tests/physics/probe.h"

#include <gtest/gtest.h>

namespace neumann::physics::flux_test {

// The mean of z over all surfaces, exactly: a triangle's is that of its centroid, that of round shapes is that of their centres.
double mean_height(const Scene& scene) {
    double sum = 0.0, area = 0.0;
    for (std::uint32_t shape = 0; shape < scene.geometry.shapes().size(); ++shape) {
        const Shape& s = scene.geometry.shapes()[shape];
        for (std::uint32_t i = 0; i < scene.geometry.primitive_count(shape); ++i) {
            const double a = scene.geometry.area(shape, i);
            area += a;
            if (const auto* mesh = std::get_if<TriangleMesh>(&s))
                for (const std::uint32_t vertex : mesh->triangles[i]) sum += a / 3.0 * mesh->vertices[vertex].z;
            else if (const auto* sphere = std::get_if<Sphere>(&s))
                sum += a * sphere->center.z;
            else if (const auto* cylinder = std::get_if<Cylinder>(&s))
                sum += a * cylinder->center().z;
            else
                sum += a * std::get<Disk>(s).center.z;
        }
    }
    return sum / area;
}

// Le = 2 + z. 8 enclosures × 2 ways × 7 bounces: 112 comparisons.
TEST(FluxSlow, WithOneAlbedoEveryBounceKeepsItsPowerOnAverage) {
    const double rho = 0.8;
    const AreaLight more_above([](const SurfacePoint& p, const Vec3&) { return grey(2.0 + p.position.z); }, grey(4.0));
    for (const ClosedScene& enclosure : enclosures({grey(rho), more_above})) {
        const Scene scene = enclosure.maker.make();
        std::vector<double> exact;
        for (int i = 0; i <= 6; ++i) exact.push_back(std::pow(rho, i) * (2.0 + mean_height(scene)));
        for (const Technique way : {Technique::mis, Technique::bsdf}) {
            SCOPED_TRACE(enclosure.name + ", " + name(way));
            expect_matches(probe(scene, anywhere(scene), way, {.samples = 2048, .bounces = 6}), exact);
        }
    }
}

// BSDF sampling does not know of lights, so the same numbers make the same walks whatever emits, and light adds up within each
// walk.
TEST(Superposition, TwoLightsAddUpWalkByWalk) {
    const auto lit_by = [](double from_ceiling, double from_disk) {
        SceneMaker maker;
        const auto faces = room({0, 0, 0}, {1, 1, 1});
        for (std::size_t i = 0; i < 6; ++i) maker.add(faces[i], i == ceiling ? glowing(0.7, from_ceiling) : matte(0.7));
        maker.add(Disk{{0.5, 0.6, 0.4}, {0.2, 0, 0}, {0, 0.2, 0}, {0, 0, 1}}, glowing(0.4, from_disk));
        const Scene scene = maker.make();
        return probe(scene, at(scene, {0.3, 0.3, 0.0}, {0, 0, 1}), Technique::bsdf, {.samples = 64});
    };
    const Estimates both = lit_by(1.7, 0.3), one = lit_by(1.7, 0.0), other = lit_by(0.0, 0.3);
    for (std::size_t i = 0; i < both.terms.size(); ++i) {
        const double sum = one.terms[i].mean.r + other.terms[i].mean.r;
        EXPECT_NEAR(both.terms[i].mean.r, sum, 2e-15 * sum) << "K^" << i << " Le";
    }
}

}  // namespace neumann::physics::flux_test
