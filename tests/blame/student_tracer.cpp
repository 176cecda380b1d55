#include "tests/blame/student_tracer.h"

#include "operators/experiments/known/scene_maker.h"

#include <oneapi/tbb/parallel_for.h>

#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace neumann::blame_test {

namespace {

struct Quad {
    Vec3 corner, a, b;
    Rgb albedo{0.0}, light{0.0};
};

// x to the left as the camera sees it, y up, z away from it. The front is that of a × b.
const std::array<Quad, 12> room = {{
    {{-1, 0, 0}, {0, 0, 2}, {2, 0, 0}, {0.7, 0.65, 0.5}, {}},              // what one stands on
    {{-1, 2, 0}, {2, 0, 0}, {0, 0, 2}, {0.6, 0.65, 0.75}, {}},             // above
    {{-1, 0, 2}, {0, 2, 0}, {2, 0, 0}, {0.75, 0.75, 0.7}, {}},             // opposite
    {{1, 0, 0}, {0, 0, 2}, {0, 2, 0}, {0.75, 0.2, 0.3}, {}},               // on the left
    {{-1, 0, 0}, {0, 2, 0}, {0, 0, 2}, {0.2, 0.45, 0.7}, {}},              // on the right
    {{-0.5, 1.6, 0.7}, {0.6, 0, 0}, {0, -0.2, 0.7}, {}, {15, 12, 8}},      // the lamp
    {{-0.7, 0.7, 0.7}, {0, 0, 0.7}, {0.6, 0, 0}, {0.5, 0.7, 0.4}, {}},     // a block: its top,
    {{-0.7, 0, 0.7}, {0, 0.7, 0}, {0.6, 0, 0}, {0.5, 0.7, 0.4}, {}},       // near side,
    {{-0.1, 0, 0.7}, {0, 0.7, 0}, {0, 0, 0.7}, {0.5, 0.7, 0.4}, {}},       // left
    {{-0.7, 0, 0.7}, {0, 0, 0.7}, {0, 0.7, 0}, {0.5, 0.7, 0.4}, {}},       // and right
    {{0.7, 0.2, 1.0}, {-0.4, 0, 0.5}, {0, 0.9, 0}, {0.35, 0.3, 0.8}, {}},  // a plate that the camera sees from behind,
    {{0.7, 0.2, 1.0}, {0, 0.9, 0}, {-0.4, 0, 0.5}, {0.8, 0.7, 0.3}, {}},   // and from the front
}};
constexpr std::size_t left_wall = 3, lamp = 5;
const Vec3 eye(-0.1, 1.0, -3.0);
constexpr double field_of_view = 0.62;

struct Hit {
    const Quad* quad = nullptr;
    double t = std::numeric_limits<double>::infinity();
};
Hit nearest(const Vec3& from, const Vec3& w) {
    Hit hit;
    for (const Quad& q : room) {
        const Vec3 n = glm::cross(q.a, q.b), d = q.corner - from;
        const double along = glm::dot(n, w), t = glm::dot(n, d) / along;
        if (!(t > 1e-6 && t < hit.t)) continue;
        const Vec3 p = w * t - d;
        const double u = glm::dot(glm::cross(p, q.b), n) / glm::dot(n, n), v = glm::dot(glm::cross(q.a, p), n) / glm::dot(n, n);
        if (u < 0.0 || u > 1.0 || v < 0.0 || v > 1.0) continue;
        hit = {&q, t};
    }
    return hit;
}

double next(std::mt19937_64& numbers) { return static_cast<double>(numbers() >> 11) * 0x1p-53; }
double largest(const Rgb& c) { return std::max({c.r, c.g, c.b}); }

}  // namespace

std::vector<Image> StudentTracer::sums(int resolution, int bounces, int samples, std::uint64_t seed) const {
    std::vector<Image> pictures;
    for (int last = 0; last <= bounces; ++last) {
        Image& picture = pictures.emplace_back(resolution, resolution);
        oneapi::tbb::parallel_for(0, resolution, [&](int y) {
            Numbers numbers((seed * 100 + static_cast<std::uint64_t>(last)) * 10000 + static_cast<std::uint64_t>(y));
            for (int x = 0; x < resolution; ++x) {
                Rgb sum(0.0);
                for (int i = 0; i < samples; ++i) {
                    const double across = (x + next(numbers)) / resolution, down = (y + next(numbers)) / resolution;
                    sum += trace(across, down, last, numbers);
                }
                picture.at(x, y) = sum / static_cast<double>(samples);
            }
        });
    }
    return pictures;
}

