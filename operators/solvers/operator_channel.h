// An operator of the algebra as the K of a solver. solve(I - R * T, Le, measure, solve_gmres) hands I − K to one of the solvers.
#pragma once

#include "operators/algebra/algebra.h"
#include "operators/solvers/solver.h"

#include <stdexcept>
#include <type_traits>

namespace neumann {

// A field with one value per unknown, convertible to and from a Vector.
template <class Field>
concept OnUnknowns = std::constructible_from<Field, const Vector&> && requires(const Field& f) {
    { to_vector(f) } -> std::convertible_to<Vector>;
};

// A ChannelOperator from an operator of the algebra. It has K* and entries if the operator has: columns of K come from rows of K*.
template <Endomorphism Op>
requires OnUnknowns<typename Op::Domain>
class OperatorChannel : public ChannelOperator {
public:
    // `measure` is the measure of each unknown, in whose inner product K* is the adjoint of K.
    OperatorChannel(Op K, Vector measure) : K_(std::move(K)), adjoint_(adjoint_of(K_)), measure_(std::move(measure)) {}

    Eigen::Index size() const override { return measure_.size(); }
    void apply(const Vector& x, Vector& y) const override { y = to_vector(K_(Field(x))); }
    const Vector& measure() const override { return measure_; }

    bool has_adjoint() const override { return adjointable; }
    bool has_entries() const override { return entries; }
    void apply_adjoint(const Vector& x, Vector& y) const override {
        if constexpr (adjointable)
            y = to_vector(adjoint_(Field(x)));
        else
            throw std::logic_error("this K has no adjoint");
    }
    double row(Eigen::Index u, const Vector& x) const override {
        double sum = 0.0;
        for_entries(K_, u, [&](std::uint32_t v, double a) { sum += a * x[v]; });
        return sum;
    }
    double diagonal(Eigen::Index u) const override {
        double sum = 0.0;
        for_entries(K_, u, [&](std::uint32_t v, double a) { sum += v == u ? a : 0.0; });
        return sum;
    }
    void add_column(Eigen::Index u, double a, Vector& y) const override {
        // m_w K_wu = m_u K*_uw.
        for_entries(adjoint_, u, [&](std::uint32_t w, double b) { y[w] += a * b * (measure_[u] / measure_[w]); });
    }
    void for_row(Eigen::Index u, const Entry& each) const override { for_entries(K_, u, each); }

protected:
    const auto& adjoint() const { return adjoint_; }

private:
    using Field = typename Op::Domain;
    static constexpr bool adjointable = Adjointable<Op>;
    struct None {};
    static auto adjoint_of(const Op& K) {
        if constexpr (adjointable)
            return neumann::adjoint(K);
        else
            return None();
    }
    using Adjoint = decltype(adjoint_of(std::declval<const Op&>()));
    static constexpr bool entries = HasRows<Op> && HasRows<Adjoint>;
    template <class A, class Each>
    static void for_entries(const A& op, Eigen::Index u, const Each& each) {
        if constexpr (entries)
            op.for_row(static_cast<std::uint32_t>(u), each);
        else
            throw std::logic_error("this K can only be applied, and not asked for its entries");
    }

    Op K_;
    Adjoint adjoint_;
    Vector measure_;
};

// Solves (I − K) L = Le with a solver given as a function or by name. `how` is the problem without K and Le, which are filled in.
// If the solver needs K* or entries and K has none, the verdict is Verdict::refused. For fields on finitely many unknowns only.
template <Endomorphism K>
requires OnUnknowns<typename K::Domain> SolverResult solve(const Difference<Identity<typename K::Domain>, K>& equation,
                                                           const typename K::Domain& Le, Vector measure, const Solver& solver,
                                                           Problem how = {}) {
    const OperatorChannel<K> channel(equation.right(), std::move(measure));
    how.K = &channel;
    how.Le = to_vector(Le);
    return solver(how);
}

}  // namespace neumann
