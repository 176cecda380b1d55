#include "operators/solvers/spectrum/spectrum.h"

#include "operators/solvers/spectrum/closed_space.h"

#include <Spectra/GenEigsSolver.h>
#include <Spectra/SymEigsSolver.h>
#include <Eigen/Eigenvalues>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace neumann {

namespace {

constexpr Eigen::Index small = 64;
constexpr double tolerance = 1e-12;
// A pair counts as found if its residual is below this, relative to the eigenvalue's modulus …
constexpr double found = 1e-10;
// … or below this, relative to the size of K: an eigenvalue that is 0, or nearly, is not known better.
constexpr double rounding = 64.0 * std::numeric_limits<double>::epsilon();
// This many restarts are never reached: the applications of K are limited instead.
constexpr Eigen::Index most_restarts = 1 << 20;
// After this many applications, and at every doubling, the number that is still needed is predicted.
constexpr double first_forecast = 512.0;

// Thrown when the first `columns` columns of V span a space that K maps into itself.
struct Closed {
    Eigen::Index columns;
};

// A search by Spectra that ends where its space closes. `Base` is GenEigsSolver or SymEigsSolver.
template <class Base>
class ClosingSearch : public Base {
public:
    ClosingSearch(ScaledProduct& K, Eigen::Index wanted, Eigen::Index dimensions) : Base(K, wanted, dimensions), K_(K) {
        K.observer = [this](const double* x) { look(x); };
    }
    ~ClosingSearch() override { ends(); }
    ClosingSearch(const ClosingSearch&) = delete;
    ClosingSearch& operator=(const ClosingSearch&) = delete;

    // Stops watching K, which may then be applied to vectors that are not columns of V.
    void ends() {
        K_.observer = [](const double*) {};
    }
    ClosedSpace space(Eigen::Index columns) const {
        return {this->m_fac.matrix_V().leftCols(columns), this->m_fac.matrix_H().topLeftCorner(columns, columns)};
    }

protected:
    // The number of columns of H that are finished; V has one more.
    Eigen::Index finished() const { return std::max<Eigen::Index>(last_, 0); }
    ScaledProduct& product() const { return K_; }
    // Called after each restart, with as many columns finished as the restart kept.
    virtual void restarted() {}

private:
    void look(const double* x) {
        const Eigen::MatrixXd &V = this->m_fac.matrix_V(), &H = this->m_fac.matrix_H();
        const bool in_basis = V.size() > 0 && x >= V.data() && x < V.data() + V.size();
        if (!in_basis) {
            // The first vector of all is not in V. Later ones start a new space, because the columns so far have closed one.
            if (last_ < 0) return;
            throw Closed{last_ + 1 == this->m_ncv ? this->m_fac.subspace_dim() : last_ + 1};
        }
        const Eigen::Index before = std::exchange(last_, (x - V.data()) / V.rows());
        if (last_ > 0 && std::abs(H(last_, last_ - 1)) <= closing * K_.size()) throw Closed{last_};
        if (last_ <= before) restarted();
    }

    ScaledProduct& K_;
    Eigen::Index last_ = -1;  // the column of V that K was last applied to
};

// Arnoldi's method with its history, and a forecast of how long it will take.
class Arnoldi : public ClosingSearch<Spectra::GenEigsSolver<ScaledProduct>> {
public:
    Arnoldi(ScaledProduct& K, Eigen::Index wanted, Eigen::Index dimensions, double most)
        : ClosingSearch(K, wanted, dimensions), most_(most) {}

