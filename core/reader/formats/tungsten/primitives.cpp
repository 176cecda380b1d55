#include "core/reader/formats/tungsten/primitives.h"

#include "core/reader/formats/make_elements.h"
#include "core/reader/formats/tungsten/emission.h"
#include "core/reader/formats/tungsten/lights.h"
#include "core/reader/formats/tungsten/transforms.h"

#include <algorithm>

#include <fmt/format.h>

namespace neumann::reader::tungsten {

namespace {

const std::vector<std::string> primitive_types = {"cube", "cylinder", "disk", "infinite_sphere", "instances",
                                                  "mesh", "point",    "quad", "sphere"};

// Refuses or ignores properties that every primitive may have.
void finish(JsonObject& primitive, Importing& importing) {
    refuse_media(primitive, {"int_medium", "ext_medium"}, importing);
    // Older files have these properties here and not in bsdfs.
    if (primitive.has("bump"))
        importing.refuse(primitive.place_of("bump"), "bump is not supported", ": how deep it is depends on the picture's size",
                         "left out");
    primitive.ignore({"name", "bump", "bump_strength", "sample"});
    primitive.finish();
}

}  // namespace

void Primitives::add_all() {
    for (std::size_t i = 0; i < list_.size(); ++i)
        importing_.notes.problems.attempt(list_.place_of(i), [&] { add(list_.object(i)); });
}

void Primitives::add(JsonObject primitive) {
    const std::string type = read_type(primitive, "primitive", primitive_types, "left out", importing_);
    if (type.empty()) return;
    if (type == "point") {
        primitive.ignore({"bsdf"});
        emit_ |= add_point(primitive, textures_, importing_);
    } else if (type == "infinite_sphere") {
        primitive.ignore({"bsdf"});
        emit_ |= add_infinite_sphere(primitive, textures_, importing_);
    } else if (type == "instances") {
        add_instances(primitive);
    } else {
        for (Element& shape : make_surface(primitive, type)) reader::add(importing_.scene.root, std::move(shape));
    }
    finish(primitive, importing_);
}

Primitives::Shapes Primitives::make_surface(JsonObject& primitive, const std::string& type) {
    const Mat4 m = read_transform(primitive);
    if (primitive.is_wrong("transform")) throw AlreadyReported();
    if (type == "mesh") return make_mesh(primitive, m);
    if (!is_without_shear(m))
        throw InputError(primitive.place_of("transform"),
                         fmt::format("transform shears a {}, expected scales, rotations and translations", type));
    if (type == "cylinder") return make_cylinder(primitive, m);
    if (type == "cube") return {make_cube(primitive, m)};
    if (type == "disk") return {make_disk(primitive, m)};
    if (type == "sphere") return {make_sphere(primitive, m)};
    return {make_quad(primitive, m)};
}

void Primitives::add_emission(Element& shape, JsonObject& primitive, double area) {
    const auto radiance = find_emission(primitive, textures_, radiance_of_unit_power(area));
    if (!radiance) return;
    if (in_group_) {
        importing_.notes.warnings.add("what is instanced does not emit, as in Tungsten");
        return;
    }
    add_area_light(shape, *radiance, primitive.place());
    emit_ = true;
}

std::vector<std::string> Primitives::add_groups(const JsonList& masters) {
    std::vector<std::string> ids(masters.size());
    in_group_ = true;
    for (std::size_t i = 0; i < masters.size(); ++i)
        importing_.notes.problems.attempt(masters.place_of(i), [&] {
            JsonObject master = masters.object(i);
            static const std::vector<std::string> surfaces = {"cube", "cylinder", "disk", "mesh", "quad", "sphere"};
            const std::string type = read_type(master, "primitive", surfaces, "left out", importing_);
            if (type.empty()) return;
            Shapes shapes = make_surface(master, type);
            finish(master, importing_);
            const std::string id = importing_.ids.unique(master.text("name").value_or("group"));
            Element group = make_object("shape", "shapegroup", master.place(), id);
            for (Element& shape : shapes) reader::add(group, std::move(shape));
            reader::add(importing_.scene.root, std::move(group));
            ids[i] = id;
        });
    in_group_ = false;
    return ids;
}

// Instances are turned and moved, and not scaled.
void Primitives::add_instances(JsonObject& primitive) {
    const Mat4 m = read_transform(primitive);
    const std::vector<std::string> groups = add_groups(primitive.list("masters"));
    for (const char* name : {"instances", "instancesA", "instancesB"})
        if (const nlohmann::json* value = primitive.value(name); value && value->is_string())
            importing_.refuse(primitive.place_of(name), fmt::format("{} in a file are not supported", name), ", expected an array",
                              "left out");
    primitive.ignore({"ratio"});
    const nlohmann::json* value = primitive.value("instances");
    if (!value || value->is_string()) return;
    const JsonList instances = primitive.list("instances");
    for (std::size_t i = 0; i < instances.size(); ++i)
        importing_.notes.problems.attempt(instances.place_of(i), [&] {
            JsonObject instance = instances.object(i);
            const auto id = instance.integer("id", 0, 255).value_or(0);
            const Mat4 own = read_transform(instance);
            instance.finish();
            if (static_cast<std::size_t>(id) >= groups.size())
                throw InputError(instance.place_of("id"),
                                 fmt::format("there is no master {}, only {}, counted from 0", id, groups.size()));
            if (groups[static_cast<std::size_t>(id)].empty()) return;
            Mat4 to_world = rotation_of(m) * rotation_of(own);
            to_world[3] = m * own[3];
            Element e = make_object("shape", "instance", instance.place());
            add_reference(e, groups[static_cast<std::size_t>(id)], instance.place_of("id"));
            add_matrix(e, "to_world", to_world, instance.place_of("transform"));
            reader::add(importing_.scene.root, std::move(e));
        });
}

}  // namespace neumann::reader::tungsten
