// Reads scenes and returns information about them.
#include "apps/commands/print_warnings.h"
#include "apps/output/files/json_text.h"
#include "apps/output/files/plan_json.h"
#include "apps/python/module.h"
#include "apps/requests/scene_file.h"
#include "core/base/stopwatch.h"
#include "core/geometry/ray_caster.h"
#include "operators/render/methods/method_plan.h"

#include <pybind11/stl.h>

namespace neumann {

namespace {

using Loaded = std::shared_ptr<LoadedScene>;

Loaded load(LoadedScene scene) {
    const Stopwatch watch;
    auto loaded = std::make_shared<LoadedScene>(std::move(scene));
    try {
        loaded->scene = std::make_shared<const Scene>(make_scene(
            read_scene_parts(loaded->file.path, loaded->file.definitions, {.lenient = loaded->file.lenient}, loaded->changes)));
    } catch (const UnknownError& e) {
        throw InputError(std::string(e.what()) + "\nlenient=True takes the scene without what is not known");
    }
    if (loaded->file.hemisphere)
        loaded->scene = std::make_shared<const Scene>(above_what_is_seen(*loaded->scene, *loaded->file.hemisphere));
    loaded->seconds = watch.seconds();
    return loaded;
}

Loaded seen_from_hemisphere(const LoadedScene& scene, int x, int y) {
    if (scene.file.hemisphere) throw InputError("hemisphere(): this scene is seen from a hemisphere already");
    auto loaded = std::make_shared<LoadedScene>(scene);
    loaded->file.hemisphere = {x, y};
    loaded->scene = std::make_shared<const Scene>(above_what_is_seen(*scene.scene, {x, y}));
    return loaded;
}

// `given`: (tag, [(attribute, value)], [children], its place in the dictionary, RFC 6901).
reader::Element element_of(const py::tuple& given, const std::string& name) {
    const Location place{name, 0, 0, given[3].cast<std::string>()};
    reader::Element e{given[0].cast<std::string>(), {}, {}, place};
    for (const auto& [key, value] : given[1].cast<std::vector<std::pair<std::string, std::string>>>())
        e.attributes.push_back({key, value, place});
    for (const py::handle child : given[2]) e.children.push_back(element_of(child.cast<py::tuple>(), name));
    return e;
}

using Rows = py::array_t<double, py::array::c_style | py::array::forcecast>;

// Vertices (n, 3), triangles (m, 3), and normals (n, 3) and texture coordinates (n, 2), which may have no rows.
std::shared_ptr<const MeshFile> mesh_of(const Rows& vertices, const py::array_t<std::uint32_t, py::array::c_style>& triangles,
                                        const Rows& normals, const Rows& uv) {
    auto file = std::make_shared<MeshFile>();
    for (py::ssize_t i = 0; i < vertices.shape(0); ++i)
        file->mesh.vertices.emplace_back(vertices.at(i, 0), vertices.at(i, 1), vertices.at(i, 2));
    for (py::ssize_t i = 0; i < triangles.shape(0); ++i)
        file->mesh.triangles.push_back({triangles.at(i, 0), triangles.at(i, 1), triangles.at(i, 2)});
    for (py::ssize_t i = 0; i < normals.shape(0); ++i)
        file->normals.emplace_back(normals.at(i, 0), normals.at(i, 1), normals.at(i, 2));
    for (py::ssize_t i = 0; i < uv.shape(0); ++i) file->mesh.uv.emplace_back(uv.at(i, 0), uv.at(i, 1));
    return file;
}

// `text`: the input of the scene's hash. `meshes`: the arguments of mesh_of() by the filename of a shape 'ply'.
Loaded load_elements(const std::string& name, const py::tuple& root, const std::map<std::string, py::tuple>& meshes,
                     const std::string& text, bool lenient) {
    auto raw = std::make_shared<reader::RawScene>();
    raw->root = element_of(root, name);
    raw->files = {name};
    raw->text = text;
    for (const auto& [filename, arrays] : meshes)
        raw->in_memory.meshes[filename] =
            mesh_of(arrays[0].cast<Rows>(), arrays[1].cast<py::array_t<std::uint32_t, py::array::c_style>>(),
                    arrays[2].cast<Rows>(), arrays[3].cast<Rows>());
    const py::gil_scoped_release without_lock;
    return load({{name, {}, lenient}, {raw, {}}});
}

// `edits`: (name, tag, value), as reader::Edit; one of the same name is replaced.
Loaded edited(const LoadedScene& scene, const std::vector<std::tuple<std::string, std::string, std::string>>& edits) {
    LoadedScene changed{scene.file, scene.changes};
    for (const auto& [name, tag, value] : edits) {
        std::erase_if(changed.changes.edits, [&](const reader::Edit& e) { return e.name == name; });
        changed.changes.edits.push_back({name, tag, value});
    }
    return load(std::move(changed));
}

}  // namespace

void bind_scene(py::module_& m) {
    m.def("trees_built", &trees_built, "The number of acceleration structures that were built so far.");
    py::class_<LoadedScene, std::shared_ptr<LoadedScene>>(m, "Scene", "A scene as its files were when it was read.")
        .def_property_readonly("path",
                               // Bytes that are not UTF-8 are as Python has them in names of files.
                               [](const LoadedScene& s) {
                                   return py::reinterpret_steal<py::str>(PyUnicode_DecodeFSDefaultAndSize(
                                       s.file.path.data(), static_cast<py::ssize_t>(s.file.path.size())));
                               })
        .def_property_readonly("definitions", [](const LoadedScene& s) { return s.file.definitions; })
        .def("hemisphere", &seen_from_hemisphere)
        .def_property_readonly("edits",
                               [](const LoadedScene& s) {
                                   std::vector<std::pair<std::string, std::string>> edits;
                                   for (const reader::Edit& e : s.changes.edits) edits.emplace_back(e.name, e.value);
                                   return edits;
                               })
        .def("edited", &edited, py::arg("edits"), py::call_guard<py::gil_scoped_release>())
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
                const std::string json = json_text(plan_json(plan_with_bounces(*loaded->scene)));
                return [json] { return py::str(json); };
            });
        });
    m.def(
        "load",
        [](const std::string& path, const std::map<std::string, std::string>& definitions, bool lenient) {
            return load({{scene_along(path), definitions, lenient}});
        },
        py::arg("path"), py::arg("definitions"), py::arg("lenient"), py::call_guard<py::gil_scoped_release>());
    m.def("load_elements", &load_elements, py::arg("name"), py::arg("root"), py::arg("meshes"), py::arg("text"),
          py::arg("lenient"));
}

}  // namespace neumann
