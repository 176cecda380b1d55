// Samples points on all surfaces, or on one shape, uniformly by area.
#pragma once

#include "core/geometry/geometry.h"

namespace neumann {

class AreaSampler {
public:
    // Throws InputError if there are more than 10⁸ triangles, as instances may have.
    explicit AreaSampler(const Geometry& geometry);
    AreaSampler(const Geometry& geometry, std::uint32_t shape);

    // The pdf is 1/area() per area, which must not be 0.
    SurfacePoint sample(double choice, const Vec2& uv) const;
    // The same with two numbers: the first also chooses the triangle.
    SurfacePoint sample(const Vec2& uv) const;
    double area() const { return cumulative_.empty() ? 0.0 : cumulative_.back(); }

private:
    void add(std::uint32_t shape);
    std::size_t find(double area) const;

    struct Primitive {
        std::uint32_t shape, primitive;
    };
    const Geometry& geometry_;
    std::vector<Primitive> primitives_;
    std::vector<double> cumulative_;
};

}  // namespace neumann
