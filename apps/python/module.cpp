#include "apps/python/module.h"

#include <pybind11/stl.h>

namespace {

// Like pybind11::register_exception, with any bytes in the message (apps/python/text.h).
template <class Error>
void register_error(pybind11::module_& m, const char* name, PyObject* base, const char* doc) {
    static const pybind11::exception<Error> type(m, name, base);
    type.attr("__doc__") = doc;
    pybind11::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const Error& e) {
            PyErr_SetObject(type.ptr(), pybind11::cast(std::string(e.what())).ptr());
        }
    });
}

}  // namespace

PYBIND11_MODULE(_neumann, m) {
    using namespace neumann;
    m.doc() = "The compiled part of neumann; see the package neumann.";
    m.attr("version") = NEUMANN_VERSION;
    register_error<InputError>(m, "InputError", PyExc_ValueError,
                               "The scene, a file or an argument is wrong: 'file:line:column: what is wrong, what was expected'.");
    register_error<RunError>(m, "RunError", PyExc_RuntimeError, "Something failed while running, such as a disk that is full.");

    const auto without_lock = py::call_guard<py::gil_scoped_release>();
    py::class_<Job>(m, "Job", "Work that goes on in the background.")
        .def("wait", &Job::wait, py::arg("seconds"), without_lock, "Whether it is done, after so many seconds at most.")
        .def("stop", &Job::stop, without_lock, "Asks for an orderly end.")
        .def(
            "progress",
            [](const Job& job) {
                const Job::Status status = job.status();
                return py::make_tuple(status.text, status.fraction);
            },
            "What is being done, and which part of it is done, or None.")
        .def("result", &Job::result, "What came out, once it is done; raises what went wrong.");

    bind_scene(m);
    bind_render(m);
    bind_pictures(m);
    bind_patched(m);
    bind_matrices(m);
    bind_solvers(m);
    bind_study(m);
    bind_photons(m);
    bind_records(m);
    bind_chains(m);
    bind_blame(m);
    bind_unbounce(m);
    bind_rays(m);
}

namespace neumann {

std::string command_line(const LoadedScene& scene, const std::string& command, const std::vector<std::string>& words) {
    std::string line = "neumann " + command + " " + scene.file.path;
    for (const std::string& word : words) line += " " + word;
    for (const auto& [name, value] : scene.file.definitions) line += " -D " + name + "=" + value;
    if (scene.file.hemisphere) line += fmt::format(" --hemisphere {},{}", (*scene.file.hemisphere)[0], (*scene.file.hemisphere)[1]);
    if (!scene.scene->replaced.empty()) line += " --lenient";
    for (const reader::Edit& edit : scene.changes.edits) line += ", edited: " + edit.name + " = " + edit.value;
    return line;
}

std::shared_ptr<const PatchScene> patch_scene(const LoadedScene& loaded, PatchOptions options) {
    options.threads = 0;  // the job limits the number of threads
    return std::make_shared<const PatchScene>(options, loaded.scene);
}

}  // namespace neumann
