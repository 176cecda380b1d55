#include "core/reader/plugins/sensors.h"

#include "core/base/frame.h"
#include "core/reader/xml/properties.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

// "50mm" or "50".
double parse_focal_length(Properties& p, std::string text) {
    const std::string whole = text;
    if (text.ends_with("mm")) text.resize(text.size() - 2);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size() && value > 0.0 && std::isfinite(value)) return value;
    p.complain("focal_length", fmt::format("focal_length is '{}', expected a positive number and mm, such as 50mm", whole));
    return 50.0;
}

void read_clipping(Properties& p, SensorOptions& camera) {
    camera.near_clip = p.number("near_clip").value_or(1e-2);
    camera.far_clip = p.number("far_clip").value_or(1e4);
    if (camera.near_clip <= 0.0) p.complain("near_clip", fmt::format("near_clip is {}, expected more than 0", camera.near_clip));
    if (camera.far_clip <= camera.near_clip)
        p.complain("far_clip", fmt::format("far_clip is {}, expected more than near_clip, {}", camera.far_clip, camera.near_clip),
                   {"near_clip"});
}

SensorOptions read_perspective(Properties& p, const std::string& type) {
    SensorOptions camera;
    camera.to_world = read_rigid_transform(p);
    const FieldOfView field = read_field_of_view(p);
    camera.fov = field.angle;
    camera.fov_axis = field.axis;
    read_clipping(p, camera);
    const std::optional<double> focus_distance = p.number("focus_distance");
    if (type == "perspective") {
        // A pinhole is sharp everywhere.
        camera.principal_point_offset = {p.number("principal_point_offset_x").value_or(0.0),
                                         p.number("principal_point_offset_y").value_or(0.0)};
        return camera;
    }
    camera.kind = SensorOptions::Kind::thin_lens;
    camera.focus_distance = focus_distance.value_or(camera.far_clip);
    if (camera.focus_distance <= 0.0)
        p.complain("focus_distance", fmt::format("focus_distance is {}, expected more than 0", camera.focus_distance),
                   {"far_clip"});
    p.require("aperture_radius", {"float", "integer"});
    camera.aperture_radius = p.number("aperture_radius").value_or(0.0);
    if (camera.aperture_radius < 0.0)
        p.complain("aperture_radius", fmt::format("aperture_radius is {}, expected at least 0", camera.aperture_radius));
    return camera;
}

SensorOptions read_orthographic(Properties& p) {
    SensorOptions camera;
    camera.kind = SensorOptions::Kind::orthographic;
    camera.to_world = p.transform("to_world");
    read_clipping(p, camera);
    p.number("focus_distance");  // parallel rays are sharp everywhere
    return camera;
}

// The limit of a pinhole camera as its field of view tends to 0: of a millionth of a radian, so that the ray is spread over a
// millionth of the distance.
SensorOptions read_radiance_meter(Properties& p) {
    const Element* to_world = p.find("to_world", {"transform"});
    const std::optional<Vec3> origin = p.point("origin"), direction = p.point("direction");
    if (origin.has_value() != direction.has_value())
        p.complain(origin ? "origin" : "direction",
                   fmt::format("{} is given without {}, expected both, or to_world", origin ? "origin" : "direction",
                               origin ? "direction" : "origin"),
                   {"origin", "direction"});
    if (to_world && direction) p.complain("direction", "both direction and to_world are given, expected one of them", {"origin"});
    const Mat4 m = p.transform("to_world");
    const Vec3 along = direction.value_or(Vec3(m[2]));
    const double largest = max_component(glm::abs(along));
    if (largest == 0.0) p.complain("direction", "the direction is zero");
    SensorOptions camera;
    const Frame frame(largest > 0.0 ? glm::normalize(along / largest) : Vec3(0.0, 0.0, 1.0));
    camera.to_world = Mat4(glm::dvec4(frame.s, 0.0), glm::dvec4(frame.t, 0.0), glm::dvec4(frame.n, 0.0),
                           glm::dvec4(origin.value_or(Vec3(m[3])), 1.0));
    camera.fov = 1e-6;
    camera.near_clip = 1e-6;
    camera.far_clip = 1e12;
    return camera;
}

