// Products of operators: (A B) f = A(B f).
#pragma once

#include <concepts>
#include <utility>

namespace neumann {

// What every operator is: a map from one kind of field to another.
template <class A>
concept Operator = requires(const A a, typename A::Domain f) {
    { a(std::move(f)) } -> std::same_as<typename A::Range>;
};

template <Operator A, Operator B>
requires std::same_as<typename A::Domain, typename B::Range>
class Product {
public:
    using Domain = typename B::Domain;
    using Range = typename A::Range;

    Product(A a, B b) : a_(std::move(a)), b_(std::move(b)) {}
    Range operator()(Domain f) const { return a_(b_(std::move(f))); }

private:
    A a_;
    B b_;
};

template <Operator A, Operator B>
requires std::same_as<typename A::Domain, typename B::Range> Product<A, B>
operator*(A a, B b) { return {std::move(a), std::move(b)}; }

}  // namespace neumann
