// PETSc's start and end.
#include "operators/solvers/petsc/module/session.h"

#include "core/base/error.h"

#include <slepcsys.h>

#include <cstdlib>
#include <sstream>

namespace neumann::petsc {

namespace {

std::exception_ptr thrown_by_matrix;
std::string message;  // the text of the first error

PetscErrorCode note(MPI_Comm, int, const char*, const char*, PetscErrorCode code, PetscErrorType type, const char* text, void*) {
    if (type == PETSC_ERROR_INITIAL && text && message.empty()) message = text;
    return code;
}

// MPI can be started only once. Whoever started it has to end it.
void start_mpi() {
    int is_there = 0;
    MPI_Initialized(&is_there);
    if (is_there) return;
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    std::atexit([] { MPI_Finalize(); });
}

class EntriesOf : public PetscEntries {
public:
    explicit EntriesOf(const PetscMatrix& A) {
        make_entries(A, &A_);
        make_vector(A, &x_);
        make_vector(A, &y_);
        check(MatGetInfo(A_, MAT_LOCAL, &info_));
    }
    void apply(const Vector& x, Vector& y) override {
        copy(x, x_);
        check(MatMult(A_, x_, y_));
        copy(y_, y);
    }
    double entries() const override { return info_.nz_used; }
    double bytes() const override { return info_.nz_used * (sizeof(PetscScalar) + sizeof(PetscInt)); }

private:
    OwnedMat A_;
    OwnedVec x_, y_;
    MatInfo info_{};
};

class Session : public Petsc {
public:
    explicit Session(const std::string& options) {
        start_mpi();
        message.clear();
        std::vector<std::string> words{"neumann", "-skip_petscrc", "-no_signal_handler"};
        std::istringstream text(options);
        for (std::string word; text >> word;) words.push_back(word);
        std::vector<char*> list;
        for (std::string& word : words) list.push_back(word.data());
        list.push_back(nullptr);
        int count = static_cast<int>(words.size());
        char** arguments = list.data();
        PETSC_STDOUT = stderr;
        PetscPushErrorHandler(note, nullptr);
        check(SlepcInitialize(&count, &arguments, nullptr, nullptr));
    }
    ~Session() override {
        SlepcFinalize();
        PetscPopErrorHandler();
    }

    std::unique_ptr<PetscLinear> linear(const PetscMatrix& A) override { return make_linear(A); }
    std::unique_ptr<PetscEntries> entries(const PetscMatrix& A) override { return std::make_unique<EntriesOf>(A); }
    PetscEigenpairs eigenpairs(const PetscMatrix& A, const PetscEigenTask& task) override { return find_eigenpairs(A, task); }

    std::vector<std::string> unused_options() const override {
        PetscInt count = 0;
        char **names = nullptr, **values = nullptr;
        check(PetscOptionsLeftGet(nullptr, &count, &names, &values));
        std::vector<std::string> unused;
        for (PetscInt i = 0; i < count; ++i)
            if (names[i] != std::string("skip_petscrc") && names[i] != std::string("no_signal_handler"))
                unused.push_back(std::string("-") + names[i] + (values[i] ? std::string(" ") + values[i] : ""));
        check(PetscOptionsLeftRestore(nullptr, &count, &names, &values));
        return unused;
    }
};

}  // namespace

void keep(std::exception_ptr thrown) { thrown_by_matrix = std::move(thrown); }

void check(PetscErrorCode code) {
    if (code == 0) return;
    const std::string text = "PETSc: " + (message.empty() ? "error " + std::to_string(code) : std::exchange(message, {}));
    if (thrown_by_matrix) std::rethrow_exception(std::exchange(thrown_by_matrix, nullptr));
    const bool input = code == PETSC_ERR_ARG_UNKNOWN_TYPE || code == PETSC_ERR_ARG_OUTOFRANGE || code == PETSC_ERR_USER_INPUT ||
                       code == PETSC_ERR_ARG_WRONG || code == PETSC_ERR_SUP;
    if (input) throw OptionError("petsc", ": " + text);
    throw RunError(text);
}

}  // namespace neumann::petsc

extern "C" neumann::Petsc* neumann_petsc(const std::string& options) { return new neumann::petsc::Session(options); }
