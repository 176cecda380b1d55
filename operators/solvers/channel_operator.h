// The interface of one colour channel of K = R ∘ T on finitely many unknowns, as the solvers of L = Le + K L use it.
//
// Unknown u stands for a patch, or for a patch and a bundle of directions; its value is radiance in W·m⁻²·sr⁻¹, and measure_u is
// area times projected solid angle. Inner product and adjoint: ⟨f, g⟩ = Σ_u measure_u f_u g_u,  ⟨K f, g⟩ = ⟨f, K* g⟩.
#pragma once

#include "operators/series/vector.h"

namespace neumann {

// All vectors have size() values; x and y must be different vectors. Calls have no visible side effects.
class ChannelOperator {
public:
    virtual ~ChannelOperator() = default;

    virtual Eigen::Index size() const = 0;
    virtual void apply(const Vector& x, Vector& y) const = 0;  // y = K x
    virtual const Vector& measure() const = 0;                 // > 0

    // Some K can only be applied. Where these return false, the functions for K* or for the entries throw std::logic_error.
    virtual bool has_adjoint() const { return true; }
    virtual bool has_entries() const { return true; }
    virtual void apply_adjoint(const Vector& x, Vector& y) const = 0;        // y = K* x
    virtual double row(Eigen::Index u, const Vector& x) const = 0;           // (K x)_u
    virtual double diagonal(Eigen::Index u) const = 0;                       // K_uu
    virtual void add_column(Eigen::Index u, double a, Vector& y) const = 0;  // y += a K e_u
};

}  // namespace neumann
