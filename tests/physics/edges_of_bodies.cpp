// Rays beside the edges of bodies, where floats and at last doubles cannot tell on which side of an edge a ray passes: it meets no
// face from behind, and none is passed through.
#include "core/geometry/geometry.h"
#include "core/sampling/sampler.h"
#include "core/sampling/warp.h"
#include "tests/physics/close_places.h"

#include <gtest/gtest.h>
#include <cmath>

namespace neumann::edges_of_bodies_test {

using namespace close_places;

// Embree's rays begin a rounding beside the real ones, so that by the edge of a box they may meet the face behind alone.
TEST(EdgesOfBodies, AreMetInOrder) {
    const TriangleMesh inner = box({0.3, 0.2, -0.8}, {0.7, 0.8, 0.1});
    TriangleMesh outer = box({-1, -1, -1}, {1, 1, 1});
    for (auto& t : outer.triangles) std::swap(t[1], t[2]);
    for (const Placement& place : places) {
        const Geometry geometry = placed({outer, inner}, place.to_world);
        const auto& vertices = std::get<TriangleMesh>(geometry.shapes()[1]).vertices;
        const Vec3 center = place.to_world * glm::dvec4(-0.5, -0.5, -0.5, 1.0);
        Sampler random(7, 0);
        random.start(0);
        int behind = 0, missed = 0, met = 0;
        for (int k = 0; k < 200000; ++k) {
            SurfacePoint from, hit;
            ASSERT_TRUE(geometry.first_hit(center, uniform_sphere(random.next2()), 1e9, from));
            const auto& t = inner.triangles[static_cast<std::size_t>(random.next() * static_cast<double>(inner.triangles.size()))];
            const Vec3 a = vertices[t[0]], b = vertices[t[1]], beside = uniform_sphere(random.next2()) * (4e-6 * random.next());
            const Vec3 w = glm::normalize(a + (b - a) * random.next() + beside - from.position);
            if (glm::dot(w, from.normal) <= 0.0) continue;
            if (!geometry.first_hit(from, w, hit)) {
                ++missed;
                continue;
            }
            behind += glm::dot(w, hit.normal) > 0.0;
            met += hit.shape == 1;
        }
        EXPECT_EQ(behind, 0) << place.name;
        EXPECT_EQ(missed, 0) << place.name;
        EXPECT_GT(met, 20000) << place.name;
    }
}

struct Corners {
    Vec3 low, high;
    bool holds(const Vec3& p) const {
        return glm::all(glm::greaterThan(p, low - 1e-10)) && glm::all(glm::lessThan(p, high + 1e-10));
    }
    const Vec3& end(double choice) const { return choice < 0.5 ? low : high; }
};

// Rays between boxes whose faces lie in common planes or a billionth beside them, aimed at edges and at places where faces cross,
// as exactly as doubles can, and then on from there: none may meet the back of a face. Rays that are nearly parallel to faces are
// left out; they pass edges within rounding for a long way. Where several edges cross within 1e-10, rounding of double leaves one
// wrong in 3·10⁵: more than one here, in any of the places, once in 100 seeds.
TEST(EdgesOfBodies, AreMetFromOutsideByRaysAimedAtThem) {
    constexpr double beside[] = {0.0, 0.0, 1e-6, -1e-6, 1e-9, -1e-9};
    const auto grazes = [](const Vec3& w) { return std::min({std::abs(w.x), std::abs(w.y), std::abs(w.z)}) < 1e-3; };
    for (const Placement& place : places) {
        Sampler random(20261125, 0);
        const auto one_of = [&](int n) { return static_cast<int>(random.next() * n); };
        const auto direction = [&] { return uniform_sphere(random.next2()); };
        const auto moved = [&](const Vec3& p) { return Vec3(place.to_world * glm::dvec4(p, 1.0)); };
        const auto turned = [&](const Vec3& w) { return glm::dmat3(place.to_world) * w; };
        const double rounding = 0x1p-52 * (1.0 + glm::length(Vec3(place.to_world[3])));
        int aimed = 0, arrived = 0, rays = 0, wrong = 0;
        for (std::uint64_t room = 0; room < 200; ++room) {
            random.start(room);
            std::vector<Corners> boxes(5);
            std::vector<TriangleMesh> meshes;
            for (Corners& b : boxes) {
                for (glm::length_t axis = 0; axis < 3; ++axis) {
                    const double from = one_of(5), to = from + 1.0 + one_of(2);
                    b.low[axis] = -0.6 + 0.2 * from + beside[one_of(6)];
                    b.high[axis] = -0.6 + 0.2 * to + beside[one_of(6)];
                }
                meshes.push_back(box(b.low, b.high));
            }
            meshes.push_back(make_cube(glm::scale(Mat4(1.0), Vec3(2.0)), true));
            const Geometry geometry = placed(meshes, place.to_world);
            const auto is_wrong = [&](const SurfacePoint& from, const Vec3& w, SurfacePoint& hit) {
                ++rays;
                return !geometry.first_hit(from, w, hit) || glm::dot(hit.normal, w) >= 0.0;
            };
            for (int i = 0; i < 400; ++i) {
                // A place on an edge of one box, or where faces of two boxes cross.
                const Corners &a = boxes[one_of(5)], &b = boxes[one_of(5)];
                const int along = one_of(3);
                Vec3 edge;
                for (int axis = 0; axis < 3; ++axis)
                    edge[axis] = axis == along ? glm::mix(a.low[axis], a.high[axis], random.next())
                                               : (random.next() < 0.5 ? a : b).end(random.next())[axis];
                // A start beside it, on a face, and outside of the other boxes.
                const int k = one_of(5), across = one_of(3);
                const bool above = random.next() < 0.5;
                const double aside = std::pow(10.0, -9.0 * random.next());
                Vec3 p = glm::clamp(edge + aside * direction(), boxes[k].low + 1e-9, boxes[k].high - 1e-9), normal(0.0);
                p[across] = (above ? boxes[k].high : boxes[k].low)[across];
                normal[across] = above ? 1.0 : -1.0;
                bool is_free = true;
                for (int j = 0; j < 5; ++j) is_free = is_free && (j == k || !boxes[j].holds(p));
                const Vec3 noise = direction() * (rounding * std::pow(10.0, 3.0 * random.next()));
                const Vec3 w = glm::normalize(edge + noise - p);
                if (!is_free || !(glm::dot(w, normal) > 0.0) || grazes(w)) continue;
                SurfacePoint from, hit, next;
                double nearest = INFINITY;
                for (std::uint32_t t = 0; t < 12; ++t) {
                    const SurfacePoint q = geometry.point_on_triangle(static_cast<std::uint32_t>(k), t, moved(p));
                    if (glm::dot(q.normal, turned(normal)) < 0.5 || glm::length(q.position - moved(p)) >= nearest) continue;
                    nearest = glm::length(q.position - moved(p));
                    from = q;
                }
                ++aimed;
                if (is_wrong(from, glm::normalize(moved(edge) + turned(noise) - from.position), hit)) {
                    ++wrong;
                    continue;
                }
                arrived += glm::length(hit.position - moved(edge)) < 1e-9;
                for (int j = 0; j < 4; ++j)
                    if (const Vec3 on = direction(); glm::dot(turned(on), hit.normal) > 0.0 && !grazes(on))
                        wrong += is_wrong(hit, turned(on), next);
            }
        }
        EXPECT_LE(wrong, 1) << place.name << ", of " << rays;
        EXPECT_GT(arrived, aimed / 10) << place.name << ", of " << aimed;
    }
}

// The same for the rims of closed cylinders that stand a billionth above the floor.
TEST(EdgesOfBodies, AreMetFromOutsideAtRimsToo) {
    for (const Placement& place : places) {
        Sampler random(20261126, 0);
        random.start(0);
        const auto moved = [&](const Vec3& p) { return Vec3(place.to_world * glm::dvec4(p, 1.0)); };
        const auto turned = [&](const Vec3& w) { return glm::dmat3(place.to_world) * w; };
        const auto disk = [&](double z, double side) {
            return Disk{moved({0, 0, z}), turned({0.5, 0, 0}), turned({0, 0.5 * side, 0}), turned({0, 0, side})};
        };
        const Cylinder tube{.base = moved({0, 0, 1e-9}), .axis = turned({0, 0, 1}), .length = 1.0, .radius = 0.5};
        TriangleMesh hall = box({-3, -3, 0}, {3, 3, 3});
        for (auto& t : hall.triangles) std::swap(t[1], t[2]);
        const Geometry geometry({tube, disk(1e-9, -1.0), disk(1.0 + 1e-9, 1.0), transformed(hall, place.to_world)});
        const double rounding = 0x1p-52 * (1.0 + glm::length(Vec3(place.to_world[3])));
        int rays = 0, wrong = 0, met = 0;
        for (int i = 0; i < 50'000; ++i) {
            const double angle = 2.0 * pi * random.next(), aside = std::pow(10.0, -8.0 * random.next());
            const Vec3 rim(0.5 * std::cos(angle), 0.5 * std::sin(angle), 1e-9);
            SurfacePoint from, hit;
            // Seen from the floor, below it or beside it.
            const Vec3 p = rim + Vec3(aside * (2.0 * random.next2() - 1.0), -1e-9);
            ASSERT_TRUE(geometry.first_hit(moved({p.x, p.y, -1e-3}), turned({0, 0, 1}), 1.0, from));
            if (from.shape != 3) continue;
            const Vec3 noise = uniform_sphere(random.next2()) * (rounding * std::pow(10.0, 3.0 * random.next()));
            const Vec3 w = glm::normalize(moved(rim) + turned(noise) - from.position);
            // Rays that graze the tube cut off so little of it that rounding decides where.
            if (glm::dot(w, turned({0, 0, 1})) < 1e-3 ||
                std::abs(glm::dot(w, turned(glm::normalize(Vec3(rim.x, rim.y, 0.0))))) < 1e-2)
                continue;
            ++rays;
            wrong += !geometry.first_hit(from, w, hit) || glm::dot(hit.normal, w) >= 0.0;
            met += hit.shape < 3;
        }
        EXPECT_EQ(wrong, 0) << place.name << ", of " << rays;
        EXPECT_GT(met, rays / 10) << place.name;
    }
}

// Rays that are reflected back and forth beside the edges of a large room that is turned, where hits lie off their surface by what
// rounding leaves of a distance of its size: never do they meet the surface that they leave, nor the back of another one.
TEST(EdgesOfBodies, AreNotMetByRaysThatStartBesideThem) {
    const Mat4 to_world = glm::scale(glm::rotate(Mat4(1.0), 1.1, glm::normalize(Vec3(1, 2, 3))), Vec3(1e6));
    const Geometry geometry({transformed(make_cube(glm::scale(glm::translate(Mat4(1.0), Vec3(0.5)), Vec3(0.5)), true), to_world)});
    Sampler sampler(20240229, 0);
    for (std::uint64_t i = 0; i < 400'000; ++i) {
        sampler.start(i);
        // Beside the edge x = y = 0, by 1e-6 to 1e-5 of the room, on the wall x = 0.
        const double aside = std::pow(10.0, -6.0 + sampler.next());
        const Vec3 from = Vec3(to_world * glm::dvec4(0.1 + 0.8 * sampler.next(), 0.1 + 0.8 * sampler.next(), sampler.next(), 1.0)),
                   towards = Vec3(to_world * glm::dvec4(0.0, aside, sampler.next(), 1.0));
        SurfacePoint p;
        ASSERT_TRUE(geometry.first_hit(from, glm::normalize(towards - from), 1e9, p));
        for (int bounce = 0; bounce < 4; ++bounce) {
            const Vec3 s = glm::normalize(glm::cross(p.normal, Vec3(1, 2, 3))), t = glm::cross(p.normal, s),
                       local = cosine_hemisphere(sampler.next2()), direction = s * local.x + t * local.y + p.normal * local.z;
            const Vec3 left = p.normal;
            ASSERT_TRUE(geometry.first_hit(p, direction, p));
            ASSERT_LT(glm::dot(p.normal, left), 0.5) << i;
            ASSERT_LT(glm::dot(p.normal, direction), 0.0) << i;
        }
    }
}

}  // namespace neumann::edges_of_bodies_test
