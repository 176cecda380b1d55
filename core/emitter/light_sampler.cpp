#include "core/emitter/light_sampler.h"

#include "core/sampling/spherical_triangle.h"
#include "core/sampling/warp.h"

#include <numeric>

namespace neumann {

namespace {

// Of the light with this index, where there are others: directions of the material find an environment anyway.
void limit_to_half(std::vector<double>& share, std::size_t index) {
    const double others = 1.0 - share[index];
    if (share[index] <= 0.5 || others <= 0.0) return;
    for (double& s : share) s *= 0.5 / others;
    share[index] = 0.5;
}

// Half as their power, half alike: a dim light may be the one that a place sees, and a bright one may be found by the material's
// directions.
std::vector<double> probabilities(const Emitters& emitters, LightChoice choice, std::size_t shapes) {
    const std::vector<double>& powers = emitters.powers();
    const double total = std::accumulate(powers.begin(), powers.end(), 0.0);
    const auto lights = static_cast<double>(std::count_if(powers.begin(), powers.end(), [](double p) { return p > 0.0; }));
    const double by_power = choice == LightChoice::power ? 1.0 : choice == LightChoice::mixed ? 0.5 : 0.0;
    std::vector<double> result;
    for (const double power : powers) result.push_back(power > 0.0 ? by_power * power / total + (1.0 - by_power) / lights : 0.0);
    if (choice == LightChoice::mixed && emitters.has_environment()) limit_to_half(result, shapes);
    return result;
}

Vec3 center_of(const Sphere& sphere) { return sphere.center; }
Vec3 center_of(const Disk& disk) { return disk.center; }
Vec3 center_of(const Cylinder& cylinder) { return cylinder.center(); }

}  // namespace

LightSampler::LightSampler(const Geometry& geometry, const Emitters& emitters, LightChoice choice, LightPlace place)
    : LightSampler(geometry, emitters, choice, place, probabilities(emitters, choice, geometry.shapes().size())) {}

LightSampler::LightSampler(const Geometry& geometry, const Emitters& emitters, LightChoice choice, LightPlace place,
                           const std::vector<double>& share)
    : geometry_(&geometry), emitters_(&emitters), choice_(choice), place_(place), table_(geometry, emitters, share) {
    for (std::uint32_t shape = 0; shape < geometry.shapes().size(); ++shape)
        density_of_shape_.push_back(share[shape] == 0.0 ? 0.0
                                                        : (choice == LightChoice::all ? 1.0 : share[shape]) / geometry.area(shape));
}

LightSample LightSampler::on_distant(std::size_t index, double probability, const Vec3& x, const Vec2& uv) const {
    LightSample light;
    const DistantSample s = emitters_->sample_distant(index, x, uv);
    light.point.position = s.from;
    light.w = s.w;
    light.pdf = s.pdf == delta_pdf ? delta_pdf : s.pdf * probability;
    if (s.pdf > 0.0) light.weight = s.light / probability;
    light.point.normal = -light.w;
    light.point.shape = SurfacePoint::infinity;
    light.distant = index;
    light.probability = probability;
    return light;
}

LightSample LightSampler::in_solid_angle(const Part& part, double probability, double angle, const Vec3& x, const Vec2& uv) const {
    LightSample light;
    const auto [a, b, c] = corners(part, x);
    light.w = sample_spherical_triangle(a, b, c, angle, uv);
    const Vec3 n = glm::cross(b - a, c - a);
    light.point = geometry_->point_on_triangle(part.shape, part.primitive, x + light.w * (glm::dot(a, n) / glm::dot(light.w, n)));
    light.pdf = probability / angle;
    light.weight = emitters_->emitted(light.point, -light.w) / light.pdf;
    return light;
}

LightSample LightSampler::sample_by_contribution(const Vec3& x, const Vec2& uv) const {
    const std::vector<double> sums = contributions(x);
    const double all = sums.back(), u = uv.x * all;
    if (!(all > 0.0)) return {};
    const auto found = std::upper_bound(sums.begin(), sums.end() - 1, u);
    const auto chosen = static_cast<std::size_t>(found - sums.begin());
    const double below = chosen == 0 ? 0.0 : sums[chosen - 1], share = *found - below;
    if (!(share > 0.0)) return {};
    const Vec2 left(std::min((u - below) / share, 0x1.fffffffffffffp-1), uv.y);
    if (table_.is_distant(chosen)) return on_distant(table_.distant(chosen), share / all, x, left);
    const Part& part = table_.parts()[chosen];
    return on_part(part, share / all / geometry_->area(part.shape, part.primitive), x, left);
}

double LightSampler::pdf_in_general(const Vec3& x, const Vec3& w, const SurfacePoint& y) const {
    const bool by_contribution = choice_ == LightChoice::contribution;
    if (y.is_infinite()) {
        if (empty() || !emitters_->has_environment()) return 0.0;
        return probability_of_distant(0, x) * emitters_->environment_pdf(w);
    }
    if (density_of_shape_[y.shape] == 0.0) return 0.0;
    const Part part{y.shape, y.primitive};
    const double area = geometry_->area(part.shape, part.primitive);
    const double probability =
        by_contribution ? contribution(part, x) / contributions(x).back() : density_of_shape_[y.shape] * area;
    if (!(probability > 0.0)) return 0.0;
    if (place_ == LightPlace::solid_angle)
        if (const double angle = sampled_solid_angle(part, x); angle > 0.0) return probability / angle;
    return probability / area * per_solid_angle(y.position - x, y.normal, w);
}

double LightSampler::probability_of_distant(std::size_t distant, const Vec3& x) const {
    if (choice_ == LightChoice::all) return 1.0;
    if (choice_ == LightChoice::contribution) return emitters_->distant_irradiance(distant, x) / contributions(x).back();
    return table_.probability(table_.parts().size() + distant);
}

std::array<Vec3, 3> LightSampler::corners(const Part& part, const Vec3& x) const {
    const auto& mesh = std::get<TriangleMesh>(geometry_->shapes()[part.shape]);
    const auto& t = mesh.triangles[part.primitive];
    return {mesh.vertices[t[0]] - x, mesh.vertices[t[1]] - x, mesh.vertices[t[2]] - x};
}

// Small ones are as good as flat, and what is left of their angles' sum over π has few digits.
double LightSampler::sampled_solid_angle(const Part& part, const Vec3& x) const {
    constexpr double smallest = 1e-4;
    if (!std::holds_alternative<TriangleMesh>(geometry_->shapes()[part.shape])) return 0.0;
    const auto [a, b, c] = corners(part, x);
    if (glm::dot(a, glm::cross(b - a, c - a)) >= 0.0) return 0.0;  // from behind
    const double angle = solid_angle(a, b, c);
    return angle > smallest ? angle : 0.0;
}

// An estimate for round shapes, positive wherever they may be seen.
double LightSampler::contribution(const Part& part, const Vec3& x) const {
    const double area = geometry_->area(part.shape, part.primitive),
                 radiance = emitters_->powers()[part.shape] / geometry_->area(part.shape);
    return std::visit(
        [&](const auto& shape) {
            if constexpr (std::is_same_v<decltype(shape), const TriangleMesh&>) {
                const auto [a, b, c] = corners(part, x);
                return glm::dot(a, glm::cross(b - a, c - a)) < 0.0 ? radiance * solid_angle(a, b, c) : 0.0;
            } else {
                const Vec3 d = center_of(shape) - x;
                return radiance * area / (glm::dot(d, d) + area * inv_pi);
            }
        },
        geometry_->shapes()[part.shape]);
}

std::vector<double> LightSampler::contributions(const Vec3& x) const {
    std::vector<double> sums;
    sums.reserve(table_.size());
    double sum = 0.0;
    for (const Part& part : table_.parts()) sums.push_back(sum += contribution(part, x));
    for (std::size_t i = table_.parts().size(); i < table_.size(); ++i)
        sums.push_back(sum += emitters_->distant_irradiance(table_.distant(i), x));
    return sums;
}

}  // namespace neumann
