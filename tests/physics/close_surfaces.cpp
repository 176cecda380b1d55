// Rays among surfaces that are nearer to each other than Embree's floats can tell, against all triangles one by one in long double.
#include "core/geometry/geometry.h"
#include "core/geometry/giants.h"
#include "core/geometry/transformed.h"
#include "core/sampling/sampler.h"
#include "core/sampling/warp.h"

#include <gtest/gtest.h>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

namespace neumann::close_surfaces_test {

using Long = glm::tvec3<long double>;

struct Plane {
    Long a, e1, e2, n;  // n: unit length
};

// All triangles, one by one. No ray meets the plane it starts on.
class Brute {
public:
    explicit Brute(const Geometry& geometry) {
        for (std::uint32_t shape = 0; shape < geometry.shapes().size(); ++shape) {
            const auto& mesh = std::get<TriangleMesh>(geometry.shapes()[shape]);
            for (const auto& t : mesh.triangles) {
                const Long a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
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
SurfacePoint near_edges(const Geometry& geometry, Sampler& random) {
    const auto shape = static_cast<std::uint32_t>(random.next() * static_cast<double>(geometry.shapes().size()));
    const auto primitive = static_cast<std::uint32_t>(random.next() * geometry.primitive_count(shape));
    const auto& mesh = std::get<TriangleMesh>(geometry.shapes()[shape]);
    const auto& t = mesh.triangles[primitive];
    const int k = static_cast<int>(3.0 * random.next());
    const Vec3 &a = mesh.vertices[t[k]], &b = mesh.vertices[t[(k + 1) % 3]], &c = mesh.vertices[t[(k + 2) % 3]];
    const double along = random.next(), in = std::pow(10.0, -8.0 * random.next());
    return geometry.point_on_triangle(shape, primitive, glm::mix(glm::mix(a, b, along), c, in));
}

struct Place {
    const char* name;
    Mat4 to_world;
};
const Place places[] = {
    {"at the origin", Mat4(1.0)},
    {"turned", glm::rotate(Mat4(1.0), 1.1, glm::normalize(Vec3(1, 2, 3)))},
    {"turned and 1 km away", glm::rotate(glm::translate(Mat4(1.0), Vec3(700, -600, 400)), 1.1, glm::normalize(Vec3(1, 2, 3)))},
};

TriangleMesh quad(const Vec3& corner, const Vec3& a, const Vec3& b) {
    return {{corner, corner + a, corner + a + b, corner + b}, {{0, 1, 2}, {0, 2, 3}}};
}
TriangleMesh box(const Vec3& low, const Vec3& high) {
    return make_cube(glm::scale(glm::translate(Mat4(1.0), 0.5 * (low + high)), 0.5 * (high - low)));
}
Geometry placed(const std::vector<TriangleMesh>& meshes, const Mat4& to_world) {
    std::vector<Shape> shapes;
    for (const TriangleMesh& mesh : meshes) shapes.emplace_back(transformed(mesh, to_world));
    return Geometry(std::move(shapes));
}

// Two walls of unit height that meet at an angle, open above.
TEST(CloseSurfaces, AreMetInLongGrooves) {
    for (const Place& place : places)
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
    for (const Place& place : places)
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

TEST(CloseSurfaces, AreMetWhereBoxesTouchAndOverlap) {
    for (const Place& place : places)
        for (const double gap : {0.0, 1e-9, 1e-6}) {
            const Geometry geometry = placed({quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), box({-0.5, -0.5, gap}, {0, 0, 0.5 + gap}),
                                              box({gap, -0.4, 0}, {0.3, 0.1, 0.3}), box({-0.1, -0.1, -0.1}, {0.2, 0.2, 0.2}),
                                              box({-0.5, -0.5, 0.5 + 2 * gap}, {0, 0, 0.7})},
                                             place.to_world);
            const Counts counts = compare(geometry, 10000, 3, [&](Sampler& random) { return near_edges(geometry, random); });
            EXPECT_EQ(counts.wrong, 0) << place.name << ", gap " << gap << ", of " << counts.rays << ", close " << counts.close;
        }
}

// Embree's rays begin a rounding beside the real ones, so that by the edge of a box they may meet the face behind alone.
TEST(CloseSurfaces, AreMetInOrderAlongTheEdgesOfBoxes) {
    const TriangleMesh inner = box({0.3, 0.2, -0.8}, {0.7, 0.8, 0.1});
    TriangleMesh outer = box({-1, -1, -1}, {1, 1, 1});
    for (auto& t : outer.triangles) std::swap(t[1], t[2]);
    for (const Place& place : places) {
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
TEST(CloseSurfaces, AreMetFromOutsideWhereRaysAreAimedAtEdges) {
    constexpr double beside[] = {0.0, 0.0, 1e-6, -1e-6, 1e-9, -1e-9};
    const auto grazes = [](const Vec3& w) { return std::min({std::abs(w.x), std::abs(w.y), std::abs(w.z)}) < 1e-3; };
    for (const Place& place : places) {
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
TEST(CloseSurfaces, AreMetFromOutsideWhereRaysAreAimedAtRims) {
    for (const Place& place : places) {
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
TEST(CloseSurfaces, AreNotMetWhereRaysStartBesideAnEdge) {
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
