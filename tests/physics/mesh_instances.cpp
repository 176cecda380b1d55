// Instances of meshes, against meshes that stand where the instances are.
#include "core/base/error.h"
#include "core/base/peak_memory.h"
#include "core/geometry/area_sampler.h"
#include "core/geometry/geometry.h"
#include "core/geometry/shading_point.h"
#include "core/geometry/transformed.h"
#include "core/sampling/sampler.h"
#include "core/sampling/warp.h"
#include "operators/experiments/known/scene_maker.h"
#include "operators/fields/patches/patches.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

namespace neumann::mesh_instances_test {

using namespace physics;

TriangleMesh smooth_ball(int level) {
    TriangleMesh mesh = icosphere(level);
    mesh.normals = mesh.vertices;
    for (const Vec3& v : mesh.vertices) mesh.uv.emplace_back(v.x + 0.5 * v.y, v.z);
    return mesh;
}

Mat4 turned(const Vec3& to, double angle, const Vec3& scale) {
    return glm::scale(glm::rotate(glm::translate(Mat4(1.0), to), angle, glm::normalize(Vec3(1, 2, 3))), scale);
}

const std::vector<Mat4> maps = {turned({0, 0, 0}, 0.3, Vec3(1.0)), turned({3, 1, 0}, 1.0, {1.0, -0.5, 0.7}),
                                turned({0, -3, 1}, 2.0, {0.1, 1.0, 1.2}), turned({-3, 0, -1}, 0.0, Vec3(1e-2)),
                                turned({0.5, 3.5, 0}, 0.5, {-1, -0.8, -1.5})};

struct Both {
    Geometry instances, copies;
};
Both make(const TriangleMesh& mesh) {
    const auto shared = std::make_shared<const SharedMesh>(mesh);
    std::vector<Shape> instances, copies;
    for (const Mat4& m : maps) {
        instances.emplace_back(MeshInstance(shared, m));
        copies.emplace_back(transformed(mesh, m));
    }
    instances.emplace_back(Sphere{{4, 4, 0}, 1.0});
    copies.emplace_back(Sphere{{4, 4, 0}, 1.0});
    return {Geometry(std::move(instances)), Geometry(std::move(copies))};
}

// Rays that pass the edge between two triangles, or a silhouette, within rounding may meet either: they are counted.
TEST(MeshInstances, RaysMeetWhatTheyMeetOnCopies) {
    const auto [instances, copies] = make(smooth_ball(3));
    Sampler random(1, 0);
    random.start(0);
    int met = 0, unlike = 0;
    constexpr int rays = 200'000;
    for (int i = 0; i < rays; ++i) {
        const Vec3 from = 6.0 * uniform_sphere(random.next2()),
                   w = glm::normalize(4.0 * (random.next2().x - 0.5) * uniform_sphere(random.next2()) - from);
        SurfacePoint a, b;
        const bool hit = instances.first_hit(from, w, 20.0, a), other = copies.first_hit(from, w, 20.0, b);
        if (hit != other || (hit && (a.shape != b.shape || a.primitive != b.primitive))) {
            ++unlike;
            continue;
        }
        if (!hit) continue;
        ++met;
        ASSERT_LT(glm::distance(a.position, b.position), 1e-9 / std::abs(glm::dot(w, b.normal)));
        ASSERT_LT(glm::distance(a.normal, b.normal), 1e-12);
        const ShadingPoint at = shading_point(instances.shapes()[a.shape], a), there = shading_point(copies.shapes()[b.shape], b);
        ASSERT_LT(glm::distance(at.frame.n, there.frame.n), 1e-6);
        ASSERT_LT(glm::distance(at.frame.s, there.frame.s), 1e-6);
        ASSERT_LT(glm::distance(texture_coordinates(at), texture_coordinates(there)), 1e-6);
        ASSERT_LT(glm::distance(tangents(at).dp_dv, tangents(there).dp_dv), 1e-6);
    }
    EXPECT_GT(met, rays / 20);
    EXPECT_LT(unlike, rays / 10'000);
}

// From a convex body's outside no ray meets it again, and from its inside every ray does.
TEST(MeshInstances, RaysLeaveTheirSurface) {
    const Geometry geometry = make(smooth_ball(4)).instances;
    Sampler random(2, 0);
    random.start(0);
    for (std::uint32_t shape = 0; shape < maps.size(); ++shape)
        for (int i = 0; i < 20'000; ++i) {
            const auto primitive = static_cast<std::uint32_t>(random.next() * geometry.primitive_count(shape));
            const SurfacePoint p = geometry.point(shape, primitive, random.next2());
            const Vec3 w = uniform_sphere(random.next2());
            SurfacePoint hit;
            const bool met = geometry.first_hit(p, w, hit);
            if (glm::dot(w, p.normal) > 0.0) {
                ASSERT_FALSE(met && hit.shape == shape) << "shape " << shape << ", cosine " << glm::dot(w, p.normal);
            } else {
                ASSERT_TRUE(met && hit.shape == shape) << "shape " << shape << ", cosine " << glm::dot(w, p.normal);
            }
        }
}

TEST(MeshInstances, AreasAndBounds) {
    const auto [instances, copies] = make(smooth_ball(2));
    for (std::uint32_t shape = 0; shape < maps.size(); ++shape) {
        EXPECT_EQ(instances.primitive_count(shape), copies.primitive_count(shape));
        EXPECT_NEAR(instances.area(shape) / copies.area(shape), 1.0, 1e-12);
        const Bounds loose = bounds_of(instances.shapes()[shape]), tight = bounds_of(copies.shapes()[shape]);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_LE(loose.low[axis], tight.low[axis] + 1e-12);
            EXPECT_GE(loose.high[axis], tight.high[axis] - 1e-12);
        }
    }
    // A map that stretches by 2 and 8 at right angles: the bound is at least 4.
    const auto& shared = std::get<MeshInstance>(instances.shapes()[0]).shared();
    EXPECT_DOUBLE_EQ(MeshInstance(shared, glm::scale(Mat4(1.0), Vec3(8, 2, 4))).distortion(), 4.0);
    EXPECT_GE(MeshInstance(shared, turned({0, 0, 0}, 0.7, {8, 2, 4})).distortion(), 4.0);
}

// 20 triangles without area of 21; the last one is seen.
TEST(MeshInstances, DegenerateTrianglesAreLeftOutAndCounted) {
    TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}};
    for (int i = 0; i < 20; ++i) mesh.triangles.push_back({0, 1, 1});
    mesh.triangles.push_back({0, 1, 2});
    const auto shared = std::make_shared<const SharedMesh>(mesh);
    const Geometry geometry({MeshInstance(shared, Mat4(1.0)), MeshInstance(shared, glm::translate(Mat4(1.0), Vec3(0, 0, 1)))});
    EXPECT_EQ(geometry.degenerate_count(), 40u);
    EXPECT_EQ(geometry.primitive_count(1), 1u);
    mesh.triangles.push_back({0, 1, 3});
    try {
        const SharedMesh wrong(mesh);
        FAIL();
    } catch (const InputError& e) {
        EXPECT_STREQ(e.what(), "mesh vertex index 3 is out of range, the mesh has 3 vertices");
    }
}

