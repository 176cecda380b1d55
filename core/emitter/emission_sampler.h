// How light sets out: a point on a light and a direction, the first ray of a path from the light (source shooting).
#pragma once

#include "core/emitter/light_table.h"

namespace neumann {

struct Emission {
    SurfacePoint from;     // of a light infinitely far away, before the scene; of one without extent, where it stands
    Vec3 w;                // in which the light travels
    Rgb weight{0.0};       // Le |cosθ| over the densities of the place and of w: power
    double density = 0.0;  // of a first edge: EmissionSampler::density(); of a point that shines, at the distance 1
    bool is_point = false;
    bool is_delta = false;    // no ray meets the light
    std::size_t distant = 0;  // which of the lights that no surface gives off; of those and of no other
};

// Lights are chosen by the power they give off, places on them uniformly, and directions from surfaces by their cosine. Refers to
// the geometry and the emitters.
class EmissionSampler {
public:
    EmissionSampler(const Geometry& geometry, const Emitters& emitters);

    // No light can be drawn.
    bool empty() const { return table_.empty(); }
    Emission sample(const Vec2& place, const Vec2& direction) const;

    // With which density the edge from y to x is drawn: per area across it at x, and per solid angle in which x sees y. `w`, from x
    // to y, which may be infinitely far away.
    double density(const SurfacePoint& y, const Vec3& w) const {
        return y.is_infinite() ? environment_density(w) : density_of_shape_[y.shape];
    }
    // The same for a light without extent, but for the solid angle: the beam at x.
    double density_of_delta(std::size_t distant, const Vec3& x, const Vec3& w) const;

private:
    Emission from_surface(const LightTable::Part& part, const Vec2& place, const Vec2& direction) const;
    double environment_density(const Vec3& w) const;
    double probability_of_distant(std::size_t distant) const { return table_.probability(table_.parts().size() + distant); }

    const Geometry* geometry_;
    const Emitters* emitters_;
    LightTable table_;
    std::vector<double> density_of_shape_;  // 0 where it is none
};

}  // namespace neumann
