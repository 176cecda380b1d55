// Radiance as a function that can be asked for its value. A field whose value is an integral answers with an unbiased random
// estimate, so it takes random numbers; asked again with others, it answers otherwise, and is right on average.
//
// Exitant and incident fields are different types: T turns one into the other and R turns it back, so `R * T` compiles and `T * T`
// does not.
#pragma once

#include "core/geometry/surface_point.h"

#include <functional>

namespace neumann {

class Random {
public:
    virtual ~Random() = default;
    virtual double next() = 0;  // uniform in [0, 1)
    Vec2 next2() {
        const double x = next();
        return {x, next()};
    }
};

// `Side` tells whether the radiance at p along ω leaves p along ω or arrives at p from ω. W·m⁻²·sr⁻¹, per channel.
template <class Side>
class Field {
public:
    using Function = std::function<Rgb(const SurfacePoint& p, const Vec3& w, Random&)>;
    Field(Function value) : value_(std::move(value)) {}

    Rgb operator()(const SurfacePoint& p, const Vec3& w, Random& random) const { return value_(p, w, random); }

    friend Field operator+(Field f, Field g) {
        return Field([f = std::move(f), g = std::move(g)](const SurfacePoint& p, const Vec3& w, Random& random) {
            return f(p, w, random) + g(p, w, random);
        });
    }

private:
    Function value_;
};

using ExitantField = Field<struct Exitant>;
using IncidentField = Field<struct Incident>;

}  // namespace neumann
