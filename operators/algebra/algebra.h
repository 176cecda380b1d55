// The algebra of operators, of functions and of matrices alike: L = Le + R T L is written (I − R T) L = Le.
//
//     (A B) f = A(B f)   (A + B) f = A f + B f   (a A) f = a (A f)   I f = f
//     (A B)* = B* A*     (A + B)* = A* + B*      (a A)* = a A*       I* = I
//
// The types allow only what makes sense: T maps exitant fields to incident ones and R maps incident ones to exitant ones, so T T
// and R R do not compile.
#pragma once

#include <concepts>
#include <cstdint>
#include <utility>

namespace neumann {

// A linear map from one kind of field to another. Operators are values that are cheap to copy, because they share large data.
template <class A>
concept Operator = requires(const A a, typename A::Domain f) {
    { a(std::move(f)) } -> std::same_as<typename A::Range>;
};

// An operator that maps a kind of field to itself.
template <class A>
concept Endomorphism = Operator<A> && std::same_as<typename A::Domain, typename A::Range>;

// An operator with an adjoint A*: ⟨A f, g⟩ = ⟨f, A* g⟩.
template <class A>
concept Adjointable = Operator<A> && requires(const A a) {
    { a.adjoint() } -> Operator;
    requires std::same_as<typename decltype(a.adjoint())::Domain, typename A::Range>;
    requires std::same_as<typename decltype(a.adjoint())::Range, typename A::Domain>;
};

template <Adjointable A>
auto adjoint(const A& a) {
    return a.adjoint();
}

// An operator on numbered unknowns with access to its entries: for_row(u, each) calls each(v, a) so that (A f)_u = Σ a f_v. An
// entry may be reported in several parts.
template <class A>
concept HasRows = Operator<A> && requires(const A a, void (*each)(std::uint32_t, double)) {
    a.for_row(std::uint32_t{}, each);
};

// The identity on one kind of field, I f = f.
template <class Field>
class Identity {
public:
    using Domain = Field;
    using Range = Field;

    Range operator()(Domain f) const { return f; }
    Identity adjoint() const { return {}; }
    template <class Each>
    void for_row(std::uint32_t u, const Each& each) const {
        each(u, 1.0);
    }
};

// A B.
template <Operator A, Operator B>
requires std::same_as<typename A::Domain, typename B::Range>
class Product {
public:
    using Domain = typename B::Domain;
    using Range = typename A::Range;

    Product(A a, B b) : a_(std::move(a)), b_(std::move(b)) {}
    const A& left() const { return a_; }
    const B& right() const { return b_; }

    Range operator()(const Domain& f) const { return a_(b_(f)); }
    Range operator()(Domain&& f) const { return a_(b_(std::move(f))); }
    auto adjoint() const requires Adjointable<A> && Adjointable<B> { return b_.adjoint() * a_.adjoint(); }
    template <class Each>
    void for_row(std::uint32_t u, const Each& each) const requires HasRows<A> && HasRows<B> {
        a_.for_row(u, [&](std::uint32_t v, double a) { b_.for_row(v, [&](std::uint32_t w, double b) { each(w, a * b); }); });
    }

private:
    A a_;
    B b_;
};

template <class A, class B>
concept Alike = Operator<A> && Operator<B> && std::same_as<typename A::Domain, typename B::Domain> &&
    std::same_as<typename A::Range, typename B::Range>;

// A + B.
template <class A, class B>
requires Alike<A, B>
class Sum {
public:
    using Domain = typename A::Domain;
    using Range = typename A::Range;

    Sum(A a, B b) : a_(std::move(a)), b_(std::move(b)) {}
    const A& left() const { return a_; }
    const B& right() const { return b_; }

    Range operator()(const Domain& f) const { return Range(a_(f) + b_(f)); }
    auto adjoint() const requires Adjointable<A> && Adjointable<B> { return a_.adjoint() + b_.adjoint(); }
    template <class Each>
    void for_row(std::uint32_t u, const Each& each) const requires HasRows<A> && HasRows<B> {
        a_.for_row(u, each);
        b_.for_row(u, each);
    }

private:
    A a_;
    B b_;
};

// A − B.
template <class A, class B>
requires Alike<A, B>
class Difference {
public:
    using Domain = typename A::Domain;
    using Range = typename A::Range;

    Difference(A a, B b) : a_(std::move(a)), b_(std::move(b)) {}
    const A& left() const { return a_; }
    const B& right() const { return b_; }

    Range operator()(const Domain& f) const { return Range(a_(f) - b_(f)); }
    auto adjoint() const requires Adjointable<A> && Adjointable<B> { return a_.adjoint() - b_.adjoint(); }
    template <class Each>
    void for_row(std::uint32_t u, const Each& each) const requires HasRows<A> && HasRows<B> {
        a_.for_row(u, each);
        b_.for_row(u, [&](std::uint32_t v, double b) { each(v, -b); });
    }

private:
    A a_;
    B b_;
};

// a A, for a number a.
template <Operator A>
class Scaled {
public:
    using Domain = typename A::Domain;
    using Range = typename A::Range;

    Scaled(double factor, A a) : factor_(factor), a_(std::move(a)) {}

    Range operator()(const Domain& f) const { return Range(factor_ * a_(f)); }
    auto adjoint() const requires Adjointable<A> { return factor_ * a_.adjoint(); }
    template <class Each>
    void for_row(std::uint32_t u, const Each& each) const requires HasRows<A> {
        a_.for_row(u, [&](std::uint32_t v, double a) { each(v, factor_ * a); });
    }

private:
    double factor_;
    A a_;
};

template <Operator A, Operator B>
requires std::same_as<typename A::Domain, typename B::Range> Product<A, B>
operator*(A a, B b) { return {std::move(a), std::move(b)}; }

template <class A, class B>
requires Alike<A, B> Sum<A, B>
operator+(A a, B b) { return {std::move(a), std::move(b)}; }

template <class A, class B>
requires Alike<A, B> Difference<A, B>
operator-(A a, B b) { return {std::move(a), std::move(b)}; }

template <Operator A>
Scaled<A> operator*(double factor, A a) {
    return {factor, std::move(a)};
}

}  // namespace neumann
