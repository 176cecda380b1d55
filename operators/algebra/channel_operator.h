// The interface of one colour channel of K = R ∘ T on finitely many unknowns, as the solvers of L = Le + K L use it.
//
// Unknown u stands for a patch, or for a patch and a bundle of directions; its value is radiance in W·m⁻²·sr⁻¹, and measure_u is
// area times projected solid angle. Inner product and adjoint: ⟨f, g⟩ = Σ_u measure_u f_u g_u,  ⟨K f, g⟩ = ⟨f, K* g⟩.
#pragma once

#include "operators/algebra/agreement.h"

#include <cstdint>
#include <functional>
#include <stdexcept>

namespace neumann {

// All vectors have size() values; x and y must be different vectors. Calls have no visible side effects.
class ChannelOperator {
public:
    virtual ~ChannelOperator() = default;

    virtual Eigen::Index size() const = 0;
    virtual void apply(const Vector& x, Vector& y) const = 0;  // y = K x
    virtual const Vector& measure() const = 0;                 // > 0

    // Several processes may share K, each with some of its rows. Then size() is the number of a process's own rows, all
    // vectors hold the values of these unknowns, and every process calls apply() and apply_adjoint() in the same order.
    virtual const Agreement& agreement() const { return Agreement::alone(); }
    // first() is the number of this process's first unknown among all unknowns, and unknowns() is how many there are in all.
    virtual std::size_t first() const { return 0; }
    virtual std::size_t unknowns() const { return static_cast<std::size_t>(size()); }

    // Some K can only be applied. Where these return false, the functions for K* or for the entries throw std::logic_error.
    virtual bool has_adjoint() const { return true; }
    virtual bool has_entries() const { return true; }
    virtual void apply_adjoint(const Vector& x, Vector& y) const = 0;        // y = K* x
    virtual double row(Eigen::Index u, const Vector& x) const = 0;           // (K x)_u
    virtual double diagonal(Eigen::Index u) const = 0;                       // K_uu
    virtual void add_column(Eigen::Index u, double a, Vector& y) const = 0;  // y += a K e_u
    // Calls each(v, a) for the entries a of row u; v is a number among all unknowns, and may come several times.
    using Entry = std::function<void(std::size_t v, double a)>;
    virtual void for_row(Eigen::Index, const Entry&) const { throw std::logic_error("this K lists no entries"); }
};

}  // namespace neumann
