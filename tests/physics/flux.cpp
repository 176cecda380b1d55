// Laws that need no reference solution. T keeps the flux and R takes its share 1 − ρ, so all that is emitted in a closed scene is
// absorbed:
//
//     Σ_{i≥1} ∫ (1 − ρ)/ρ K^i Le dA = ∫ Le dA,   and with the same ρ everywhere   ∫ K^i Le dA = ρ^i ∫ Le dA.
//
// And K is linear: emitters add up, and emitters that together cover an enclosure evenly add up to the furnace.
#include "core/geometry/area_sampler.h"
#include "operators/known/enclosures.h"
#include "tests/physics/probe.h"

#include <gtest/gtest.h>

namespace neumann::physics {
namespace {

// (1 − ρ)/ρ, by shape.
StartPicker absorbed(const Scene& scene, std::vector<double> rho) {
    return [pick = anywhere(scene), rho = std::move(rho)](Random& random) {
        Start start = pick(random);
        const double r = rho[start.point.shape];
        start.weight = grey((1.0 - r) / r);
        return start;
    };
}

// 2 scenes × 2 ways: 4 comparisons.
TEST(Flux, WhatIsEmittedIsAbsorbed) {
    const double rho[6] = {0.2, 0.5, 0.8, 0.9, 0.95, 0.7};
    for (const bool furnished : {false, true}) {
        SceneMaker maker;
        std::vector<double> rho_of_shape;
        const auto add = [&](Shape shape, double r, double emitted) {
            maker.add(std::move(shape), emitted > 0.0 ? glowing(r, emitted) : matte(r));
            rho_of_shape.push_back(r);
        };
        const auto faces = room({0, 0, 0}, {1, 1, 1});
        for (std::size_t i = 0; i < 6; ++i) add(faces[i], rho[i], i == ceiling ? 1.0 : i == left ? 0.3 : 0.0);
        if (furnished) {
            add(box({0.2, 0.3, 0.1}, {0.4, 0.7, 0.5}), 0.6, 0.0);
            add(Sphere{{0.7, 0.6, 0.4}, 0.2, false}, 0.85, 0.0);
            add(Sphere{{0.6, 0.3, 0.8}, 0.05, false}, 0.3, 2.0);
        }
        const Scene scene = maker.make();
        const AreaSampler surfaces(scene.geometry);
        const double emitted = 1.0 + 0.3 + (furnished ? 2.0 * 4.0 * pi * 0.05 * 0.05 : 0.0);
        for (const Technique way : {Technique::mis, Technique::bsdf}) {
            SCOPED_TRACE(name(way) + (furnished ? ", furnished" : ""));
            const Estimates found =
                probe(scene, absorbed(scene, rho_of_shape), way, {.samples = 4096, .bounces = 4, .rest_probability = 1.0});
            expect_matches(found.reflected, emitted / surfaces.area(), "absorbed flux per area");
        }
    }
}

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
TEST(Flux, WithOneAlbedoEveryBounceKeepsItsPowerOnAverage) {
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

// The facets of a 20° cap emit: the area's mean is ρ^i times the emitting fraction, 0.018868107508640625 of 320 facets (0.030 for
// the true cap). 2 ways × 6 bounces, BSDF sampling to 0.8%: 12 comparisons.
TEST(FluxSlow, AMeshedSphereIsExactOnAverage) {
    const double rho = 0.7, fraction = 0.018868107508640625;
    const TriangleMesh sphere = flipped(icosphere(2));
    const auto in_cap = [](const Vec3& p) { return glm::normalize(p).z > std::cos(pi / 9.0); };
    SceneMaker maker;
    maker.add(part(sphere, in_cap), glowing(rho, 1.0));
    maker.add(part(sphere, [&](const Vec3& p) { return !in_cap(p); }), matte(rho));
    const Scene scene = maker.make();
    EXPECT_EQ(scene.geometry.primitive_count(0) + scene.geometry.primitive_count(1), 320u);
    EXPECT_NEAR(scene.geometry.area(0) / (scene.geometry.area(0) + scene.geometry.area(1)), fraction, 1e-12);
    std::vector<double> exact;
    for (int i = 1; i <= 6; ++i) exact.push_back(fraction * std::pow(rho, i));
    for (const Technique way : {Technique::mis, Technique::bsdf}) {
        SCOPED_TRACE(name(way));
        expect_matches(probe(scene, anywhere(scene), way, {.samples = way == Technique::mis ? 4096u : 32768u, .bounces = 6}), exact,
                       1, looks_for_lights(way) ? power : 0.008);
    }
}

// Each face of a room lights it in turn. 8 comparisons.
TEST(SuperpositionSlow, SixGlowingFacesAddUpToTheFurnace) {
    const double rho = 0.6;
    const auto faces = room({0, 0, 0}, {1.2, 0.9, 0.7});
    std::vector<Statistic> sums(9);
    for (std::size_t glowing_face = 0; glowing_face < 6; ++glowing_face) {
        SceneMaker maker;
        for (std::size_t i = 0; i < 6; ++i) maker.add(faces[i], i == glowing_face ? glowing(rho, 1.0) : matte(rho));
        const Scene scene = maker.make();
        // Seeds of their own, so that the six errors are independent.
        const Estimates found = probe(scene, at(scene, {0.4, 0.2, 0.0}, {0, 0, 1}), Technique::mis,
                                      {.samples = 4096, .seed = fixed_seed + glowing_face});
        for (std::size_t i = 0; i < sums.size(); ++i) {
            sums[i].mean += found.terms[i].mean;
            sums[i].standard_error = glm::sqrt(sums[i].standard_error * sums[i].standard_error +
                                               found.terms[i].standard_error * found.terms[i].standard_error);
        }
    }
    for (int i = 1; i <= 8; ++i)
        expect_matches(sums[static_cast<std::size_t>(i)], std::pow(rho, i), "sum of K^" + std::to_string(i) + " Le");
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

}  // namespace
}  // namespace neumann::physics
