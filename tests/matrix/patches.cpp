// Patches cover the surfaces, each point is on the patch that was cut around it, and interpolation is linear.
#include "operators/fields/patches/patch_space.h"

#include "core/base/error.h"
#include "core/sampling/sampler.h"
#include "operators/experiments/known/enclosures.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numeric>

namespace neumann::patches_test {

using namespace known;

// A body of fine faces on a floor of two large ones, in one mesh.
TriangleMesh with_large_faces(TriangleMesh mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3& corner : {Vec3(-2, -2, -1.1), Vec3(2, -2, -1.1), Vec3(2, 2, -1.1), Vec3(-2, 2, -1.1)})
        mesh.vertices.push_back(corner);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
    return mesh;
}

Mat4 turned(const Vec3& to, double scale) {
    return glm::scale(glm::rotate(glm::translate(Mat4(1.0), to), 1.1, glm::normalize(Vec3(1, 2, 3))),
                      Vec3(std::abs(scale), std::abs(scale), scale));
}

std::vector<ClosedScene> surfaces() {
    std::vector<ClosedScene> all = enclosures(matte(0.5));
    const auto add = [&](const std::string& name, Shape shape) {
        all.emplace_back(ClosedScene{name, {}}).maker.add(std::move(shape), matte(0.5));
    };
    add("skewed quadrilateral", TriangleMesh{{{0, 0, 0}, {2, 0.3, 0}, {1.4, 1.7, 0}, {0.2, 1.1, 0}}, {{0, 1, 2}, {0, 2, 3}}});
    add("long triangle", triangle({0, 0, 0}, {5, 0, 1}, {0, 0.4, 2}));
    add("kite that is no convex quadrilateral",
        TriangleMesh{{{0, 0, 0}, {2, 2, 0}, {0.5, 0.5, 1e-3}, {0, 2, 0}}, {{0, 1, 2}, {0, 2, 3}}});
    add("slanted cylinder", Cylinder{{1, 2, 3}, glm::normalize(Vec3(1, 2, -2)), 1.5, 0.4, true});
    add("slanted disc", make_disk(Mat4({2, 0, 0.5, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {1, 2, 3, 1})));
    add("fine mesh", flipped(icosphere(5)));
    add("fine mesh with large faces", with_large_faces(icosphere(5)));
    const auto shared = std::make_shared<const SharedMesh>(icosphere(5));
    SceneMaker& instances = all.emplace_back(ClosedScene{"instances, one mirrored and one stretched", {}}).maker;
    instances.add(MeshInstance(shared, turned({0, 0, 0}, 0.7)), matte(0.5));
    instances.add(MeshInstance(shared, turned({3, 0, 0}, -0.7)), matte(0.5));
    instances.add(MeshInstance(shared, glm::scale(turned({0, 3, 0}, 0.5), Vec3(1, 1, 3))), matte(0.5));
    return all;
}

double area(const Patches& patches) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < patches.size(); ++i) sum += patches.area(i);
    return sum;
}

double area(const Geometry& geometry) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < geometry.shapes().size(); ++i) sum += geometry.area(i);
    return sum;
}

// A box that stands on the floor, turned, and a lamp close below the ceiling: their outlines divide floor and ceiling.
Scene furnished_room() {
    SceneMaker maker;
    maker.add(room({0, 0, 0}, {1, 1, 1}), matte(0.5));
    const Mat4 turn({0.8, 0.6, 0, 0}, {-0.6, 0.8, 0, 0}, {0, 0, 1, 0}, {0.4, 0.2, 0, 1});
    maker.add(transformed(box({0, 0, 0}, {0.3, 0.3, 0.5}), turn), matte(0.5));
    maker.add(parallelogram({0.6, 0.6, 0.998}, {0, 0.2, 0}, {0.3, 0, 0}), glowing(0.5, 1.0));
    return maker.make();
}

