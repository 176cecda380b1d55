// Samples points on all surfaces, uniformly by area.
#pragma once

#include "core/geometry/geometry.h"

namespace neumann {

class AreaSampler {
public:
    // Throws InputError if there are more than 10⁸ triangles, as instances may have.
    explicit AreaSampler(const Geometry& geometry);

    // The pdf is 1/area() per area. The scene must have surfaces.
    SurfacePoint sample(double choice, const Vec2& uv) const;
    double area() const { return cumulative_.empty() ? 0.0 : cumulative_.back(); }

private:
    struct Primitive {
        std::uint32_t shape, primitive;
    };
    const Geometry& geometry_;
    std::vector<Primitive> primitives_;
    std::vector<double> cumulative_;
};

}  // namespace neumann
