#include "core/reader/formats/gltf/import_gltf.h"

#include "core/reader/formats/gltf/cameras.h"
#include "core/reader/formats/gltf/extensions.h"
#include "core/reader/formats/gltf/lights.h"
#include "core/reader/formats/gltf/shapes.h"
#include "core/reader/formats/make_elements.h"
#include "core/reader/formats/surroundings.h"

#include <fmt/format.h>

namespace neumann::reader {

namespace {

using namespace gltf;

// If the version is another, the rest of the file cannot be understood.
void check_version(JsonObject& root) {
    auto asset = root.object("asset");
    if (!asset) root.fail_missing("asset", "an object with the version of glTF, 2.0");
    const auto version = asset->text("version"), least = asset->text("minVersion");
    if (!version) asset->fail_missing("version", "2.0");
    const auto check = [&](const std::string& name, const std::string& text) {
        if (!text.starts_with("2."))
            throw InputError(asset->place_of(name), fmt::format("glTF {}, expected 2.0; export the scene as glTF 2.0", text));
    };
    check("version", *version);
    if (least) check("minVersion", *least);
}

// The places of each mesh, in the order in which the tree comes to the meshes.
std::vector<std::vector<Placed>> by_mesh(const std::vector<Placed>& all) {
    std::vector<std::vector<Placed>> result;
    std::map<std::size_t, std::size_t> order;
    for (const Placed& placed : all) {
        const auto [found, is_new] = order.try_emplace(placed.what, result.size());
        if (is_new) result.emplace_back();
        result[found->second].push_back(placed);
    }
    return result;
}

JsonList list_of_lights(JsonObject& root) {
    if (auto extension = root.extension("KHR_lights_punctual")) return extension->list("lights");
    return {nullptr, root.place(), root.notes()};
}

RawScene read(const std::string& path, const NamedValues& definitions, Warnings& warnings, Problems& problems) {
    const GltfFile file(path);
    Notes notes{warnings, problems, has_no_effect};
    JsonObject root(file.root(), {path}, notes);
    check_version(root);
    check_extensions(root);
    RawScene result{make_scene_element({path}), {path}};
    Element& scene = result.root;
    add(scene, make_object("integrator", "path", scene.place));

    Accessors accessors(file, path, root, result.files);
    Pictures pictures(root, accessors, path, result.files, result.in_memory);
    const JsonList lights = list_of_lights(root), cameras = root.list("cameras");
    const Nodes nodes = problems.attempt(scene.place, [&] { return read_nodes(root, lights, accessors); }).value_or(Nodes());
    Shapes shapes(root, accessors, pictures, result.in_memory);
    for (const std::vector<Placed>& places : by_mesh(nodes.meshes))
        problems.attempt(places.front().place, [&] { shapes.add(scene, places.front().what, places); });
    for (const Placed& placed : nodes.lights)
        problems.attempt(placed.place, [&] { add(scene, make_light(placed, lights.object(placed.what))); });
    if (nodes.lights.empty() && !has_emitters(scene)) add_surroundings(scene, warnings);
    if (nodes.cameras.empty())
        warnings.add("the file has no camera: everything is seen from the front, from the right and from above");
    if (nodes.cameras.empty() ||
        !problems.attempt(scene.place, [&] { add_camera(scene, nodes.cameras, cameras, definitions, notes); }))
        add_default_camera(scene, shapes.bounds(), definitions);
    if (root.list("animations").size() > 0) warnings.add("animations left out: everything stands where its node says");
    root.finish();
    return result;
}

}  // namespace

RawScene import_gltf(const std::string& path, const NamedValues& definitions, Warnings& warnings, Problems& problems) {
    try {
        return read(path, definitions, warnings, problems);
    } catch (const AlreadyReported&) {
        problems.check({path});
        throw;
    }
}

}  // namespace neumann::reader