TEST(Patches, EndAtTheOutlinesOfWhatStandsOnThem) {
    const Scene scene = furnished_room();
    const Patches patches(scene.geometry, {1500, 0.3});
    EXPECT_NEAR(area(patches) / area(scene.geometry), 1.0, 1e-13);
    const auto inside = [](const Vec3& p, bool& border) {
        const Vec2 d(p.x - 0.4, p.y - 0.2), q(0.8 * d.x + 0.6 * d.y, -0.6 * d.x + 0.8 * d.y);
        const double within = std::min({q.x, q.y, 0.3 - q.x, 0.3 - q.y});
        border = std::abs(within) < 0.005;  // a sixteenth of a patch's width
        return within > 0.0;
    };
    Sampler random(3, 0);
    random.start(0);
    std::uint64_t divided = 0;
    for (std::uint32_t i = 0; i < patches.size(); ++i) {
        if (patches.chart(i).normal().z < 0.5 || patches.chart(i).corners()[0].z > 0.1) continue;  // the floor
        bool border = false, found = false, outside = false;
        for (int k = 0; k < 64; ++k) {
            const SurfacePoint p = patches.point(i, random.next2());
            const bool in = inside(p.position, border);
            if (border) continue;
            (in ? found : outside) = true;
            // Nor does interpolation look across.
            const Patches::Reading r = patches.interpolate(p);
            for (int n = 0; n < 4; ++n) {
                if (r.weight[n] == 0.0) continue;
                const bool same = inside(patches.point(r.patch[n], Vec2(0.5)).position, border) == in;
                EXPECT_TRUE(same || border);
            }
        }
        EXPECT_FALSE(found && outside) << "patch " << i;
        divided += found;
    }
    EXPECT_GT(divided, 20u);
}

// The gap between lamp and ceiling is 0.002 wide. Down to 16 of its widths patches are a quarter as wide as they are away from its
// mouth.
TEST(Patches, NarrowTowardsTheMouthOfAGap) {
    const Scene scene = furnished_room();
    const Patches patches(scene.geometry, {1500, 0.3});
    constexpr double deepest = 0.0319;
    Sampler random(5, 0);
    random.start(0);
    int at_the_mouth = 0;
    for (std::uint32_t i = 0; i < patches.size(); ++i) {
        double nearest = 1.0, farthest = 0.0;
        for (int k = 0; k < 256; ++k) {
            const Vec3 p = patches.point(i, random.next2()).position;
            if (p.z < 0.997) break;
            // Distance from the outline of [0.6, 0.9] × [0.6, 0.8].
            const Vec2 from(std::abs(p.x - 0.75) - 0.15, std::abs(p.y - 0.7) - 0.1);
            const double d = std::max(from.x, from.y) > 0.0 ? glm::length(glm::max(from, Vec2(0.0))) : -std::max(from.x, from.y);
            nearest = std::min(nearest, d);
            farthest = std::max(farthest, d);
        }
        if (nearest > deepest) continue;
        EXPECT_LE(farthest - nearest, 0.25 * nearest + 0.001) << "patch " << i;
        at_the_mouth += farthest < 0.005;
    }
    EXPECT_GE(at_the_mouth, 40);  // 1 long, in cells 0.06 wide, on both surfaces and on both sides above
}

TEST(Patches, CoverTheSurfaces) {
    for (const ClosedScene& e : surfaces()) {
        const Scene scene = e.maker.make();
        for (const std::size_t n : {1u, 50u, 3000u})
            EXPECT_NEAR(area(Patches(scene.geometry, {n, 0.5})) / area(scene.geometry), 1.0, 1e-13) << e.name << ", " << n;
    }
}

TEST(Patches, AreAboutAsManyAsAskedFor) {
    for (const ClosedScene& e : surfaces()) {
        const Scene scene = e.maker.make();
        const std::size_t n = Patches(scene.geometry, {5000, 0.5}).size();
        EXPECT_LE(n, 5000u) << e.name;
        EXPECT_GE(n, e.name.starts_with("instances") ? 2500u : 3500u) << e.name;  // their numbers are powers of two
    }
}

TEST(Patches, DoNotFollowTheNumberOfFaces) {
    for (const int level : {3, 4, 5, 6, 7}) {
        SceneMaker maker;
        maker.add(room({-2, -2, -2}, {2, 2, 2}), matte(0.5));
        maker.add(icosphere(level), matte(0.5));
        const Scene scene = maker.make();
        const std::size_t n = Patches(scene.geometry, {1000, 0.5}).size();
        EXPECT_LE(n, 1000u) << level;
        EXPECT_GE(n, 800u) << level;
    }
}

