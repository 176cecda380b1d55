#include "core/reader/formats/pbrt/import_pbrt.h"

#include "core/reader/formats/make_elements.h"
#include "core/reader/formats/pbrt/lights.h"
#include "core/reader/formats/pbrt/materials.h"
#include "core/reader/formats/pbrt/read_directives.h"
#include "core/reader/formats/pbrt/sensor.h"
#include "core/reader/formats/pbrt/shapes.h"
#include "core/reader/formats/pbrt/textures.h"

namespace neumann::reader {

RawScene import_pbrt(const std::string& path, const NamedValues& definitions, Warnings& warnings, Problems& problems) {
    using namespace pbrt;
    PbrtScene from = read_directives(path, warnings, problems);
    RawScene scene{make_scene_element(from.start), from.files};
    Importer importer{scene, definitions, warnings, problems};
    const auto add_all = [&](std::vector<Element> elements) {
        for (Element& e : elements) add(scene.root, std::move(e));
    };
    if (auto integrator = problems.attempt(from.start, [&] { return make_integrator(from, importer); }))
        add(scene.root, std::move(*integrator));
    Element sensor = make_sensor(from, scene.root, importer);
    add(scene.root, std::move(sensor));
    Textures textures(from, importer);
    Materials materials(from, textures, importer);
    Shapes shapes(from, materials, textures, importer);
    std::vector<Element> all_shapes = shapes.make();
    materials.make_all();
    add_all(materials.take());
    add_all(make_lights(from, importer));
    add_all(std::move(all_shapes));
    return scene;
}

}  // namespace neumann::reader
