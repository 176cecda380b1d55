// A point light with a cone (Mitsuba's `spot`) around +z of its own space: full intensity up to the angle of the beam, then falling
// to 0 at the cutoff. An optional picture fills the square around the cone.
#pragma once

#include "core/emitter/beam.h"
#include "core/emitter/slide.h"

#include <optional>

namespace neumann {

class SpotLight {
public:
    enum class Edge {
        linear,  // in the angle, as in Mitsuba
        smooth   // 3 x² − 2 x³, x linear in the cosine, as in pbrt
    };

    // Angles are from the axis, in radians: 0 ≤ beam_width ≤ cutoff, and below π/2 with a slide.
    SpotLight(const Mat4& to_world, const Rgb& intensity, double cutoff, double beam_width, std::optional<Slide> slide = {},
              Edge edge = Edge::linear);

    Beam beam(const Vec3& at, const Surroundings&) const;
    // The total power divided by π.
    double brightness(const Surroundings&) const;
    bool is_grey() const { return neumann::is_grey(intensity_) && (!slide_ || slide_->is_grey()); }
    const Vec3& position() const { return position_; }
    // Samples a direction uniformly in the cone; the pdf is per solid angle.
    Vec3 sample_direction(const Vec2& u) const;
    double direction_pdf(const Vec3& w) const;

private:
    double falloff(double angle) const;

    glm::dmat3 to_local_;
    Vec3 position_;
    Rgb intensity_;
    double cutoff_, beam_width_;
    std::optional<Slide> slide_;
    Edge edge_;
};

}  // namespace neumann
