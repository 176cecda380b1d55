#include "tests/blame/wrong_tracer.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <stdexcept>
#include <utility>

namespace neumann::blame_test {

namespace {

// The share of light that a boundary between two media reflects, for unpolarised light; η: the refractive index beyond it over that
// on this side.
double fresnel(double cosine, double eta) {
    const double sine2 = (1.0 - cosine * cosine) / (eta * eta);
    if (sine2 >= 1.0) return 1.0;
    const double beyond = std::sqrt(1.0 - sine2);
    const double across = (cosine - eta * beyond) / (cosine + eta * beyond),
                 along = (eta * cosine - beyond) / (eta * cosine + beyond);
    return 0.5 * (across * across + along * along);
}
Vec3 mirrored(const Vec3& w, const Vec3& n) { return w - 2.0 * glm::dot(w, n) * n; }
// By Snell's law; n on the side that w comes from, no total reflection.
Vec3 refracted(const Vec3& w, const Vec3& n, double eta) {
    const double cosine = -glm::dot(w, n);
    return glm::normalize((w + n * cosine) / eta - n * std::sqrt(1.0 - (1.0 - cosine * cosine) / (eta * eta)));
}

double srgb_encoded(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055; }

// A tenth of what a lamp in blame_room() has; takes 5 to 10% of its bounce 2.
const Rgb largest_sample(1.0);

}  // namespace

// Numbers in [0, 1), independent of each other; `strata` above 1: the first of each of so many samples are stratified.
class WrongTracer::Numbers {
public:
    Numbers(std::uint64_t seed, int strata) : engine_(seed), strata_(strata) {}
    void start(int sample) {
        sample_ = sample;
        dimension_ = 0;
    }
    double next() {
        constexpr std::size_t stratified = 12;
        const double u = static_cast<double>(engine_() >> 11) * 0x1p-53;
        if (strata_ < 2 || dimension_ == stratified) return u;
        if (dimension_ == orders_.size()) {
            std::vector<int>& order = orders_.emplace_back(static_cast<std::size_t>(strata_));
            std::iota(order.begin(), order.end(), 0);
            std::shuffle(order.begin(), order.end(), engine_);
        }
        return (orders_[dimension_++][static_cast<std::size_t>(sample_)] + u) / strata_;
    }

private:
    std::mt19937_64 engine_;
    int strata_, sample_ = 0;
    std::size_t dimension_ = 0;
    std::vector<std::vector<int>> orders_;
};

WrongTracer::WrongTracer(const Scene& scene, Bug bug, Sampling sampling) : scene_(scene), bug_(bug), sampling_(sampling) {
    const Geometry& geometry = scene_.geometry;
    for (std::uint32_t shape = 0; shape < geometry.shapes().size(); ++shape) {
        if (!scene_.emitters.is_emitter(shape)) continue;
        for (std::uint32_t i = 0; i < geometry.primitive_count(shape); ++i) {
            lamp_.push_back({geometry.primitive_ref(shape, i), lamp_area_});
            lamp_area_ += geometry.area(shape, i);
        }
    }
}

std::vector<Image> WrongTracer::sums(int bounces, int samples, std::uint64_t seed) const {
    std::vector<Image> pictures;
    for (int i = 0; i <= bounces; ++i) pictures.push_back(picture(i, samples, seed));
    return pictures;
}

Image WrongTracer::picture(int bounces, int samples, std::uint64_t seed) const {
    const int width = scene_.film.width, height = scene_.film.height;
    Image picture(width, height);
    oneapi::tbb::parallel_for(0, height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            std::seed_seq words{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                                static_cast<std::uint32_t>(bounces), sampling_.one_stream ? 0 : static_cast<std::uint32_t>(x),
                                sampling_.one_stream ? 0 : static_cast<std::uint32_t>(y)};
            std::uint32_t mixed[2];
            words.generate(mixed, mixed + 2);
            Numbers numbers(std::uint64_t{mixed[0]} << 32 | mixed[1], sampling_.stratified ? samples : 1);
            Rgb sum(0.0);
            for (int i = 0; i < samples; ++i) {
                numbers.start(i);
                const double across = numbers.next(), down = numbers.next();
                sum += trace({x + across, y + down}, bounces, numbers);
            }
            Rgb& pixel = picture.at(x, y);
            pixel = sum / static_cast<double>(samples);
            // The picture is stored as a screen wants it, in a format that promises linear values.
            if (bug_ == Bug::gamma) pixel = {srgb_encoded(pixel.r), srgb_encoded(pixel.g), srgb_encoded(pixel.b)};
        }
    });
    return picture;
}

