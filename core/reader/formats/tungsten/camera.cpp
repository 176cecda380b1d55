#include "core/reader/formats/tungsten/camera.h"

#include "core/base/did_you_mean.h"
#include "core/reader/formats/film.h"
#include "core/reader/formats/make_elements.h"
#include "core/reader/formats/tungsten/transforms.h"
#include "core/reader/meshes/mesh_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace neumann::reader::tungsten {

namespace {

// Tungsten clips nothing; these distances clip nothing where scenes are.
constexpr double nearest_depth = 1e-4, farthest_depth = 1e7;

FilmSize read_resolution(JsonObject& camera) {
    constexpr std::int64_t largest = 65536;
    constexpr double usual_width = 1000.0, usual_height = 563.0;
    const Location place = camera.place_of("resolution");
    const nlohmann::json* value = camera.value("resolution");
    if (!value) return {usual_width, usual_height, place, place};
    if (value->is_number()) {
        const double size = static_cast<double>(camera.integer("resolution", 1, largest).value_or(1));
        return {size, size, place, place};
    }
    const std::vector<double> size = camera.numbers("resolution", {usual_width, usual_height}, {1.0, double{largest}});
    for (const double pixels : size)
        if (pixels != std::floor(pixels))
            camera.complain("resolution", fmt::format("resolution has {} pixels, expected whole numbers", pixels));
    return {size[0], size[1], below(place, std::size_t{0}), below(place, std::size_t{1})};
}

Element make_filter(JsonObject& camera, Importing& importing) {
    const Location place = camera.place_of("reconstruction_filter");
    const std::string name = camera.text("reconstruction_filter").value_or("tent");
    if (name == "box" || name == "tent") return make_object("rfilter", name, place);
    if (name == "catmull_rom") return make_object("rfilter", "catmullrom", place);
    if (name == "mitchell_netravali") return make_object("rfilter", "mitchell", place);
    if (name == "gaussian") {
        Element filter = make_object("rfilter", "gaussian", place);
        add_float(filter, "stddev", 0.5, place);
        return filter;
    }
    if (name == "lanczos") {
        Element filter = make_object("rfilter", "lanczos", place);
        add_integer(filter, "lobes", 2, place);
        return filter;
    }
    static const std::vector<std::string> names = {"box", "catmull_rom", "gaussian", "lanczos", "mitchell_netravali", "tent"};
    if (name == "dirac")
        importing.notes.warnings.add("reconstruction_filter 'dirac', which sees the centres of pixels alone: 'box' is taken");
    else
        importing.refuse(place, fmt::format("reconstruction_filter '{}' is not supported", printable(name)),
                         "; " + allowed_instead(name, names), "taken as 'box'");
    return make_object("rfilter", "box", place);
}

// The distance from the camera to the middle of the primitive of this name.
double distance_to_pivot(JsonObject& root, JsonObject& camera, const std::string& name, const Vec3& from, Importing& importing) {
    const JsonList primitives = root.list("primitives");
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        if (!primitives[i].is_object()) continue;
        JsonObject primitive = primitives.object(i);
        if (!primitive.has("name") || primitives[i]["name"] != name) continue;
        return length_of(Vec3(read_transform(primitive)[3]) - from);
    }
    importing.notes.problems.add(
        InputError(camera.place_of("focus_pivot"), fmt::format("there is no primitive '{}'", printable(name))),
        camera.place_of("focus_pivot"));
    return 1.0;
}

void read_lens(JsonObject& root, JsonObject& camera, Element& sensor, const Vec3& position, Importing& importing) {
    double distance = camera.number("focus_distance", 1.0);
    Location place = camera.place_of("focus_distance");
    if (const std::optional<std::string> pivot = camera.text("focus_pivot"); pivot && !pivot->empty()) {
        distance = distance_to_pivot(root, camera, *pivot, position, importing);
        place = camera.place_of("focus_pivot");
    }
    if (!(distance > 0.0))
        importing.notes.problems.add(InputError(place, fmt::format("the focus is {} away, expected more than 0", distance)), place);
    add_float(sensor, "focus_distance", distance > 0.0 ? distance : 1.0, place);
    add_float(sensor, "aperture_radius", camera.number("aperture_size", 0.001, not_negative), camera.place_of("aperture_size"));
    if (camera.number("cateye", 0.0) > 0.0)
        importing.refuse(camera.place_of("cateye"), "cateye is not supported", ", expected 0", "taken as 0");
    const nlohmann::json* aperture = camera.value("aperture");
    const bool is_round = !aperture || (aperture->is_object() && aperture->value("type", nlohmann::json()) == "disk");
    if (!is_round)
        importing.refuse(camera.place_of("aperture"), "the aperture is no disk, which is not supported",
                         ", expected {\"type\": \"disk\"}", "taken as a disk");
}

}  // namespace

void read_camera(JsonObject& root, Importing& importing) {
    auto camera = root.object("camera");
    if (!camera) root.fail_missing("camera", "an object");
    static const std::vector<std::string> types = {"pinhole", "thinlens"};
    const std::string type = read_type(*camera, "camera", types, "taken as 'pinhole'", importing);
    const bool has_lens = type == "thinlens";
    Element sensor = make_object("sensor", has_lens ? "thinlens" : "perspective", camera->place());
    const double angle = camera->number("fov", 60.0);
    if (!(angle > 0.0 && angle < 180.0))
        camera->complain("fov", fmt::format("fov is {}, expected more than 0 and less than 180 degrees", angle));
    add_float(sensor, "fov", angle, camera->place_of("fov"));
    add_string(sensor, "fov_axis", "x", camera->place_of("fov"));
    add_float(sensor, "near_clip", nearest_depth, camera->place());
    add_float(sensor, "far_clip", farthest_depth, camera->place());
    if (!camera->has("transform")) camera->fail_missing("transform", "where the camera stands");
    const Mat4 m = read_transform(*camera);
    const Vec3 scale = scale_of(m);
    constexpr double tolerance = 1e-4;
    if (!(std::min({scale.x, scale.y, scale.z}) >= (1.0 - tolerance) * max_component(scale)) || !is_without_shear(m))
        camera->complain("transform", "the camera is stretched, expected the same scale in all directions");
    Mat4 to_world = rotation_of(m);
    to_world[3] = m[3];
    add_matrix(sensor, "to_world", to_world, camera->place_of("transform"));
    if (has_lens) read_lens(root, *camera, sensor, Vec3(m[3]), importing);
    Element& film = add(sensor, make_object("film", "hdrfilm", camera->place()));
    add_film_size(importing.scene.root, film, read_resolution(*camera), importing.definitions);
    add(film, make_filter(*camera, importing));
    refuse_media(*camera, {"medium"}, importing);
    camera->ignore({"name", "tonemap"});  // pictures are written linear
    if (!type.empty()) camera->finish();
    add(importing.scene.root, std::move(sensor));
}

}  // namespace neumann::reader::tungsten
