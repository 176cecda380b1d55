#include "core/reader/formats/tungsten/import_tungsten.h"

#include "core/reader/formats/json_file.h"
#include "core/reader/formats/make_elements.h"
#include "core/reader/formats/surroundings.h"
#include "core/reader/formats/tungsten/camera.h"
#include "core/reader/formats/tungsten/integrator.h"
#include "core/reader/formats/tungsten/lights.h"
#include "core/reader/formats/tungsten/primitives.h"

#include <fmt/format.h>

namespace neumann::reader {

namespace {

void refuse_other_programs(const JsonObject& root) {
    const auto refuse = [&](const std::string& whose, const std::string& remedy) {
        throw InputError(root.place(), fmt::format("this looks like a scene of {}, expected one of Tungsten; {}", whose, remedy));
    };
    if (root.has("entities") || root.has("technique"))
        refuse("Ignis", "name the Mitsuba or glTF file that it was made from, or export the scene as glTF 2.0");
    if (root.has("cameras") && root.has("objects")) refuse("SeeSharp", "export the scene as glTF 2.0 from Blender");
    if (!root.has("primitives") && !root.has("bsdfs") && !root.has("camera"))
        throw InputError(root.place(), "the file has no primitives, bsdfs nor camera, expected a scene of Tungsten");
}

}  // namespace

RawScene import_tungsten(const std::string& path, const NamedValues& definitions, Warnings& warnings, Problems& problems) {
    using namespace tungsten;
    const nlohmann::json json = parse_json(path, read_bytes(path, {path}));
    RawScene scene{make_scene_element({path}), {path}};
    Importing importing{scene, definitions, {warnings, problems}};
    JsonObject root(json, {path}, importing.notes);
    refuse_other_programs(root);
    problems.attempt(root.place(), [&] { read_integrator(root, importing); });
    if (!problems.attempt(root.place(), [&] { read_camera(root, importing); }))
        add(scene.root, make_object("sensor", "perspective", root.place()));  // so that it is not reported twice
    Textures textures(importing);
    Bsdfs bsdfs(root, textures, importing);
    bsdfs.add_all();
    Primitives primitives(root, bsdfs, textures, importing);
    primitives.add_all();
    if (!primitives.emit()) add_surroundings(scene.root, warnings);  // as in Tungsten
    // Media matter only where something names them, and the command line says how to render.
    root.ignore({"media", "renderer", "name"});
    root.finish();
    return scene;
}

}  // namespace neumann::reader