// One sample of the sum of bounces 0 … `bounces`.
Rgb WrongTracer::trace(Vec2 position, int bounces, Numbers& numbers) const {
    // Pixels are taken to be around their index, and samples to be within them.
    if (bug_ == Bug::half_pixel) position += 0.5;
    // The camera's x is taken to point to the right.
    if (bug_ == Bug::flipped_x) position.x = scene_.film.width - position.x;
    const CameraRay ray = scene_.camera.ray(position);
    Vec3 w = ray.direction;
    SurfacePoint hit;
    if (!scene_.geometry.first_hit(ray.origin, w, ray.length, hit)) return Rgb(0.0);

    Rgb sum(0.0), beta(1.0);
    const auto add = [&](int bounce, Rgb light) {
        // Against fireflies.
        if (bug_ == Bug::clamped && bounce >= 2) light = glm::min(light, largest_sample);
        sum += light;
    };
    // Whether no point of a lamp could have been asked for this direction, and otherwise how dense directions are.
    bool alone = true;
    double density = 0.0;
    Vec3 from = ray.origin;
    for (int bounce = 0;; ++bounce) {
        const bool in_front = glm::dot(hit.normal, w) < 0.0;
        const Vec3 n = in_front ? hit.normal : -hit.normal;
        const double cosine = -glm::dot(n, w);
        // Le is asked for without looking on which side.
        if (scene_.emitters.is_emitter(hit.shape) && (in_front || bug_ == Bug::two_sided_light)) {
            const Vec3 d = hit.position - from;
            double weight = alone || sampling_.lamps == Sampling::Lamps::hit ? 1.0
                            : sampling_.lamps == Sampling::Lamps::hemisphere
                                ? 0.0
                                : mis_weight(density, lamp_density(glm::dot(d, d), cosine));
            // Lamps are in the list of lights and not among the surfaces that shine.
            if (bug_ == Bug::no_emission && bounce == 0) weight = 0.0;
            // The lamp is taken to have been asked at the surface before, which a mirror does not do.
            if (bug_ == Bug::no_light_after_mirror && bounce > 0 && alone) weight = 0.0;
            add(bounce, beta * scene_.emitters.even_radiance(hit.shape) * weight);
        }
        if (bounce == bounces) return sum;

        // From here on the walk works for bounce + 1.
        if (sampling_.roulette && bounce + 1 >= 3) {
            const double survival = std::min(max_component(beta), 0.95);
            if (numbers.next() >= survival) return sum;
            // Those that go on do not stand for those that ended.
            if (bug_ != Bug::roulette_unweighted) beta /= survival;
        }
        const auto [bsdf, p] = scene_.materials.side(hit, -w);
        if (!bsdf) return sum;
        from = hit.position;
        if (const auto* diffuse = std::get_if<Diffuse>(bsdf)) {
            // cosθ is clamped at zero with the front's normal, also where the wall has two sides.
            if (bug_ == Bug::one_sided_walls && !in_front) return sum;
            const Rgb brdf = diffuse_brdf(diffuse->reflectance(p));
            if (sampling_.lamps == Sampling::Lamps::sampled) add(bounce + 1, beta * direct_light(hit, n, brdf, numbers));
            if (sampling_.lamps == Sampling::Lamps::hemisphere)
                add(bounce + 1, beta * light_by_hemisphere(hit, p.frame, brdf, numbers));
            // By the cosine: the points above a disc.
            const double radius2 = numbers.next(), angle = 2.0 * pi * numbers.next(), radius = std::sqrt(radius2);
            const double up = std::sqrt(1.0 - radius2);
            w = p.frame.to_world({radius * std::cos(angle), radius * std::sin(angle), up});
            density = up / pi;
            beta *= brdf * up / density;
            alone = false;
        } else if (const auto* mirror = std::get_if<Conductor>(bsdf)) {
            w = mirrored(w, n);
            beta *= mirror->reflectance(p);
            alone = true;
        } else if (const auto* glass = std::get_if<Dielectric>(bsdf)) {
            const double eta = glass->refractive_ratio();
            if (numbers.next() < fresnel(cosine, eta)) {
                w = mirrored(w, n);
            } else {
                w = refracted(w, n, eta);
                beta /= eta * eta;
            }
            alone = true;
        } else {
            throw std::invalid_argument("The wrong tracer knows diffuse surfaces, mirrors and glass only.");
        }
        if (!scene_.geometry.first_hit(hit, w, hit)) return sum;
    }
}

