#include "operators/solvers/spectrum/closed_space.h"

#include "operators/solvers/spectrum/fixed_numbers.h"

#include <Eigen/Eigenvalues>

namespace neumann {

namespace {

// Adds V's part of f to `part` and removes it from f. Removing it twice is enough (Kahan and Parlett).
void remove(const Eigen::Ref<const Eigen::MatrixXd>& V, Vector& f, Vector& part) {
    part = Vector::Zero(V.cols());
    for (int i = 0; i < 2; ++i) {
        const Vector more = V.transpose() * f;
        f -= V * more;
        part += more;
    }
}

}  // namespace

void extend(ClosedSpace& space, const ScaledProduct& K, Eigen::Index wanted) {
    FixedNumbers numbers;
    Vector f(K.rows()), part;
    while (space.V.cols() < std::min(wanted, K.rows())) {
        numbers.fill(f);
        remove(space.V, f, part);
        for (double subdiagonal = 0.0;;) {
            const Eigen::Index k = space.V.cols();
            space.V.conservativeResize(K.rows(), k + 1);
            space.V.col(k) = f.normalized();
            space.H.conservativeResizeLike(Eigen::MatrixXd::Zero(k + 1, k + 1));
            if (k > 0) space.H(k, k - 1) = subdiagonal;
            f = K(space.V.col(k));
            remove(space.V, f, part);
            space.H.col(k) = part;
            subdiagonal = f.norm();
            if (subdiagonal <= closing * K.size() || k + 1 == K.rows()) break;
        }
    }
}

std::vector<Eigenpair> leading_pairs(const Eigen::MatrixXd& V, const Eigen::MatrixXd& H, Eigen::Index wanted) {
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(H);
    std::vector<Eigenpair> pairs;
    if (solver.info() != Eigen::Success) return pairs;
    for (Eigen::Index i = 0; i < H.rows(); ++i)
        pairs.push_back({solver.eigenvalues()[i], (V * solver.eigenvectors().col(i)).normalized(), 0.0});
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Eigenpair& a, const Eigenpair& b) { return std::abs(a.value) > std::abs(b.value); });
    pairs.resize(std::min(pairs.size(), static_cast<std::size_t>(wanted)));
    return pairs;
}

std::optional<Vector> last_light(ScaledProduct& K) {
    // The lit unknowns have fixed pseudo-random numbers rather than ones, because a K with negative entries may map
    // ones to 0 by chance. They are set again after each product, so that nothing underflows.
    Vector light(K.rows());
    FixedNumbers().fill(light);
    light = light.cwiseAbs().array() + 0.5;
    Vector x = light, y(K.rows());
    for (Eigen::Index lit = K.rows(), left = 0;; lit = left) {
        y = K(x);
        if (lit == K.rows()) K.scale_to(y.lpNorm<Eigen::Infinity>());
        left = (y.array() != 0.0).count();
        if (left == 0) return x.normalized();
        if (left == lit) return std::nullopt;
        x = (y.array() != 0.0).select(light, 0.0);
    }
}

}  // namespace neumann
