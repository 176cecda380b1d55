// The results of `spectrum` and `solve` for a scene on patches.
#include "apps/commands/solve_command.h"
#include "apps/commands/spectrum_command.h"
#include "apps/commands/spectrum_print.h"
#include "apps/output/files/json_text.h"
#include "apps/python/module.h"
#include "core/base/interrupt.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

namespace neumann {

namespace {

std::unique_ptr<Job> start_spectrum(const std::shared_ptr<LoadedScene>& loaded, const Keywords& keywords) {
    SpectrumRequest request = request_of(spectrum_options(), *loaded, keywords);
    return std::make_unique<Job>(request.patches.threads, [loaded, request](Job& job) -> Job::Finish {
        job.tell("tracing T and looking for eigenvalues");
        const auto scene = patch_scene(*loaded, request.patches);
        const auto tell = [&](const std::function<std::string()>& text) { job.tell(text()); };
        const auto report = std::make_shared<const SceneSpectrum>(spectrum_of(*scene, request, tell));
        return [report, json = json_text(spectrum_json(*scene, *report))]() -> py::object {
            py::list vectors;
            for (const ChannelSpectrum& channel : report->channels) {
                Eigen::MatrixXcd columns;
                for (const Eigenpair& pair : channel.leading.pairs) {
                    columns.conservativeResize(pair.vector.size(), columns.cols() + 1);
                    columns.col(columns.cols() - 1) = pair.vector;
                }
                vectors.append(columns);
            }
            return py::make_tuple(json, vectors);
        };
    });
}

std::unique_ptr<Job> start_solve(const std::shared_ptr<LoadedScene>& loaded, const Keywords& keywords) {
    SolveRequest request = request_of(solve_options(), *loaded, keywords);
    return std::make_unique<Job>(request.patches.threads, [loaded, request](Job& job) -> Job::Finish {
        job.tell("solving L = Le + K L by all solvers");
        const auto scene = patch_scene(*loaded, request.patches);
        const auto solved = std::make_shared<const SolvedScene>(solve_scene(*scene, request, true));
        return [solved, json = json_text(solve_json(*scene, request, *solved)), warnings = scene->warnings()]() -> py::object {
            py::list x;
            for (const SolverRow& row : solved->all.rows) x.append(row.result.x);
            return py::make_tuple(json, x, warnings);
        };
    });
}

}  // namespace

void bind_matrices(py::module_& m) {
    m.def("spectrum", &start_spectrum, py::arg("scene"), py::arg("keywords"));
    m.def("solve", &start_solve, py::arg("scene"), py::arg("keywords"));
}

}  // namespace neumann
