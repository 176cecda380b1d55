// K given as a matrix, dense or sparse: (K x)_u = Σ_v K_uv x_v,  K* = M⁻¹ Kᵀ M with M = diag(measure).
#pragma once

#include "operators/algebra/channel_operator.h"

#include <Eigen/SparseCore>

#include <stdexcept>

namespace neumann {

// Throws std::invalid_argument if the sizes do not match or a measure is not positive.
inline void check_channel(Eigen::Index rows, Eigen::Index columns, const Vector& measure) {
    if (rows != columns || rows != measure.size())
        throw std::invalid_argument("K has to be square, with a measure for each unknown");
    if (!(measure.array() > 0.0).all()) throw std::invalid_argument("the measure of every unknown has to be positive");
}

class DenseChannel : public ChannelOperator {
public:
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    DenseChannel(Matrix K, Vector measure) : K_(std::move(K)), measure_(std::move(measure)) {
        check_channel(K_.rows(), K_.cols(), measure_);
    }

    const Matrix& matrix() const { return K_; }

    Eigen::Index size() const override { return K_.rows(); }
    void apply(const Vector& x, Vector& y) const override { y.noalias() = K_ * x; }
    void apply_adjoint(const Vector& x, Vector& y) const override {
        y.noalias() = K_.transpose() * x.cwiseProduct(measure_);
        y.array() /= measure_.array();
    }
    double row(Eigen::Index u, const Vector& x) const override { return K_.row(u).dot(x); }
    double diagonal(Eigen::Index u) const override { return K_(u, u); }
    void add_column(Eigen::Index u, double a, Vector& y) const override { y += a * K_.col(u); }
    void for_row(Eigen::Index u, const Entry& each) const override {
        for (Eigen::Index v = 0; v < K_.cols(); ++v)
            if (K_(u, v) != 0.0) each(static_cast<std::size_t>(v), K_(u, v));
    }
    const Vector& measure() const override { return measure_; }

private:
    Matrix K_;
    Vector measure_;
};

class SparseChannel : public ChannelOperator {
public:
    using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

    SparseChannel(Matrix K, Vector measure) : K_(std::move(K)), transposed_(K_.transpose()), measure_(std::move(measure)) {
        check_channel(K_.rows(), K_.cols(), measure_);
    }

    Eigen::Index size() const override { return K_.rows(); }
    void apply(const Vector& x, Vector& y) const override { y.noalias() = K_ * x; }
    void apply_adjoint(const Vector& x, Vector& y) const override {
        y.noalias() = transposed_ * x.cwiseProduct(measure_);
        y.array() /= measure_.array();
    }
    double row(Eigen::Index u, const Vector& x) const override { return K_.row(u).dot(x); }
    double diagonal(Eigen::Index u) const override { return K_.coeff(u, u); }
    void add_column(Eigen::Index u, double a, Vector& y) const override {
        for (Matrix::InnerIterator entry(transposed_, u); entry; ++entry) y[entry.col()] += a * entry.value();
    }
    void for_row(Eigen::Index u, const Entry& each) const override {
        for (Matrix::InnerIterator entry(K_, u); entry; ++entry) each(static_cast<std::size_t>(entry.col()), entry.value());
    }
    const Vector& measure() const override { return measure_; }

private:
    Matrix K_, transposed_;
    Vector measure_;
};

}  // namespace neumann
