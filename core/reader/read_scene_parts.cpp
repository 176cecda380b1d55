#include "core/reader/area_lights.h"
#include "core/reader/bsdfs.h"
#include "core/reader/file_hash.h"
#include "core/reader/properties.h"
#include "core/reader/read_scene.h"
#include "core/reader/sensor.h"
#include "core/reader/shapes.h"

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
    const Context aside{context.document, context.objects, dropped, context.mesh_files};
    Bsdfs other_bsdfs(aside);
    AreaLights other_lights(aside);
    for (const Element& e : root.children) {
        if (e.tag == "bsdf" && !bsdfs.has(e)) other_bsdfs.sides(e);
        if (e.tag == "emitter" && !lights.has(e)) other_lights.index(e);
        if (e.tag == "film") read_film(e, aside);
        if (e.tag == "rfilter") read_filter(e, aside);
        if (e.tag == "sampler") read_sampler(e, aside);
    }
}

}  // namespace

}  // namespace reader

SceneParts read_scene_parts(const std::string& path, const std::map<std::string, std::string>& definitions, bool optional) {
    using namespace reader;
    const Document document = read_document(path, definitions, optional);
    const Objects objects(document.root);
    SceneParts parts;
    std::vector<std::string> mesh_files;
    const Context context{document, objects, parts.warnings, mesh_files};

    if (const Element* e = only(document.root, "integrator")) parts.bounces = read_integrator(*e, context);
    const Element* sensor = only(document.root, "sensor");
    if (!sensor) throw InputError(document.root.place, "the scene has no <sensor>, expected one");
    const Sensor s = read_sensor(*sensor, context);
    parts.camera = s.camera;
    parts.film = s.film;
    parts.sampler = s.sampler;

    Bsdfs bsdfs(context);
    AreaLights lights(context);
    for (const Element& e : document.root.children) {
        if (e.tag != "shape") continue;
        ReadShape shape = read_shape(e, context);
        parts.sides_of_shape.push_back(shape.bsdf ? bsdfs.sides(*shape.bsdf) : bsdfs.default_sides(shape.emitter));
        parts.lights.of_shape.push_back(shape.emitter ? lights.index(*shape.emitter) : Emitters::none);
        parts.shapes.push_back(std::move(shape.shape));
        parts.origins.push_back(origin(e, shape.bsdf));
    }
    check_unused(document.root, context, bsdfs, lights);
    parts.bsdfs = bsdfs.take();
    parts.lights.area = lights.take();
    std::vector<std::string> files = document.files;
    files.insert(files.end(), mesh_files.begin(), mesh_files.end());
    parts.hash = hash_files(files);
    return parts;
}

}  // namespace neumann