// On a sphere of radius 1 in 500 patches, each of them is about 0.16 wide. A cap of this area has normals within 5.1° of its own.
TEST(Patches, JoinFacesThatAreNearAndLookAlike) {
    SceneMaker maker;
    maker.add(icosphere(6), matte(0.5));
    const Scene scene = maker.make();
    const Patches patches(scene.geometry, {500, 0.0});
    ASSERT_TRUE(patches.charts()[0].clusters());
    const double mean = area(patches) / static_cast<double>(patches.size());
    Sampler random(11, 0);
    random.start(0);
    double squares = 0.0;
    for (std::uint32_t i = 0; i < patches.size(); ++i) {
        const SurfacePoint first = patches.point(i, random.next2());
        for (int k = 0; k < 64; ++k) {
            const SurfacePoint p = patches.point(i, random.next2());
            EXPECT_LE(glm::distance(p.position, first.position), 4.0 * std::sqrt(mean)) << "patch " << i;
            EXPECT_GE(glm::dot(p.normal, first.normal), 0.8) << "patch " << i;
        }
        squares += (patches.area(i) / mean - 1.0) * (patches.area(i) / mean - 1.0);
    }
    EXPECT_LE(std::sqrt(squares / static_cast<double>(patches.size())), 0.4);
}

// The place of a point among the faces is found again from the point.
TEST(Patches, KnowPlacesOnSmallFaces) {
    SceneMaker maker;
    maker.add(with_large_faces(icosphere(4)), matte(0.5));
    const Scene scene = maker.make();
    const Patches patches(scene.geometry, {100, 0.0});
    const auto chart = std::find_if(patches.charts().begin(), patches.charts().end(), [](const Chart& c) { return c.clusters(); });
    ASSERT_NE(chart, patches.charts().end());
    Sampler random(12, 0);
    random.start(0);
    for (int k = 0; k < 1000; ++k) {
        const Vec2 st = random.next2();
        const SurfacePoint p = chart->point(scene.geometry, st);
        EXPECT_EQ(patches.chart_of(p), static_cast<std::uint32_t>(chart - patches.charts().begin()));
        const Vec2 found = chart->coordinates(scene.geometry, p);
        EXPECT_NEAR(found.x, st.x, 1e-7);  // points keep clear of edges by a rounding error of floats
        EXPECT_NEAR(found.y, st.y, 1e-3);
    }
}

// Faces without measurable area, many in one place, and one that is most of the area.
TEST(Patches, JoinFacesOfAllSizes) {
    TriangleMesh mesh;
    const auto add = [&](const Vec3& at, double size) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (const Vec3& corner : {at, at + Vec3(size, 0, 0), at + Vec3(0, size, 0)}) mesh.vertices.push_back(corner);
        mesh.triangles.push_back({first, first + 1, first + 2});
    };
    for (int i = 0; i < 100; ++i) add({0, 0, 1}, 1e-3);
    for (int i = 0; i < 100; ++i) add({0, 0.5, std::pow(2.0, -i)}, std::pow(0.7, i));
    SceneMaker maker;
    maker.add(mesh, matte(0.5));
    maker.add(parallelogram({0, 0, 0}, {100, 0, 0}, {0, 100, 0}), matte(0.5));
    const Scene scene = maker.make();
    for (const std::size_t n : {1u, 10u, 100u, 1000u}) {
        const Patches patches(scene.geometry, {n, 0.0});
        EXPECT_NEAR(area(patches) / area(scene.geometry), 1.0, 1e-13) << n;
        for (std::uint32_t i = 0; i < patches.size(); ++i) {
            EXPECT_GT(patches.area(i), 0.0) << n;
            EXPECT_EQ(patches.locate(patches.point(i, Vec2(0.5))), i) << n;
        }
    }
}

