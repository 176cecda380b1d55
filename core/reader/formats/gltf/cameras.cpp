#include "core/reader/formats/gltf/cameras.h"

#include "core/base/did_you_mean.h"
#include "core/reader/formats/film.h"
#include "core/reader/formats/make_elements.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace neumann::reader::gltf {

namespace {

// glTF's cameras have x to the right and look along −z, Mitsuba's have x to the left and look along z.
Mat4 facing(const Mat4& m) { return {-m[0], m[1], -m[2], m[3]}; }

void add_film_and_sampler(Element& scene, Element& sensor, double aspect, const Location& place, const NamedValues& definitions) {
    add_film(scene, sensor, aspect, place, definitions);
    Element& sampler = add(sensor, make_object("sampler", "ldsampler", place));
    add_defined(scene, sampler, "integer", "sample_count", "spp", "64", place);
}

void add_clipping(Element& sensor, double near, double far, const Location& place) {
    add_float(sensor, "near_clip", near, place);
    add_float(sensor, "far_clip", far, place);
}

double positive(JsonObject& object, const std::string& name) {
    const auto value = object.find_number(name);
    if (!value) object.fail_missing(name, "a number above 0");
    if (*value > 0.0) return *value;
    throw InputError(object.place_of(name), fmt::format("{} is {}, expected more than 0", name, *value));
}

// The clipping distance of a camera without one; no scene is that large.
constexpr double far_away = 1e9;

double add_perspective(Element& sensor, JsonObject camera) {
    const double angle = positive(camera, "yfov"), near = positive(camera, "znear");
    const double aspect = camera.has("aspectRatio") ? positive(camera, "aspectRatio") : usual_aspect;
    const double far = camera.has("zfar") ? positive(camera, "zfar") : std::max(far_away, 2.0 * near);
    if (!(angle < std::numbers::pi))
        throw InputError(camera.place_of("yfov"), fmt::format("yfov is {}, expected less than π", angle));
    if (!(far > near))
        throw InputError(camera.place_of("zfar"), fmt::format("zfar is {}, expected more than znear, {}", far, near));
    add_float(sensor, "fov", angle * 180.0 / std::numbers::pi, camera.place());
    add_string(sensor, "fov_axis", "y", camera.place());
    add_clipping(sensor, near, far, camera.place());
    camera.finish();
    return aspect;
}

struct Magnified {
    double x, aspect;
};

Magnified add_orthographic(Element& sensor, JsonObject camera) {
    const double x = positive(camera, "xmag"), y = positive(camera, "ymag"), far = positive(camera, "zfar");
    const double near = camera.number("znear", 0.0, not_negative);
    if (!(far > near))
        throw InputError(camera.place_of("zfar"), fmt::format("zfar is {}, expected more than znear, {}", far, near));
    add_clipping(sensor, std::max(near, far * 1e-9), far, camera.place());
    camera.finish();
    return {x, x / y};
}

void add_camera(Element& scene, const Placed& placed, JsonObject camera, const std::string& id, const NamedValues& definitions) {
    const std::string type = camera.text("type").value_or("");
    auto perspective = camera.object("perspective"), orthographic = camera.object("orthographic");
    camera.ignore({"name"});
    camera.finish();
    const bool is_perspective = type == "perspective";
    if (!is_perspective && type != "orthographic")
        throw InputError(camera.place_of("type"), fmt::format("type is '{}', expected perspective or orthographic", type));
    if (!(is_perspective ? perspective : orthographic)) camera.fail_missing(type, "an object");
    Element sensor = make_object("sensor", type, camera.place());
    if (!id.empty()) sensor.attributes.push_back({"id", id, camera.place()});
    Mat4 to_world = facing(without_scale(placed));
    double aspect = 1.0;
    if (is_perspective) {
        aspect = add_perspective(sensor, *perspective);
    } else {
        const Magnified magnified = add_orthographic(sensor, *orthographic);
        aspect = magnified.aspect;
        to_world[0] *= magnified.x;
        to_world[1] *= magnified.x;
    }
    add_matrix(sensor, "to_world", to_world, placed.place);
    add_film_and_sampler(scene, sensor, aspect, camera.place(), definitions);
    add(scene, std::move(sensor));
}

// The name of a camera is that of its node, or its own.
std::string name_of(const Placed& placed, const JsonList& cameras) {
    if (!placed.name.empty()) return placed.name;
    return cameras.object(placed.what).text("name").value_or("");
}

// The index of the camera of this name or number; 0, and a problem, if there is none.
std::size_t choose(const std::string& wish, const std::vector<std::string>& names, const Location& place, Problems& problems) {
    if (const auto found = std::find(names.begin(), names.end(), wish); found != names.end())
        return static_cast<std::size_t>(found - names.begin());
    for (std::size_t i = 0; i < names.size(); ++i)
        if (wish == std::to_string(i)) return i;
    problems.add(InputError(place, fmt::format("-D camera={}: there is no such camera, expected a number from 0 on or one of: {}{}",
                                               wish, join(names), did_you_mean(wish, names))),
                 place);
    return 0;
}

}  // namespace

void add_camera(Element& scene, const std::vector<Placed>& placed, const JsonList& cameras, const NamedValues& definitions,
                Notes& notes) {
    std::vector<std::string> names;
    for (const Placed& p : placed) names.push_back(name_of(p, cameras));
    const auto wish = definitions.find("camera");
    const bool is_wished = wish != definitions.end();
    const std::size_t chosen = is_wished ? choose(wish->second, names, scene.place, notes.problems) : 0;
    if (placed.size() > 1 && !is_wished)
        notes.warnings.add(fmt::format("several cameras: {}; the first is taken, and -D camera=NAME takes another", join(names)));
    std::string id;
    if (placed.size() > 1 || is_wished) {
        // Its use as the sensor's id counts as a use of -D camera.
        add(scene, {"default", {{"name", "camera", scene.place}, {"value", "camera", scene.place}}, {}, scene.place});
        id = "$camera";
    }
    add_camera(scene, placed[chosen], cameras.object(placed[chosen].what), id, definitions);
}

void add_default_camera(Element& scene, const Bounds& bounds, const NamedValues& definitions) {
    constexpr double angle = 40.0;
    const double radius = bounds.is_empty() || !(bounds.radius() > 0.0) ? 1.0 : bounds.radius();
    const Vec3 center = bounds.is_empty() ? Vec3(0.0) : bounds.center(), backwards = glm::normalize(Vec3(0.6, 0.45, 1.0));
    const double distance = radius / std::sin(0.5 * angle * std::numbers::pi / 180.0);
    const Vec3 right = glm::normalize(glm::cross(Vec3(0.0, 1.0, 0.0), backwards));
    const Mat4 camera(glm::dvec4(right, 0.0), glm::dvec4(glm::cross(backwards, right), 0.0), glm::dvec4(backwards, 0.0),
                      glm::dvec4(center + backwards * distance, 1.0));
    Element sensor = make_object("sensor", "perspective", scene.place);
    add_float(sensor, "fov", angle, scene.place);
    add_string(sensor, "fov_axis", "y", scene.place);
    add_clipping(sensor, 1e-3 * distance, 1e3 * distance, scene.place);
    add_matrix(sensor, "to_world", facing(camera), scene.place);
    add_film_and_sampler(scene, sensor, usual_aspect, scene.place, definitions);
    add(scene, std::move(sensor));
}

}  // namespace neumann::reader::gltf
