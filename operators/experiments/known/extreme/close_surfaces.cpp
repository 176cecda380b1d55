// Surfaces that are nearer to each other than floats of the scene's size resolve: creases, thin gaps, boxes that touch.
#include "core/sampling/sampler.h"
#include "operators/experiments/known/extreme/extremes.h"
#include "operators/experiments/known/extreme/rectangle_overhead.h"
#include "operators/experiments/known/scene_maker.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace neumann::known {

namespace {

struct Translation {
    const char* name;
    Vec3 to;
};
constexpr Translation translations[] = {{"here", {0.7, -0.6, 0.4}}, {"1km-away", {700.0, -600.0, 400.0}}};

// The rotation ensures that no face is along an axis.
Mat4 turned_and_moved(const Vec3& to) { return glm::rotate(glm::translate(Mat4(1.0), to), 1.1, glm::normalize(Vec3(1, 2, 3))); }
Vec3 moved(const Mat4& to_world, const Vec3& p) { return Vec3(to_world * glm::dvec4(p, 1.0)); }
Vec3 turned(const Mat4& to_world, const Vec3& n) { return glm::dmat3(to_world) * n; }

// The point p on a shape, made without a ray: the float nearest to the origin of a ray may be behind the surface.
SurfacePoint point_on(const Scene& scene, std::uint32_t shape, const Vec3& p) {
    SurfacePoint nearest;
    double distance = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < scene.geometry.primitive_count(shape); ++i) {
        const SurfacePoint point = scene.geometry.point_on_triangle(shape, i, p);
        if (glm::length(point.position - p) >= distance) continue;
        distance = glm::length(point.position - p);
        nearest = point;
    }
    return nearest;
}
StartPicker on_shape(const Scene& scene, std::uint32_t shape, const Vec3& p, const Vec3& normal) {
    return [start = Start{point_on(scene, shape, p), normal}](Random&) { return start; };
}

// Two walls of unit height that meet at an angle a, under the sky. A point near the crease sees a share s = sin²(a/2) of sky, and
// otherwise the other wall: K^i Le = ρ^i s (1 − s)^(i−1). At the distance p from the crease, a share p (1 + π/4)/π is missing.
void groove(Figures& figures, std::uint64_t seed, double half_length, double p, const Mat4& to_world) {
    const double rho = 0.8, a = pi / 3.0, s = 0.25;
    SceneMaker maker;
    const Vec3 corner(0, -half_length, 0), along(0, 2.0 * half_length, 0);
    const std::uint32_t floor = maker.add(transformed(parallelogram(corner, {1, 0, 0}, along), to_world), matte(rho));
    maker.add(transformed(parallelogram(corner, along, {std::cos(a), 0, std::sin(a)}), to_world), matte(rho));
    maker.parts.lights.environment = ConstantEnvironment(grey(1.0));
    const Scene scene = maker.make();
    std::vector<double> exact;
    for (int i = 1; i <= 3; ++i) exact.push_back(std::pow(rho, i) * s * std::pow(1.0 - s, i - 1));
    const StartPicker start = on_shape(scene, floor, moved(to_world, {p, 0.3, 0}), turned(to_world, {0, 0, 1}));
    for (const Technique technique : {Technique::mis, Technique::bsdf})
        figures.terms(sharp_probe(scene, start, technique, {.samples = 1024, .bounces = 3, .seed = seed}), exact, 1,
                      4.0 * 0.5684 * p);
}

// Form factors of rectangles from a point, for the corner that is nearest to it; Howell, A Catalog of Radiation Heat Transfer
// Configuration Factors, B-3 and B-4. Parallel, at distance h: the point is below the corner.
double parallel_corner(double a, double b, double h) { return 0.25 * rectangle_overhead(2.0 * a, 2.0 * b, h); }
// Perpendicular: at distance d, from the point's plane up to h, b wide.
double perpendicular_corner(double b, double h, double d) {
    const double r = std::hypot(d, h);
    return (std::atan(b / d) - d / r * std::atan(b / r)) / (2.0 * pi);
}