// A hit keeps clear of the triangle's edges by its rounding error, so next to the line between two patches it may be on either.
TEST(Patches, AreFoundFromTheirPoints) {
    std::uint64_t elsewhere = 0, all = 0;
    for (const ClosedScene& e : surfaces()) {
        const Scene scene = e.maker.make();
        const Patches patches(scene.geometry, {700, 0.6});
        Sampler random(1, 0);
        random.start(0);
        for (std::uint32_t i = 0; i < patches.size(); ++i)
            for (int k = 0; k < 8; ++k) {
                const SurfacePoint p = patches.point(i, random.next2());
                elsewhere += patches.locate(p) != i;
                ++all;
            }
    }
    EXPECT_LE(elsewhere, all / 5000) << "of " << all;
}

// Uniform points: the part that falls into one half of a patch's coordinates is that half's part of the area. 40 cells of each
// surface, |z| < 4.5: 3e-3 false alarms.
TEST(Patches, PointsAreUniformByArea) {
    for (const ClosedScene& e : surfaces()) {
        const Scene scene = e.maker.make();
        const Patches coarse(scene.geometry, {40, 0.3}), fine(scene.geometry, {2000, 0.0});
        std::vector<double> share(fine.size());
        Sampler random(7, 0);
        random.start(0);
        constexpr int samples = 4000;
        // Points of all coarse patches, weighted by area, against the area of the fine patches, eight groups of them.
        std::vector<double> found(8), expected(8), squares(8);
        for (std::uint32_t i = 0; i < coarse.size(); ++i) {
            const double weight = coarse.area(i) / samples;
            std::vector<double> in(8);
            for (int k = 0; k < samples; ++k) in[fine.locate(coarse.point(i, random.next2())) % 8] += 1.0;
            for (int g = 0; g < 8; ++g) {
                found[g] += in[g] * weight;
                const double p = in[g] / samples;
                squares[g] += coarse.area(i) * coarse.area(i) * p * (1.0 - p) / samples;
            }
        }
        for (std::uint32_t i = 0; i < fine.size(); ++i) expected[i % 8] += fine.area(i);
        for (int g = 0; g < 8; ++g)
            EXPECT_LE(std::abs(found[g] - expected[g]), 4.5 * std::sqrt(squares[g])) << e.name << ", group " << g;
    }
}

TEST(Patches, InterpolationIsExactForLinearFunctions) {
    const Vec3 slope(0.3, -1.2, 0.7);
    SceneMaker maker;
    maker.add(parallelogram({1, 2, 3}, {2, 0, 1}, {0.5, 1.5, 0}), matte(0.5));
    const Scene scene = maker.make();
    const Patches patches(scene.geometry, {300, 0.7});
    Sampler random(3, 0);
    random.start(0);
    for (int k = 0; k < 1000; ++k) {
        const SurfacePoint p =
            patches.point(static_cast<std::uint32_t>(random.next() * static_cast<double>(patches.size())), random.next2());
        const Patches::Reading r = patches.interpolate(p);
        double value = 0.0, sum = 0.0;
        for (int i = 0; i < 4; ++i) {
            value += r.weight[i] * glm::dot(slope, patches.point(r.patch[i], Vec2(0.5)).position);
            sum += r.weight[i];
        }
        EXPECT_NEAR(sum, 1.0, 1e-14);
        EXPECT_NEAR(value, glm::dot(slope, p.position), 1e-6);  // points keep clear of edges by a rounding error of floats
    }
}

TEST(Patches, InterpolationStaysWithinAChartAndAddsUpToOne) {
    for (const ClosedScene& e : surfaces()) {
        const Scene scene = e.maker.make();
        const Patches patches(scene.geometry, {500, 0.7});
        Sampler random(3, 0);
        random.start(0);
        for (std::uint32_t i = 0; i < patches.size(); ++i) {
            const Patches::Reading r = patches.interpolate(patches.point(i, random.next2()));
            EXPECT_NEAR(std::accumulate(r.weight.begin(), r.weight.end(), 0.0), 1.0, 1e-12) << e.name;
            for (const std::uint32_t patch : r.patch) EXPECT_EQ(&patches.chart(patch), &patches.chart(i)) << e.name;
        }
    }
}

