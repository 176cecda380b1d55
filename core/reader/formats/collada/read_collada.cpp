#include "core/reader/formats/collada/read_collada.h"

#include "core/reader/formats/collada/cameras.h"
#include "core/reader/formats/collada/lights.h"
#include "core/reader/formats/collada/shapes.h"
#include "core/reader/formats/make_elements.h"
#include "core/reader/formats/surroundings.h"
#include "core/reader/xml/parse_xml.h"

#include <algorithm>
#include <array>

namespace neumann::reader {

namespace {

const std::array<std::string, 24> parts_of_collada = {"asset",
                                                      "extra",
                                                      "library_animation_clips",
                                                      "library_animations",
                                                      "library_articulated_systems",
                                                      "library_cameras",
                                                      "library_controllers",
                                                      "library_effects",
                                                      "library_force_fields",
                                                      "library_formulas",
                                                      "library_geometries",
                                                      "library_images",
                                                      "library_joints",
                                                      "library_kinematics_models",
                                                      "library_kinematics_scenes",
                                                      "library_lights",
                                                      "library_materials",
                                                      "library_nodes",
                                                      "library_physics_materials",
                                                      "library_physics_models",
                                                      "library_physics_scenes",
                                                      "library_visual_scenes",
                                                      "scene",
                                                      "technique"};

}  // namespace

RawScene read_collada(const std::string& path, const NamedValues& definitions, Warnings& warnings, Problems& problems) {
    const collada::File file(parse_xml(path));
    const Element& root = file.root();
    RawScene scene{make_scene_element(root.place), {path}};
    const collada::Import import{file, scene, definitions, warnings, problems};
    collada::check_children(root, parts_of_collada, problems);
    if (const Element* animations = collada::child(root, "library_animations"); animations && !animations->children.empty())
        warnings.add("animations are left out: the scene is as its nodes have it");
    const int up = problems.attempt(root.place, [&] { return collada::up_axis(root); }).value_or(1);
    const collada::SceneNodes nodes = collada::read_nodes(file, warnings, problems);
    const std::vector<collada::Lamp> lamps = collada::add_lights(nodes.lights, up, import);
    const Bounds bounds = collada::add_shapes(nodes.geometries, lamps, import);
    if (nodes.lights.empty() && !has_emitters(scene.root)) add_surroundings(scene.root, warnings);
    if (!problems.attempt(root.place, [&] { collada::add_camera(nodes.cameras, bounds, up, import); }))
        add(scene.root, make_object("sensor", "perspective", root.place));
    return scene;
}

}  // namespace neumann::reader
