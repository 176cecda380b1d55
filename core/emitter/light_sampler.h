// Light sampling (next-event estimation): chooses a light and a point or direction on it.
#pragma once

#include "core/emitter/light_table.h"
#include "core/emitter/light_tree.h"
#include "core/emitter/light_visibility.h"
#include "core/sampling/delta_pdf.h"
#include "core/sampling/projected_polygon.h"

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace neumann {

struct LightSample {
    SurfacePoint point;  // on the light; for an infinitely distant light, a point beyond the scene
    Vec3 w;              // direction towards it
    Rgb weight{0.0};     // unoccluded radiance / pdf
    double pdf = 0.0;    // of w, per solid angle, or delta_pdf if the light has no extent
    // The index of a distant light, and the probability with which a light sample chooses it.
    std::size_t distant = 0;
    double probability = 0.0;
};

// A point on a light that is sampled without regard to a receiver. `density` is per area.
struct EvenPoint {
    SurfacePoint point;
    const Rgb& radiance;
    double density;
};

// How lights are chosen.
enum class LightChoice {
    mixed,    // half by power, half uniformly; the environment with probability 1/2 at most if there are other lights
    uniform,  // all with equal probability
    power,    // in proportion to power, computed with the largest radiance
    // In proportion to the unoccluded contribution to the point, radiance times solid angle; takes time linear in the
    // number of parts of lights.
    contribution,
    // The same times the square root of the learned probability that the light is seen (light_visibility.h).
    seen,
    // About as `contribution`, by bounds of groups of lights; takes time logarithmic in the number of parts.
    tree,
    all  // every light once
};

// How a point on a light is sampled. Round shapes, and parts that are seen small, are always sampled by area.
enum class LightPlace {
    area,            // uniformly
    solid_angle,     // uniformly in solid angle
    projected,       // in proportion to the cosine at the receiver; without a normal there, as solid_angle
    near_projected,  // as `projected` from nearby, where the variance of points may be infinite, and by area from afar
};

// A point for which light is sampled.
struct Receiver {
    Vec3 position;
    Vec3 normal{0.0};  // of the surface, on the side that receives light; 0 if both sides do

    Receiver() = default;
    Receiver(const Vec3& position, const Vec3& normal = Vec3(0.0)) : position(position), normal(normal) {}
    bool has_side() const { return normal != Vec3(0.0); }
};

// Keeps references to the geometry and the emitters.
class LightSampler {
public:
    // `visibility` is for LightChoice::seen, which is `contribution` without it.
    explicit LightSampler(const Geometry& geometry, const Emitters& emitters, LightChoice choice = LightChoice::mixed,
                          LightPlace place = LightPlace::area, std::shared_ptr<const LightVisibility> visibility = nullptr);

    // Whether there is no light to sample.
    bool empty() const { return table_.empty(); }
    // Number of light samples per point; their contributions add up.
    std::size_t samples_per_point() const { return choice_ == LightChoice::all ? table_.lights().size() : 1; }

    // Samples light for the receiver x: the first number chooses the light and is then reused, with the second, for the
    // point on it. The density is that of pdf(). `number` is the number of the sample, below samples_per_point().
    LightSample sample(const Receiver& x, const Vec2& uv, std::size_t number = 0) const {
        if (empty()) return {};
        if (goes_by_contribution()) return sample_by_contribution(x, uv);
        if (choice_ == LightChoice::tree) return sample_by_tree(x, uv);
        const LightTable::Choice chosen =
            choice_ == LightChoice::all ? table_.choose_of(table_.lights()[number], uv.x) : table_.choose(uv.x);
        return sample_chosen(chosen, x, uv.y);
    }
    // Whether light samples are points that do not depend on x, on surfaces that shine evenly; and such a point.
    bool finds_even_points() const {
        return !empty() && choice_ != LightChoice::all && !depends_on_place() && place_ == LightPlace::area &&
               table_.size() == table_.parts().size() && emitters_->shapes_shine_evenly();
    }
    EvenPoint sample_even_point(const Vec2& uv) const {
        const LightTable::Choice chosen = table_.choose(uv.x);
        const Geometry::PrimitiveRef place = place_of(chosen.index);
        return {geometry_->point(place, Vec2(chosen.left, uv.y)), emitters_->even_radiance(place.shape),
                density_of_shape_[place.shape]};
    }
    // The pdf, per solid angle, with which a sample for x finds y, the hit of a ray from x along w; y may be infinitely far away.
    double pdf(const Receiver& x, const Vec3& w, const SurfacePoint& y) const {
        if (!depends_on_place() && place_ == LightPlace::area && !y.is_infinite())
            return density_of_shape_[y.shape] * per_solid_angle(y.position - x.position, y.normal, w);
        return pdf_in_general(x, w, y);
    }

    // The probability with which a sample for x chooses a distant light.
    double probability_of_distant(std::size_t distant, const Receiver& x) const;

private:
    LightSampler(const Geometry& geometry, const Emitters& emitters, LightChoice choice, LightPlace place,
                 std::shared_ptr<const LightVisibility> visibility, const std::vector<double>& share);

    using Part = LightTable::Part;
    void keep_places();
    // The factor from a density per area to one per solid angle: d² / |cosθ|.
    static double per_solid_angle(const Vec3& d, const Vec3& normal, const Vec3& w) {
        return glm::dot(d, d) / std::abs(glm::dot(normal, w));
    }

    // `part` is its index in the table.
    LightSample on_part(std::size_t part, double density, const Receiver& x, const Vec2& uv) const {
        const bool as_seen =
            place_ == LightPlace::near_projected ? is_near(table_.parts()[part], x.position) : place_ != LightPlace::area;
        if (as_seen) return on_part_as_seen(part, density, x, uv);
        return at_point(evenly_on(part, uv), density, x.position);
    }
    Geometry::PrimitiveRef place_of(std::size_t part) const {
        const Part& p = table_.parts()[part];
        return places_.empty() ? geometry_->primitive_ref(p.shape, p.primitive) : places_[part];
    }
    // The place of the second triangle of a rectangle.
    Geometry::PrimitiveRef second_place_of(std::size_t part) const {
        const Part& p = table_.parts()[part];
        return places_.empty() ? geometry_->primitive_ref(p.shape, p.primitive + 1) : second_places_[part];
    }
    SurfacePoint evenly_on(std::size_t part, const Vec2& uv) const {
        if (!table_.parts()[part].is_rectangle()) return geometry_->point(place_of(part), uv);
        const double u = 2.0 * uv.x;
        return u < 1.0 ? geometry_->point(place_of(part), {u, uv.y}) : geometry_->point(second_place_of(part), {u - 1.0, uv.y});
    }
    LightSample at_point(const SurfacePoint& point, double density, const Vec3& x) const {
        LightSample light;
        light.point = point;
        const Vec3 d = light.point.position - x;
        const double distance2 = glm::dot(d, d);
        light.w = d * (1.0 / std::sqrt(distance2));
        const double cosine = -glm::dot(light.point.normal, light.w);
        if (!(cosine > 0.0)) return light;
        light.pdf = density * distance2 / cosine;
        light.weight = emitters_->emitted(light.point, -light.w) / light.pdf;
        return light;
    }
    LightSample sample_chosen(const LightTable::Choice& chosen, const Receiver& x, double v) const {
        const Vec2 left(chosen.left, v);
        if (table_.is_distant(chosen.index))
            return on_distant(table_.distant(chosen.index), choice_ == LightChoice::all ? 1.0 : chosen.probability, x.position,
                              left);
        return on_part(chosen.index, density_of_shape_[table_.parts()[chosen.index].shape], x, left);
    }
    LightSample on_distant(std::size_t index, double probability, const Vec3& x, const Vec2& uv) const;
    LightSample on_part_as_seen(std::size_t part, double density, const Receiver& x, const Vec2& uv) const;
    // The point of a part at this position, or in this direction from x.
    SurfacePoint point_on(const Part& part, const Vec3& position) const;
    SurfacePoint point_towards(const Part& part, const Vec3& x, const Vec3& w) const;
    LightSample sample_by_contribution(const Receiver& x, const Vec2& uv) const;
    LightSample sample_by_tree(const Receiver& x, const Vec2& uv) const;
    // Whether lights are chosen by where x is.
    bool goes_by_contribution() const { return choice_ == LightChoice::contribution || choice_ == LightChoice::seen; }
    bool depends_on_place() const { return goes_by_contribution() || choice_ == LightChoice::tree; }
    double pdf_in_general(const Receiver& x, const Vec3& w, const SurfacePoint& y) const;

    bool is_near(const Part& part, const Vec3& x) const;
    bool is_seen_from_front(const Part& part, const Vec3& x) const;
    double solid_angle_from_front(const Part& part, const Vec3& x) const;
    // The solid angle of a part if it is sampled by solid angle, or 0.
    double sampled_solid_angle(const Part& part, const Vec3& x) const;
    double contribution(const Part& part, const Vec3& x) const;
    double probability_of_part(const Part& part, double area, const Receiver& x) const;
    // What is learned of the visibility of lights from x; null if nothing is.
    const float* learned(const Receiver& x) const { return visibility_ ? visibility_->weights(x.position, x.normal) : nullptr; }
    // The contributions of a part and of a distant light with what is learned, and the cumulative ones of all.
    double weighted(const Part& part, const Vec3& x, const float* learned) const;
    double weighted(std::size_t distant, const Vec3& x, const float* learned) const;
    std::vector<double> contributions(const Receiver& x) const;
    LightTree make_tree();
    // The cumulative importances of the tree and of the lights that are everywhere, in this order.
    std::vector<double> importances(const Receiver& x) const;
    std::array<Vec3, 3> corners(const Part& part, const Vec3& x) const;
    // The polygon of a part that is sampled by projected solid angle; nothing for others.
    std::optional<ProjectedPolygon> projected(const Part& part, const Receiver& x) const;

    const Geometry* geometry_;
    const Emitters* emitters_;
    LightChoice choice_;
    LightPlace place_;
    std::shared_ptr<const LightVisibility> visibility_;
    LightTable table_;
    LightTree tree_;                                     // over the table's entries that have a place
    std::vector<std::size_t> everywhere_;                // the table's other entries
    std::vector<Geometry::PrimitiveRef> places_;         // of the table's parts, unless there are many
    std::vector<Geometry::PrimitiveRef> second_places_;  // of the second triangles of the table's rectangles
    std::vector<double> density_of_shape_;               // density of a sample, per area
};

}  // namespace neumann
