// How a point asks for light: which light it looks at, and where on it (next-event estimation).
#pragma once

#include "core/emitter/emitters.h"
#include "core/geometry/rectangle.h"
#include "core/sampling/delta_pdf.h"

#include <algorithm>
#include <array>
#include <vector>

namespace neumann {

struct LightSample {
    SurfacePoint point;  // where it comes from; of an infinitely distant light, a point beyond the scene
    Vec3 w;              // towards it
    Rgb weight{0.0};     // the radiance that arrives from there unless something stands between, over pdf
    double pdf = 0.0;    // of w, per solid angle, or delta_pdf where the light has no extent
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
    bool empty() const { return cumulative_.empty(); }
    // How often a point asks; the samples of all asks add up.
    std::size_t asks() const { return choice_ == LightChoice::all ? lights_.size() : 1; }

    // Light for the point x: u picks a light, and what is left of it is, with v, the place there. The same density as pdf() tells.
    LightSample sample(const Vec3& x, const Vec2& uv, std::size_t ask = 0) const {
        if (empty()) return {};
        if (choice_ == LightChoice::contribution) return sample_by_contribution(x, uv);
        if (choice_ == LightChoice::all) return sample_of(lights_[ask], x, uv);
        const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, uv.x);
        const double low = found == cumulative_.begin() ? 0.0 : found[-1];
        const auto chosen = static_cast<std::size_t>(found - cumulative_.begin());
        const double left = std::min((uv.x - low) / (*found - low), 0x1.fffffffffffffp-1);
        if (chosen >= parts_.size()) return on_distant(chosen - parts_.size(), *found - low, x, {left, uv.y});
        return on_part(parts_[chosen], density_of_shape_[parts_[chosen].shape], x, {left, uv.y});
    }
    // The density, per solid angle, with which an ask for x finds the light that a ray from x along w ends at; y may be infinitely
    // far away.
    double pdf(const Vec3& x, const Vec3& w, const SurfacePoint& y) const {
        if (choice_ != LightChoice::contribution && place_ == LightPlace::area && !y.is_infinite())
            return density_of_shape_[y.shape] * per_solid_angle(y.position - x, y.normal, w);
        return pdf_in_general(x, w, y);
    }

private:
    // A primitive, or where directions are sampled two triangles that are a rectangle, from `primitive` on.
    struct Part {
        static constexpr std::uint32_t no_rectangle = 0xffffffffu;
        std::uint32_t shape, primitive, rectangle = no_rectangle;
    };
    // A light's range in cumulative_.
    struct Light {
        std::size_t first, end;
    };
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
    LightSample on_distant(std::size_t index, double probability, const Vec3& x, const Vec2& uv) const;
    LightSample on_part_as_seen(const Part& part, double density, const Vec3& x, const Vec2& uv) const;
    SurfacePoint point_on_rectangle(const Part& part, const Vec3& position) const;
    LightSample sample_of(const Light& light, const Vec3& x, const Vec2& uv) const;
    LightSample sample_by_contribution(const Vec3& x, const Vec2& uv) const;
    double pdf_in_general(const Vec3& x, const Vec3& w, const SurfacePoint& y) const;

    Part part_at(const SurfacePoint& y) const;
    double area(const Part& part) const;
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
    std::vector<Part> parts_;
    std::vector<Rectangle> rectangles_;
    std::vector<std::vector<Part>> rectangular_;  // by shape and primitive, of shapes with rectangles
    std::vector<Light> lights_;
    std::vector<double> cumulative_;        // of the probabilities of parts_, then of the distant lights of Emitters
    std::vector<double> density_of_shape_;  // per area, of an ask
};

}  // namespace neumann
