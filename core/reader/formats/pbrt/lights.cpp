#include "core/reader/formats/pbrt/lights.h"

#include "core/base/did_you_mean.h"
#include "core/base/frame.h"
#include "core/reader/formats/find_file.h"
#include "core/reader/formats/make_elements.h"
#include "core/reader/formats/pbrt/colours.h"
#include "core/reader/formats/pbrt/goniometric.h"
#include "core/reader/formats/pbrt/light_scale.h"
#include "core/reader/formats/pbrt/octahedral.h"
#include "core/reader/formats/pbrt/rigid.h"
#include "core/reader/meshes/mesh_text.h"
#include "core/reader/xml/transform.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

namespace neumann::reader::pbrt {

namespace {

using std::numbers::pi;

const std::vector<std::string> light_types = {"distant", "goniometric", "infinite", "point", "spot"};

Vec3 to_world_point(const Entity& e, const Vec3& p) { return Vec3(e.to_world * glm::dvec4(p, 1.0)); }
Vec3 to_world_vector(const Entity& e, const Vec3& v) { return Vec3(e.to_world * glm::dvec4(v, 0.0)); }

// Throws InputError if the transformation of a light with a direction has no inverse.
void expect_direction(const Entity& e) {
    if (!is_invertible(e.to_world))
        throw InputError(e.place(), fmt::format("the transformation of {} has no inverse, expected one that scales nothing to 0",
                                                e.parameters.title()));
}

void finish(Parameters& p) {
    p.finish();
    if (p.is_wrong()) throw AlreadyReported();
}

// Reads `from` and `to`, which must differ.
std::pair<Vec3, Vec3> read_from_to(Parameters& p) {
    const Vec3 from = p.point("from").value_or(Vec3(0.0)), to = p.point("to").value_or(Vec3(0.0, 0.0, 1.0));
    if (from == to) p.complain("to", fmt::format("from and to of {} are the same point", p.title()));
    return {from, to};
}

Rgb read_colour(Parameters& p, const std::string& name, Importer& importer) {
    return find_light_colour(p, name, importer).value_or(Rgb(1.0)) * read_scale(p) * importer.imaging_ratio;
}

Element make_point(Entity& e, Importer& importer) {
    Parameters& p = e.parameters;
    Rgb intensity = read_colour(p, "I", importer);
    if (const double power = read_positive(p, "power"); power > 0.0) intensity *= power / (4.0 * pi);
    const Vec3 from = p.point("from").value_or(Vec3(0.0));
    finish(p);
    Element light = make_object("emitter", "point", e.place());
    add_point(light, "position", to_world_point(e, from), e.place());
    add_rgb(light, "intensity", intensity, e.place());
    return light;
}

Element make_distant(Entity& e, Importer& importer) {
    expect_direction(e);
    Parameters& p = e.parameters;
    Rgb irradiance = read_colour(p, "L", importer);
    if (const double illuminance = read_positive(p, "illuminance"); illuminance > 0.0) irradiance *= illuminance;
    const auto [from, to] = read_from_to(p);
    finish(p);
    Element light = make_object("emitter", "directional", e.place());
    const Vec3 direction = to_world_vector(e, to - from);
    add_vector(light, "direction", direction / length_of(direction), e.place());
    add_rgb(light, "irradiance", irradiance, e.place());
    return light;
}

Element make_spot(Entity& e, Importer& importer) {
    expect_direction(e);
    Parameters& p = e.parameters;
    Rgb intensity = read_colour(p, "I", importer);
    const double cone = p.number("coneangle", 30.0), delta = p.number("conedeltaangle", 5.0);
    if (!(cone > 0.0 && cone <= 180.0))
        p.complain("coneangle",
                   fmt::format("coneangle of {} is {}, expected more than 0 and at most 180 degrees", p.title(), cone));
    else if (!(delta >= 0.0 && delta <= cone))
        p.complain("conedeltaangle",
                   fmt::format("conedeltaangle of {} is {}, expected from 0 to coneangle, {} degrees", p.title(), delta, cone));
    const double from_cosine = std::cos(glm::radians(cone - delta)), to_cosine = std::cos(glm::radians(cone));
    if (const double power = read_positive(p, "power"); power > 0.0)
        intensity *= power / (2.0 * pi * (1.0 - 0.5 * (from_cosine + to_cosine)));
    const auto [from, to] = read_from_to(p);
    finish(p);
    Element light = make_object("emitter", "spot", e.place());
    const Frame frame(glm::normalize(to - from));
    const Mat4 own(glm::dvec4(frame.s, 0.0), glm::dvec4(frame.t, 0.0), glm::dvec4(frame.n, 0.0), glm::dvec4(from, 1.0));
    add_matrix(light, "to_world", without_scale(e.to_world * own).matrix, e.place());
    add_rgb(light, "intensity", intensity, e.place());
    add_float(light, "cutoff_angle", cone, p.place("coneangle"));
    add_float(light, "beam_width", cone - delta, p.place("conedeltaangle"));
    if (delta > 0.0) add_string(light, "falloff", "smooth", e.place());
    return light;
}

// Reads a picture of all directions in pbrt's octahedral mapping.
Picture read_square(const Entity& e, const std::string& filename, Importer& importer) {
    const Picture picture = find_picture(filename, e.parameters.place("filename"), importer);
    const std::shared_ptr<const Texels> texels = importer.read_picture(picture.path);
    if (texels->width != texels->height)
        throw InputError(
            e.parameters.place("filename"),
            fmt::format("'{}' is {}×{} pixels, expected a square: pbrt-v4 has equal-area octahedral pictures, which its "
                        "'imgtool makeequiarea' makes of others",
                        printable(filename), texels->width, texels->height));
    constexpr int max_size = 8192;
    if (texels->width > max_size)
        throw InputError(e.parameters.place("filename"),
                         fmt::format("'{}' is {} pixels wide, expected at most {}", printable(filename), texels->width, max_size));
    return picture;
}

Element make_picture_light(Entity& e, const std::string& filename, double scale, double illuminance, Importer& importer) {
    expect_direction(e);
    const Picture picture = read_square(e, filename, importer);
    if (illuminance > 0.0) {
        const double own = illuminance_of(picture, importer);
        if (!(own > 0.0))
            throw InputError(e.parameters.place("filename"), fmt::format("'{}' has no light from above", printable(filename)));
        scale *= illuminance / own;
    }
    const std::string name = importer.unused_name("textures/" + stem_of(picture.path) + ".exr");
    importer.scene.in_memory.pictures[name] = to_latitude_longitude(picture, importer);
    Element light = make_object("emitter", "envmap", e.place());
    add_string(light, "filename", name, e.place());
    add_float(light, "scale", scale, e.parameters.place("scale"));
    add_matrix(light, "to_world", without_scale(e.to_world * from_envmap()).matrix, e.place());
    return light;
}

Element make_infinite(Entity& e, Importer& importer) {
    Parameters& p = e.parameters;
    const std::optional<Rgb> colour = find_light_colour(p, "L", importer);
    const std::optional<std::string> filename = p.text("filename");
    if (colour && filename) p.complain("filename", fmt::format("{} has L and filename, expected one of them", p.title()));
    if (p.find("portal", {"point3"}))
        p.refuse("portal", fmt::format("portal of {} is not supported", p.title()), ": pbrt has no light from beside it");
    const double scale = read_scale(p) * importer.imaging_ratio, illuminance = read_positive(p, "illuminance");
    finish(p);
    if (filename) return make_picture_light(e, *filename, scale, illuminance, importer);
    Element light = make_object("emitter", "constant", e.place());
    add_rgb(light, "radiance", colour.value_or(Rgb(1.0)) * scale * (illuminance > 0.0 ? illuminance / pi : 1.0), e.place());
    return light;
}

std::vector<Element> make_goniometric(Entity& e, Importer& importer) {
    expect_direction(e);
    Parameters& p = e.parameters;
    Rgb intensity = read_colour(p, "I", importer);
    const double power = read_positive(p, "power");
    const std::optional<std::string> filename = p.text("filename");
    if (!filename) p.complain("filename", fmt::format("{} has no filename, expected a picture of its directions", p.title()));
    finish(p);
    const Picture picture = read_square(e, *filename, importer);
    if (power > 0.0) {
        double sum = 0.0;
        const std::size_t count = for_each_texel(picture, importer, [&](const Rgb& c) { sum += (c.r + c.g + c.b) / 3.0; });
        if (!(sum > 0.0)) throw InputError(p.place("filename"), fmt::format("'{}' has no light", printable(*filename)));
        intensity *= power / (4.0 * pi * sum / static_cast<double>(count));
    }
    importer.warnings.add("goniometric light: six projectors, to whose pixels its picture is resampled");
    // In pbrt the picture's +y is up.
    Mat4 swap_y_and_z(1.0);
    std::swap(swap_y_and_z[1], swap_y_and_z[2]);
    return make_projectors(picture, intensity, without_scale(e.to_world * swap_y_and_z).matrix, e.place(), importer);
}

std::vector<Element> make_light(Entity& e, Importer& importer) {
    if (e.type == "point") return {make_point(e, importer)};
    if (e.type == "distant") return {make_distant(e, importer)};
    if (e.type == "spot") return {make_spot(e, importer)};
    if (e.type == "infinite") return {make_infinite(e, importer)};
    if (e.type == "goniometric") return make_goniometric(e, importer);
    throw Unknown(e.place(), fmt::format("light type '{}' is not supported", printable(e.type)),
                  "; " + allowed_instead(e.type, light_types), "left out");
}

}  // namespace

std::vector<Element> make_lights(PbrtScene& scene, Importer& importer) {
    std::vector<Element> lights;
    for (Entity& e : scene.lights)
        importer.problems.attempt(e.place(), [&] {
            for (Element& light : make_light(e, importer)) lights.push_back(std::move(light));
        });
    return lights;
}

}  // namespace neumann::reader::pbrt
