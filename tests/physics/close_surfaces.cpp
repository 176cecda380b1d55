// Rays among surfaces that are nearer to each other than Embree's floats can tell, against all triangles one by one in long double.
#include "core/geometry/geometry.h"
#include "core/geometry/giants.h"
#include "core/sampling/sampler.h"
#include "core/sampling/warp.h"
#include "operators/experiments/known/scene_maker.h"
#include "tests/physics/close_places.h"

#include <gtest/gtest.h>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>

namespace neumann::close_surfaces_test {

using namespace close_places;
using Long = glm::tvec3<long double>;

struct Plane {
    Long a, e1, e2, n;  // n: unit length
};

// All triangles, one by one. No ray meets the plane it starts on.
class Brute {
public:
    explicit Brute(const Geometry& geometry) {
        for (std::uint32_t shape = 0; shape < geometry.shapes().size(); ++shape) {
            for (std::uint32_t i = 0; i < geometry.primitive_count(shape); ++i) {
                const TriangleCorners corners = corners_of(geometry.shapes()[shape], i);
                const Long a = corners.at[0], b = corners.at[1], c = corners.at[2];
                planes_.push_back({a, b - a, c - a, glm::normalize(glm::cross(b - a, c - a))});
            }
        }
    }
    // Distances along direction, the nearest first; infinite where nothing is met.
    // With triangles larger by `grown`, and without those whose planes are so near to the start.
    long double nearest(const SurfacePoint& from, const Vec3& direction, long double grown = 0.0L, long double near = 0.0L) const {
        long double best = INFINITY;
        for (const Plane& p : planes_)
            if (!holds(p, from.position, near)) best = std::min(best, distance(p, from.position, direction, grown));
        return best;
    }
    bool visible(const SurfacePoint& x, const SurfacePoint& y, long double grown = 0.0L, long double near = 0.0L) const {
        const Long d = Long(y.position) - Long(x.position);
        for (const Plane& p : planes_)
            if (!holds(p, y.position, near) && !holds(p, x.position, near) && distance(p, x.position, d, grown) < 1.0L)
                return false;
        return true;
    }

private:
    // As far as the coordinates of points, which are doubles, can tell.
    static bool holds(const Plane& p, const Vec3& x, long double near = 0.0L) {
        const long double size = std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)}) + glm::length(p.a);
        return std::abs(glm::dot(Long(x) - p.a, p.n)) <= std::max(near, 0x1p-50L * size);
    }
    static long double distance(const Plane& p, const Vec3& from, const Long& direction, long double grown) {
        if (holds(p, from)) return INFINITY;
        const Long o = Long(from) - p.a;
        const long double t = -glm::dot(o, p.n) / glm::dot(direction, p.n);
        if (!(t > 0.0L)) return INFINITY;
        const Long x = o + direction * t;
        const Long normal = glm::cross(p.e1, p.e2);
        const long double square = glm::dot(normal, normal);
        const long double u = glm::dot(glm::cross(x, p.e2), normal) / square, v = glm::dot(glm::cross(p.e1, x), normal) / square;
        const long double area = std::sqrt(square);
        const long double outside =
            1e-12L + grown / area * std::max({glm::length(p.e1), glm::length(p.e2), glm::length(p.e2 - p.e1)});
        return u >= -outside && v >= -outside && 1.0L - u - v >= -outside ? t : INFINITY;
    }
    std::vector<Plane> planes_;
};

Vec3 random_direction(Sampler& random, const Vec3& normal) {
    const Vec3 w = uniform_sphere(random.next2());
    return glm::dot(w, normal) < 0.0 ? -w : w;
}

struct Counts {
    int rays = 0, wrong = 0, close = 0;
};

