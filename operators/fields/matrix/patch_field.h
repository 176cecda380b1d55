// Fields on a patch space, with one value per unknown: exitant radiance, and incident radiance in the cells of
// directions. They have different types, like functions (operators/pointwise/field.h): T maps exitant to incident
// fields and R maps them back. All colour channels are stored together. C is 1 if the scene is grey, otherwise 4; the
// fourth channel is zero and makes a column one SIMD load of doubles.
#pragma once

#include "core/base/vec.h"
#include "operators/algebra/vector.h"

#include <concepts>
#include <cstdint>

namespace neumann {

template <int C>
using Channels = Eigen::Array<double, C, 1>;

template <int C>
Channels<C> to_channels(const Rgb& c) {
    if constexpr (C == 1)
        return Channels<1>(c.r);
    else
        return Channels<4>(c.r, c.g, c.b, 0.0);
}
template <int C>
Rgb to_rgb(const Channels<C>& c) {
    if constexpr (C == 1)
        return Rgb(c[0]);
    else
        return Rgb(c[0], c[1], c[2]);
}

// One column per unknown, and a last one for PatchSpace::nothing(), which stays zero. The values are basic radiance,
// W·m⁻²·sr⁻¹. A change of side must be explicit: ExitantVector<C>(std::move(f).values()).
template <class Side, int C>
class PatchField {
public:
    using Values = Eigen::Array<double, C, Eigen::Dynamic>;

    static PatchField zero(std::uint32_t unknowns) { return PatchField(Values(Values::Zero(C, Eigen::Index{unknowns} + 1))); }
    explicit PatchField(Values values) : values_(std::move(values)) {}
    // A field of one channel converts from and to a Vector.
    template <std::same_as<Vector> V>
    explicit PatchField(const V& x) requires(C == 1) : values_(1, x.size() + 1) {
        values_ << x.transpose().array(), 0.0;
    }
    friend Vector to_vector(const PatchField& f) requires(C == 1) { return f.values_.leftCols(f.unknowns()).transpose(); }

    const Values& values() const& { return values_; }
    Values&& values() && { return std::move(values_); }
    Eigen::Index unknowns() const { return values_.cols() - 1; }
    auto col(Eigen::Index u) { return values_.col(u); }
    auto col(Eigen::Index u) const { return values_.col(u); }
    auto row(Eigen::Index channel) const { return values_.row(channel); }
    double& operator()(Eigen::Index channel, Eigen::Index u) { return values_(channel, u); }
    double operator()(Eigen::Index channel, Eigen::Index u) const { return values_(channel, u); }
    double* data() { return values_.data(); }
    const double* data() const { return values_.data(); }
    Eigen::Index size() const { return values_.size(); }

    friend PatchField operator+(PatchField f, const PatchField& g) {
        f.values_ += g.values_;
        return f;
    }
    friend PatchField operator-(PatchField f, const PatchField& g) {
        f.values_ -= g.values_;
        return f;
    }
    friend PatchField operator*(double a, PatchField f) {
        f.values_ *= a;
        return f;
    }
    // `a` has a factor for each channel.
    friend PatchField operator*(const Channels<C>& a, PatchField f) {
        f.values_.colwise() *= a;
        return f;
    }

private:
    Values values_;
};

template <int C>
using ExitantVector = PatchField<struct Exitant, C>;
template <int C>
using IncidentVector = PatchField<struct Incident, C>;

}  // namespace neumann
