#include "core/reader/area_lights.h"
#include "core/reader/bsdfs.h"
#include "core/reader/file_hash.h"
#include "core/reader/integrator.h"
#include "core/reader/light_images.h"
#include "core/reader/properties.h"
#include "core/reader/read_scene.h"
#include "core/reader/read_shapes.h"
#include "core/reader/scene_lights.h"
#include "core/reader/sensor.h"
#include "core/reader/textures.h"

#include <fmt/format.h>

namespace neumann {

namespace reader {

namespace {

// The only <integrator> or <sensor>, or null.
const Element* only(const Element& root, const std::string& tag) {
    const Element* first = nullptr;
    for (const Element& e : root.children) {
        if (e.tag != tag) continue;
        if (first)
            throw InputError(e.place,
                             fmt::format("a second <{}>, expected only one; the first is at {}", tag, to_string(first->place)));
        first = &e;
    }
    return first;
}

Origin origin(const Element& shape, const Element* bsdf) {
    const auto title = [](const Element& e) { return fmt::format("{} '{}'", e.tag, e.attribute("type").value); };
    return {shape.place, title(shape), bsdf ? title(*bsdf) : "default bsdf"};
}

// What stands at the top level and nothing refers to is checked and dropped.
void check_unused(const Element& root, const Context& context, const Bsdfs& bsdfs, const AreaLights& lights) {
    Warnings dropped;
    std::vector<std::string> dropped_files;
    const Context aside{context.document, context.objects, dropped, dropped_files, context.textures};
    Bsdfs other_bsdfs(aside);
    AreaLights other_lights(aside);
    for (const Element& e : root.children) {
        if (e.tag == "bsdf" && !bsdfs.has(e)) other_bsdfs.sides(e);
        if (e.tag == "emitter" && e.attribute("type").value == "area" && !lights.has(e)) other_lights.index(e);
        if (e.tag == "texture" && !context.textures.known.count(&e)) read_texture(e, Illuminant::d65, aside);
        if (e.tag == "film") read_film(e, aside);
        if (e.tag == "rfilter") read_filter(e, aside);
        if (e.tag == "sampler") read_sampler(e, aside);
        for (const Element& shape : e.children)  // of a group
            for (const Element& bsdf : shape.children)
                if (shape.tag == "shape" && bsdf.tag == "bsdf" && !bsdfs.has(bsdf)) other_bsdfs.sides(bsdf);
    }
}

}  // namespace

}  // namespace reader

SceneParts read_scene_parts(const std::string& path, const std::map<std::string, std::string>& definitions, bool optional) {
    using namespace reader;
    SceneParts parts;
    const Document document = read_document(path, definitions, parts.warnings, optional);
    const Objects objects(document.root);
    std::vector<std::string> mesh_files;
    TextureStore textures;
    const Context context{document, objects, parts.warnings, mesh_files, textures};

    if (const Element* e = only(document.root, "integrator")) {
        const Integrator integrator = read_integrator(*e, context);
        parts.bounces = integrator.bounces;
        parts.hide_emitters = integrator.hide_emitters;
    }
    const Element* sensor = only(document.root, "sensor");
    if (!sensor) throw InputError(document.root.place, "the scene has no <sensor>, expected one");
    const ReadSensor s = read_sensor(*sensor, context);
    parts.camera = s.camera;
    parts.film = s.film;
    parts.sampler = s.sampler;

    Bsdfs bsdfs(context);
    AreaLights lights(context);
    SceneLights scene_lights(context);
    for (const Element& e : document.root.children)
        if (e.tag == "emitter") scene_lights.add(e);
    // All shapes before their materials: textures may hold what meshes bring along.
    std::vector<ReadShape> shapes;
    read_shapes(document.root, context, [&](ReadShape shape) { shapes.push_back(std::move(shape)); });
    for (ReadShape& shape : shapes) {
        parts.sides_of_shape.push_back(shape.bsdf ? bsdfs.sides(*shape.bsdf) : bsdfs.default_sides(shape.emitter));
        parts.lights.of_shape.push_back(shape.emitter ? lights.index(*shape.emitter) : Emitters::none);
        parts.shapes.push_back(std::move(shape.shape));
        parts.origins.push_back(origin(*shape.element, shape.bsdf));
    }
    check_unused(document.root, context, bsdfs, lights);
    parts.bsdfs = bsdfs.take();
    parts.lights.area = lights.take();
    parts.lights.environment = scene_lights.take_environment();
    parts.lights.delta = scene_lights.take_delta();
    std::vector<std::string> files = document.files;
    files.insert(files.end(), mesh_files.begin(), mesh_files.end());
    parts.hash = hash_files(files);
    return parts;
}

}  // namespace neumann
