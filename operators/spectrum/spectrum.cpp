#include "operators/spectrum/spectrum.h"

#include <Spectra/GenEigsSolver.h>
#include <Spectra/SymEigsSolver.h>
#include <Eigen/Eigenvalues>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace neumann {

namespace {

constexpr Eigen::Index small = 64;
constexpr double tolerance = 1e-12;
// A pair counts as found if its residual is below this, relative to the eigenvalue's modulus.
constexpr double found = 1e-10;
// Never reached: the applications of K are limited instead.
constexpr Eigen::Index most_restarts = 1 << 20;
// After this many applications, and at every doubling, the number that is still needed is predicted.
constexpr double first_forecast = 512.0;

struct Ended {};

// The interface of a matrix that Spectra expects.
class SpectraMatrix {
public:
    using Scalar = double;

    SpectraMatrix(Eigen::Index size, std::function<void(const Vector&, Vector&)> apply)
        : apply_(std::move(apply)), input_(size), output_(size) {}

    // Called with the address of each vector that K is to be applied to; may throw to end a search.
    std::function<void(const double*)> watch = [](const double*) {};

    Eigen::Index rows() const { return input_.size(); }
    Eigen::Index cols() const { return input_.size(); }
    void perform_op(const double* x, double* y) const {
        watch(x);
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

Eigenpairs finish(const SpectraMatrix& product, const Eigen::VectorXcd& values, const Eigen::MatrixXcd& vectors,
                  Eigen::Index count) {
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

// Arnoldi's method that can be observed and stopped at every application of K.
class Arnoldi : public Spectra::GenEigsSolver<SpectraMatrix> {
public:
    Arnoldi(SpectraMatrix& product, Eigen::Index wanted, Eigen::Index dimensions, const EigenLimits& limits)
        : GenEigsSolver(product, wanted, dimensions), product_(product), limits_(limits) {
        product.watch = [this](const double* x) { look(x); };
    }
    ~Arnoldi() override {
        product_.watch = [](const double*) {};
    }
    Arnoldi(const Arnoldi&) = delete;
    Arnoldi& operator=(const Arnoldi&) = delete;

    // Approximations of the wanted pairs from the space spanned so far: K V = V H + f eᵀ, so V y has the residual |f| |y_last|.
    std::vector<Eigenpair> approximations() const {
        std::vector<Eigenpair> pairs;
        if (columns_ < m_nev) return pairs;
        const Eigen::EigenSolver<Eigen::MatrixXd> small_one(m_fac.matrix_H().topLeftCorner(columns_, columns_));
        for (const Eigen::Index i : leading(small_one)) {
            const Eigen::VectorXcd y = small_one.eigenvectors().col(i).normalized();
            pairs.push_back({small_one.eigenvalues()[i], m_fac.matrix_V().leftCols(columns_) * y, residual(y)});
        }
        return pairs;
    }
    const std::vector<EigenStep>& history() const { return history_; }
    const std::string& why() const { return why_; }

private:
    void look(const double* x) {
        const double* const V = m_fac.matrix_V().data();
        const bool in_basis = V && x >= V && x < V + m_n * m_ncv;
        const Eigen::Index before = columns_;
        // x is the column of V after the space's last one.
        columns_ = in_basis ? (x - V) / m_n : 0;
        if (columns_ >= m_nev && columns_ <= before) note();
        const EigenStep last = history_.empty() ? EigenStep{product_.applications()} : history_.back();
        if (product_.applications() >= limits_.most) end("");
        limits_.look({product_.applications(), last.residual});
        if (limits_.watch.stop()) end("stopped");
    }
    // Called after each restart.
    void note() {
        EigenStep step{product_.applications(), 0.0};
        const Eigen::EigenSolver<Eigen::MatrixXd> small_one(m_fac.matrix_H().topLeftCorner(columns_, columns_));
        for (const Eigen::Index i : leading(small_one))
            step.residual = std::max(step.residual, residual(small_one.eigenvectors().col(i).normalized()) /
                                                        std::max(std::abs(small_one.eigenvalues()[i]), 1e-12));
        history_.push_back(step);
        if (step.applications < forecast_) return;
        forecast_ *= 2.0;
        // The residual is assumed to go on falling as it fell from the first half of the search to the second.
        double first = std::numeric_limits<double>::infinity(), second = first;
        for (const EigenStep& s : history_) {
            double& best = s.applications < 0.5 * step.applications ? first : second;
            best = std::min(best, s.residual);
        }
        const double rate = std::log(first / second) / (0.5 * step.applications);
        if (!(rate > 0.0) || step.applications + std::log(second / tolerance) / rate > limits_.most)
            end(fmt::format("it falls too slowly for {:.0f}", limits_.most));
    }
    [[noreturn]] void end(const std::string& because) {
        const double largest = history_.empty() ? std::numeric_limits<double>::quiet_NaN() : history_.back().residual;
        why_ = fmt::format("not found within {:.0f} applications of K, {}{}", product_.applications(),
                           history_.empty() ? "too few to say more" : fmt::format("largest residual {:.1e}", largest),
                           because.empty() ? "" : ": " + because);
        throw Ended();
    }
    std::vector<Eigen::Index> leading(const Eigen::EigenSolver<Eigen::MatrixXd>& small_one) const {
        std::vector<Eigen::Index> order(static_cast<std::size_t>(small_one.eigenvalues().size()));
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Eigen::Index>(i);
        std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
            return std::abs(small_one.eigenvalues()[a]) > std::abs(small_one.eigenvalues()[b]);
        });
        order.resize(static_cast<std::size_t>(m_nev));
        return order;
    }
    double residual(const Eigen::VectorXcd& y) const {
        return m_fac.matrix_H()(columns_, columns_ - 1) * std::abs(y[columns_ - 1]);
    }

    SpectraMatrix& product_;
    const EigenLimits& limits_;
    Eigen::Index columns_ = 0;  // finished columns of V and H
    double forecast_ = first_forecast;
    std::vector<EigenStep> history_;
    std::string why_;
};

}  // namespace

OperatorNorms operator_norms(const ChannelOperator& K, const EigenLimits& limits) {
    const Eigen::Index n = K.size();
    OperatorNorms norms;
    if (n == 0) return norms;
    Vector sums(n);
    const Vector ones = Vector::Ones(n);
    K.apply(ones, sums);
    norms.sup = sums.maxCoeff();
    K.apply_adjoint(ones, sums);
    norms.one = sums.maxCoeff(&norms.one_at);
    // D K*K D⁻¹ with D = diag(√m) is symmetric.
    const Vector root = K.measure().cwiseSqrt();
    Vector once(n);
    SpectraMatrix square(n, [&](const Vector& x, Vector& y) {
        K.apply(x.cwiseQuotient(root), once);
        K.apply_adjoint(once, y);
        y.array() *= root.array();
    });
    double largest = 0.0;
    if (n <= small) {
        const Eigen::MatrixXd matrix = square.formed();
        largest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
    } else {
        square.watch = [&](const double*) {
            // Each application is one of K and one of K*.
            limits.look({2.0 * square.applications()});
            if (2.0 * square.applications() >= limits.most || limits.watch.stop()) throw Ended();
        };
        Spectra::SymEigsSolver<SpectraMatrix> lanczos(square, 1, 20);
        try {
            lanczos.init();
            lanczos.compute(Spectra::SortRule::LargestMagn, 1000, 1e-13);
            largest = lanczos.info() == Spectra::CompInfo::Successful ? lanczos.eigenvalues()[0]
                                                                      : std::numeric_limits<double>::quiet_NaN();
        } catch (const Ended&) {
            largest = std::numeric_limits<double>::quiet_NaN();
        }
    }
    norms.two = std::isnan(largest) ? largest : std::sqrt(std::max(largest, 0.0));
    return norms;
}

double Eigenpairs::radius() const {
    if (pairs.empty() || !(converged || pairs.front().residual <= found * std::abs(pairs.front().value)))
        return std::numeric_limits<double>::quiet_NaN();
    return std::abs(pairs.front().value);
}

Eigenpairs leading_eigenpairs(const ChannelOperator& K, int count, bool adjoint, const EigenLimits& limits) {
    const Eigen::Index n = K.size(), wanted = std::min<Eigen::Index>(count, n);
    SpectraMatrix product(n, [&](const Vector& x, Vector& y) { adjoint ? K.apply_adjoint(x, y) : K.apply(x, y); });
    if (wanted <= 0) return {};
    if (n <= small || wanted > n - 2) {
        const Eigen::EigenSolver<Eigen::MatrixXd> solver(product.formed());
        return finish(product, solver.eigenvalues(), solver.eigenvectors(), wanted);
    }
    Arnoldi arnoldi(product, wanted, std::min(n, std::max<Eigen::Index>(2 * wanted + 1, 20)), limits);
    try {
        arnoldi.init();
        arnoldi.compute(Spectra::SortRule::LargestMagn, most_restarts, tolerance);
    } catch (const Ended&) {
        return {arnoldi.approximations(), false, product.applications(), arnoldi.history(), arnoldi.why()};
    }
    product.watch = [](const double*) {};
    Eigenpairs result = finish(product, arnoldi.eigenvalues(), arnoldi.eigenvectors(), wanted);
    result.history = arnoldi.history();
    return result;
}

double spectral_radius(const ChannelOperator& K) { return leading_eigenpairs(K, 1).radius(); }

}  // namespace neumann
