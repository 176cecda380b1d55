// Reads scenes and returns information about them.
#include "apps/commands/print_warnings.h"
#include "apps/files/plan_json.h"
#include "apps/python/module.h"
#include "core/base/stopwatch.h"
#include "core/geometry/ray_caster.h"
#include "core/reader/read_scene.h"
#include "operators/methods/method_plan.h"

#include <pybind11/stl.h>

namespace neumann {

namespace {

std::shared_ptr<LoadedScene> load(const std::string& path, const std::map<std::string, std::string>& definitions, bool lenient) {
    const Stopwatch watch;
    auto loaded = std::make_shared<LoadedScene>();
    loaded->path = path;
    loaded->definitions = definitions;
    try {
        loaded->scene = std::make_shared<const Scene>(read_scene(path, definitions, {.lenient = lenient}));
    } catch (const UnknownError& e) {
        throw InputError(std::string(e.what()) + "\nlenient=True takes the scene without what is not known");
    }
    loaded->seconds = watch.seconds();
    return loaded;
}

}  // namespace

void bind_scene(py::module_& m) {
    m.def("trees_built", &trees_built, "The number of acceleration structures that were built so far.");
    py::class_<LoadedScene, std::shared_ptr<LoadedScene>>(m, "Scene", "A scene as its files were when it was read.")
        .def_readonly("path", &LoadedScene::path)
        .def_readonly("definitions", &LoadedScene::definitions)
        .def_property_readonly("hash", [](const LoadedScene& s) { return s.scene->hash; })
        .def_property_readonly("width", [](const LoadedScene& s) { return s.scene->film.crop_width; })
        .def_property_readonly("height", [](const LoadedScene& s) { return s.scene->film.crop_height; })
        .def_property_readonly("bounces", [](const LoadedScene& s) { return s.scene->bounces; })
        .def_property_readonly("shapes", [](const LoadedScene& s) { return s.scene->geometry.shapes().size(); })
        .def_property_readonly("largest_albedo",
                               [](const LoadedScene& s) {
                                   const Rgb a = s.scene->materials.largest_albedo();
                                   return py::make_tuple(a.r, a.g, a.b);
                               })
        .def_property_readonly("warnings", [](const LoadedScene& s) { return texts(s.scene->warnings); })
        .def_property_readonly("replaced", [](const LoadedScene& s) { return s.scene->replaced; })
        .def("plan", [](const std::shared_ptr<LoadedScene>& loaded) {
            return std::make_unique<Job>(0, [loaded](Job&) -> Job::Finish {
                const std::string json = plan_json(plan_with_bounces(*loaded->scene)).dump();
                return [json] { return py::str(json); };
            });
        });
    m.def("load", &load, py::arg("path"), py::arg("definitions"), py::arg("lenient"), py::call_guard<py::gil_scoped_release>());
}

}  // namespace neumann