    // Approximations of the wanted pairs from the space spanned so far.
    std::vector<Eigenpair> approximations() const {
        if (finished() < m_nev) return {};
        std::vector<Eigenpair> pairs = small_pairs();
        for (Eigenpair& pair : pairs) pair.vector = m_fac.matrix_V().leftCols(finished()) * pair.vector;
        return pairs;
    }
    const std::vector<EigenStep>& history() const { return history_; }

private:
    void restarted() override {
        if (finished() < m_nev) return;
        EigenStep step{product().applications(), 0.0};
        for (const Eigenpair& pair : small_pairs())
            step.residual = std::max(step.residual, pair.residual / std::max(std::abs(pair.value), 1e-12));
        history_.push_back(step);
        product().residual = step.residual;
        if (step.applications < forecast_) return;
        forecast_ *= 2.0;
        // The residual is assumed to go on falling as it fell from the first half of the search to the second.
        double first = std::numeric_limits<double>::infinity(), second = first;
        for (const EigenStep& s : history_) {
            double& best = s.applications < 0.5 * step.applications ? first : second;
            best = std::min(best, s.residual);
        }
        const double rate = std::log(first / second) / (0.5 * step.applications);
        if (!(rate > 0.0) || step.applications + std::log(second / tolerance) / rate > most_)
            throw EndedSearch{fmt::format("it falls too slowly for {:.0f}", most_)};
    }

    // Eigenpairs (λ, y) of H. As K V = V H + f eᵀ, V y has the residual |f| |y_last|.
    std::vector<Eigenpair> small_pairs() const {
        const Eigen::Index k = finished();
        const auto& H = m_fac.matrix_H();
        std::vector<Eigenpair> pairs = leading_pairs(Eigen::MatrixXd::Identity(k, k), H.topLeftCorner(k, k), m_nev);
        for (Eigenpair& pair : pairs) pair.residual = std::abs(H(k, k - 1)) * std::abs(pair.vector[k - 1]);
        return pairs;
    }

    double most_;
    double forecast_ = first_forecast;
    std::vector<EigenStep> history_;
};

using Lanczos = ClosingSearch<Spectra::SymEigsSolver<ScaledProduct>>;

std::string not_found(const ScaledProduct& K, const std::vector<EigenStep>& history, const std::string& because) {
    return fmt::format("not found within {:.0f} applications of K, {}{}", K.applications(),
                       history.empty() ? "too few to say more" : fmt::format("largest residual {:.1e}", history.back().residual),
                       because.empty() ? "" : ": " + because);
}

void unscale(Eigenpair& pair, const ScaledProduct& K) {
    pair.value = {K.unscaled(pair.value.real()), K.unscaled(pair.value.imag())};
    pair.residual = K.unscaled(pair.residual);
}

// Checks with K itself whether the pairs are eigenpairs, however the search ended.
void check(Eigenpairs& result, const ScaledProduct& K, Eigen::Index wanted) {
    EigenStep last;
    last.residual = 0.0;
    result.converged = static_cast<Eigen::Index>(result.pairs.size()) == wanted;
    for (Eigenpair& pair : result.pairs) {
        const Vector real = K.unlimited(pair.vector.real());
        const Vector imaginary =
            pair.vector.imag().isZero(0.0) ? Vector::Zero(real.size()).eval() : K.unlimited(pair.vector.imag());
        pair.residual = (real + std::complex<double>(0.0, 1.0) * imaginary - pair.value * pair.vector).norm();
        const double size = std::abs(pair.value);
        if (!(pair.residual <= std::max(found * size, rounding * K.size()))) result.converged = false;
        if (pair.residual > 0.0) last.residual = std::max(last.residual, pair.residual / size);
        unscale(pair, K);
    }
    result.applications = K.applications();
    if (!result.converged) result.why = not_found(K, {last}, "K does not keep the vectors that the search ended with");
}

std::vector<Eigenpair> dark_pairs(const Vector& v, Eigen::Index wanted) {
    return {static_cast<std::size_t>(wanted), {0.0, v.cast<std::complex<double>>(), 0.0}};
}

Eigenpairs pairs_of_matrix(const Eigen::MatrixXd& matrix, Eigen::Index wanted) {
    const EigenLimits none{.most = std::numeric_limits<double>::infinity()};
    const Eigen::Index n = matrix.rows();
    ScaledProduct product(
        n, [&](const Vector& x, Vector& y) { y.noalias() = matrix * x; }, none);
    Eigenpairs result;
    const std::optional<Vector> dark = last_light(product);
    result.pairs = dark ? dark_pairs(*dark, wanted)
                        : leading_pairs(Eigen::MatrixXd::Identity(n, n),
                                        matrix.unaryExpr([&](double x) { return product.scaled(x); }), wanted);
    check(result, product, wanted);
    return result;
}

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
    const double scale = norms.sup > 0.0 ? std::ldexp(1.0, -std::ilogb(norms.sup)) : 1.0;
    ScaledProduct square(
        n,
        [&](const Vector& x, Vector& y) {
            K.apply(scale * x.cwiseQuotient(root), once);
            K.apply_adjoint(scale * once, y);
            y.array() *= root.array();
        },
        limits, 2.0);
    norms.two = std::numeric_limits<double>::quiet_NaN();
    const auto found = [&](double largest) { norms.two = std::sqrt(std::max(square.unscaled(largest), 0.0)) / scale; };
    try {
        if (n <= small) {
            found(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(square.formed(), Eigen::EigenvaluesOnly).eigenvalues().maxCoeff());
        } else if (last_light(square)) {
            found(0.0);
        } else {
            Lanczos lanczos(square, 1, 20);
            try {
                lanczos.init();
                lanczos.compute(Spectra::SortRule::LargestMagn, 1000, 1e-13);
                if (lanczos.info() == Spectra::CompInfo::Successful) found(lanczos.eigenvalues()[0]);
            } catch (const Closed& closed) {
                const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> small_one(lanczos.space(closed.columns).H,
                                                                               Eigen::EigenvaluesOnly);
                found(small_one.eigenvalues().maxCoeff());
            }
        }
    } catch (const EndedSearch&) {
    }
    return norms;
}

