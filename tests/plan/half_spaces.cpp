// Proofs of what surfaces see of each other, on bodies where it is known, and beside rays that try to find the contrary.
#include "operators/render/plan/half_spaces.h"

#include "core/geometry/area_sampler.h"
#include "core/sampling/sampler.h"
#include "operators/paths/walk/left_out.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace neumann::physics::half_spaces_test {

const Vec3 low(-1.0, -2.0, -0.5), high(1.0, 1.0, 2.0);

Mat4 somewhere(double size) {
    const Mat4 there = glm::translate(Mat4(1.0), Vec3(3e4, -1e4, 2e4) * size);
    return glm::scale(glm::rotate(there, 0.7, glm::normalize(Vec3(1.0, 2.0, 3.0))), Vec3(size));
}

std::vector<Shape> shapes_of(const std::array<TriangleMesh, 6>& meshes, const Mat4& to_world = Mat4(1.0)) {
    std::vector<Shape> shapes;
    for (const TriangleMesh& mesh : meshes) shapes.emplace_back(transformed(mesh, to_world));
    return shapes;
}
std::vector<Shape> capped_cylinder(bool inwards) {
    const Vec3 n(0.0, 0.0, inwards ? 1.0 : -1.0);
    Cylinder side{.base = {}, .axis = {0.0, 0.0, 1.0}, .length = 2.0, .radius = 1.0, .flip_normals = inwards};
    return {side, Disk{.center = {}, .normal = n}, Disk{.center = {0.0, 0.0, 2.0}, .normal = -n}};
}
Geometry geometry(std::vector<Shape> shapes) { return Geometry(std::move(shapes)); }
ConvexBody body(std::vector<Shape> shapes) { return HalfSpaces(geometry(std::move(shapes))).convex_body(); }

// Points of a body that is found see each other as rays tell it, too, wherever the walk will not ask.
std::size_t unseen(const Geometry& g) {
    const AreaSampler surfaces(g);
    Sampler random(1, 0);
    random.start(0);
    std::size_t count = 0;
    for (int i = 0; i < 20000; ++i) {
        double choice = random.next();
        const SurfacePoint x = surfaces.sample(choice, random.next2());
        choice = random.next();
        const SurfacePoint y = surfaces.sample(choice, random.next2());
        if (see_through_room(x, y)) count += !g.visible(x, y);
    }
    return count;
}

TEST(HalfSpaces, RoomsAreConvexBodiesOfAnySizeAnywhere) {
    for (const double size : {1e-3, 1.0, 1e6}) {
        const Geometry g = geometry(shapes_of(room(low, high), somewhere(size)));
        const ConvexBody found = HalfSpaces(g).convex_body();
        EXPECT_TRUE(found.found && found.fronts_face_inwards && found.is_closed) << size;
        EXPECT_EQ(unseen(g), 0u) << size;
    }
}

TEST(HalfSpaces, OtherConvexBodies) {
    const ConvexBody outwards = body({box(low, high)});
    EXPECT_TRUE(outwards.found && outwards.is_closed && !outwards.fronts_face_inwards);
    const ConvexBody polyhedron = body({flipped(icosphere(2))});
    EXPECT_TRUE(polyhedron.found && polyhedron.is_closed && polyhedron.fronts_face_inwards);
    for (const bool inwards : {false, true}) {
        const ConvexBody sphere = body({Sphere{.center = {}, .radius = 2.0, .flip_normals = inwards}});
        EXPECT_TRUE(sphere.found && sphere.is_closed && sphere.fronts_face_inwards == inwards);
        const Geometry can = geometry(capped_cylinder(inwards));
        const ConvexBody cylinder = HalfSpaces(can).convex_body();
        EXPECT_TRUE(cylinder.found && cylinder.fronts_face_inwards == inwards);
        EXPECT_EQ(unseen(can), 0u);
    }
    std::vector<Shape> open = shapes_of(room(low, high));
    open.erase(open.begin() + 2);
    const ConvexBody with_a_wall_missing = body(open);
    EXPECT_TRUE(with_a_wall_missing.found && with_a_wall_missing.fronts_face_inwards && !with_a_wall_missing.is_closed);
    auto turned = room(low, high);
    turned[3] = flipped(turned[3]);
    const ConvexBody with_a_wall_turned = body(shapes_of(turned));
    EXPECT_TRUE(with_a_wall_turned.found && with_a_wall_turned.is_closed && !with_a_wall_turned.fronts_face_inwards);
}