// Paths of random directions from points on all surfaces and near their edges, and shadow rays between them. By the edge of
// something either answer is right: what a ray a millionth of a radian beside it meets is accepted, too, and what triangles meet
// that are larger by Embree's rounding. No ray that passes through a surface or between two that touch is right by this.
Counts compare(const Geometry& geometry, int paths, std::uint64_t seed, const std::function<SurfacePoint(Sampler&)>& start) {
    const Brute brute(geometry);
    const double rounding = 2e-7 * geometry.radius();
    Sampler random(seed, 0);
    random.start(0);
    Counts counts;
    for (int i = 0; i < paths; ++i) {
        SurfacePoint x = start(random);
        for (int bounce = 0; bounce < 6; ++bounce) {
            const double side = random.next() < 0.5 ? -1.0 : 1.0;
            const Vec3 w = random_direction(random, x.normal * side);
            SurfacePoint y = x;
            const bool hit = geometry.first_hit(x, w, y);
            const long double found = hit ? glm::dot(Long(y.position) - Long(x.position), Long(w)) : INFINITY;
            const double size =
                std::max({std::abs(x.position.x), std::abs(x.position.y), std::abs(x.position.z), geometry.radius()});
            const auto agrees = [&](const Vec3& direction, long double grown, long double near = 0.0L) {
                const long double expected = brute.nearest(x, direction, grown, near);
                const double cosine = hit ? std::abs(glm::dot(w, y.normal)) : 1.0;
                return found == expected || std::abs(found - expected) * cosine <= 1e-4L * expected * cosine + 1e-12L * size;
            };
            bool right = agrees(w, 0.0L) || agrees(w, rounding) || agrees(w, 0.0L, 1e-12L * size);
            for (int k = 0; k < 8 && !right; ++k) right = agrees(glm::normalize(w + 1e-6 * uniform_sphere(random.next2())), 0.0L);
            ++counts.rays;
            counts.wrong += !right;
            counts.close += x.close || (hit && y.close);
            if (!right && counts.wrong <= 3)
                ADD_FAILURE() << "from " << x.shape << "/" << x.primitive << (x.close ? " close" : "") << " found " << found
                              << (hit ? " on " : " nothing ") << y.shape << "/" << y.primitive << ", expected "
                              << brute.nearest(x, w) << ", position " << x.position.x << " " << x.position.y << " " << x.position.z
                              << " direction " << w.x << " " << w.y << " " << w.z;
            if (!hit) break;
            const SurfacePoint z = start(random);
            // What lies in one plane, light does not go between.
            const Vec3 d = glm::normalize(z.position - y.position);
            if (std::abs(glm::dot(d, y.normal)) < 1e-6 || std::abs(glm::dot(d, z.normal)) < 1e-6) {
                x = y;
                continue;
            }
            const auto sees = [&](const Vec3& moved, long double grown) {
                SurfacePoint to = z;
                to.position = moved;
                return brute.visible(y, to, grown);
            };
            const bool seen = geometry.visible(y, z);
            bool alike = seen == sees(z.position, 0.0L) || (!seen && !sees(z.position, rounding)) ||
                         (seen && (brute.visible(y, z, 0.0L, 1e-12L * size) || brute.visible(y, z, -1e-11L * size)));
            for (int k = 0; k < 8 && !alike; ++k)
                alike =
                    seen == sees(z.position + 1e-6 * glm::length(z.position - y.position) * uniform_sphere(random.next2()), 0.0L);
            ++counts.rays;
            counts.wrong += !alike;
            if (!alike && counts.wrong <= 3)
                ADD_FAILURE() << "visible " << seen << " between " << y.shape << "/" << y.primitive << (y.close ? " close" : "")
                              << " and " << z.shape << "/" << z.primitive << (z.close ? " close" : "");
            x = y;
        }
    }
    return counts;
}

SurfacePoint anywhere(const Geometry& geometry, Sampler& random) {
    const auto shape = static_cast<std::uint32_t>(random.next() * static_cast<double>(geometry.shapes().size()));
    const auto primitive = static_cast<std::uint32_t>(random.next() * geometry.primitive_count(shape));
    return geometry.point(shape, primitive, random.next2());
}

// A point whose distance from the edges of its triangle is logarithmic.
SurfacePoint near_edges(const Geometry& geometry, std::uint32_t shape, Sampler& random) {
    const auto primitive = static_cast<std::uint32_t>(random.next() * geometry.primitive_count(shape));
    const std::array<Vec3, 3> corners = corners_of(geometry.shapes()[shape], primitive).at;
    const auto k = static_cast<std::size_t>(3.0 * random.next());
    const Vec3 &a = corners[k], &b = corners[(k + 1) % 3], &c = corners[(k + 2) % 3];
    const double along = random.next(), in = std::pow(10.0, -8.0 * random.next());
    return geometry.point_on_triangle(shape, primitive, glm::mix(glm::mix(a, b, along), c, in));
}
SurfacePoint near_edges(const Geometry& geometry, Sampler& random) {
    const auto shape = static_cast<std::uint32_t>(random.next() * static_cast<double>(geometry.shapes().size()));
    return near_edges(geometry, shape, random);
}

TriangleMesh quad(const Vec3& corner, const Vec3& a, const Vec3& b) {
    return {{corner, corner + a, corner + a + b, corner + b}, {{0, 1, 2}, {0, 2, 3}}};
}

