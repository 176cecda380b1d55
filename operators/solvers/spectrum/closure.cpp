#include "operators/solvers/spectrum/closure.h"

#include "operators/solvers/spectrum/fixed_numbers.h"

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

template <class Other>
double defect(const ChannelOperator& K, int pairs, const Other& other) {
    FixedNumbers numbers;
    const auto dot = [&](const Vector& f, const Vector& g) { return K.agreement().sum(f.cwiseProduct(K.measure()).dot(g)); };
    Vector f(K.size()), g(K.size()), Kf(K.size()), other_g(K.size());
    double largest = 0.0;
    for (int i = 0; i < pairs; ++i) {
        numbers.fill(K, f);
        numbers.fill(K, g);
        K.apply(f, Kf);
        other(g, other_g);
        const double size = std::sqrt(dot(Kf, Kf) * dot(g, g));
        if (size > 0.0) largest = std::max(largest, std::abs(dot(Kf, g) - dot(f, other_g)) / size);
    }
    return largest;
}

}  // namespace

Vector row_sums(const ChannelOperator& F) {
    Vector sums(F.size());
    F.apply(Vector::Ones(F.size()), sums);
    return sums;
}

double closure_defect(const ChannelOperator& F) { return F.agreement().size(row_sums(F) - Vector::Ones(F.size())); }

double reciprocity_defect(const ChannelOperator& F, int pairs) {
    return defect(F, pairs, [&](const Vector& g, Vector& y) { F.apply(g, y); });
}

double adjoint_defect(const ChannelOperator& K, int pairs) {
    return defect(K, pairs, [&](const Vector& g, Vector& y) { K.apply_adjoint(g, y); });
}

}  // namespace neumann
