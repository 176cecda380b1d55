#include "core/reader/changed_scene.h"
#include "core/reader/file_hash.h"
#include "core/reader/plugins/area_lights.h"
#include "core/reader/plugins/bsdfs.h"
#include "core/reader/plugins/integrator.h"
#include "core/reader/plugins/light_images.h"
#include "core/reader/plugins/read_shapes.h"
#include "core/reader/plugins/scene_lights.h"
#include "core/reader/plugins/sensors.h"
#include "core/reader/plugins/textures.h"
#include "core/reader/read_raw_scene.h"
#include "core/reader/read_scene.h"
#include "core/reader/xml/grammar.h"
#include "core/reader/xml/properties.h"

#include <fmt/format.h>
#include <algorithm>

namespace neumann {

namespace reader {

namespace {

// The only <integrator> or <sensor>, or null.
const Element* only(const Element& root, const std::string& tag, Problems& problems) {
    const Element* first = nullptr;
    for (const Element& e : root.children) {
        if (e.tag != tag) continue;
        if (first)
            problems.add(InputError(e.place, fmt::format("a second <{}>, expected only one; the first is at {}", tag,
                                                         to_string(first->place))),
                         e.place);
        else
            first = &e;
    }
    return first;
}

bool has_sensor(const Element& e) {
    return std::ranges::any_of(e.children, [](const Element& child) { return child.tag == "sensor" || has_sensor(child); });
}

// The sensor of the scene, or else that of one of its shapes.
ReadSensor read_only_sensor(const Element& root, const Context& context, const std::vector<ReadShape>& shapes) {
    Problems& problems = context.problems();
    const Element* sensor = only(root, "sensor", problems);
    for (const ReadShape& shape : shapes)
        if (!sensor && shape.sensor) sensor = shape.sensor;
    if (!sensor) {
        // The element that could not be read may have been the sensor.
        for (const Element& e : root.children)
            if (e.broken && !is_object(e.tag)) throw AlreadyReported();
        if (has_sensor(root) && problems.any()) throw AlreadyReported();
        throw InputError(root.place, "the scene has no <sensor>, expected one");
    }
    ReadSensor read = read_sensor(*sensor, context, shapes);
    for (const ReadShape& shape : shapes)
        if (shape.sensor && shape.sensor != sensor && !read.meters.contains(shape.sensor))
            problems.add(InputError(shape.sensor->place, fmt::format("a second <sensor>, expected only one; the first is at {}",
                                                                     to_string(sensor->place))),
                         shape.sensor->place);
    return read;
}

Origin origin(const Element& shape, const Element* bsdf) {
    // An object is named by its id, or else by its type.
    const auto title = [](const Element& e) {
        const Attribute* id = e.find("id");
        return fmt::format("{} '{}'", e.tag, id ? id->value : e.attribute("type").value);
    };
    return {shape.place, title(shape), bsdf ? title(*bsdf) : "default bsdf"};
}

// Checks what the picture does not depend on: objects to which nothing refers, objects in shapes, and the contents of
// elements that could not be read.
class Unused {
public:
    Unused(const Context& context, const Bsdfs& bsdfs, const AreaLights& lights)
        : bsdfs_(bsdfs),
          lights_(lights),
          aside_{context.document, context.objects, dropped_, dropped_files_, context.textures},
          other_bsdfs_(aside_),
          other_lights_(aside_) {}

    void check(const Element& parent) {
        for (const Element& e : parent.children) {
            aside_.problems().attempt(e.place, [&] { read(e, parent); });
            if (e.tag == "shape" || aside_.problems().any()) check(e);
        }
    }

private:
    void read(const Element& e, const Element& parent) {
        const bool is_on_shape = parent.tag == "shape";
        if (e.tag == "bsdf" && !bsdfs_.has(e)) other_bsdfs_.sides(e);
        if (e.tag == "emitter" && (is_on_shape || is_of_shapes(e)) && !lights_.has(e)) other_lights_.index(e);
        if (e.tag == "texture" && !aside_.textures.known.count(&e)) read_texture(e, Illuminant::d65, aside_);
        if (e.tag == "film") read_film(e, aside_);
        if (e.tag == "rfilter") read_filter(e, aside_);
        if (e.tag == "sampler") read_sampler(e, aside_);
    }