double Eigenpairs::radius() const {
    if (pairs.empty() || !(converged || pairs.front().residual <= found * std::abs(pairs.front().value)))
        return std::numeric_limits<double>::quiet_NaN();
    return std::abs(pairs.front().value);
}

Eigenpairs leading_eigenpairs(const ChannelOperator& K, int count, bool adjoint, const EigenLimits& limits) {
    const Eigen::Index n = K.size(), wanted = std::min<Eigen::Index>(count, n);
    if (wanted <= 0) return {};
    ScaledProduct product(
        n, [&](const Vector& x, Vector& y) { adjoint ? K.apply_adjoint(x, y) : K.apply(x, y); }, limits);
    Eigenpairs result;
    std::optional<Arnoldi> search;
    try {
        if (n <= small || wanted > n - 2) {
            result = pairs_of_matrix(product.formed(), wanted);
            result.applications = product.applications();
            return result;
        }
        if (const std::optional<Vector> dark = last_light(product)) {
            result.pairs = dark_pairs(*dark, wanted);
        } else {
            search.emplace(product, wanted, std::min(n, std::max<Eigen::Index>(2 * wanted + 1, 20)), limits.most);
            try {
                search->init();
                search->compute(Spectra::SortRule::LargestMagn, most_restarts, tolerance);
                const Eigen::VectorXcd values = search->eigenvalues();
                const Eigen::MatrixXcd vectors = search->eigenvectors();
                for (Eigen::Index i = 0; i < values.size(); ++i)
                    result.pairs.push_back({values[i], vectors.col(i).normalized(), 0.0});
            } catch (const Closed& closed) {
                ClosedSpace space = search->space(closed.columns);
                search->ends();
                extend(space, product, wanted);
                result.pairs = leading_pairs(space.V, space.H, wanted);
            }
            result.history = search->history();
        }
        check(result, product, wanted);
    } catch (const EndedSearch& ended) {
        result = {};
        if (search) {
            result.pairs = search->approximations();
            result.history = search->history();
        }
        for (Eigenpair& pair : result.pairs) unscale(pair, product);
        result.applications = product.applications();
        result.why = not_found(product, result.history, ended.because);
    }
    return result;
}

double spectral_radius(const ChannelOperator& K) { return leading_eigenpairs(K, 1).radius(); }

}  // namespace neumann