TEST(MeshInstances, UniformPointsRefuseTooMany) {
    const auto shared = std::make_shared<const SharedMesh>(icosphere(6));
    std::vector<Shape> shapes;
    for (int i = 0; i < 1300; ++i)
        shapes.emplace_back(MeshInstance(shared, glm::translate(Mat4(1.0), Vec3(3 * (i % 36), 3 * (i / 36), 0))));
    const Geometry geometry(std::move(shapes));
    try {
        const AreaSampler sampler(geometry);
        FAIL();
    } catch (const InputError& e) {
        EXPECT_STREQ(e.what(), "points on all surfaces need a list of the scene's 106496000 triangles; expected at most 100000000");
    }
}

// Patches are shared out by instance, and their clusters of faces are in memory once.
TEST(MeshInstances, HavePatchesOfTheirOwn) {
    const auto shared = std::make_shared<const SharedMesh>(icosphere(6));
    std::vector<Shape> shapes;
    for (int i = 0; i < 1300; ++i)
        shapes.emplace_back(MeshInstance(shared, glm::rotate(glm::translate(Mat4(1.0), Vec3(3 * (i % 36), 3 * (i / 36), 0)),
                                                             0.01 * i, glm::normalize(Vec3(1, 2, 3)))));
    const Geometry geometry(std::move(shapes));
    restart_peak_memory();
    const double before = peak_memory();
    const Patches patches(geometry, {.patches = 6000});
    EXPECT_LE(peak_memory() - before, 20e6);
    EXPECT_GE(patches.size(), 4 * 1300u);
    EXPECT_LE(patches.size(), 6000u);
    double area = 0.0;
    for (std::uint32_t i = 0; i < patches.size(); ++i) area += patches.area(i);
    EXPECT_NEAR(area, 1300 * geometry.area(0), 1e-9 * area);
    for (std::uint32_t i = 0; i < patches.size(); i += 7) EXPECT_EQ(patches.locate(patches.point(i, Vec2(0.5))), i);
}

// A thousand instances of 1.3 million triangles take a few hundredths of the memory of the first.
TEST(MeshInstancesSlow, TakeTheMemoryOfOne) {
    const auto shared = std::make_shared<const SharedMesh>(icosphere(8));
    const auto peak = [&](int count) {
        restart_peak_memory();
        std::vector<Shape> shapes;
        for (int i = 0; i < count; ++i)
            shapes.emplace_back(MeshInstance(shared, glm::translate(Mat4(1.0), Vec3(3 * (i % 32), 3 * (i / 32), 0))));
        shapes.emplace_back(parallelogram({-100, -100, -0.5}, {300, 0, 0}, {0, 300, 0}));
        const Geometry geometry(std::move(shapes));
        // On a ground, to which each of them is near, and on them.
        Sampler random(3, 0);
        random.start(0);
        for (int i = 0; i < 1000; ++i) {
            SurfacePoint p;
            EXPECT_TRUE(geometry.first_hit({100.0 * random.next(), 100.0 * random.next(), 3.0}, {0, 0, -1}, 10.0, p));
        }
        return peak_memory();
    };
    const double one = peak(1), thousand = peak(1000);
    ASSERT_GT(one, 0.0);
    EXPECT_LT(thousand, 1.1 * one);
}

}  // namespace neumann::mesh_instances_test
