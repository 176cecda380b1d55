#include "plain_tracer.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <oneapi/tbb/combinable.h>
#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

using glm::vec2;
using glm::vec3;

RTCRayHit ray_along(const vec3& o, const vec3& d, float length) {
    RTCRayHit r;
    r.ray = {o.x, o.y, o.z, 0.0f, d.x, d.y, d.z, 0.0f, length, ~0u, 0, 0};
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return r;
}

// Shirley and Chiu's disc; sine and cosine up to π/4 by Taylor's polynomials.
vec3 cosine_hemisphere(const vec2& u) {
    const float a = 2.0f * u.x - 1.0f, b = 2.0f * u.y - 1.0f;
    const bool flat = std::abs(a) > std::abs(b);
    const float radius = flat ? a : b, phi = radius == 0.0f ? 0.0f : (flat ? b : a) / radius * 0.785398163f, x = phi * phi;
    const float sine = radius * phi * (1.0f + x * (-1.0f / 6 + x * (1.0f / 120 - x * (1.0f / 5040))));
    const float cosine = radius * (1.0f + x * (-0.5f + x * (1.0f / 24 - x * (1.0f / 720 - x * (1.0f / 40320)))));
    return {flat ? cosine : sine, flat ? sine : cosine, std::sqrt(std::max(1.0f - radius * radius, 0.0f))};
}

// Duff et al., Building an Orthonormal Basis, Revisited, 2017.
vec3 to_world(const vec3& n, const vec3& w) {
    const float sign = std::copysign(1.0f, n.z), a = -1.0f / (sign + n.z), b = n.x * n.y * a;
    return vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x) * w.x + vec3(b, sign + n.y * n.y * a, -n.y) * w.y + n * w.z;
}

float power_heuristic(float a, float b) { return 1.0f / (1.0f + (b / a) * (b / a)); }

}  // namespace

// PCG32: O'Neill, PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms for Random Number Generation, 2014.
struct PlainTracer::Numbers {
    std::uint64_t state, stream;
    Numbers(std::uint64_t seed, std::uint64_t number) : state(seed), stream(2 * number + 1) { next(), state += seed, next(); }
    float next() {
        const std::uint64_t old = state;
        state = old * 6364136223846793005u + stream;
        const auto x = static_cast<std::uint32_t>((old >> 18 ^ old) >> 27), turn = static_cast<std::uint32_t>(old >> 59);
        return static_cast<float>((x >> turn | x << (-turn & 31)) >> 8) * 0x1p-24f;
    }
    vec2 next2() {
        const float x = next();
        return {x, next()};
    }
};

struct PlainTracer::Embree {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);
    ~Embree() { rtcReleaseScene(scene), rtcReleaseDevice(device); }
#if RTC_VERSION_MAJOR >= 4
    void hit(RTCRayHit& r) const { rtcIntersect1(scene, &r, nullptr); }
    void occlude(RTCRay& r) const { rtcOccluded1(scene, &r, nullptr); }
#else
    static RTCIntersectContext context() {
        RTCIntersectContext c;
        return rtcInitIntersectContext(&c), c;
    }
    void hit(RTCRayHit& r) const {
        auto c = context();
        rtcIntersect1(scene, &c, &r);
    }
    void occlude(RTCRay& r) const {
        auto c = context();
        rtcOccluded1(scene, &c, &r);
    }
#endif
};

PlainTracer::PlainTracer(const Scene& scene)
    : width_(scene.film.width),
      height_(scene.film.height),
      radiance_(scene.emitters.largest_radiance()),
      offset_(static_cast<float>(1e-4 * scene.geometry.radius())),
      embree_(std::make_unique<Embree>()) {
    // Directions through three corners of the film, with length 1 along the axis.
    const CameraRay middle = scene.camera.ray({0.5 * width_, 0.5 * height_});
    const auto through = [&](double x, double y) {
        const Vec3 d = scene.camera.ray({x, y}).direction;
        return vec3(d / glm::dot(d, middle.direction));
    };
    corner_ = through(0, 0);
    across_ = (through(width_, 0) - corner_) / static_cast<float>(width_);
    down_ = (through(0, height_) - corner_) / static_cast<float>(height_);
    const CameraRay side = scene.camera.ray({0.0, 0.0});
    // All rays come from one point, each from its own place on the near plane.
    near_ = static_cast<float>(glm::length(side.origin - middle.origin) / glm::length(vec3(middle.direction) - corner_));
    eye_ = vec3(middle.origin) - vec3(middle.direction) * near_;

    std::vector<vec3> corners;
    for (std::uint32_t i = 0; i < scene.geometry.shapes().size(); ++i) {
        const auto& mesh = std::get<TriangleMesh>(scene.geometry.shapes()[i]);
        const auto albedo = [&](bool front) {
            const Bsdf* bsdf = scene.materials.at(i, front);
            return bsdf ? vec3(std::get<Diffuse>(*bsdf).largest_albedo()) : vec3(0.0f);
        };
        const bool is_lamp = scene.emitters.is_emitter(i);
        for (const auto& t : mesh.triangles) {
            const Vec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]], n = glm::cross(b - a, c - a);
            faces_.push_back({vec3(glm::normalize(n)), albedo(true), albedo(false), is_lamp});
            for (const Vec3& p : {a, b, c}) corners.emplace_back(p);
            if (!is_lamp || lamp_area_ > 0.0f) continue;
            // The first of the triangles a b c and a c d: the lamp has a corner b and sides from there to a and c.
            lamp_ = vec3(b), lamp_a_ = vec3(c - b), lamp_b_ = vec3(a - b), lamp_normal_ = vec3(glm::normalize(n));
            lamp_area_ = static_cast<float>(glm::length(n));
        }
    }
    RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<vec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3), corners.size()));
    std::copy(corners.begin(), corners.end(), vertices);
    auto* indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), faces_.size()));
    for (unsigned i = 0; i < corners.size(); ++i) indices[i] = i;
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(embree_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(embree_->scene);
}
PlainTracer::~PlainTracer() = default;

