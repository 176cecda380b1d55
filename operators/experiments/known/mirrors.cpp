// Mirrors: light follows a single path, which geometry gives, and every term is a product along it. Samples have no
// variance, whatever the technique for direct light.
#include "core/material/retroreflector.h"
#include "core/sampling/warp.h"
#include "operators/experiments/known/groups.h"
#include "operators/experiments/known/scene_maker.h"

#include <fmt/format.h>
#include <algorithm>
#include <stdexcept>

namespace neumann::known {

namespace {

constexpr double mirror_rho = 0.9;

Conductor mirror() { return Conductor({}, grey(mirror_rho)); }
// Few samples are enough, because all must be equal. Pointwise operators start again for every term, so they have fewer bounces.
ProbeSettings probe_settings(Technique technique, int bounces, std::uint64_t seed) {
    return {.samples = 2, .bounces = technique == Technique::pointwise ? std::min(bounces, 12) : bounces, .seed = seed};
}

// Figures for the first and the last few terms, and for the worst of all.
void add_terms(Figures& figures, const Estimates& found, const std::function<double(int)>& exact, double tolerance) {
    double worst = 0.0, spread = 0.0;
    const int last = static_cast<int>(found.terms.size()) - 1;
    for (int i = 0; i <= last; ++i) {
        const Statistic& term = found.terms[static_cast<std::size_t>(i)];
        worst = std::max(worst, std::abs(term.mean.r - exact(i)));
        spread = std::max(spread, term.standard_error.r);
        if (i >= 1 && (i <= 4 || i == last)) figures.near(fmt::format("K^{} Le", i), term.mean.r, exact(i), tolerance);
    }
    figures.near(fmt::format("largest error, i <= {}", last), worst, 0.0, tolerance);
    figures.near("largest standard error", spread, 0.0, 0.0);
}

// A ray in a cube of mirrors goes straight on through the cube's mirror images. Le is the position, as a colour, so
// that a face is recognised by its 0 or 1.
void unfold(Figures& figures, Technique technique, std::uint64_t seed) {
    const Vec3 origin(0.3, 0.4, 0.5), direction(1.0, 0.7, 0.45);
    constexpr int faces[] = {1, 3, 5, 0, 2, 1, 4, 0, 3, 1, 2, 5, 0, 3, 1, 0, 4, 2, 1, 3, 0,
                             5, 1, 2, 0, 4, 3, 1, 0, 2, 5, 1, 3, 0, 2, 4, 1, 0, 3, 1, 5};
    // The points where the unfolded ray crosses the i-th wall, folded back.
    std::vector<double> crossings;
    for (int axis = 0; axis < 3; ++axis)
        for (int wall = 1; wall <= 60; ++wall) crossings.push_back((wall - origin[axis]) / direction[axis]);
    std::sort(crossings.begin(), crossings.end());
    SceneMaker maker;
    for (const TriangleMesh& face : room({0, 0, 0}, {1, 1, 1}))
        maker.add(face, made_of(mirror(), AreaLight([](const ShadingPoint& p, const Vec3&) { return p.position; }, grey(1.0))));
    const Scene scene = maker.make();
    const Estimates found = probe(scene, seen(scene, origin, direction), technique, probe_settings(technique, 40, seed));
    double worst = 0.0;
    int wrong_faces = 0;
    for (std::size_t i = 0; i < found.terms.size(); ++i) {
        const Vec3 x = origin + direction * crossings.at(i), folded = glm::abs(x - 2.0 * glm::round(0.5 * x));
        const double weight = std::pow(mirror_rho, static_cast<double>(i));
        worst = std::max(worst, max_component(glm::abs(found.terms[i].mean - weight * folded)));
        const int axis = faces[i] / 2, side = faces[i] % 2;
        wrong_faces += std::abs(found.terms[i].mean[axis] - side * weight) > 1e-12;
    }
    figures.near(fmt::format("wrong faces of {}", found.terms.size()), wrong_faces, 0.0, 0.0);
    figures.near("largest error of rho^i Le(face i)", worst, 0.0, 1e-12);
}

// In a sphere a ray goes round in steps α = π − 2θ: Le = 1 + cos 3φ gives K^i Le = ρ^i (1 + cos 3iα). The eigenvalues are complex.
void rotate(Figures& figures, Technique technique, std::uint64_t seed) {
    const double theta = 37.0 * pi / 180.0, alpha = pi - 2.0 * theta;
    SceneMaker maker;
    const auto emitted = [](const ShadingPoint& p, const Vec3&) {
        return grey(1.0 + std::cos(3.0 * std::atan2(p.position.y, p.position.x)));
    };
    maker.add(Sphere{{0, 0, 0}, 1.0, true}, made_of(mirror(), AreaLight(emitted, grey(2.0))));
    const Scene scene = maker.make();
    const Vec3 towards(-std::cos(theta), std::sin(theta), 0.0);
    const auto exact = [&](int i) { return std::pow(mirror_rho, i) * (1.0 + std::cos(3.0 * i * alpha)); };
    const Estimates found =
        probe(scene, seen(scene, Vec3(1, 0, 0) + 0.5 * towards, -towards), technique, probe_settings(technique, 60, seed));
    add_terms(figures, found, exact, 1e-10);
    if (technique == Technique::pointwise) return;
    // The terms beyond 60 add at most 2 ρ^61/(1 − ρ).
    double sum = 0.0;
    for (const Statistic& term : found.terms) sum += term.mean.r;
    figures.near("sum of 61 terms of the total", sum, 10.701126599366, 2.0 * std::pow(mirror_rho, 61) / (1.0 - mirror_rho));
}

// In a prism over an equilateral triangle the path through the middles of the sides closes after three bounces.
void go_round(Figures& figures, Technique technique, std::uint64_t seed) {
    const Vec3 corner[] = {{1, 0, 0}, {-0.5, std::sqrt(0.75), 0}, {-0.5, -std::sqrt(0.75), 0}};
    SceneMaker maker;
    for (int side = 0; side < 3; ++side) {
        const Vec3 a = corner[side], b = corner[(side + 1) % 3];
        maker.add(parallelogram(a - Vec3(0, 0, 1), Vec3(0, 0, 2.5), b - a),
                  made_of(mirror(), side == 0 ? std::optional<AreaLight>(grey(1.0)) : std::nullopt));
    }
    const Scene scene = maker.make();
    const Vec3 middle = 0.5 * (corner[0] + corner[1]), before = 0.5 * (corner[2] + corner[0]);
    add_terms(
        figures,
        probe(scene, seen(scene, before + 0.1 * (middle - before), middle - before), technique,
              probe_settings(technique, 36, seed)),
        [](int i) { return i % 3 == 0 ? std::pow(mirror_rho, i) : 0.0; }, 8 * 36 * std::numeric_limits<double>::epsilon());
}

// m mirrors at 45° in a zigzag, and a lamp behind the last one: the only term is K^m Le = ρ^m Le; if the mirrors emit
// e, the terms before it are K^i Le = ρ^i e.
void look_round_corners(Figures& figures, Technique technique, std::uint64_t seed, int m, double glow) {
    SceneMaker maker;
    // Follows the light along +x into the first mirror, up to the second, along +x, …
    Vec3 at(0.0), along(1, 0, 0), across(0, 0, 1);
    for (int k = 0; k < m; ++k) {
        maker.add(patch(at, glm::normalize(across - along), 0.3),
                  made_of(mirror(), glow > 0.0 ? std::optional<AreaLight>(grey(glow)) : std::nullopt));
        std::swap(along, across);
        at += along;
    }
    maker.add(patch(at, -along, 0.2), lamp(2.0));
    const Scene scene = maker.make();
    const Estimates found = probe(scene, seen(scene, {-1, 0.01, 0.02}, {1, 0, 0}), technique, probe_settings(technique, 8, seed));
    for (int i = 0; i <= 8; ++i) {
        const double seen = i < m ? glow : i == m ? 2.0 : 0.0;
        figures.near(fmt::format("K^{} Le", i), found.terms.at(static_cast<std::size_t>(i)).mean.r, seen * std::pow(mirror_rho, i),
                     seen > 0.0 ? 64.0 * std::numeric_limits<double>::epsilon() : 0.0);
    }
}

// Retroreflectors: K = ρ T, so that K² = ρ² I shows T² = I, for any place and direction.
void go_back(Figures& figures, Technique technique, std::uint64_t seed) {
    SceneMaker maker;
    const auto emitted = [](const ShadingPoint& p, const Vec3& w) { return grey(2.0 + p.position.x * p.position.y + 0.5 * w.z); };
    for (const TriangleMesh& face : room({-0.7, -1.1, -0.9}, {0.8, 1.2, 1.3}))
        maker.add(face, made_of(Retroreflector(grey(mirror_rho)), AreaLight(emitted, grey(5.0))));
    const Scene scene = maker.make();
    const Vec3 origin(0.1, 0.2, 0.3), d = glm::normalize(Vec3(0.3, -0.5, 0.7));
    SurfacePoint here, there;
    if (!scene.geometry.first_hit(origin, d, 1e9, here) || !scene.geometry.first_hit(origin, -d, 1e9, there))
        throw std::logic_error("the room has a hole");
    const auto Le = [](const SurfacePoint& p, const Vec3& w) { return 2.0 + p.position.x * p.position.y + 0.5 * w.z; };
    const double first = Le(here, -d), second = Le(there, d);
    add_terms(
        figures, probe(scene, seen(scene, origin, d), technique, probe_settings(technique, 30, seed)),
        [=](int i) { return std::pow(mirror_rho, i) * (i % 2 ? second : first); }, 1e-12);
}

// Two convex mirrors that face each other: an error grows by 1 + L/R + √((1 + L/R)² − 1) a bounce, 2 + √3 here, until
// it reaches the size of the mirrors. This is the largest eigenvalue of a trip from mirror to mirror; it is measured
// between two rays that start 1e-12 apart.
void diverge(Figures& figures, std::uint64_t) {
    SceneMaker maker;
    maker.add(Sphere{{-1.5, 0, 0}, 1.0, false}, made_of(mirror()));
    maker.add(Sphere{{1.5, 0, 0}, 1.0, false}, made_of(mirror()));
    const Scene scene = maker.make();
    // The height at which a ray of slight slope meets its mirror at the n-th bounce.
    const auto heights = [&](double start) {
        std::vector<double> all;
        Vec3 o(0, start, 0), w(1, 0, 0);
        SurfacePoint p;
        bool found = scene.geometry.first_hit(o, w, 1e9, p);
        for (int n = 0; n < 12; ++n) {
            if (!found) throw std::logic_error("the ray left the mirrors");
            all.push_back(p.position.y);
            const Vec3 normal = p.normal;
            w = w - 2.0 * glm::dot(w, normal) * normal;
            found = scene.geometry.first_hit(p, w, p);
        }
        return all;
    };
    const std::vector<double> y = heights(1e-12);
    for (const std::size_t n : {4, 8, 11})
        figures.near(fmt::format("growth at bounce {}", n), y[n] / y[n - 1], 2.0 + std::sqrt(3.0), n == 4 ? 2e-3 : 1e-6);
}

}  // namespace

Cases mirror_cases() {
    Cases cases;
    for (const Technique technique : specular_techniques) {
        const std::string name = short_name(technique);
        cases.push_back({"mirrors/cube/" + name, "unfolding: exact",
                         [technique](Figures& f, std::uint64_t seed) { unfold(f, technique, seed); }});
        cases.push_back({"mirrors/sphere/" + name, "rho^i (1 + cos 3 i alpha): exact",
                         [technique](Figures& f, std::uint64_t seed) { rotate(f, technique, seed); }});
        cases.push_back({"mirrors/triangle/" + name, "rho^i every third bounce, else 0: exact",
                         [technique](Figures& f, std::uint64_t seed) { go_round(f, technique, seed); }});
        for (const int m : {1, 5})
            cases.push_back({fmt::format("mirrors/periscope-{}/{}", m, name), "rho^m Le at bounce m, else 0: exact",
                             [=](Figures& f, std::uint64_t seed) { look_round_corners(f, technique, seed, m, 0.0); }});
        cases.push_back({"mirrors/glowing-periscope/" + name, "rho^i e, and rho^m Le at bounce m: exact",
                         [=](Figures& f, std::uint64_t seed) { look_round_corners(f, technique, seed, 5, 0.7); }});
        cases.push_back({"mirrors/retroreflectors/" + name, "K^2 = rho^2 I: exact",
                         [technique](Figures& f, std::uint64_t seed) { go_back(f, technique, seed); }});
    }
    cases.push_back({"mirrors/facing-convex", "error grows by 2 + sqrt 3 a bounce: exact", diverge});
    return cases;
}

}  // namespace neumann::known