// Two walls of unit height that meet at an angle, open above.
TEST(CloseSurfaces, AreMetInLongGrooves) {
    for (const Placement& place : places)
        for (const double length : {1.0, 20.0, 2000.0, 2e4})
            for (const double angle : {pi / 3.0, 0.1, 3.0}) {
                const Vec3 along(2.0 * length, 0, 0), corner(-length, 0, 0);
                const Geometry geometry = placed(
                    {quad(corner, along, {0, std::cos(angle), std::sin(angle)}), quad(corner, along, {0, 1, 0})}, place.to_world);
                // Far from the ends, at distances from 1 down to 1e-6 from the crease.
                const auto start = [&](Sampler& random) {
                    const auto shape = static_cast<std::uint32_t>(2.0 * random.next());
                    const double up = std::pow(10.0, -6.0 * random.next()), x = 0.5 * random.next();
                    const Vec3 p(x, up * (shape == 0 ? std::cos(angle) : 1.0), up * (shape == 0 ? std::sin(angle) : 0.0));
                    // Of the two triangles of a wall the one that holds x.
                    const std::uint32_t primitive = (x + length) / (2.0 * length) >= up ? 0 : 1;
                    return geometry.point_on_triangle(shape, primitive, Vec3(place.to_world * glm::dvec4(p, 1.0)));
                };
                const Counts counts = compare(geometry, 2000, 1, start);
                EXPECT_EQ(counts.wrong, 0) << place.name << ", length " << length << ", angle " << angle << ", of " << counts.rays;
                // Longer walls are giants, and flatter ones continue each other.
                if (length <= 20.0 && angle < 2.0) {
                    EXPECT_GT(counts.close, 0);
                }
            }
}

TEST(CloseSurfaces, AreMetInThinGapsAboveWideGround) {
    for (const Placement& place : places)
        for (const double half_width : {10.0, 1e3, 1e5, 1e6})
            for (const double gap : {1e-3, 1e-6}) {
                const Geometry geometry =
                    placed({quad({-half_width, -half_width, 0}, {2 * half_width, 0, 0}, {0, 2 * half_width, 0}),
                            box({0, 0, gap}, {1, 1, 1 + gap})},
                           place.to_world);
                const auto start = [&](Sampler& random) {
                    const Vec2 u = 1.5 * random.next2() - 0.25;
                    if (random.next() < 0.5)
                        return near_edges(geometry, random).shape == 1
                                   ? anywhere(geometry, random)
                                   : geometry.point_on_triangle(0, u.x >= u.y ? 0 : 1,
                                                                Vec3(place.to_world * glm::dvec4(u, 0.0, 1.0)));
                    const auto primitive = static_cast<std::uint32_t>(12.0 * random.next());
                    return geometry.point(1, primitive, random.next2());
                };
                const Counts counts = compare(geometry, 2000, 2, start);
                EXPECT_EQ(counts.wrong, 0) << place.name << ", half width " << half_width << ", gap " << gap << ", of "
                                           << counts.rays;
            }
}

// Boxes whose faces are cut into triangles in two ways.
TEST(CloseSurfacesSlow, AreMetWhereBoxesTouchAndOverlap) {
    for (const auto cut : {&close_places::box, &known::box})
        for (const Placement& place : places)
            for (const double gap : {0.0, 1e-9, 1e-6}) {
                const Geometry geometry =
                    placed({quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), cut({-0.5, -0.5, gap}, {0, 0, 0.5 + gap}),
                            cut({gap, -0.4, 0}, {0.3, 0.1, 0.3}), cut({-0.1, -0.1, -0.1}, {0.2, 0.2, 0.2}),
                            cut({-0.5, -0.5, 0.5 + 2 * gap}, {0, 0, 0.7})},
                           place.to_world);
                const Counts counts = compare(geometry, 10000, 3, [&](Sampler& random) { return near_edges(geometry, random); });
                EXPECT_EQ(counts.wrong, 0) << place.name << ", gap " << gap << ", of " << counts.rays << ", close " << counts.close;
            }
}

// The faces of instances as well, although nothing is kept of where they are close.
TEST(CloseSurfaces, AreMetOnInstances) {
    for (const Placement& place : places)
        for (const double gap : {0.0, 1e-9, 1e-6, 1e-3}) {
            const Geometry geometry =
                placed_as_instances({quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), known::box({-0.5, -0.5, gap}, {0, 0, 0.5 + gap}),
                                     known::box({gap, -0.4, 0}, {0.3, 0.1, 0.3}), known::box({-0.1, -0.1, -0.1}, {0.2, 0.2, 0.2}),
                                     known::box({-0.5, -0.5, 0.5 + 2 * gap}, {0, 0, 0.7})},
                                    place.to_world);
            const Counts counts = compare(geometry, 3000, 4, [&](Sampler& random) {
                return random.next() < 0.5 ? anywhere(geometry, random) : near_edges(geometry, random);
            });
            EXPECT_EQ(counts.wrong, 0) << place.name << ", gap " << gap << ", of " << counts.rays << ", close " << counts.close;
            EXPECT_GT(counts.close, 0);
        }
}

