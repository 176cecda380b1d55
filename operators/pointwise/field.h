// Radiance as a function of point and direction. A field whose value is an integral returns an unbiased random estimate
// of it, which depends on the random numbers that it is given.
//
// Exitant and incident fields are different types: T turns one into the other and R turns it back, so `R * T` compiles and `T * T`
// does not.
#pragma once

#include "core/geometry/surface_point.h"
#include "operators/algebra/compensated_sum.h"

#include <functional>
#include <vector>

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

    // f is evaluated before g.
    friend Field operator+(Field f, Field g) { return combined(std::move(f), std::move(g), 1.0); }
    friend Field operator-(Field f, Field g) { return combined(std::move(f), std::move(g), -1.0); }
    friend Field operator*(double a, Field f) {
        return Field([a, f = std::move(f)](const SurfacePoint& p, const Vec3& w, Random& random) { return a * f(p, w, random); });
    }

private:
    static Field combined(Field f, Field g, double a) {
        return Field([f = std::move(f), g = std::move(g), a](const SurfacePoint& p, const Vec3& w, Random& random) {
            const Rgb value = f(p, w, random);
            return value + a * g(p, w, random);
        });
    }
    Function value_;
};

using ExitantField = Field<struct Exitant>;
using IncidentField = Field<struct Incident>;

// The sum of functions: evaluates all of them, the first one first, and adds up their values.
template <class Side>
class CompensatedSum<Field<Side>> {
public:
    explicit CompensatedSum(Field<Side> first) : terms_{std::move(first)} {}

    void add(Field<Side> term) { terms_.push_back(std::move(term)); }
    Field<Side> value() const {
        return Field<Side>([terms = terms_](const SurfacePoint& p, const Vec3& w, Random& random) {
            Rgb sum(0.0), lost(0.0);
            for (const Field<Side>& term : terms) {
                const Rgb value = term(p, w, random);
                for (int c = 0; c < 3; ++c) add_compensated(sum[c], lost[c], value[c]);
            }
            return sum + lost;
        });
    }

private:
    std::vector<Field<Side>> terms_;
};

}  // namespace neumann
