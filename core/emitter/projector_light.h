// A pinhole that projects a picture (Mitsuba's `projector`), the reverse of a camera: a white surface perpendicular to its axis at
// distance 1 shows the picture.
#pragma once

#include "core/emitter/beam.h"
#include "core/emitter/slide.h"

namespace neumann {

class ProjectorLight {
public:
    // `half_width` is tan of half the angle across the picture. `to_world` is as a camera's, without scale.
    ProjectorLight(const Mat4& to_world, Slide slide, double scale, double half_width);

    Beam beam(const Vec3& at, const Surroundings&) const;
    // The total power divided by π.
    double brightness(const Surroundings&) const { return slide_.mean() * scale_ * 4.0 * half_size_.x * half_size_.y; }
    bool is_grey() const { return slide_.is_grey(); }
    const Vec3& position() const { return position_; }
    // Samples a direction uniformly on the picture; the pdf is per solid angle.
    Vec3 sample_direction(const Vec2& u) const;
    double direction_pdf(const Vec3& w) const;

private:
    glm::dmat3 to_local_;
    Vec3 position_;
    Slide slide_;
    double scale_;
    Vec2 half_size_;
};

}  // namespace neumann
