#include "operators/solvers/petsc/petsc_solver.h"

#include "operators/solvers/solver_log.h"
#include "operators/solvers/spectrum/fixed_numbers.h"
#include "operators/solvers/stoppable.h"

#include <fmt/format.h>

namespace neumann {

namespace {

std::vector<std::string> messages_of(const Petsc& petsc) {
    std::vector<std::string> messages;
    for (const std::string& option : petsc.unused_options())
        messages.push_back("PETSc: nothing has asked for the option " + option);
    return messages;
}

PetscMatrix rows_of(const ChannelOperator& K) {
    PetscMatrix A;
    A.size = K.size();
    A.first = K.first();
    A.all = K.unknowns();
    return A;
}

PetscMatrix one_minus(PetscMatrix K) {
    PetscMatrix A = K;
    A.apply = [of_K = K.apply](const Vector& x, Vector& y) {
        of_K(x, y);
        y = x - y;
    };
    A.apply_transposed = [of_K = K.apply_transposed](const Vector& x, Vector& y) {
        of_K(x, y);
        y = x - y;
    };
    A.diagonal = [of_K = K.diagonal](Eigen::Index u) { return 1.0 - of_K(u); };
    A.row = [first = K.first, of_K = K.row](Eigen::Index u, const auto& each) {
        each(first + static_cast<std::size_t>(u), 1.0);
        of_K(u, [&](std::size_t v, double a) { each(v, -a); });
    };
    return A;
}

}  // namespace

PetscMatrix petsc_matrix(const ChannelOperator& K) {
    PetscMatrix A = rows_of(K);
    A.apply = [&K](const Vector& x, Vector& y) { K.apply(x, y); };
    // Kᵀ = M K* M⁻¹.
    A.apply_transposed = [&K](const Vector& x, Vector& y) {
        K.apply_adjoint(x.cwiseQuotient(K.measure()), y);
        y.array() *= K.measure().array();
    };
    A.diagonal = [&K](Eigen::Index u) { return K.diagonal(u); };
    A.row = [&K](Eigen::Index u, const auto& each) { K.for_row(u, each); };
    return A;
}

std::vector<std::string> petsc_options(const std::string& text) {
    if (!text.empty()) return {text};
    return {"-ksp_type gmres -pc_type none", "-ksp_type gmres -pc_type jacobi", "-ksp_type bcgs -pc_type bjacobi",
            "-ksp_type gmres -pc_type gamg"};
}

SolverResult solve_petsc(const Problem& problem, Petsc& petsc, std::string& method) {
    SolverLog log(problem);
    PetscMatrix K = petsc_matrix(*problem.K);
    K.apply = [&](const Vector& x, Vector& y) { log.apply(x, y); };
    const PetscMatrix A = one_minus(std::move(K));
    Vector x = Vector::Zero(problem.Le.size()), r(x.size());
    const std::unique_ptr<PetscLinear> linear = petsc.linear(A);
    method = linear->method();
    if (log.largest(problem.Le) == 0.0) return log.end(x, Verdict::converged, "nothing emits");
    double first = std::numeric_limits<double>::quiet_NaN();
    const PetscLinear::OnIterate on_iterate = [&](int, double residual, const std::function<Vector()>& iterate) {
        if (std::isnan(first)) first = residual;
        const double error = problem.exact ? log.true_error(iterate()) : std::numeric_limits<double>::quiet_NaN();
        log.record(residual / first, error);
    };
    const double least = std::numeric_limits<double>::epsilon();
    double goal = log.first_goal();
    try {
        for (;;) {
            const int most = static_cast<int>(problem.most) - static_cast<int>(log.own_applications());
            const PetscLinear::End end = linear->solve(problem.Le, x, goal, most, on_iterate);
            log.apply(x, r);
            r += problem.Le - x;
            const double estimate = log.from_residual(r, x);
            if (log.reached(x, estimate)) return log.end(x, Verdict::converged, "by the residual");
            if (log.exhausted()) return log.end_limit(x);
            if (!end.converged) return log.end(x, Verdict::broke_down, "PETSc ended with " + end.why);
            if (end.own_tolerance)
                return log.end(x, Verdict::limit, "PETSc ended with " + end.why + ", the tolerance that its options set");
            if (goal <= least && log.is_rounding(log.largest(r), x, false)) return log.end_rounding(x, estimate);
            if (goal <= least) return log.end(x, Verdict::limit, "PETSc's tolerance cannot be smaller");
            goal = std::max(0.1 * goal, least);
        }
    } catch (const Stopped&) {
        throw;
    } catch (const RunError& e) {
        return log.end(x, Verdict::broke_down, e.what());
    }
}

std::vector<std::string> add_petsc_rows(const Problem& problem, const std::vector<std::string>& options, bool histories,
                                        const Watch& watch, SideBySide& all) {
    std::vector<std::string> messages;
    const StoppableChannel K(*problem.K, watch);
    const Agreement& agreement = K.agreement();
    Problem plain = problem;
    plain.K = &K;
    plain.exact = nullptr;
    try {
        for (const std::string& of : options) {
            if (all.interrupted) break;
            const std::unique_ptr<Petsc> petsc = start_petsc(of);
            SolverRow row;
            std::string method;
            const Stopwatch clock;
            row.result = solve_petsc(plain, *petsc, method);
            row.seconds = clock.seconds();
            const bool known = all.exact.size() == K.size() && all.no_reference.empty();
            if (known && agreement.size(all.exact) > 0.0)
                row.error = agreement.size(row.result.x - all.exact) / agreement.size(all.exact);
            if (known && histories) {
                Problem judged = plain;
                judged.exact = &all.exact;
                row.result.history = solve_petsc(judged, *petsc, method).history;
            }
            row.title = "PETSc " + method;
            row.name = "petsc-" + method;
            std::replace(row.name.begin(), row.name.end(), '/', '-');
            all.rows.push_back(std::move(row));
            for (const std::string& text : messages_of(*petsc)) messages.push_back(text);
        }
    } catch (const Stopped&) {
        all.interrupted = true;
    }
    return messages;
}

Eigenpairs slepc_eigenpairs(const ChannelOperator& K, int count, const std::string& options, const EigenLimits& limits,
                            std::vector<std::string>* messages) {
    Eigenpairs result;
    PetscMatrix A = petsc_matrix(K);
    A.apply = [&](const Vector& x, Vector& y) {
        limits.look({result.applications});
        if (K.agreement().any(limits.watch.stop() || result.applications >= limits.most)) throw Stopped();
        K.apply(x, y);
        ++result.applications;
    };
    const std::unique_ptr<Petsc> petsc = start_petsc(options);
    try {
        PetscEigenTask task;
        task.count = count;
        FixedNumbers().fill(K, task.start);
        const PetscEigenpairs found = petsc->eigenpairs(A, task);
        for (std::size_t i = 0; i < found.values.size(); ++i) {
            Eigenpair pair{found.values[i], found.vectors[i], 0.0};
            Vector real(K.size()), imaginary = Vector::Zero(K.size());
            K.apply(pair.vector.real(), real);
            if (pair.value.imag() != 0.0) K.apply(pair.vector.imag(), imaginary);
            const Eigen::VectorXcd image = real.cast<std::complex<double>>() + std::complex<double>(0.0, 1.0) * imaginary;
            double squares[] = {pair.vector.squaredNorm(), (image - pair.value * pair.vector).squaredNorm()};
            K.agreement().sum(squares);
            pair.vector /= std::sqrt(squares[0]);
            pair.residual = std::sqrt(squares[1] / squares[0]);
            result.pairs.push_back(std::move(pair));
        }
        result.converged = found.converged;
        // Whether the pairs are found is checked with their residuals, not only by what SLEPc reports.
        constexpr double small = 1e-6;
        for (const Eigenpair& pair : result.pairs) {
            if (!result.converged || pair.residual <= small * std::abs(result.pairs.front().value)) continue;
            result.converged = false;
            result.why =
                fmt::format("not found by SLEPc's {}: what it found has a residual of {:.1e}", found.method, pair.residual);
        }
        if (!found.converged)
            result.why = fmt::format("not found by SLEPc's {} within {} restarts, {:.0f} applications of K", found.method,
                                     found.restarts, result.applications);
    } catch (const Stopped&) {
        result.why = fmt::format("not found within {:.0f} applications of K: stopped", result.applications);
    }
    if (messages)
        for (const std::string& text : messages_of(*petsc)) messages->push_back(text);
    return result;
}

OperatorNorms slepc_norms(const ChannelOperator& K, const EigenLimits& limits) {
    const Agreement& agreement = K.agreement();
    OperatorNorms norms;
    Vector sums(K.size());
    const Vector ones = Vector::Ones(K.size());
    K.apply(ones, sums);
    norms.sup = agreement.size(sums);
    K.apply_adjoint(ones, sums);
    const double own = sums.size() == 0 ? 0.0 : sums.maxCoeff(&norms.one_at);
    norms.one = agreement.largest(own);
    if (own < norms.one || sums.size() == 0) norms.one_at = -1;
    // D K*K D⁻¹ with D = diag(√m) is symmetric.
    const Vector root = K.measure().cwiseSqrt();
    Vector once(K.size());
    double applications = 0.0;
    PetscMatrix A = rows_of(K);
    A.apply = [&](const Vector& x, Vector& y) {
        limits.look({applications});
        if (agreement.any(limits.watch.stop() || applications >= limits.most)) throw Stopped();
        applications += 2.0;
        K.apply(x.cwiseQuotient(root), once);
        K.apply_adjoint(once, y);
        y.array() *= root.array();
    };
    norms.two = std::numeric_limits<double>::quiet_NaN();
    try {
        PetscEigenTask task;
        task.symmetric = true;
        task.tolerance = 1e-8;  // for the vector; that of the value is its square
        FixedNumbers().fill(K, task.start);
        const PetscEigenpairs found = start_petsc("")->eigenpairs(A, task);
        if (found.converged) norms.two = std::sqrt(std::max(found.values.front().real(), 0.0));
    } catch (const Stopped&) {
    }
    return norms;
}

}  // namespace neumann
