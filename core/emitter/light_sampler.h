// How a point asks for light: which light it looks at, and where on it (next-event estimation).
#pragma once

#include "core/emitter/light_table.h"
#include "core/sampling/delta_pdf.h"

#include <array>
#include <vector>

namespace neumann {

struct LightSample {
    SurfacePoint point;  // where it comes from; of an infinitely distant light, a point beyond the scene
    Vec3 w;              // towards it
    Rgb weight{0.0};     // the radiance that arrives from there unless something stands between, over pdf
    double pdf = 0.0;    // of w, per solid angle, or delta_pdf where the light has no extent
    // Of a light that no surface gives off: which of the distant ones, and the probability with which an ask picks it.
    std::size_t distant = 0;
    double probability = 0.0;
};

// Which light.
enum class LightChoice {
    mixed,         // half by power, half alike, an environment at most every other time
    uniform,       // alike
    power,         // by the power it gives off, of its largest radiance
    contribution,  // by what it would bring to the point if nothing stood between: radiance times solid angle, of each of its
                   // parts, all of which are looked at for that
    all            // each once
};

// Where on it: uniform on its surface, or in the directions in which it is seen.
enum class LightPlace { area, solid_angle };

// Refers to the geometry and the emitters.
class LightSampler {
public:
    explicit LightSampler(const Geometry& geometry, const Emitters& emitters, LightChoice choice = LightChoice::mixed,
                          LightPlace place = LightPlace::area);

    // No light can be asked.
    bool empty() const { return table_.empty(); }
    // How often a point asks; the samples of all asks add up.
    std::size_t asks() const { return choice_ == LightChoice::all ? table_.lights().size() : 1; }

    // Light for the point x: u picks a light, and what is left of it is, with v, the place there. The same density as pdf() tells.
    LightSample sample(const Vec3& x, const Vec2& uv, std::size_t ask = 0) const {
        if (empty()) return {};
        if (choice_ == LightChoice::contribution) return sample_by_contribution(x, uv);
        const LightTable::Choice chosen =
            choice_ == LightChoice::all ? table_.choose_of(table_.lights()[ask], uv.x) : table_.choose(uv.x);
        return sample_chosen(chosen, x, uv.y);
    }
    // The density, per solid angle, with which an ask for x finds the light that a ray from x along w ends at; y may be infinitely
    // far away.
    double pdf(const Vec3& x, const Vec3& w, const SurfacePoint& y) const {
        if (choice_ != LightChoice::contribution && place_ == LightPlace::area && !y.is_infinite())
            return density_of_shape_[y.shape] * per_solid_angle(y.position - x, y.normal, w);
        return pdf_in_general(x, w, y);
    }

    // The probability with which an ask for x picks that one of the distant lights.
    double probability_of_distant(std::size_t distant, const Vec3& x) const;

private:
    LightSampler(const Geometry& geometry, const Emitters& emitters, LightChoice choice, LightPlace place,
                 const std::vector<double>& share);

    using Part = LightTable::Part;
    // What a density per area becomes per solid angle: d² / |cosθ|.
    static double per_solid_angle(const Vec3& d, const Vec3& normal, const Vec3& w) {
        return glm::dot(d, d) / std::abs(glm::dot(normal, w));
    }

    LightSample on_part(const Part& part, double density, const Vec3& x, const Vec2& uv) const {
        if (place_ == LightPlace::solid_angle) return on_part_as_seen(part, density, x, uv);
        return at_point(geometry_->point(part.shape, part.primitive, uv), density, x);
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
    LightSample sample_chosen(const LightTable::Choice& chosen, const Vec3& x, double v) const {
        const Vec2 left(chosen.left, v);
        if (table_.is_distant(chosen.index))
            return on_distant(table_.distant(chosen.index), choice_ == LightChoice::all ? 1.0 : chosen.probability, x, left);
        const Part& part = table_.parts()[chosen.index];
        return on_part(part, density_of_shape_[part.shape], x, left);
    }
    LightSample on_distant(std::size_t index, double probability, const Vec3& x, const Vec2& uv) const;
    LightSample on_part_as_seen(const Part& part, double density, const Vec3& x, const Vec2& uv) const;
    SurfacePoint point_on_rectangle(const Part& part, const Vec3& position) const;
    LightSample sample_by_contribution(const Vec3& x, const Vec2& uv) const;
    double pdf_in_general(const Vec3& x, const Vec3& w, const SurfacePoint& y) const;

    double solid_angle_from_front(const Part& part, const Vec3& x) const;
    // The solid angle of a part whose directions are sampled, or 0 where its points are.
    double sampled_solid_angle(const Part& part, const Vec3& x) const;
    double contribution(const Part& part, const Vec3& x) const;
    // Of all parts and distant lights, added up.
    std::vector<double> contributions(const Vec3& x) const;
    std::array<Vec3, 3> corners(const Part& part, const Vec3& x) const;

    const Geometry* geometry_;
    const Emitters* emitters_;
    LightChoice choice_;
    LightPlace place_;
    LightTable table_;
    std::vector<double> density_of_shape_;  // per area, of an ask
};

}  // namespace neumann