    const Bsdfs& bsdfs_;
    const AreaLights& lights_;
    Warnings dropped_;
    std::vector<std::string> dropped_files_;
    const Context aside_;
    Bsdfs other_bsdfs_;
    AreaLights other_lights_;
};

}  // namespace

}  // namespace reader

SceneParts read_scene_parts(const std::string& path, const std::map<std::string, std::string>& definitions,
                            const Reading& reading) {
    return read_scene_parts(path, definitions, reading, {});
}

SceneParts read_scene_parts(const std::string& path, const std::map<std::string, std::string>& definitions, const Reading& reading,
                            const SceneChanges& changes) {
    using namespace reader;
    SceneParts parts;
    Problems problems(reading.lenient);
    RawScene raw = changes.in_memory ? *changes.in_memory : read_raw_scene(path, definitions, parts.warnings, problems);
    std::string in_memory = std::move(raw.text);
    Document document = read_document(std::move(raw), definitions, parts.warnings, problems, reading.optional_definitions);
    for (const Edit& edit : changes.edits) {
        problems.attempt(document.root.place, [&] { apply(edit, document.root); });
        in_memory += "\n" + edit.name + " " + edit.tag + " " + edit.value;
    }
    const Objects objects(document.root, problems, document.lost);
    std::vector<std::string> mesh_files;
    TextureStore textures;
    const Context context{document, objects, parts.warnings, mesh_files, textures};

    if (const Element* e = only(document.root, "integrator", problems))
        problems.attempt(e->place, [&] {
            const Integrator integrator = read_integrator(*e, context);
            parts.bounces = integrator.bounces;
            parts.hide_emitters = integrator.hide_emitters;
        });

    Bsdfs bsdfs(context);
    AreaLights lights(context);
    SceneLights scene_lights(context);
    for (const Element& e : document.root.children)
        if (e.tag == "emitter") problems.attempt(e.place, [&] { scene_lights.add(e); });
    // All shapes are read before their materials, because textures may use attributes of meshes.
    std::vector<ReadShape> shapes;
    read_shapes(document.root, context, [&](ReadShape shape) { shapes.push_back(std::move(shape)); });
    problems.attempt(document.root.place, [&] {
        ReadSensor s = read_only_sensor(document.root, context, shapes);
        parts.camera = std::move(s.camera);
        parts.film = s.film;
        parts.sampler = s.sampler;
    });
    for (ReadShape& shape : shapes) {
        parts.sides_of_shape.push_back(shape.bsdf ? bsdfs.sides(*shape.bsdf) : bsdfs.default_sides(shape.emitter));
        parts.lights.of_shape.push_back(shape.emitter ? lights.index(*shape.emitter, shape.shape) : Emitters::none);
        parts.shapes.push_back(std::move(shape.shape));
    }
    Unused(context, bsdfs, lights).check(document.root);
    problems.check(document.files);
    parts.replaced = problems.replaced(document.files);
    for (const std::string& what : parts.replaced) parts.warnings.add(what);
    for (const ReadShape& shape : shapes) parts.origins.push_back(origin(*shape.element, shape.bsdf));
    parts.bsdfs = bsdfs.take();
    parts.lights.area = lights.take();
    parts.lights.environment = scene_lights.take_environment();
    parts.lights.delta = scene_lights.take_delta();
    std::vector<std::string> files(document.files.begin() + (changes.in_memory ? 1 : 0), document.files.end());
    files.insert(files.end(), mesh_files.begin(), mesh_files.end());
    parts.hash = hash_files(files, in_memory);
    return parts;
}

}  // namespace neumann