// A meter measures one number.
void check_film_of_meter(const Film& film, const Element& e) {
    if (film.width == 1 && film.height == 1) return;
    throw InputError(e.place,
                     fmt::format("the film of sensor 'radiancemeter' has {}×{} pixels, expected 1×1", film.width, film.height));
}

}  // namespace

FieldOfView read_field_of_view(Properties& p) {
    static const std::map<std::string, FovAxis> axes = {{"x", FovAxis::x},
                                                        {"y", FovAxis::y},
                                                        {"diagonal", FovAxis::diagonal},
                                                        {"smaller", FovAxis::smaller},
                                                        {"larger", FovAxis::larger}};
    const std::string axis = p.choice("fov_axis", {"x", "y", "diagonal", "smaller", "larger"}, "x");
    const std::optional<double> fov = p.number("fov");
    const std::optional<std::string> focal_length = p.text("focal_length");
    if (fov && focal_length) p.complain("focal_length", "both fov and focal_length are given, expected one of them");
    // Of 35 mm film, 36 mm × 24 mm.
    if (!fov)
        return {2.0 * std::atan(0.5 * std::hypot(36.0, 24.0) / parse_focal_length(p, focal_length.value_or("50mm"))),
                FovAxis::diagonal};
    if (!(*fov > 0.0 && *fov < 180.0))
        p.complain("fov", fmt::format("fov is {}, expected more than 0 and less than 180 degrees", *fov));
    return {glm::radians(*fov), axes.at(axis)};
}

Mat4 read_rigid_transform(Properties& p) {
    const Mat4 m = p.transform("to_world");
    constexpr double tolerance = 1e-3;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j <= i; ++j)
            if (std::abs(glm::dot(Vec3(m[i]), Vec3(m[j])) - (i == j ? 1.0 : 0.0)) > tolerance)
                p.complain("to_world",
                           fmt::format("to_world of {} scales or shears, expected rotations and translations", p.title()));
    return m;
}

ReadSensor read_sensor(const Element& e, const Context& context) {
    const std::string type =
        type_of(e, {"orthographic", "perspective", "radiancemeter", "thinlens"}, "perspective", context.problems());
    const bool is_meter = type == "radiancemeter";
    Properties p(e, context.objects);
    ReadSensor s;
    s.camera = type == "orthographic" ? read_orthographic(p) : is_meter ? read_radiance_meter(p) : read_perspective(p, type);
    const std::vector<const Element*> films = p.nested("film"), samplers = p.nested("sampler");
    p.refuse_rest();
    Problems& problems = context.problems();
    const auto film = [&] {
        const Film read = films.empty() ? Film() : read_film(*films.front(), context);
        if (is_meter) check_film_of_meter(read, films.empty() ? e : *films.front());
        return read;
    };
    s.film = problems.attempt(e.place, film).value_or(Film());
    if (!samplers.empty()) s.sampler = problems.attempt(e.place, [&] { return read_sampler(*samplers.front(), context); });
    p.finish();
    return s;
}

SamplerKind read_sampler(const Element& e, const Context& context) {
    static const std::vector<std::string> types = {"independent", "ldsampler", "multijitter", "orthogonal", "stratified"};
    const std::string type = type_of(e, types, "independent", context.problems());
    Properties p(e, context.objects);
    // The command line decides about both.
    const std::int64_t count = p.integer("sample_count").value_or(1);
    if (count < 1) p.complain("sample_count", fmt::format("sample_count is {}, expected at least 1", count));
    p.integer("seed");
    if (type == "multijitter" || type == "stratified") p.boolean("jitter");
    if (type == "orthogonal") {
        p.boolean("jitter");
        p.integer("strength");
    }
    p.finish();
    // The other samplers are stratified, and an Owen-scrambled Sobol' sequence has the same stratification.
    return type == "independent" ? SamplerKind::independent : SamplerKind::sobol;
}

}  // namespace neumann::reader
