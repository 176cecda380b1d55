#include "core/reader/sensor.h"

#include "core/reader/properties.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

// "50mm" or "50".
double parse_focal_length(const Properties& p, std::string text) {
    const std::string whole = text;
    if (text.ends_with("mm")) text.resize(text.size() - 2);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(value > 0.0) || !std::isfinite(value))
        p.fail("focal_length", fmt::format("focal_length is '{}', expected a positive number and mm, such as 50mm", whole));
    return value;
}

void read_fov(Properties& p, Perspective::Options& camera) {
    using Axis = Perspective::FovAxis;
    static const std::map<std::string, Axis> axes = {
        {"x", Axis::x}, {"y", Axis::y}, {"diagonal", Axis::diagonal}, {"smaller", Axis::smaller}, {"larger", Axis::larger}};
    const std::string axis = p.choice("fov_axis", {"x", "y", "diagonal", "smaller", "larger"}, "x");
    const std::optional<double> fov = p.number("fov");
    const std::optional<std::string> focal_length = p.text("focal_length");
    if (fov && focal_length) p.fail("focal_length", "both fov and focal_length are given, expected one of them");
    if (!fov && !focal_length)
        throw InputError(p.element().place, fmt::format("{} lacks the parameter 'fov', expected float", p.title()));
    if (fov) {
        if (!(*fov > 0.0 && *fov < 180.0))
            p.fail("fov", fmt::format("fov is {}, expected more than 0 and less than 180 degrees", *fov));
        camera.fov = glm::radians(*fov);
        camera.fov_axis = axes.at(axis);
    } else {
        // Of 35 mm film, 36 mm × 24 mm.
        camera.fov = 2.0 * std::atan(0.5 * std::hypot(36.0, 24.0) / parse_focal_length(p, *focal_length));
        camera.fov_axis = Axis::diagonal;
    }
}

Mat4 read_camera_to_world(Properties& p) {
    const Mat4 m = p.transform("to_world");
    constexpr double tolerance = 1e-3;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j <= i; ++j)
            if (std::abs(glm::dot(Vec3(m[i]), Vec3(m[j])) - (i == j ? 1.0 : 0.0)) > tolerance)
                p.fail("to_world", fmt::format("to_world of {} scales or shears, expected rotations and translations", p.title()));
    return m;
}

}  // namespace

Sensor read_sensor(const Element& e, const Context& context) {
    if (e.attribute("type").value != "perspective") fail_type(e, {"perspective"});
    Properties p(e, context.objects);
    Sensor s;
    s.camera.to_world = read_camera_to_world(p);
    read_fov(p, s.camera);
    s.camera.near_clip = p.number("near_clip").value_or(1e-2);
    s.camera.far_clip = p.number("far_clip").value_or(1e4);
    if (s.camera.near_clip <= 0.0) p.fail("near_clip", fmt::format("near_clip is {}, expected more than 0", s.camera.near_clip));
    if (s.camera.far_clip <= s.camera.near_clip)
        p.fail("far_clip", fmt::format("far_clip is {}, expected more than near_clip, {}", s.camera.far_clip, s.camera.near_clip));
    p.number("focus_distance");  // a pinhole is sharp everywhere
    s.camera.principal_point_offset = {p.number("principal_point_offset_x").value_or(0.0),
                                       p.number("principal_point_offset_y").value_or(0.0)};
    const std::vector<const Element*> films = p.nested("film"), samplers = p.nested("sampler");
    p.finish();
    if (!films.empty()) s.film = read_film(*films.front(), context);
    if (!samplers.empty()) s.sampler = read_sampler(*samplers.front(), context);
    return s;
}

SamplerKind read_sampler(const Element& e, const Context& context) {
    static const std::vector<std::string> types = {"independent", "ldsampler", "multijitter", "orthogonal", "stratified"};
    const std::string& type = e.attribute("type").value;
    if (std::find(types.begin(), types.end(), type) == types.end()) fail_type(e, types);
    Properties p(e, context.objects);
    // Both are the command line's to decide.
    const std::int64_t count = p.integer("sample_count").value_or(1);
    if (count < 1) p.fail("sample_count", fmt::format("sample_count is {}, expected at least 1", count));
    p.integer("seed");
    if (type == "multijitter" || type == "stratified") p.boolean("jitter");
    if (type == "orthogonal") {
        p.boolean("jitter");
        p.integer("strength");
    }
    p.finish();
    // The others are stratified in ways that an Owen-scrambled Sobol' sequence contains.
    return type == "independent" ? SamplerKind::independent : SamplerKind::sobol;
}

}  // namespace neumann::reader
