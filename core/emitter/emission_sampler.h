// Samples emission: a point on a light and a direction, the first ray of a path from a light.
#pragma once

#include "core/emitter/light_table.h"

namespace neumann {

struct Emission {
    SurfacePoint from;     // on the light; for a light infinitely far away, a point outside the scene
    Vec3 w;                // direction in which the light travels
    Rgb weight{0.0};       // power: Le |cosθ| divided by the densities of the point and of w
    double density = 0.0;  // of the first edge, see EmissionSampler::density(); for a point light, at distance 1
    bool is_point = false;
    bool is_delta = false;    // no ray can hit the light
    std::size_t distant = 0;  // index of the distant light; only set for these
};

// Chooses lights in proportion to their power, points on them uniformly, and directions from surfaces in proportion to the cosine.
// Keeps references to the geometry and the emitters.
class EmissionSampler {
public:
    EmissionSampler(const Geometry& geometry, const Emitters& emitters);

    // Whether there is no light to sample.
    bool empty() const { return table_.empty(); }
    Emission sample(const Vec2& place, const Vec2& direction) const;

    // The density with which the edge from y to x is sampled: per area perpendicular to it at x, and per solid angle at x. `w` is
    // the direction from x to y; y may be infinitely far away.
    double density(const SurfacePoint& y, const Vec3& w) const {
        return y.is_infinite() ? environment_density(w) : density_of_shape_[y.shape];
    }
    // The same for a light without extent, per area perpendicular to the beam at x alone.
    double density_of_delta(std::size_t distant, const Vec3& x, const Vec3& w) const;

private:
    Emission from_surface(const LightTable::Part& part, const Vec2& place, const Vec2& direction) const;
    double environment_density(const Vec3& w) const;
    double probability_of_distant(std::size_t distant) const { return table_.probability(table_.parts().size() + distant); }

    const Geometry* geometry_;
    const Emitters* emitters_;
    LightTable table_;
    std::vector<double> density_of_shape_;  // 0 if the shape is not a light
};

}  // namespace neumann
