#include "core/reader/formats/tungsten/lights.h"

#include "core/reader/formats/make_elements.h"
#include "core/reader/formats/tungsten/emission.h"
#include "core/reader/formats/tungsten/transforms.h"

#include <numbers>

namespace neumann::reader::tungsten {

namespace {

constexpr double per_whole_sphere = 0.25 / std::numbers::pi;

// Tungsten's pictures begin at −x and go on over −z; Mitsuba's begin at −z and go on over +x.
Mat4 of_environment(const Mat4& transform) {
    const Mat4 turn(glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 1, 0, 0), glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 0, 0, 1));
    return rotation_of(transform) * turn;
}

}  // namespace

bool add_point(JsonObject& primitive, Textures& textures, Importing& importing) {
    const Mat4 m = read_transform(primitive);
    const auto intensity = find_emission(primitive, textures, per_whole_sphere);
    if (!intensity) return false;
    if (intensity->texture) throw InputError(intensity->place, "the emission of a point varies, expected a constant");
    Element e = make_object("emitter", "point", primitive.place());
    reader::add_point(e, "position", Vec3(m[3]), primitive.place_of("transform"));
    add_rgb(e, "intensity", intensity->constant, intensity->place);
    add(importing.scene.root, std::move(e));
    return true;
}

bool add_infinite_sphere(JsonObject& primitive, Textures& textures, Importing& importing) {
    const Mat4 m = read_transform(primitive);
    const auto radiance = find_emission(primitive, textures, per_whole_sphere);
    if (!radiance) return false;
    if (radiance->texture && radiance->filename.empty())
        throw InputError(radiance->place, "light from everywhere with a pattern, expected a constant or a picture");
    if (radiance->is_raw)
        importing.refuse(radiance->place, "gamma_correct is false for light from everywhere", ", expected true", "taken as true");
    Element e = make_object("emitter", radiance->texture ? "envmap" : "constant", primitive.place());
    if (radiance->texture) {
        add_string(e, "filename", radiance->filename, radiance->place);
        add_float(e, "scale", radiance->picture_scale, radiance->place);
        add_matrix(e, "to_world", of_environment(m), primitive.place_of("transform"));
    } else {
        add_rgb(e, "radiance", radiance->constant, radiance->place);
    }
    add(importing.scene.root, std::move(e));
    return true;
}

}  // namespace neumann::reader::tungsten