// A column with pleats: needles around an axis, and fans of them, of which each has hundreds of others around it, on a ground and
// in it. Without pleats its faces would continue each other. Not 1 km away, where a needle of a millimetre has corners with too few
// digits.
TEST(CloseSurfacesSlow, AreMetInCrowds) {
    for (const Placement& place : std::span(places).first(2))
        for (const double gap : {0.0, 1e-6, -0.5}) {
            TriangleMesh column = known::prism(400);
            for (std::size_t i = 0; i < column.vertices.size(); ++i) {
                Vec3& v = column.vertices[i];
                const double radius = i / 2 % 2 == 0 ? 0.1 : 0.097;
                v = Vec3(radius * v.x, radius * v.y, v.z + gap);
            }
            const Geometry geometry =
                placed({column, quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), quad({-0.3, 0.0, 0.2}, {0.6, 0, 0.1}, {0, 0.6, 0})},
                       place.to_world);
            const Counts counts = compare(geometry, 1500, 5, [&](Sampler& random) {
                return random.next() < 0.5 ? anywhere(geometry, random) : near_edges(geometry, random);
            });
            EXPECT_EQ(counts.wrong, 0) << place.name << ", gap " << gap << ", of " << counts.rays << ", close " << counts.close;
            EXPECT_GT(counts.close, 0);
        }
}

// Triangles of all shapes whose corners are often the same or nearly so, with spheres, discs and a cylinder among them.
std::vector<Shape> close_jumble(std::uint64_t seed) {
    Sampler random(seed, 0);
    random.start(0);
    const auto corner = [&] {
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis) p[axis] = std::floor(3.0 * random.next()) / 2.0;
        const double off = random.next() < 0.5 ? 0.0 : std::pow(10.0, -9.0 * random.next());
        return p + off * uniform_sphere(random.next2());
    };
    std::vector<Shape> shapes;
    for (int i = 0; i < 40; ++i) {
        TriangleMesh mesh{{corner(), corner(), corner()}, {{0, 1, 2}}};
        if (Triangle::area(mesh.vertices[0], mesh.vertices[1], mesh.vertices[2]) > 1e-8) shapes.emplace_back(std::move(mesh));
    }
    for (const double radius : {0.5, 0.5 + 1e-7, 0.25}) shapes.emplace_back(Sphere{corner(), radius});
    for (const double width : {0.5, 0.01})
        shapes.emplace_back(make_disk(glm::scale(glm::translate(Mat4(1.0), corner()), Vec3(0.5, width, 1.0))));
    shapes.emplace_back(Cylinder{corner(), {0, 0, 1}, 1.0, 0.5});
    return shapes;
}

// A face keeps where it is close after it has been asked for a few points. Rays in one order and in the other, each on a geometry
// of its own, find the same.
TEST(CloseSurfacesSlow, DoNotDependOnWhatWasAskedBefore) {
    TriangleMesh column = known::prism(400);
    for (std::size_t i = 0; i < column.vertices.size(); ++i)
        column.vertices[i] *= i / 2 % 2 == 0 ? Vec3(0.1, 0.1, 1) : Vec3(0.097, 0.097, 1);
    const Mat4& turned = places[1].to_world;
    std::vector<std::vector<Shape>> scenes{
        {transformed(column, turned), transformed(quad({-1, -1, 1e-7}, {2, 0, 0}, {0, 2, 0}), turned)},
        {transformed(box({0, 0, 0}, {1, 1, 1}), turned), transformed(box({1e-6, -0.3, 0}, {0.5, 0.7, 1e-3}), turned)}};
    for (std::uint64_t seed = 0; seed < 20; ++seed) scenes.push_back(close_jumble(seed));
    for (const std::vector<Shape>& shapes : scenes) {
        constexpr std::uint32_t asked = 20000;
        const Geometry once(shapes), again(shapes);
        const auto ask = [](const Geometry& geometry, std::uint32_t i) {
            Sampler random(i, 0);
            random.start(0);
            const auto shape = static_cast<std::uint32_t>(random.next() * static_cast<double>(geometry.shapes().size()));
            const SurfacePoint from = std::holds_alternative<TriangleMesh>(geometry.shapes()[shape])
                                          ? near_edges(geometry, shape, random)
                                          : geometry.point(shape, 0, random.next2());
            // Half of them graze.
            Vec3 w = random_direction(random, from.normal);
            if (random.next() < 0.5) w = glm::normalize(w - from.normal * (glm::dot(w, from.normal) * (1.0 - 0.2 * random.next())));
            SurfacePoint to = from;
            const bool hit = geometry.first_hit(from, w, to);
            return std::tuple(bool{from.close}, from.position, hit, to.shape, std::uint32_t{to.primitive}, bool{to.close},
                              to.position);
        };
        std::vector<decltype(ask(once, 0))> found;
        int close = 0, differ = 0;
        for (std::uint32_t i = 0; i < asked; ++i) {
            found.push_back(ask(once, i));
            close += std::get<0>(found.back());
        }
        for (std::uint32_t i = asked; i-- > 0;) differ += ask(again, i) != found[i];
        EXPECT_EQ(differ, 0);
        EXPECT_GT(close, 0);
    }
}