TEST(HalfSpaces, NoConvexBodies) {
    const auto with = [](const Shape& shape) {
        std::vector<Shape> shapes = shapes_of(room(low, high));
        shapes.push_back(shape);
        return body(std::move(shapes)).found;
    };
    EXPECT_FALSE(body({}).found);
    EXPECT_FALSE(with(patch({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 0.1)));
    EXPECT_FALSE(with(Sphere{.center = {}, .radius = 0.1}));
    EXPECT_FALSE(with(Disk{.center = {0.0, 0.0, 0.0}, .u = {0.1, 0.0, 0.0}, .v = {0.0, 0.1, 0.0}}));
    EXPECT_FALSE(with(Cylinder{.length = 0.1, .radius = 0.1}));
    // A lamp that hangs a millionth below the ceiling hides some of it; one that lies in it does not.
    EXPECT_FALSE(with(patch({0.0, 0.0, 2.0 - 1e-6}, {0.0, 0.0, -1.0}, 0.1)));
    EXPECT_TRUE(with(patch({0.0, 0.0, 2.0}, {0.0, 0.0, -1.0}, 0.1)));
    // A dent.
    TriangleMesh dented = icosphere(2);
    EXPECT_TRUE(body({dented}).found);
    dented.vertices[7] *= 0.9;
    EXPECT_FALSE(body({dented}).found);
    EXPECT_FALSE(body({Sphere{.center = {}, .radius = 1.0}, Sphere{.center = {5.0, 0.0, 0.0}, .radius = 1.0}}).found);
    std::vector<Shape> can = capped_cylinder(true);
    std::get<Disk>(can[2]).center.z = 1.9;
    EXPECT_FALSE(body(can).found);
}

// By rays in all directions above the horizon of points everywhere on the side.
std::size_t surfaces_seen(const Geometry& g, std::uint32_t shape, bool front) {
    Sampler random(2, shape);
    random.start(0);
    std::size_t count = 0;
    for (int i = 0; i < 5000; ++i) {
        const auto primitive = static_cast<std::uint32_t>(random.next() * g.primitive_count(shape));
        const SurfacePoint x = g.point(shape, primitive, random.next2());
        SurfacePoint met;
        count += g.first_hit(x, Frame(front ? x.normal : -x.normal).to_world(cosine_hemisphere(random.next2())), met);
    }
    return count;
}

TEST(HalfSpaces, SidesThatSeeNothing) {
    struct Case {
        const char* name;
        std::vector<Shape> shapes;
        bool front, back;  // of the first shape: sees nothing
    };
    const TriangleMesh cube = box(low, high), rectangle = patch({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 1.0);
    const Case all[] = {
        {"box", {cube}, true, false},
        {"rectangle", {rectangle}, true, true},
        {"sphere", {Sphere{}}, true, false},
        {"flipped sphere", {Sphere{.center = {}, .radius = 1.0, .flip_normals = true}}, false, true},
        {"sphere with all within", {Sphere{.center = {}, .radius = 9.0}, Sphere{}, cube, Disk{}}, true, false},
        {"sphere with a corner without", {Sphere{.center = {}, .radius = 2.9}, cube}, false, false},
        {"cylinder", {Cylinder{}}, true, false},
        {"can", capped_cylinder(false), true, false},
        {"box above a rectangle", {rectangle, box({-0.1, -0.1, 0.0}, {0.1, 0.1, 0.1})}, false, true},
        {"box below a rectangle", {rectangle, box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.0})}, true, false},
        {"two boxes", {cube, box({5.0, 5.0, 5.0}, {6.0, 6.0, 6.0})}, false, false},
        {"two rectangles in a plane", {rectangle, patch({3.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 1.0)}, true, true},
        {"a rectangle a millionth above", {rectangle, patch({0.0, 0.0, 1e-6}, {0.0, 0.0, 1.0}, 0.1)}, false, true},
        {"rectangle and sphere", {rectangle, Sphere{.center = {0.0, 0.0, -2.0}, .radius = 1.0}}, true, false},
        {"cone-like",
         {TriangleMesh{{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}}},
         true,
         false},
    };
    for (const Case& c : all) {
        const Geometry g = geometry(c.shapes);
        for (const bool front : {true, false}) {
            const bool expected = front ? c.front : c.back;
            EXPECT_EQ(HalfSpaces(g).no_surface_seen_from(0, front), expected) << c.name << (front ? ", front" : ", back");
            if (expected) {
                EXPECT_EQ(surfaces_seen(g, 0, front), 0u) << c.name << (front ? ", front" : ", back");
            }
        }
    }
}

// Planes times vertices: what cannot be looked through in a moment is not claimed.
TEST(HalfSpaces, TooManyTrianglesAreNotLookedThrough) {
    EXPECT_TRUE(body({icosphere(4)}).found);
    const Geometry g = geometry({icosphere(6)});
    EXPECT_FALSE(HalfSpaces(g).convex_body().found);
    EXPECT_FALSE(HalfSpaces(g).no_surface_seen_from(0, true));
}

}  // namespace neumann::physics::half_spaces_test
