// D (I − K) D⁻¹ as a matrix-free operator for Eigen's iterative solvers. With D = diag(√measure) their Euclidean inner product is
// the one weighted with the measure.
#pragma once

#include "operators/algebra/channel_operator.h"

#include <Eigen/IterativeLinearSolvers>

#include <functional>

namespace neumann {
class EigenSystem;
}

template <>
struct Eigen::internal::traits<neumann::EigenSystem> : Eigen::internal::traits<Eigen::SparseMatrix<double>> {};

namespace neumann {

class EigenSystem : public Eigen::EigenBase<EigenSystem> {
public:
    using Scalar = double;
    using RealScalar = double;
    using StorageIndex = int;
    enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic, IsRowMajor = false };

    // `applied` is called for each application of K. K is not applied to the zero vector.
    EigenSystem(const ChannelOperator& K, std::function<void()> applied)
        : K_(&K), root_(K.measure().cwiseSqrt()), applied_(std::move(applied)) {}

    Eigen::Index rows() const { return K_->size(); }
    Eigen::Index cols() const { return K_->size(); }

    Vector scaled(const Vector& x) const { return root_.cwiseProduct(x); }     // D x
    Vector unscaled(const Vector& y) const { return y.cwiseQuotient(root_); }  // D⁻¹ y

    Vector times(const Vector& y) const {
        if (y.isZero(0.0)) return Vector::Zero(y.size());
        Vector Kx(y.size());
        applied_();
        K_->apply(unscaled(y), Kx);
        return y - scaled(Kx);
    }

    template <class Rhs>
    Eigen::Product<EigenSystem, Rhs, Eigen::AliasFreeProduct> operator*(const Eigen::MatrixBase<Rhs>& x) const {
        return {*this, x.derived()};
    }

private:
    const ChannelOperator* K_;
    Vector root_;
    std::function<void()> applied_;
};

}  // namespace neumann

template <class Rhs>
struct Eigen::internal::generic_product_impl<neumann::EigenSystem, Rhs, Eigen::SparseShape, Eigen::DenseShape, Eigen::GemvProduct>
    : Eigen::internal::generic_product_impl_base<neumann::EigenSystem, Rhs,
                                                 Eigen::internal::generic_product_impl<neumann::EigenSystem, Rhs>> {
    template <class Result>
    static void scaleAndAddTo(Result& result, const neumann::EigenSystem& system, const Rhs& x, double a) {
        result += a * system.times(x);
    }
};
