// A scene as matrices: T, R and Le, the camera, the spectrum of K, and all solvers.
#include "apps/commands/export_command.h"
#include "apps/commands/interrupt.h"
#include "apps/commands/solve_command.h"
#include "apps/commands/spectrum_command.h"
#include "apps/commands/spectrum_print.h"
#include "apps/python/module.h"
#include "operators/matrix/camera_vector.h"
#include "operators/matrix/scene_patches.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

namespace neumann {

namespace {

std::shared_ptr<const PatchScene> patch_scene(const LoadedScene& loaded, PatchOptions options) {
    options.threads = 0;  // the job limits them
    return std::make_shared<const PatchScene>(options, loaded.scene, loaded.definitions);
}

// One channel of a scene on patches.
struct Patched {
    std::shared_ptr<const PatchScene> scene;
    ChosenChannel chosen;
};

py::dict as_dict(const Patched& patched) {
    const TracedSystem& system = patched.scene->traced();
    const int c = patched.chosen.channel;
    py::dict d;
    d["T"] = transport_matrix(system.table());
    d["R"] = reflection_matrix(system.table(), system.reflection(c));
    d["Le"] = system.emitted(c);
    d["b"] = system.direct(c);
    d["measure"] = Vector(system.transport().measure());
    d["ray_measure"] = ray_measures(system.table());
    d["patches"] = patches_table(system.space());
    d["channel"] = system.channel_name(c);
    d["radius"] = patched.chosen.radius;
    d["no_radius"] = patched.chosen.no_radius;
    d["title"] = patched.scene->title();
    d["warnings"] = patched.scene->warnings();
    return d;
}

std::unique_ptr<Job> start_matrices(const std::shared_ptr<LoadedScene>& loaded, const std::vector<std::string>& arguments) {
    SolveRequest request = parse<SolveRequest>("solve", add_solve, *loaded, arguments);
    channel_number(request.channel);  // throws before anything is traced
    return std::make_unique<Job>(request.patches.threads, [loaded, request](Job& job) -> Job::Finish {
        job.tell("tracing T");
        auto patched = std::make_shared<Patched>();
        patched->scene = patch_scene(*loaded, request.patches);
        check_matrix_memory(request.patches, patched->scene->traced());
        job.tell("looking for the spectral radius");
        patched->chosen = choose_channel(patched->scene->system(), channel_number(request.channel), {.stop = interrupted});
        return [patched] { return py::cast(patched); };
    });
}

std::unique_ptr<Job> start_camera(const std::shared_ptr<Patched>& patched, std::uint32_t samples, std::uint64_t seed) {
    return std::make_unique<Job>(0, [patched, samples, seed](Job& job) -> Job::Finish {
        job.tell("looking through the camera");
        const PatchScene& scene = *patched->scene;
        check_camera(scene.scene());
        const auto matrix = std::make_shared<const Eigen::SparseMatrix<double, Eigen::RowMajor>>(
            camera_matrix(scene.scene(), scene.system().space(), samples, seed));
        return [matrix] { return py::cast(*matrix); };
    });
}

std::unique_ptr<Job> start_spectrum(const std::shared_ptr<LoadedScene>& loaded, const std::vector<std::string>& arguments) {
    SpectrumRequest request = parse<SpectrumRequest>("spectrum", add_spectrum, *loaded, arguments);
    request.patches.command_line = command_line("spectrum", *loaded, arguments);
    return std::make_unique<Job>(request.patches.threads, [loaded, request](Job& job) -> Job::Finish {
        job.tell("tracing T and looking for eigenvalues");
        const auto scene = patch_scene(*loaded, request.patches);
        const auto tell = [&](const std::function<std::string()>& text) { job.tell(text()); };
        const auto report = std::make_shared<const SceneSpectrum>(spectrum_of(*scene, request, tell));
        return [report, json = spectrum_json(*scene, *report).dump()]() -> py::object {
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

std::unique_ptr<Job> start_solve(const std::shared_ptr<LoadedScene>& loaded, const std::vector<std::string>& arguments) {
    SolveRequest request = parse<SolveRequest>("solve", add_solve, *loaded, arguments);
    channel_number(request.channel);  // throws before anything is traced
    request.patches.command_line = command_line("solve", *loaded, arguments);
    return std::make_unique<Job>(request.patches.threads, [loaded, request](Job& job) -> Job::Finish {
        job.tell("solving L = Le + K L by all solvers");
        const auto scene = patch_scene(*loaded, request.patches);
        const auto solved = std::make_shared<const SolvedScene>(solve_scene(*scene, request, true));
        return [solved, json = solve_json(*scene, request, *solved).dump(), warnings = scene->warnings()]() -> py::object {
            py::list x;
            for (const SolverRow& row : solved->all.rows) x.append(row.result.x);
            return py::make_tuple(json, x, warnings);
        };
    });
}

}  // namespace

void bind_matrices(py::module_& m) {
    py::class_<Patched, std::shared_ptr<Patched>>(m, "Patched", "A channel of a scene on patches.")
        .def("matrices", &as_dict)
        .def_property_readonly("height", [](const Patched& p) { return p.scene->scene().film.crop_height; })
        .def_property_readonly("width", [](const Patched& p) { return p.scene->scene().film.crop_width; })
        .def("camera", &start_camera, py::arg("samples"), py::arg("seed"));
    m.def("matrices", &start_matrices, py::arg("scene"), py::arg("arguments"));
    m.def("spectrum", &start_spectrum, py::arg("scene"), py::arg("arguments"));
    m.def("solve", &start_solve, py::arg("scene"), py::arg("arguments"));
}

}  // namespace neumann