// Adds one sample of every bounce to `sum`. Returns the number of rays.
std::uint64_t PlainTracer::trace(int x, int y, int bounces, Numbers& numbers, vec3* sum) const {
    constexpr float infinity = std::numeric_limits<float>::infinity(), one_over_pi = 0.318309886f;
    const vec2 place = numbers.next2();
    const vec3 through = corner_ + across_ * (static_cast<float>(x) + place.x) + down_ * (static_cast<float>(y) + place.y);
    vec3 origin = eye_ + through * near_, w = glm::normalize(through), beta(1.0f);
    float pdf = infinity;
    std::uint64_t rays = 0;
    for (int bounce = 0;; ++bounce) {
        RTCRayHit found = ray_along(origin, w, infinity);
        embree_->hit(found);
        ++rays;
        if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return rays;
        const Face& face = faces_[found.hit.primID];
        const vec3 p = origin + w * found.ray.tfar;
        const float cosine = -glm::dot(face.normal, w);
        if (face.is_lamp && cosine > 0.0f) {
            const float distance = found.ray.tfar, pdf_of_lamp = distance * distance / (cosine * lamp_area_);
            sum[bounce] += beta * radiance_ * (bounce == 0 ? 1.0f : power_heuristic(pdf, pdf_of_lamp));
        }
        if (bounce == bounces) return rays;

        const vec3 n = cosine > 0.0f ? face.normal : -face.normal;
        beta *= cosine > 0.0f ? face.albedo_front : face.albedo_back;
        if (beta == vec3(0.0f)) return rays;
        origin = p + n * offset_;
        const vec2 on_lamp = numbers.next2();
        const vec3 d = lamp_ + lamp_a_ * on_lamp.x + lamp_b_ * on_lamp.y - p;
        const float distance2 = glm::dot(d, d), length = std::sqrt(distance2), here = glm::dot(n, d) / length,
                    there = -glm::dot(lamp_normal_, d) / length;
        if (here > 0.0f && there > 0.0f) {
            RTCRay shadow = ray_along(origin, d + (lamp_normal_ - n) * offset_, 1.0f).ray;
            embree_->occlude(shadow);
            ++rays;
            const float density = distance2 / (there * lamp_area_);
            if (shadow.tfar >= 0.0f)
                sum[bounce + 1] += beta * radiance_ * (one_over_pi * here / density * power_heuristic(density, here * one_over_pi));
        }
        const vec3 local = cosine_hemisphere(numbers.next2());
        pdf = local.z * one_over_pi;
        w = to_world(n, local);
    }
}

PlainTracer::Pictures PlainTracer::render(int bounces, int samples, std::uint64_t seed) const {
    const auto quantities = static_cast<std::size_t>(bounces) + 1;
    Pictures pictures{
        std::vector<vec3>(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * quantities, vec3(0.0f)), 0};
    oneapi::tbb::combinable<std::uint64_t> rays([] { return std::uint64_t{0}; });
    oneapi::tbb::parallel_for(0, height_, [&](int y) {
        std::uint64_t& cast = rays.local();
        for (int x = 0; x < width_; ++x) {
            const auto pixel = static_cast<std::size_t>(y * width_ + x);
            Numbers numbers(seed, pixel);
            vec3* sum = pictures.of.data() + pixel * quantities;
            for (int i = 0; i < samples; ++i) cast += trace(x, y, bounces, numbers, sum);
            for (std::size_t q = 0; q < quantities; ++q) sum[q] /= static_cast<float>(samples);
        }
    });
    pictures.rays = rays.combine(std::plus<>());
    return pictures;
}

}  // namespace neumann
