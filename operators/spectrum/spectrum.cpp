#include "operators/spectrum/spectrum.h"

#include <Spectra/GenEigsSolver.h>
#include <Spectra/SymEigsSolver.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace neumann {

namespace {

constexpr Eigen::Index small = 64;

// What Spectra asks of a matrix.
class Product {
public:
    using Scalar = double;

    Product(Eigen::Index size, std::function<void(const Vector&, Vector&)> apply)
        : apply_(std::move(apply)), input_(size), output_(size) {}

    Eigen::Index rows() const { return input_.size(); }
    Eigen::Index cols() const { return input_.size(); }
    void perform_op(const double* x, double* y) const {
        input_ = Eigen::Map<const Vector>(x, input_.size());
        apply_(input_, output_);
        Eigen::Map<Vector>(y, output_.size()) = output_;
        ++applications_;
    }
    Eigen::MatrixXd formed() const {
        Eigen::MatrixXd matrix(rows(), cols());
        for (Eigen::Index u = 0; u < cols(); ++u) perform_op(Vector::Unit(cols(), u).eval().data(), matrix.col(u).data());
        return matrix;
    }
    double applications() const { return applications_; }

private:
    std::function<void(const Vector&, Vector&)> apply_;
    mutable Vector input_, output_;
    mutable double applications_ = 0.0;
};

Eigenpairs finish(const Product& product, const Eigen::VectorXcd& values, const Eigen::MatrixXcd& vectors, Eigen::Index count) {
    Eigenpairs result;
    for (Eigen::Index i = 0; i < values.size(); ++i) result.pairs.push_back({values[i], vectors.col(i).normalized(), 0.0});
    std::stable_sort(result.pairs.begin(), result.pairs.end(),
                     [](const Eigenpair& a, const Eigenpair& b) { return std::abs(a.value) > std::abs(b.value); });
    if (static_cast<Eigen::Index>(result.pairs.size()) > count) result.pairs.resize(static_cast<std::size_t>(count));
    result.converged = static_cast<Eigen::Index>(result.pairs.size()) == count;
    for (Eigenpair& pair : result.pairs) {
        Vector real(product.rows()), imaginary = Vector::Zero(product.rows());
        product.perform_op(pair.vector.real().eval().data(), real.data());
        if (!pair.vector.imag().isZero(0.0)) product.perform_op(pair.vector.imag().eval().data(), imaginary.data());
        pair.residual = (real + std::complex<double>(0.0, 1.0) * imaginary - pair.value * pair.vector).norm();
    }
    result.applications = product.applications();
    return result;
}

}  // namespace

OperatorNorms operator_norms(const ChannelOperator& K) {
    const Eigen::Index n = K.size();
    OperatorNorms norms;
    if (n == 0) return norms;
    Vector sums(n);
    const Vector ones = Vector::Ones(n);
    K.apply(ones, sums);
    norms.sup = sums.maxCoeff();
    K.apply_adjoint(ones, sums);
    norms.one = sums.maxCoeff();
    // D K*K D⁻¹ with D = diag(√m) is symmetric.
    const Vector root = K.measure().cwiseSqrt();
    Vector once(n);
    Product square(n, [&](const Vector& x, Vector& y) {
        K.apply(x.cwiseQuotient(root), once);
        K.apply_adjoint(once, y);
        y.array() *= root.array();
    });
    double largest = 0.0;
    if (n <= small) {
        const Eigen::MatrixXd matrix = square.formed();
        largest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
    } else {
        Spectra::SymEigsSolver<Product> lanczos(square, 1, 20);
        lanczos.init();
        lanczos.compute(Spectra::SortRule::LargestMagn, 1000, 1e-13);
        largest =
            lanczos.info() == Spectra::CompInfo::Successful ? lanczos.eigenvalues()[0] : std::numeric_limits<double>::quiet_NaN();
    }
    norms.two = std::sqrt(std::max(largest, 0.0));
    return norms;
}

Eigenpairs leading_eigenpairs(const ChannelOperator& K, int count, bool adjoint) {
    const Eigen::Index n = K.size(), wanted = std::min<Eigen::Index>(count, n);
    Product product(n, [&](const Vector& x, Vector& y) { adjoint ? K.apply_adjoint(x, y) : K.apply(x, y); });
    if (wanted <= 0) return {};
    if (n <= small || wanted > n - 2) {
        const Eigen::EigenSolver<Eigen::MatrixXd> solver(product.formed());
        return finish(product, solver.eigenvalues(), solver.eigenvectors(), wanted);
    }
    Spectra::GenEigsSolver<Product> arnoldi(product, wanted, std::min(n, std::max<Eigen::Index>(2 * wanted + 1, 20)));
    arnoldi.init();
    arnoldi.compute(Spectra::SortRule::LargestMagn, 1000, 1e-12);
    return finish(product, arnoldi.eigenvalues(), arnoldi.eigenvectors(), wanted);
}

double spectral_radius(const ChannelOperator& K) {
    const Eigenpairs leading = leading_eigenpairs(K, 1);
    return leading.pairs.empty() ? std::numeric_limits<double>::quiet_NaN() : std::abs(leading.pairs.front().value);
}

}  // namespace neumann