// A light without extent may lie on a face, which then hides nothing from it.
TEST(CloseSurfaces, SeeALightWithoutExtentThatLiesOnAFace) {
    known::SceneMaker maker;
    for (const double z : {0.0, 1e-9}) maker.add(known::parallelogram({-1, -1, z}, {2, 0, 0}, {0, 2, 0}), known::matte(0.5));
    maker.add(known::parallelogram({-1, -1, 1}, {0, 2, 0}, {2, 0, 0}), known::matte(0.5));
    const Scene scene = maker.make();
    SurfacePoint light;
    light.position = Vec3(0.3, 0.1, 1.0);
    light.shape = SurfacePoint::infinity;
    int close = 0;
    for (int i = 0; i < 1000; ++i) {
        SurfacePoint x;
        const Vec3 from(-0.9 + 0.0018 * i, 0.4 - 0.0007 * i, 0.5);
        ASSERT_TRUE(scene.geometry.first_hit(from, Vec3(0, 0, -1), 10.0, x));
        close += x.close;
        EXPECT_TRUE(scene.geometry.visible(x, light)) << i;
    }
    EXPECT_EQ(close, 1000);
}

// The ground of a room is a giant, and the walls of a room are none.
TEST(CloseSurfaces, GiantsAreWhatDwarfsAllElse) {
    const std::vector<Shape> in_room{make_rectangle(glm::scale(Mat4(1.0), Vec3(5.0))), box({0, 0, 0}, {1, 1, 1})};
    EXPECT_TRUE(find_giants(in_room).faces.empty());
    const std::vector<Shape> on_ground{box({0, 0, 0}, {1, 1, 1}), make_rectangle(glm::scale(Mat4(1.0), Vec3(500.0)))};
    const Giants found = find_giants(on_ground);
    EXPECT_EQ(found.faces, (std::vector<Face>{{1, 0}, {1, 1}}));
    EXPECT_EQ(found.rest.high, Vec3(1.0));
    // A dome, too; and a mesh may hold giants among others.
    TriangleMesh mesh = box({0, 0, 0}, {1, 1, 1});
    const auto corner = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3 v : {Vec3(-1e3, -1e3, 0), Vec3(1e3, -1e3, 0), Vec3(0, 1e3, 0)}) mesh.vertices.push_back(v);
    mesh.triangles.insert(mesh.triangles.begin() + 3, {corner, corner + 1, corner + 2});
    mesh.uv.clear();
    std::vector<Shape> domed{mesh, Sphere{{0, 0, 0}, 1e4, true}};
    EXPECT_EQ(find_giants(domed).faces, (std::vector<Face>{{0, 3}, {1, 0}}));
    const Geometry geometry(std::move(domed));
    SurfacePoint p;
    ASSERT_TRUE(geometry.first_hit({0.5, 0.5, 2.0}, {0, 0, -1}, 1e9, p));
    EXPECT_LT(glm::length(p.position - Vec3(0.5, 0.5, 1.0)), 1e-12);
    ASSERT_TRUE(geometry.first_hit({-2.5, 0.5, 2.0}, {0, 0, -1}, 1e9, p));
    EXPECT_EQ((Face{p.shape, p.primitive}), (Face{0, 3}));
    ASSERT_TRUE(geometry.first_hit(p, {0, 0, 1}, p));
    EXPECT_EQ(p.shape, 1u);
    EXPECT_FALSE(geometry.first_hit({-2.5, 0.5, 2.0}, {0, 0, -1}, 1.5, p));
}

}  // namespace neumann::close_surfaces_test