Rgb StudentTracer::trace(double across, double down, int bounces, Numbers& numbers) const {
    const double reach = std::tan(slip_ == Slip::half_angle ? field_of_view : 0.5 * field_of_view);
    Vec3 from = eye, w = glm::normalize(Vec3((1.0 - 2.0 * across) * reach, (1.0 - 2.0 * down) * reach, 1.0));
    Rgb sum(0.0), beta(1.0);
    for (int bounce = 0;; ++bounce) {
        const Hit hit = nearest(from, w);
        if (!hit.quad) return sum;
        const Vec3 n = glm::normalize(glm::cross(hit.quad->a, hit.quad->b));
        if (glm::dot(n, w) >= 0.0) return sum;
        if (bounce == 0 || !samples_lamp_ || (slip_ == Slip::emission_at_bounce_1 && bounce == 1)) sum += beta * hit.quad->light;
        if (bounce == bounces) return sum;
        Rgb albedo = hit.quad->albedo;
        if (slip_ == Slip::swapped_wall && hit.quad == &room[left_wall]) std::swap(albedo.r, albedo.g);
        if (bounce >= 1 && !survives(beta, albedo, numbers)) return sum;
        from += w * hit.t;
        if (samples_lamp_ && !(slip_ == Slip::no_samples_at_the_end && bounce + 1 == bounces))
            sum += beta * direct_light(from, n, albedo, numbers);
        Rgb weight(0.0);
        w = next_direction(n, albedo, weight, numbers);
        beta *= weight;
        if (largest(beta) <= 0.0) return sum;
    }
}

Rgb StudentTracer::direct_light(const Vec3& x, const Vec3& n, const Rgb& albedo, Numbers& numbers) const {
    const Quad& q = room[lamp];
    const Vec3 y = q.corner + q.a * next(numbers) + q.b * next(numbers), d = y - x, across = glm::cross(q.a, q.b);
    const double distance = glm::length(d), area = glm::length(across);
    const Vec3 w = d / distance;
    const double here = glm::dot(n, w), there = -glm::dot(across, w) / area;
    if (here <= 0.0 || there <= 0.0 || nearest(x, w).t < distance - 1e-6) return Rgb(0.0);
    const double fall = slip_ == Slip::inverse_distance ? distance : distance * distance;
    const double times = slip_ == Slip::no_area ? 1.0 : slip_ == Slip::over_area ? 1.0 / area : area;
    return q.light * albedo * (inv_pi * here * there / fall * times);
}

Vec3 StudentTracer::next_direction(const Vec3& n, const Rgb& albedo, Rgb& weight, Numbers& numbers) const {
    const double u = next(numbers), v = next(numbers);
    const bool is_uniform = slip_ == Slip::next_no_cosine || slip_ == Slip::uniform_as_cosine || slip_ == Slip::whole_sphere;
    double cosine = is_uniform ? u : std::sqrt(1.0 - u);
    if (slip_ == Slip::even_theta) cosine = std::cos(0.5 * pi * u);
    if (slip_ == Slip::whole_sphere) cosine = 2.0 * u - 1.0;
    const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0)), phi = (slip_ == Slip::half_hemisphere ? pi : 2.0 * pi) * v;
    // By the cosine the weight is the albedo.
    weight = albedo;
    switch (slip_) {
        case Slip::next_no_cosine:
            weight *= 2.0;
            break;
        case Slip::next_cosine_squared:
            weight *= cosine;
            break;
        case Slip::cosine_as_uniform:
        case Slip::even_theta:
            weight *= 2.0 * cosine;
            break;
        case Slip::whole_sphere:
            weight *= cosine > 0.0 ? 2.0 * cosine : 0.0;
            break;
        case Slip::no_pi_next:
            weight *= inv_pi;
            break;
        case Slip::albedo_squared_next:
            weight *= albedo;
            break;
        case Slip::white_next:
            weight = largest(albedo) > 0.0 ? Rgb(1.0) : Rgb(0.0);
            break;
        default:
            break;
    }
    const Vec3 s = glm::normalize(glm::cross(std::abs(n.x) > 0.1 ? Vec3(0, 1, 0) : Vec3(1, 0, 0), n)), t = glm::cross(n, s);
    return s * (sine * std::cos(phi)) + t * (sine * std::sin(phi)) + n * cosine;
}

bool StudentTracer::survives(Rgb& beta, const Rgb& albedo, Numbers& numbers) const {
    double p = std::min(largest(beta), 0.95);
    if (slip_ == Slip::roulette_constant) p = 0.7;
    if (slip_ == Slip::roulette_albedo) p = largest(albedo);
    if (next(numbers) >= p) return false;
    switch (slip_) {
        case Slip::roulette_constant:
        case Slip::roulette_albedo:
            return true;
        case Slip::roulette_one_minus:
            beta /= 1.0 - p;
            return true;
        case Slip::roulette_squared:
            beta /= p * p;
            return true;
        default:
            beta /= p;
            return true;
    }
}

Scene student_room(int resolution) {
    known::SceneMaker maker;
    for (const Quad& q : room)
        maker.add(known::parallelogram(q.corner, q.a, q.b), largest(q.light) > 0.0
                                                                ? known::Surface{std::nullopt, AreaLight(q.light)}
                                                                : known::Surface{q.albedo, std::nullopt});
    maker.parts.camera.to_world = glm::translate(Mat4(1.0), eye);
    maker.parts.camera.fov = field_of_view;
    maker.parts.film = {
        .width = resolution, .height = resolution, .crop_width = resolution, .crop_height = resolution, .filter = BoxFilter()};
    return maker.make();
}

}  // namespace neumann::blame_test
