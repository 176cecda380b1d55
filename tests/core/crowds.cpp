// Scenes of many triangles that are long, or share a corner, or lie in one place, or on a ground: all load in the time of a smooth
// mesh of as many, and so do their lamps.
#include "core/emitter/emission_sampler.h"
#include "core/emitter/light_sampler.h"
#include "core/scene/coincident_surfaces.h"
#include "operators/experiments/known/scene_maker.h"

#include <gtest/gtest.h>
#include <cmath>
#include <ctime>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace neumann::crowds_test {

constexpr std::uint32_t many = 1u << 16;

// A square of n² little ones, in waves.
TriangleMesh waves(std::uint32_t n) {
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j <= n; ++j) {
            const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
            mesh.vertices.emplace_back(x, y, 0.05 * std::sin(9.0 * x) * std::cos(7.0 * y));
        }
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
            const std::uint32_t k = i * (n + 1) + j;
            mesh.triangles.push_back({k, k + n + 1, k + n + 2});
            mesh.triangles.push_back({k, k + n + 2, k + 1});
        }
    return mesh;
}
TriangleMesh smooth() { return waves(static_cast<std::uint32_t>(std::lround(std::sqrt(many / 2)))); }
// Needles around an axis that leans.
TriangleMesh tube() {
    TriangleMesh mesh;
    const std::uint32_t n = many / 2;
    for (std::uint32_t i = 0; i < n; ++i) {
        const double angle = 2.0 * pi * i / n;
        const Vec3 foot(0.1 * std::cos(angle), 0.5, 0.1 * std::sin(angle));
        mesh.vertices.push_back(foot);
        mesh.vertices.push_back(foot + Vec3(1, 2, 1.5));
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % n);
        mesh.triangles.push_back({a, b, a + 1});
        mesh.triangles.push_back({b, b + 1, a + 1});
    }
    return mesh;
}
// A cone, whose triangles share its apex.
TriangleMesh fan() {
    TriangleMesh mesh;
    mesh.vertices.emplace_back(0, 2, 0);
    for (std::uint32_t i = 0; i < many; ++i) {
        const double angle = 2.0 * pi * i / many;
        mesh.vertices.emplace_back(std::cos(angle), 1.0, std::sin(angle));
    }
    for (std::uint32_t i = 0; i < many; ++i) mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % many});
    return mesh;
}
TriangleMesh in_one_place() {
    TriangleMesh mesh = known::triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    mesh.triangles.resize(many, mesh.triangles.front());
    return mesh;
}
TriangleMesh ground(double half) { return known::parallelogram({-half, -half, -0.5}, {2.0 * half, 0, 0}, {0, 2.0 * half, 0}); }

// Of all threads: the least of three times.
double processor_seconds(const std::function<void()>& work) {
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
        const std::clock_t begin = std::clock();
        work();
        least = std::min(least, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    }
    return least;
}

double seconds_to_load(const std::vector<TriangleMesh>& meshes) {
    known::SceneMaker maker;
    for (const TriangleMesh& mesh : meshes) maker.add(mesh, known::matte(0.5));
    return processor_seconds([&] { EXPECT_GT(maker.make().geometry.radius(), 0.0); });
}

// Where each triangle looks at each other one, these take 200 to 2000 times as long as the smooth mesh.
TEST(Crowds, LoadAsASmoothMesh) {
    constexpr double at_most = 6.0;
    const double usual = seconds_to_load({smooth()});
    const std::pair<const char*, std::vector<TriangleMesh>> all[] = {
        {"a tube", {tube()}},
        {"a fan", {fan()}},
        {"in one place", {in_one_place()}},
        {"two heaps in one place", {in_one_place(), in_one_place()}},
        {"on a ground", {smooth(), ground(0.5)}},
        {"on a giant", {smooth(), ground(50.0)}},
        {"a tube on a giant", {tube(), ground(100.0)}},
    };
    for (const auto& [name, meshes] : all) EXPECT_LT(seconds_to_load(meshes), at_most * usual) << name << ", in place of " << usual;
}

// A lamp is as its triangles: their areas are added up once, and not for each.
TEST(Crowds, LampsStartAsFastAsTheyLoad) {
    known::SceneMaker maker;
    maker.add(smooth(), known::lamp(1.0));
    const Scene scene = maker.make();
    const double loading = processor_seconds([&] { EXPECT_FALSE(maker.make().emitters.empty()); });
    const Receiver x(Vec3(0.5, 0.5, 3.0));
    for (const LightChoice choice :
         {LightChoice::mixed, LightChoice::power, LightChoice::all, LightChoice::contribution, LightChoice::tree})
        EXPECT_LT(processor_seconds([&] {
                      const LightSampler lights(scene.geometry, scene.emitters, choice);
                      EXPECT_GT(lights.sample(x, Vec2(0.3, 0.7)).pdf, 0.0);
                  }),
                  loading);
    EXPECT_LT(processor_seconds([&] {
                  const EmissionSampler emission(scene.geometry, scene.emitters);
                  EXPECT_GT(emission.sample(Vec2(0.3, 0.7), Vec2(0.5)).density, 0.0);
              }),
              loading);
}

// A lamp that lies in the ground is found whether the ground is a giant or not; which one is seen in front is that of the first
// shape, or that which lies higher.
TEST(Crowds, WhatLiesInOnePlaceIsFound) {
    const TriangleMesh tile = known::parallelogram({-0.2, -0.3, -0.5}, {0.4, 0, 0}, {0, 0.6, 0});
    const auto found = [&](double half, double up, bool ground_first) {
        known::SceneMaker maker;
        TriangleMesh lamp = tile;
        for (Vec3& v : lamp.vertices) v.z += up;
        if (ground_first) maker.add(ground(half), known::matte(0.5));
        maker.add(lamp, known::lamp(1.0));
        if (!ground_first) maker.add(ground(half), known::matte(0.5));
        const Geometry geometry(maker.parts.shapes);
        const Materials materials(maker.parts.bsdfs, maker.parts.sides_of_shape, geometry.shared_shapes());
        return coincident_surfaces(geometry, materials, maker.parts.lights.of_shape).lights;
    };
    for (const double half : {0.5, 4.0, 50.0, 500.0})
        for (const bool ground_first : {true, false}) {
            SCOPED_TRACE(half);
            EXPECT_EQ(found(half, 0.0, ground_first), ground_first ? 2u : 0u);
            EXPECT_EQ(found(half, 1e-10, ground_first), 0u);
            EXPECT_EQ(found(half, -1e-10, ground_first), 2u);
            EXPECT_EQ(found(half, -1e-3, ground_first), 0u);
        }
}

}  // namespace neumann::crowds_test
