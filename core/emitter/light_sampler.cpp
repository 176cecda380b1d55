#include "core/emitter/light_sampler.h"

#include "core/geometry/rounding.h"
#include "core/sampling/spherical_rectangle.h"
#include "core/sampling/spherical_triangle.h"
#include "core/sampling/warp.h"

#include <algorithm>
#include <numeric>

namespace neumann {

namespace {

// If there are more parts, few of them are sampled often.
constexpr std::size_t most_kept_places = 4096;

// Limits the probability of the light with this index to 1/2 if there are others, because BSDF sampling finds an environment
// anyway.
void limit_to_half(std::vector<double>& share, std::size_t index) {
    const double others = 1.0 - share[index];
    if (share[index] <= 0.5 || others <= 0.0) return;
    for (double& s : share) s *= 0.5 / others;
    share[index] = 0.5;
}

// `mixed`: half in proportion to power, half uniformly, because a point may see only a dim light, and BSDF sampling may already
// find the bright ones.
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
Vec3 center_of(const MeshInstance& instance) { return instance.bounds().center(); }

// The irradiance at distance 1 of a point that shines in all directions, or of a round body, over its power divided by π.
constexpr double of_all_sides = 0.25;

}  // namespace

LightSampler::LightSampler(const Geometry& geometry, const Emitters& emitters, LightChoice choice, LightPlace place,
                           std::shared_ptr<const LightVisibility> visibility)
    : LightSampler(geometry, emitters, choice, place, std::move(visibility),
                   probabilities(emitters, choice, geometry.shapes().size())) {}

LightSampler::LightSampler(const Geometry& geometry, const Emitters& emitters, LightChoice choice, LightPlace place,
                           std::shared_ptr<const LightVisibility> visibility, const std::vector<double>& share)
    : geometry_(&geometry),
      emitters_(&emitters),
      choice_(choice),
      place_(place),
      visibility_(choice == LightChoice::seen ? std::move(visibility) : nullptr),
      table_(geometry, emitters, share,
             place == LightPlace::area ? LightTable::Rectangles::as_triangles : LightTable::Rectangles::whole) {
    if (table_.parts().size() <= most_kept_places) keep_places();
    for (std::uint32_t shape = 0; shape < geometry.shapes().size(); ++shape)
        density_of_shape_.push_back(share[shape] == 0.0 ? 0.0
                                                        : (choice == LightChoice::all ? 1.0 : share[shape]) / emitters.area(shape));
    if (choice == LightChoice::tree) tree_ = make_tree();
}

void LightSampler::keep_places() {
    for (const Part& part : table_.parts()) {
        places_.push_back(geometry_->primitive_ref(part.shape, part.primitive));
        second_places_.push_back(geometry_->primitive_ref(part.shape, part.primitive + (part.is_rectangle() ? 1 : 0)));
    }
}

LightTree LightSampler::make_tree() {
    std::vector<LightTree::Light> lights(table_.size());
    for (std::size_t i = 0; i < table_.parts().size(); ++i) {
        const Part& part = table_.parts()[i];
        const Shape& shape = geometry_->shapes()[part.shape];
        LightTree::Light& light = lights[i];
        light.power = emitters_->powers()[part.shape] / emitters_->area(part.shape) * table_.area(part);
        if (mesh_of(shape)) {
            const TriangleCorners corners = corners_of(shape, part.primitive);
            light.bounds = corners.bounds();
            if (part.is_rectangle()) light.bounds.add(corners_of(shape, part.primitive + 1).bounds());
            light.axis = Triangle::normal(corners.at[0], corners.at[1], corners.at[2]);
            light.has_normal = true;
        } else {
            light.bounds = bounds_of(shape);
            const auto* disk = std::get_if<Disk>(&shape);
            light.has_normal = disk;
            if (disk)
                light.axis = disk->normal;
            else
                light.power *= of_all_sides;
        }
    }
    for (std::size_t i = table_.parts().size(); i < table_.size(); ++i)
        if (const auto place = emitters_->position_of_distant(table_.distant(i))) {
            lights[i].bounds.add(*place);
            lights[i].power = of_all_sides * emitters_->powers()[geometry_->shapes().size() + table_.distant(i)];
        } else {
            everywhere_.push_back(i);
        }
    return LightTree(lights);
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

LightSample LightSampler::on_part_as_seen(std::size_t index, double density, const Receiver& x, const Vec2& uv) const {
    const Part& part = table_.parts()[index];
    LightSample light;
    if (const auto polygon = projected(part, x)) {
        light.w = polygon->sample(uv);
        light.point = point_towards(part, x.position, light.w);
        light.pdf = polygon->pdf(light.w);
    } else if (const double angle = sampled_solid_angle(part, x.position); angle == 0.0) {
        return at_point(evenly_on(index, uv), density, x.position);
    } else if (part.is_rectangle()) {
        const Rectangle& r = table_.rectangle(part);
        const Vec3 d = SphericalRectangle(r.corner - x.position, r.a, r.b).sample(uv);
        light.w = glm::normalize(d);
        light.point = point_on(part, x.position + d);
        light.pdf = 1.0 / angle;
    } else {
        const auto [a, b, c] = corners(part, x.position);
        light.w = sample_spherical_triangle(a, b, c, angle, uv);
        light.point = point_towards(part, x.position, light.w);
        light.pdf = 1.0 / angle;
    }
    light.pdf *= density * table_.area(part);
    if (light.pdf > 0.0) light.weight = emitters_->emitted(light.point, -light.w) / light.pdf;
    return light;
}

SurfacePoint LightSampler::point_on(const Part& part, const Vec3& position) const {
    if (!part.is_rectangle()) return geometry_->point_on_triangle(part.shape, part.primitive, position);
    const Rectangle& r = table_.rectangle(part);
    const Vec3 d = position - r.corner;
    const bool in_first = glm::dot(d, r.a) / glm::dot(r.a, r.a) + glm::dot(d, r.b) / glm::dot(r.b, r.b) <= 1.0;
    return geometry_->point_on_triangle(part.shape, part.primitive + (in_first ? 0 : 1), position);
}

SurfacePoint LightSampler::point_towards(const Part& part, const Vec3& x, const Vec3& w) const {
    const auto [a, b, c] = corners(part, x);
    const Vec3 n = glm::cross(b - a, c - a);
    return point_on(part, x + w * (glm::dot(a, n) / glm::dot(w, n)));
}

LightSample LightSampler::sample_by_contribution(const Receiver& x, const Vec2& uv) const {
    const std::vector<double> sums = contributions(x);
    const double all = sums.back(), u = uv.x * all;
    if (!(all > 0.0)) return {};
    const auto found = std::upper_bound(sums.begin(), sums.end() - 1, u);
    const auto chosen = static_cast<std::size_t>(found - sums.begin());
    const double below = chosen == 0 ? 0.0 : sums[chosen - 1], share = *found - below;
    if (!(share > 0.0)) return {};
    const Vec2 left(std::min((u - below) / share, 0x1.fffffffffffffp-1), uv.y);
    if (table_.is_distant(chosen)) return on_distant(table_.distant(chosen), share / all, x.position, left);
    return on_part(chosen, share / all / table_.area(table_.parts()[chosen]), x, left);
}

std::vector<double> LightSampler::importances(const Receiver& x) const {
    std::vector<double> sums{tree_.importance(x.position, x.normal)};
    for (const std::size_t light : everywhere_)
        sums.push_back(sums.back() + emitters_->distant_irradiance(table_.distant(light), x.position));
    return sums;
}

LightSample LightSampler::sample_by_tree(const Receiver& x, const Vec2& uv) const {
    const std::vector<double> sums = importances(x);
    const double all = sums.back(), u = uv.x * all;
    if (!(all > 0.0)) return {};
    const auto found = std::upper_bound(sums.begin(), sums.end() - 1, u);
    const double below = found == sums.begin() ? 0.0 : *(found - 1), share = *found - below;
    if (!(share > 0.0)) return {};
    const double left = std::min((u - below) / share, 0x1.fffffffffffffp-1);
    if (found != sums.begin())
        return on_distant(table_.distant(everywhere_[static_cast<std::size_t>(found - sums.begin()) - 1]), share / all, x.position,
                          Vec2(left, uv.y));
    const auto chosen = tree_.choose(x.position, x.normal, left);
    if (!chosen) return {};
    const double probability = share / all * chosen->probability;
    if (table_.is_distant(chosen->light))
        return on_distant(table_.distant(chosen->light), probability, x.position, Vec2(chosen->left, uv.y));
    return on_part(chosen->light, probability / table_.area(table_.parts()[chosen->light]), x, Vec2(chosen->left, uv.y));
}

double LightSampler::pdf_in_general(const Receiver& x, const Vec3& w, const SurfacePoint& y) const {
    if (y.is_infinite()) {
        if (empty() || !emitters_->has_environment()) return 0.0;
        return probability_of_distant(0, x) * emitters_->environment_pdf(w);
    }
    if (density_of_shape_[y.shape] == 0.0) return 0.0;
    const Part part = table_.part_at(y);
    const double area = table_.area(part), probability = probability_of_part(part, area, x);
    if (!(probability > 0.0)) return 0.0;
    if (const auto polygon = projected(part, x)) return probability * polygon->pdf(w);
    if (const double angle = sampled_solid_angle(part, x.position); angle > 0.0) return probability / angle;
    return probability / area * per_solid_angle(y.position - x.position, y.normal, w);
}

double LightSampler::probability_of_part(const Part& part, double area, const Receiver& x) const {
    if (goes_by_contribution()) return weighted(part, x.position, learned(x)) / contributions(x).back();
    if (choice_ != LightChoice::tree) return density_of_shape_[part.shape] * area;
    const std::vector<double> sums = importances(x);
    return sums.front() > 0.0 ? sums.front() / sums.back() *
                                    tree_.probability(static_cast<std::uint32_t>(table_.index_of(part)), x.position, x.normal)
                              : 0.0;
}

double LightSampler::probability_of_distant(std::size_t distant, const Receiver& x) const {
    if (choice_ == LightChoice::all) return 1.0;
    if (goes_by_contribution()) return weighted(distant, x.position, learned(x)) / contributions(x).back();
    const std::size_t light = table_.parts().size() + distant;
    if (choice_ != LightChoice::tree) return table_.probability(light);
    const std::vector<double> sums = importances(x);
    if (!(sums.back() > 0.0)) return 0.0;
    if (std::ranges::find(everywhere_, light) != everywhere_.end())
        return emitters_->distant_irradiance(distant, x.position) / sums.back();
    return sums.front() / sums.back() * tree_.probability(static_cast<std::uint32_t>(light), x.position, x.normal);
}

std::array<Vec3, 3> LightSampler::corners(const Part& part, const Vec3& x) const {
    const auto& mesh = std::get<TriangleMesh>(geometry_->shapes()[part.shape]);
    const auto& t = mesh.triangles[part.primitive];
    return {mesh.vertices[t[0]] - x, mesh.vertices[t[1]] - x, mesh.vertices[t[2]] - x};
}

// Whether x is closer to the part's middle than twice the radius of a ball around the part.
bool LightSampler::is_near(const Part& part, const Vec3& x) const {
    if (!std::holds_alternative<TriangleMesh>(geometry_->shapes()[part.shape])) return false;
    constexpr double times = 2.0;
    if (part.is_rectangle()) {
        const Rectangle& r = table_.rectangle(part);
        const Vec3 d = r.corner + 0.5 * (r.a + r.b) - x;
        return glm::dot(d, d) < times * times * 0.25 * (glm::dot(r.a, r.a) + glm::dot(r.b, r.b));
    }
    const auto [a, b, c] = corners(part, x);
    const Vec3 middle = (a + b + c) / 3.0;
    const double radius2 =
        std::max({glm::dot(a - middle, a - middle), glm::dot(b - middle, b - middle), glm::dot(c - middle, c - middle)});
    return glm::dot(middle, middle) < times * times * radius2;
}

// Whether a part is seen from the front by more than rounding: from its own plane it is seen edge-on, and by the last
// digits of its corners it covers nothing or half of the sky.
bool LightSampler::is_seen_from_front(const Part& part, const Vec3& x) const {
    // `corner` is relative to x.
    const auto in_front = [&](const Vec3& corner, const Vec3& a, const Vec3& b) {
        constexpr double places = 4.0;  // x and the corners come from coordinates that were turned and moved, perhaps several times
        const Vec3 n = glm::cross(a, b);
        const double size = largest_component(x + corner) + largest_component(a) + largest_component(b);
        const double of_places = double_rounding(x, size) * glm::length(n);
        const double of_normal = 0x1p-49 * glm::length(a) * glm::length(b) * glm::length(corner);
        return glm::dot(corner, n) < -places * (of_places + of_normal);
    };
    if (part.is_rectangle()) {
        const Rectangle& r = table_.rectangle(part);
        return in_front(r.corner - x, r.a, r.b);
    }
    const auto [a, b, c] = corners(part, x);
    return in_front(a, b - a, c - a);
}

// The solid angle of a part of a mesh; 0 from behind.
double LightSampler::solid_angle_from_front(const Part& part, const Vec3& x) const {
    if (!is_seen_from_front(part, x)) return 0.0;
    if (part.is_rectangle()) {
        const Rectangle& r = table_.rectangle(part);
        return SphericalRectangle(r.corner - x, r.a, r.b).solid_angle();
    }
    const auto [a, b, c] = corners(part, x);
    return solid_angle(a, b, c);
}

// Parts that are seen small are sampled by area: that is nearly uniform, and their measures are differences with few digits.
double LightSampler::sampled_solid_angle(const Part& part, const Vec3& x) const {
    constexpr double smallest = 1e-4;
    const bool wanted = place_ == LightPlace::solid_angle || place_ == LightPlace::projected;
    if (!wanted || !std::holds_alternative<TriangleMesh>(geometry_->shapes()[part.shape])) return 0.0;
    const double angle = solid_angle_from_front(part, x);
    return angle > smallest ? angle : 0.0;
}

std::optional<ProjectedPolygon> LightSampler::projected(const Part& part, const Receiver& x) const {
    constexpr double smallest = 1e-6;
    std::optional<ProjectedPolygon> polygon;
    const bool wanted = place_ == LightPlace::projected || (place_ == LightPlace::near_projected && is_near(part, x.position));
    if (!wanted || !x.has_side() || !std::holds_alternative<TriangleMesh>(geometry_->shapes()[part.shape]) ||
        !is_seen_from_front(part, x.position))
        return polygon;
    if (part.is_rectangle()) {
        const Rectangle& r = table_.rectangle(part);
        const Vec3 corner = r.corner - x.position;
        polygon.emplace(std::array{corner, corner + r.a, corner + r.a + r.b, corner + r.b}, x.normal);
    } else {
        polygon.emplace(corners(part, x.position), x.normal);
    }
    if (!(polygon->area() > smallest)) polygon.reset();
    return polygon;
}

// The contribution of round shapes is an estimate, positive wherever they may be seen.
double LightSampler::contribution(const Part& part, const Vec3& x) const {
    const double radiance = emitters_->powers()[part.shape] / emitters_->area(part.shape);
    return std::visit(
        [&](const auto& shape) {
            if constexpr (std::is_same_v<decltype(shape), const TriangleMesh&>) {
                return radiance * solid_angle_from_front(part, x);
            } else {
                const Vec3 d = center_of(shape) - x;
                const double whole = table_.area(part);
                return radiance * whole / (glm::dot(d, d) + whole * inv_pi);
            }
        },
        geometry_->shapes()[part.shape]);
}

double LightSampler::weighted(const Part& part, const Vec3& x, const float* learned) const {
    return contribution(part, x) * (learned ? static_cast<double>(learned[part.shape]) : 1.0);
}

double LightSampler::weighted(std::size_t distant, const Vec3& x, const float* learned) const {
    return emitters_->distant_irradiance(distant, x) *
           (learned ? static_cast<double>(learned[geometry_->shapes().size() + distant]) : 1.0);
}

std::vector<double> LightSampler::contributions(const Receiver& x) const {
    const float* const learned_here = learned(x);
    std::vector<double> sums;
    sums.reserve(table_.size());
    double sum = 0.0;
    for (const Part& part : table_.parts()) sums.push_back(sum += weighted(part, x.position, learned_here));
    for (std::size_t i = table_.parts().size(); i < table_.size(); ++i)
        sums.push_back(sum += weighted(table_.distant(i), x.position, learned_here));
    return sums;
}

}  // namespace neumann