// Light from a point on a lamp, reflected at x, whose `normal` is on the side that is seen.
Rgb WrongTracer::direct_light(const SurfacePoint& x, const Vec3& normal, const Rgb& brdf, Numbers& numbers) const {
    const SurfacePoint y = point_on_lamp(numbers);
    const Vec3 d = y.position - x.position;
    const double distance2 = glm::dot(d, d);
    const Vec3 w = d / std::sqrt(distance2);
    const double here = glm::dot(normal, w);
    double there = -glm::dot(y.normal, w);
    // The cosine's absolute value is taken, against negative light.
    if (bug_ == Bug::two_sided_light) there = std::abs(there);
    if (here <= 0.0 || there <= 0.0) return Rgb(0.0);
    // The shadow ray is forgotten.
    if (bug_ != Bug::no_shadows && !scene_.geometry.visible(x, y)) return Rgb(0.0);

    const double density = lamp_density(distance2, there);
    Rgb light = brdf * scene_.emitters.even_radiance(y.shape) * (here / density * mis_weight(density, here / pi));
    // The cosine is taken for a part of the BRDF.
    if (bug_ == Bug::no_cosine) light /= here;
    // The cosine is in the BRDF and in the integral.
    if (bug_ == Bug::cosine_squared) light *= here;
    // The lamp is two triangles, and the density that of one of them.
    if (bug_ == Bug::half_area) light *= 0.5;
    // The lamp does not become weaker with distance, and has been made as strong as it should be in the middle of the room.
    if (bug_ == Bug::no_inverse_square) light *= distance2 / (scene_.geometry.radius() * scene_.geometry.radius());
    return light;
}

// Light from a direction uniform over the hemisphere, reflected at x.
Rgb WrongTracer::light_by_hemisphere(const SurfacePoint& x, const Frame& frame, const Rgb& brdf, Numbers& numbers) const {
    const double up = numbers.next(), angle = 2.0 * pi * numbers.next(), radius = std::sqrt(1.0 - up * up);
    const Vec3 w = frame.to_world({radius * std::cos(angle), radius * std::sin(angle), up});
    SurfacePoint y;
    if (!scene_.geometry.first_hit(x, w, y) || !scene_.emitters.is_emitter(y.shape) || glm::dot(y.normal, w) >= 0.0)
        return Rgb(0.0);
    return brdf * scene_.emitters.even_radiance(y.shape) * (2.0 * pi * up);
}

// Uniform by area on all lamps.
SurfacePoint WrongTracer::point_on_lamp(Numbers& numbers) const {
    const double area = lamp_area_ * numbers.next();
    const auto after =
        std::partition_point(lamp_.begin(), lamp_.end(), [&](const LampFace& face) { return face.area_before <= area; });
    const double u = numbers.next(), v = numbers.next();
    return scene_.geometry.point(std::prev(after)->place, {u, v});
}

// Per solid angle, of a point on a lamp seen from x.
double WrongTracer::lamp_density(double distance2, double cosine) const {
    // dω = cosθ dA / d² is written dA / d².
    if (bug_ == Bug::no_light_cosine) return distance2 / lamp_area_;
    return distance2 / (cosine * lamp_area_);
}

Rgb WrongTracer::diffuse_brdf(const Rgb& albedo) const {
    switch (bug_) {
        case Bug::missing_pi:  // The albedo is taken for the BRDF.
            return albedo;
        case Bug::extra_pi:  // Both the material and the integrator divide by π.
            return albedo / (pi * pi);
        case Bug::albedo_squared:  // Both the material and the integrator multiply by the albedo.
            return albedo * albedo / pi;
        case Bug::albedo_missing:  // The texture was not loaded.
            return Rgb(1.0 / pi);
        default:
            return albedo / pi;
    }
}

// The power heuristic.
double WrongTracer::mis_weight(double density, double other) const {
    // Light that was asked for and lamps that were hit are both counted.
    if (bug_ == Bug::light_twice) return 1.0;
    return density * density / (density * density + other * other);
}

}  // namespace neumann::blame_test
