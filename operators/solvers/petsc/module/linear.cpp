// PETSc's linear solvers (KSP).
#include "operators/solvers/petsc/module/session.h"

#include <array>
#include <string_view>

namespace neumann::petsc {

namespace {

// Whether the preconditioner needs more than products and the diagonal.
bool needs_entries(std::string_view preconditioner) {
    constexpr std::array<std::string_view, 3> simple = {PCNONE, PCJACOBI, PCSHELL};
    return std::find(simple.begin(), simple.end(), preconditioner) == simple.end();
}

class Linear : public PetscLinear {
public:
    explicit Linear(const PetscMatrix& A) : A_(&A) {
        make_shell(A, &shell_);
        make_vector(A, &b_);
        make_vector(A, &x_);
        check(KSPCreate(PETSC_COMM_WORLD, &ksp_));
        check(KSPSetOperators(ksp_, shell_, shell_));
        PC pc = nullptr;
        check(KSPGetPC(ksp_, &pc));
        check(PCSetType(pc, PCNONE));
        check(KSPSetType(ksp_, KSPGMRES));
        check(KSPGMRESSetRestart(ksp_, 50));
        check(KSPSetInitialGuessNonzero(ksp_, PETSC_TRUE));
        check(KSPMonitorSet(ksp_, monitor, this, nullptr));
        check(KSPSetFromOptions(ksp_));
        PCType type = nullptr;
        check(PCGetType(pc, &type));
        if (needs_entries(type)) {
            make_entries(A, &entries_);
            check(KSPSetOperators(ksp_, shell_, entries_));
        }
    }

    std::string method() const override {
        KSPType solver = nullptr;
        PCType preconditioner = nullptr;
        PC pc = nullptr;
        check(KSPGetType(ksp_, &solver));
        check(KSPGetPC(ksp_, &pc));
        check(PCGetType(pc, &preconditioner));
        return std::string(solver) + "/" + preconditioner;
    }

    End solve(const Vector& b, Vector& x, double tolerance, int most, const OnIterate& on_iterate) override {
        on_iterate_ = &on_iterate;
        copy(b, b_);
        copy(x, x_);
        check(KSPSetTolerances(ksp_, tolerance, 0.0, PETSC_DEFAULT, std::max(most, 1)));
        check(KSPSetFromOptions(ksp_));
        PetscReal relative = 0.0, absolute = 0.0;
        check(KSPGetTolerances(ksp_, &relative, &absolute, nullptr, nullptr));
        // Several solvers can only begin from 0 (preonly, richardson with some preconditioners).
        check(KSPSetInitialGuessNonzero(ksp_, x.isZero(0.0) ? PETSC_FALSE : PETSC_TRUE));
        check(KSPSolve(ksp_, b_, x_));
        copy(x_, x);
        KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
        const char* text = "";
        check(KSPGetConvergedReason(ksp_, &reason));
        check(KSPGetConvergedReasonString(ksp_, &text));
        return {reason > 0, text, relative != tolerance || absolute != 0.0};
    }

private:
    static PetscErrorCode monitor(KSP ksp, PetscInt iteration, PetscReal residual, void* context) {
        return guarded([&] {
            const auto iterate = [&] {
                Vec x = nullptr;
                Vector found;
                check(KSPBuildSolution(ksp, nullptr, &x));
                copy(x, found);
                return found;
            };
            (*static_cast<const Linear*>(context)->on_iterate_)(static_cast<int>(iteration), residual, iterate);
        });
    }

    const PetscMatrix* A_;
    OwnedMat shell_, entries_;
    OwnedVec b_, x_;
    Owned<KSP, KSPDestroy> ksp_;
    const OnIterate* on_iterate_ = nullptr;
};

}  // namespace

std::unique_ptr<PetscLinear> make_linear(const PetscMatrix& A) { return std::make_unique<Linear>(A); }

}  // namespace neumann::petsc
