// A point that shines into a cone (Mitsuba's `spot`): along +z of its own space, as bright as can be up to the angle of the beam,
// from there linearly less up to the cutoff. A picture may be put before it, which fills the square around the cone.
#pragma once

#include "core/emitter/beam.h"
#include "core/emitter/slide.h"

#include <optional>

namespace neumann {

class SpotLight {
public:
    // Angles from the axis, radians, 0 ≤ beam_width ≤ cutoff; below π/2 with a slide.
    SpotLight(const Mat4& to_world, const Rgb& intensity, double cutoff, double beam_width, std::optional<Slide> slide = {});

    Beam beam(const Vec3& at, const Surroundings&) const;
    // The power in all, over π.
    double brightness(const Surroundings&) const;
    bool is_grey() const { return neumann::is_grey(intensity_) && (!slide_ || slide_->is_grey()); }
    const Vec3& position() const { return position_; }
    // Uniform in the cone, per solid angle.
    Vec3 sample_direction(const Vec2& u) const;
    double direction_pdf(const Vec3& w) const;

private:
    glm::dmat3 to_local_;
    Vec3 position_;
    Rgb intensity_;
    double cutoff_, beam_width_;
    std::optional<Slide> slide_;
};

}  // namespace neumann