// A unit cube hovers above the ground under the sky: K Le = ρ (1 − F) on the ground, in front of one side's middle.
void hovering_cube(Figures& figures, std::uint64_t seed, double half_width, double gap, const Mat4& to_world) {
    const double rho = 0.5;
    SceneMaker maker;
    const TriangleMesh square = parallelogram({-half_width, -half_width, 0}, {2 * half_width, 0, 0}, {0, 2 * half_width, 0});
    const std::uint32_t ground = maker.add(transformed(square, to_world), matte(rho));
    maker.add(transformed(box({-0.5, -0.5, gap}, {0.5, 0.5, 1.0 + gap}), to_world), matte(rho));
    maker.parts.lights.environment = ConstantEnvironment(grey(1.0));
    const Scene scene = maker.make();
    const auto measure = [&](const char* where, double x, double F) {
        const StartPicker start = on_shape(scene, ground, moved(to_world, {x, 0, 0}), turned(to_world, {0, 0, 1}));
        for (const Technique technique : {Technique::mis, Technique::bsdf})
            figures.sampled(fmt::format("K Le {}, {}", where, short_name(technique)),
                            sharp_probe(scene, start, technique, {.samples = 1024, .bounces = 1, .seed = seed}).terms[1],
                            rho * (1.0 - F));
    };
    const double side = perpendicular_corner(0.5, 1.0 + gap, gap) - perpendicular_corner(0.5, gap, gap);
    const double bottom = parallel_corner(1.0 + gap, 0.5, gap) - parallel_corner(gap, 0.5, gap);
    measure("before it", 0.5 + gap, 2.0 * (side + bottom));
    measure("below it", 0.5 - gap, 2.0 * (parallel_corner(gap, 0.5, gap) + parallel_corner(1.0 - gap, 0.5, gap)));
}

const Surface glow = glowing(0.8, 1.0);
const double bounce_8 = std::pow(0.8, 8);

// A furnace: surfaces that emit alike are seen as ρ^i from everywhere, and the insides of bodies are black. The shapes
// 0 to 5 are the walls.
Scene furnace_with(const std::vector<Shape>& bodies, const Mat4& to_world) {
    SceneMaker maker;
    for (const TriangleMesh& face : room({-1, -1, 0}, {1, 1, 2})) maker.add(transformed(face, to_world), glow);
    for (const Shape& body : bodies) maker.add(transformed(body, to_world).value(), glow);
    return maker.make();
}

void bodies_in_furnace(Figures& figures, std::uint64_t seed, const std::vector<Shape>& bodies, const Mat4& to_world) {
    const Scene scene = furnace_with(bodies, to_world);
    const Statistic found = probe(scene, at(scene, moved(to_world, {0.1, -0.7, 0}), turned(to_world, {0, 0, 1})), Technique::bsdf,
                                  {.samples = 2048, .seed = seed})
                                .terms[8];
    figures.near("K^8 Le", found.mean.r, bounce_8, 64 * eps);
    figures.near("standard error", found.standard_error.r, 0.0, 0.0);
}

struct Box {
    Vec3 low, high;
    bool holds(const Vec3& p) const {
        constexpr double margin = 1e-10;
        return glm::all(glm::greaterThan(p, low - margin)) && glm::all(glm::lessThan(p, high + margin));
    }
};

// Picks points on the faces of boxes but inside no other box, more often than not at small distances from an edge.
StartPicker beside_edges(const Scene& scene, const std::vector<Box>& boxes, const Mat4& to_world) {
    return [&](Random& random) {
        for (;;) {
            const auto k = std::min(static_cast<std::size_t>(random.next() * static_cast<double>(boxes.size())), boxes.size() - 1);
            const auto axis = static_cast<glm::length_t>(3.0 * random.next()), next = (axis + 1) % 3, last = (axis + 2) % 3;
            const bool above = random.next() < 0.5, from_high = random.next() < 0.5;
            const double aside = 0.5 * std::pow(10.0, -6.0 * random.next());
            Vec3 p, normal(0.0);
            p[axis] = above ? boxes[k].high[axis] : boxes[k].low[axis];
            p[next] = glm::mix(boxes[k].low[next], boxes[k].high[next], from_high ? 1.0 - aside : aside);
            p[last] = glm::mix(boxes[k].low[last], boxes[k].high[last], random.next());
            normal[axis] = above ? 1.0 : -1.0;
            bool open = p.z > 1e-10;
            for (std::size_t i = 0; i < boxes.size(); ++i) open = open && (i == k || !boxes[i].holds(p));
            if (open)
                return Start{point_on(scene, static_cast<std::uint32_t>(6 + k), moved(to_world, p)), turned(to_world, normal)};
        }
    };
}

