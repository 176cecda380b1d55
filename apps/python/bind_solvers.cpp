// The series and its solvers on any K: matrices of a scene, of a book, or of the unit cube.
#include "apps/python/module.h"
#include "core/base/error.h"
#include "core/base/interrupt.h"
#include "core/base/stopwatch.h"
#include "operators/experiments/known/cube.h"
#include "operators/solvers/matrix_channel.h"
#include "operators/solvers/series_run.h"
#include "operators/solvers/side_by_side.h"
#include "operators/solvers/spectrum/convergence.h"
#include "operators/solvers/spectrum/spectrum.h"
#include "operators/solvers/stoppable.h"

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

namespace neumann {

namespace {

using Operator = std::shared_ptr<ChannelOperator>;
using Dense = DenseChannel::Matrix;
using Sparse = SparseChannel::Matrix;

Operator dense(const Eigen::Ref<const Dense>& K, const Vector& measure) { return std::make_shared<DenseChannel>(K, measure); }
Operator sparse(const Sparse& K, const Vector& measure) { return std::make_shared<SparseChannel>(K, measure); }

// A channel whose applications Ctrl-C stops.
StoppableChannel stoppable(const Operator& K) { return {K, {.stop = interrupted}}; }

Vector applied(const ChannelOperator& K, void (ChannelOperator::*product)(const Vector&, Vector&) const, const Vector& x) {
    if (x.size() != K.size()) throw InputError(fmt::format("x has {} values, expected {}", x.size(), K.size()));
    Vector y(x.size());
    (K.*product)(x, y);
    return y;
}
Vector diagonal(const ChannelOperator& K) {
    return Vector::NullaryExpr(K.size(), [&](Eigen::Index u) { return K.diagonal(u); });
}

// A row for each bounce: bounce, power, l2, sup, ratio, a_priori, a_posteriori, estimate, enclosure_width.
py::array_t<double> as_array(const std::vector<SeriesRow>& rows) {
    py::array_t<double> array({rows.size(), std::size_t{9}});
    double* to = array.mutable_data();
    for (const SeriesRow& r : rows)
        for (const double x : {double(r.bounce), r.term.power, r.term.l2, r.term.sup, r.ratio, r.a_priori, r.a_posteriori,
                               r.estimate, r.enclosure_width})
            *to++ = x;
    return array;
}

py::object as_dict(const SeriesRun& run) {
    py::dict d, enclosure;
    d["sum"] = run.sum;
    d["verdict"] = name(run.verdict);
    d["why"] = run.why;
    d["warnings"] = run.warnings;
    d["rate"] = run.rate;
    d["rows"] = as_array(run.rows);
    enclosure["exists"] = run.enclosure.exists;
    enclosure["why"] = run.enclosure.why;
    enclosure["c1"] = run.enclosure.c1;
    enclosure["c2"] = run.enclosure.c2;
    enclosure["low"] = run.enclosure.low;
    enclosure["high"] = run.enclosure.high;
    enclosure["width"] = run.enclosure.width;
    d["enclosure"] = enclosure;
    return d;
}

void check_size(const char* what, const Vector& x, const Operator& K) {
    if (x.size() != K->size())
        throw InputError(fmt::format("{} has {} values, expected {}, one for each unknown of K", what, x.size(), K->size()));
}

std::unique_ptr<Job> start_series(const Operator& K, const Vector& Le, double tolerance, int most, std::optional<double> norm) {
    check_size("Le", Le, K);
    return std::make_unique<Job>(0, [=](Job& job) -> Job::Finish {
        SeriesOptions options{tolerance, most, norm, {}};
        options.observer = [&](const SeriesRow& row) {
            job.tell(fmt::format("bounce {}   ‖K^n Le‖∞ {:.3g}", row.bounce, row.term.sup));
        };
        const auto run = std::make_shared<const SeriesRun>(run_series(stoppable(K), Le, options));
        return [run] { return as_dict(*run); };
    });
}

// A row for each step: applications, estimate, error, seconds.
py::array_t<double> as_array(const std::vector<SolverStep>& history) {
    py::array_t<double> array({history.size(), std::size_t{4}});
    double* to = array.mutable_data();
    for (const SolverStep& s : history)
        for (const double x : {s.applications, s.estimate, s.error, s.seconds}) *to++ = x;
    return array;
}

py::object as_dict(const SolverRow& row) {
    py::dict d;
    d["name"] = row.name;
    d["title"] = row.title;
    d["x"] = row.result.x;
    d["verdict"] = name(row.result.verdict);
    d["why"] = row.result.why;
    d["applications"] = row.result.applications;
    d["setup_applications"] = row.result.setup;
    d["seconds"] = row.seconds;
    d["history"] = as_array(row.result.history);
    return d;
}

std::unique_ptr<Job> start_solver(const std::string& name, const Operator& K, const Vector& Le, double tolerance, int most,
                                  std::optional<double> radius, std::optional<double> lowest, std::optional<Vector> reflectance,
                                  std::optional<Vector> exact) {
    const NamedSolver* solver = find_solver(name);
    if (solver == nullptr) {
        std::string names;
        for (const NamedSolver& s : solvers()) names += (names.empty() ? "" : ", ") + std::string(s.name);
        throw InputError(fmt::format("no solver is called '{}'; there are {}", name, names));
    }
    check_size("Le", Le, K);
    if (reflectance) check_size("reflectance", *reflectance, K);
    if (exact) check_size("exact", *exact, K);
    return std::make_unique<Job>(0, [=](Job& job) -> Job::Finish {
        const StoppableChannel stopping = stoppable(K);
        Problem problem;
        problem.K = &stopping;
        problem.Le = Le;
        problem.tolerance = tolerance;
        problem.most = most;
        problem.radius = radius;
        problem.lowest = lowest;
        if (reflectance) problem.reflectance = &*reflectance;
        if (exact) problem.exact = &*exact;
        problem.observer = [&](const SolverStep& step) {
            job.tell(
                fmt::format("{}   {:.0f} applications of K   error about {:.2g}", solver->title, step.applications, step.estimate));
        };
        const Stopwatch watch;
        auto row = std::make_shared<SolverRow>(SolverRow{solver->name, solver->title, solver->solve(problem)});
        row->seconds = watch.seconds();
        return [row] { return as_dict(*row); };
    });
}

std::unique_ptr<Job> start_spectrum_of(const Operator& K, int count, bool adjoint, double most) {
    return std::make_unique<Job>(0, [=](Job& job) -> Job::Finish {
        job.tell("looking for eigenvalues");
        const StoppableChannel stopping = stoppable(K);
        EigenLimits limits;
        limits.most = most;
        limits.look = [&](const EigenStep& step) {
            job.tell(fmt::format("looking for eigenvalues   {:.0f} applications of K   largest residual {:.1e}", step.applications,
                                 step.residual));
        };
        const auto norms = operator_norms(stopping, limits);
        const auto leading = std::make_shared<const Eigenpairs>(leading_eigenpairs(stopping, count, adjoint, limits));
        return [norms, leading]() -> py::object {
            const auto n = static_cast<Eigen::Index>(leading->pairs.size());
            Eigen::VectorXcd values(n);
            Vector residuals(n);
            Eigen::MatrixXcd vectors(n > 0 ? leading->pairs[0].vector.size() : 0, n);
            for (Eigen::Index i = 0; i < n; ++i) {
                const Eigenpair& pair = leading->pairs[static_cast<std::size_t>(i)];
                values[i] = pair.value;
                residuals[i] = pair.residual;
                vectors.col(i) = pair.vector;
            }
            const double radius = leading->radius();
            py::dict d, sizes;
            sizes["1"] = norms.one;
            sizes["2"] = norms.two;
            sizes["inf"] = norms.sup;
            d["norms"] = sizes;
            d["spectral_radius"] = radius;
            d["series"] = name(judge(radius, std::numeric_limits<double>::quiet_NaN()));
            d["eigenvalues"] = values;
            d["eigenvectors"] = vectors;
            d["residuals"] = residuals;
            d["eigenvalues_converged"] = leading->converged;
            d["applications"] = leading->applications;
            d["why"] = leading->why;
            py::array_t<double> history({leading->history.size(), std::size_t{2}});
            double* to = history.mutable_data();
            for (const EigenStep& step : leading->history)
                for (const double x : {step.applications, step.residual}) *to++ = x;
            d["history"] = history;
            return d;
        };
    });
}

std::unique_ptr<Job> start_cube(int n) {
    if (n < 1 || n > 64) throw InputError(fmt::format("a cube of {} patches an edge: expected 1 to 64", n));
    return std::make_unique<Job>(0, [n](Job& job) -> Job::Finish {
        job.tell("integrating form factors");
        const auto cube = std::make_shared<const known::Cube>(known::patched_cube(n));
        return [cube]() -> py::object { return py::make_tuple(cube->factors.F, cube->factors.area, cube->face); };
    });
}

}  // namespace

void bind_solvers(py::module_& m) {
    py::class_<ChannelOperator, std::shared_ptr<ChannelOperator>>(m, "Operator", "K on finitely many unknowns.")
        .def_property_readonly("size", &ChannelOperator::size)
        .def_property_readonly("measure", [](const ChannelOperator& K) { return Vector(K.measure()); })
        .def(
            "apply", [](const ChannelOperator& K, const Vector& x) { return applied(K, &ChannelOperator::apply, x); }, py::arg("x"),
            py::call_guard<py::gil_scoped_release>())
        .def(
            "apply_adjoint",
            [](const ChannelOperator& K, const Vector& x) { return applied(K, &ChannelOperator::apply_adjoint, x); }, py::arg("x"),
            py::call_guard<py::gil_scoped_release>())
        .def("diagonal", &diagonal, py::call_guard<py::gil_scoped_release>());
    m.def("dense", &dense, py::arg("K"), py::arg("measure"));
    m.def("sparse", &sparse, py::arg("K"), py::arg("measure"));
    m.def("series", &start_series, py::arg("K"), py::arg("Le"), py::arg("tolerance"), py::arg("most"), py::arg("norm"));
    m.def("solve_one", &start_solver, py::arg("name"), py::arg("K"), py::arg("Le"), py::arg("tolerance"), py::arg("most"),
          py::arg("radius"), py::arg("lowest"), py::arg("reflectance"), py::arg("exact"));
    m.def("spectrum_of", &start_spectrum_of, py::arg("K"), py::arg("count"), py::arg("adjoint"), py::arg("most"));
    m.def("cube", &start_cube, py::arg("n"));
    py::list names;
    for (const NamedSolver& solver : solvers()) names.append(py::make_tuple(solver.name, solver.title));
    m.attr("solvers") = names;
}

}  // namespace neumann