TEST(Patches, CoarserOnesAreUnionsOfFinerOnes) {
    std::vector<std::pair<std::string, Scene>> scenes;
    for (const ClosedScene& e : surfaces()) scenes.emplace_back(e.name, e.maker.make());
    scenes.emplace_back("furnished room", furnished_room());
    for (const auto& [name, scene] : scenes) {
        const Patches fine(scene.geometry, {600, 0.7}), coarse = fine.coarser();
        const std::vector<std::uint32_t> around = fine.coarser_of_each(coarse);
        ASSERT_EQ(around.size(), fine.size());
        std::vector<double> area(coarse.size());
        std::size_t elsewhere = 0;
        for (std::uint32_t i = 0; i < fine.size(); ++i) {
            area[around[i]] += fine.area(i);
            elsewhere += coarse.locate(fine.point(i, Vec2(0.5))) != around[i];
        }
        // A part of a cell ends in squares, beside an outline.
        EXPECT_LE(elsewhere, name == "furnished room" ? fine.size() / 20 : 0) << name;
        for (std::uint32_t i = 0; i < coarse.size(); ++i) EXPECT_NEAR(area[i] / coarse.area(i), 1.0, 1e-12) << name;
    }
}

// Otherwise a discretisation that compares them would be nothing.
TEST(Patches, CoarserOnesAreOthersOnEveryChart) {
    for (const ClosedScene& e : surfaces()) {
        const Scene scene = e.maker.make();
        const Patches fine(scene.geometry, {1, 0.7}), coarse = fine.coarser();
        std::vector<std::size_t> more(fine.charts().size());
        for (std::uint32_t i = 0; i < fine.size(); ++i) ++more[fine.chart_number(i)];
        for (std::uint32_t i = 0; i < coarse.size(); ++i) --more[coarse.chart_number(i)];
        for (const std::size_t n : more) EXPECT_GT(n, 0u) << e.name;
    }
}

TEST(Patches, RefuseWhatCannotBeCut) {
    const Scene empty = SceneMaker().make();
    EXPECT_THROW(Patches(empty.geometry, {100, 0.0}), InputError);
    SceneMaker maker;
    maker.add(triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), matte(0.5));
    EXPECT_THROW(Patches(maker.make().geometry, {0, 0.0}), InputError);
}

TEST(PatchSpace, LeavesOutSidesThatFaceNothing) {
    // The outsides of a room and of a sphere, but not the inside and the outside of a box in the room.
    SceneMaker maker;
    Surface two_sided = matte(0.5);
    two_sided.two_sided = true;
    maker.add(room({-1, -1, -1}, {1, 1, 1}), two_sided);
    const std::uint32_t box_shape = maker.add(box({0.1, 0.2, -0.5}, {0.4, 0.5, 0.3}), two_sided);
    const Scene scene = maker.make();
    const std::vector<SideDirections> sides(scene.geometry.shapes().size(), SideDirections{1, 1, false});
    const PatchSpace space(scene.geometry, {600, 0.0}, sides);
    for (const Facet& facet : space.facets()) EXPECT_TRUE(facet.front || space.patches().chart(facet.patch).shape() == box_shape);
    std::size_t backs = 0;
    for (const Facet& facet : space.facets()) backs += !facet.front;
    EXPECT_GT(backs, 0u);
}

TEST(DirectionCells, HoldTheirDirections) {
    Sampler random(5, 0);
    random.start(0);
    for (const std::uint32_t k : {1u, 2u, 8u, 16u}) {
        const DirectionCells cells{k};
        std::uint32_t elsewhere = 0;
        for (std::uint32_t cell = 0; cell < cells.size(); ++cell)
            for (int i = 0; i < 32; ++i) {
                const Vec3 w = cells.direction(cell, random.next2());
                elsewhere += cells.cell(w) != cell;
                // A mirror turns by half a circle.
                const std::uint32_t across = k - 1 - cell % k, along = k - 1 - cell / k;
                if (cells.cell(w) != cell) continue;
                EXPECT_EQ(cells.cell({-w.x, -w.y, w.z}), along * k + across);
            }
        EXPECT_LE(elsewhere, 1u);
    }
}

}  // namespace neumann::patches_test