// A thousand rooms with five boxes each. Their faces lie in a few common planes, or a little beside them, so that boxes touch,
// overlap, and leave gaps of a millionth of the room.
void boxes_at_random(Figures& figures, std::uint64_t seed, const Mat4& to_world) {
    constexpr double beside[] = {0.0, 0.0, 1e-6, -1e-6, 1e-9, -1e-9};
    Sampler random(seed, 0);
    const auto one_of = [&](int n) { return static_cast<int>(random.next() * n); };
    int wrong = 0;
    for (std::uint64_t i = 0; i < 1000; ++i) {
        random.start(i);
        std::vector<Box> boxes(5);
        for (Box& b : boxes)
            for (glm::length_t axis = 0; axis < 3; ++axis) {
                const double from = one_of(5), to = from + 1.0 + one_of(2), first = axis == 2 ? 0.0 : -0.6;
                b.low[axis] = first + 0.2 * from + beside[one_of(6)];
                b.high[axis] = first + 0.2 * to + beside[one_of(6)];
            }
        std::vector<Shape> bodies;
        for (const Box& b : boxes) bodies.emplace_back(box(b.low, b.high));
        const Scene scene = furnace_with(bodies, to_world);
        const Statistic found = probe(scene, beside_edges(scene, boxes, to_world), Technique::bsdf,
                                      {.samples = 2, .sampler = SamplerKind::independent, .seed = seed + i})
                                    .terms[8];
        wrong += std::abs(found.mean.r - bounce_8) > 64 * eps || found.standard_error.r != 0.0;
    }
    figures.near("rooms of 1000 that lose light", wrong, 0.0, 0.0);
}

}  // namespace

Cases extreme_close_cases() {
    Cases cases;
    for (const Translation& translation : translations) {
        const Mat4 to_world = turned_and_moved(translation.to);
        for (const double half_length : {20.0, 2e4})
            for (const double p : {1e-3, 1e-6})
                cases.push_back({fmt::format("extreme/close/groove-{:g}-{:g}-{}", half_length, p, translation.name),
                                 "rho^i s (1-s)^(i-1), s = sin^2(a/2)",
                                 [=](Figures& figures, std::uint64_t seed) { groove(figures, seed, half_length, p, to_world); }});
        for (const double half_width : {10.0, 1e3, 1e6})
            for (const double gap : {1e-3, 1e-6})
                cases.push_back({fmt::format("extreme/close/cube-{:g}-above-{:g}-{}", gap, half_width, translation.name),
                                 "form factors of rectangles: exact", [=](Figures& figures, std::uint64_t seed) {
                                     hovering_cube(figures, seed, half_width, gap, to_world);
                                 }});
        for (const double gap : {0.0, 1e-6, -1e-6})
            cases.push_back({fmt::format("extreme/close/boxes-{:g}-apart-{}", gap, translation.name), "rho^i: exact",
                             [=](Figures& figures, std::uint64_t seed) {
                                 bodies_in_furnace(
                                     figures, seed,
                                     {box({-0.5, -0.5, gap}, {0, 0, 0.5}), box({gap, -0.4, 0}, {0.3, 0.1, 0.3}),
                                      box({-0.5, -0.5, 0.5 + gap}, {0, 0, 0.7}), box({1.0 - 0.2, 0.3, 0.3}, {1.0 - gap, 0.5, 0.5})},
                                     to_world);
                             }});
        cases.push_back({fmt::format("extreme/close/boxes-at-random-{}", translation.name), "rho^i: exact",
                         [=](Figures& figures, std::uint64_t seed) { boxes_at_random(figures, seed, to_world); }});
        // A sphere that touches the floor, one sunk into a wall, two that overlap, and a closed cylinder on the floor.
        cases.push_back(
            {fmt::format("extreme/close/round-{}", translation.name), "rho^i: exact", [=](Figures& figures, std::uint64_t seed) {
                 const double r = 0.25;
                 bodies_in_furnace(figures, seed,
                                   {Sphere{{0.5, 0.5, r}, r}, Sphere{{0.9, -0.5, 0.4}, r}, Sphere{{-0.5, 0.5, 1}, r},
                                    Sphere{{-0.4, 0.6, 1.1}, r}, Cylinder{.base = {-0.5, -0.4, 0}, .length = 0.5, .radius = r},
                                    Disk{{-0.5, -0.4, 0.5}, {r, 0, 0}, {0, r, 0}, {0, 0, 1}}},
                                   to_world);
             }});
    }
    return cases;
}

}  // namespace neumann::known
