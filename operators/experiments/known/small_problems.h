// Operators on a few unknowns, with everything known about them.
#pragma once

#include "operators/solvers/matrix_channel.h"

#include <algorithm>
#include <initializer_list>

namespace neumann::known {

inline Vector vector(std::initializer_list<double> values) {
    Vector x(static_cast<Eigen::Index>(values.size()));
    std::copy(values.begin(), values.end(), x.begin());
    return x;
}

inline DenseChannel two_by_two(double a, double b, double c, double d, double measure_0, double measure_1) {
    DenseChannel::Matrix K(2, 2);
    K << a, b, c, d;
    return {K, vector({measure_0, measure_1})};
}

// Concentric spheres of radii 0.99 and 1, albedo 0.9: F_12 = 1, F_21 = 0.99², F_22 = 1 − F_21. λ = 0.9 and −0.88209.
inline DenseChannel plates() { return two_by_two(0.0, 0.9, 0.9 * 0.9801, 0.9 * 0.0199, 0.9801, 1.0); }

// A disc of albedo 0.7 (first) under a hemisphere of albedo 0.5: F_dh = 1, F_hd = F_hh = 1/2.
inline DenseChannel dome() { return two_by_two(0.0, 0.7, 0.25, 0.25, 1.0, 2.0); }

// A furnace of three equal patches that see each other and themselves equally: K = ρ F with F_uv = 1/3.
inline DenseChannel furnace(double rho) { return {DenseChannel::Matrix::Constant(3, 3, rho / 3), Vector::Ones(3)}; }

// Three mirrors that send light round: K moves the value of each unknown to the next, times ρ.
inline DenseChannel carousel(double rho) {
    DenseChannel::Matrix K = DenseChannel::Matrix::Zero(3, 3);
    K(1, 0) = K(2, 1) = K(0, 2) = rho;
    return {K, Vector::Ones(3)};
}

// The inside of a sphere in two halves of albedo a and b: everything is seen equally, F_uv = 1/2. λ = (a + b)/2 and 0.
inline DenseChannel sphere_halves(double a, double b) { return two_by_two(a / 2, a / 2, b / 2, b / 2, 1.0, 1.0); }

// Rooms of one unknown each that do not see each other.
inline DenseChannel separate_rooms(double a, double b) { return two_by_two(a, 0.0, 0.0, b, 1.0, 1.0); }

}  // namespace neumann::known
