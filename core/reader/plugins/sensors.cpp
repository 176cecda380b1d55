#include "core/reader/plugins/sensors.h"

#include "core/base/frame.h"
#include "core/reader/xml/properties.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

const std::vector<std::string>& sensor_types() {
    static const std::vector<std::string> types = {"batch",        "distant",     "hemisphere",    "irradiancemeter",
                                                   "orthographic", "perspective", "radiancemeter", "thinlens"};
    return types;
}

// Reads "50mm" or "50".
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

SensorOptions read_hemisphere(Properties& p) {
    SensorOptions camera;
    camera.kind = SensorOptions::Kind::hemisphere;
    camera.to_world = read_rigid_transform(p);
    return camera;
}

// Reads `direction`, or the +z of `to_world`, at length 1. `beside` names parameters that may already have a problem with them.
Vec3 read_direction(Properties& p, const std::vector<std::string>& beside = {}) {
    const Element* to_world = p.find("to_world", {"transform"});
    const std::optional<Vec3> direction = p.point("direction");
    if (to_world && direction) p.complain("direction", "both direction and to_world are given, expected one of them", beside);
    const Vec3 along = direction.value_or(Vec3(p.transform("to_world")[2]));
    const double largest = max_component(glm::abs(along));
    if (largest == 0.0) p.complain("direction", "the direction is zero");
    return largest > 0.0 ? glm::normalize(along / largest) : Vec3(0.0, 0.0, 1.0);
}

// A radiance meter is the limit of a pinhole camera as its field of view tends to 0. A field of a millionth of a radian
// stands for it, which spreads the ray over a millionth of the distance.
SensorOptions read_radiance_meter(Properties& p) {
    p.find("to_world", {"transform"});
    const std::optional<Vec3> origin = p.point("origin"), direction = p.point("direction");
    if (origin.has_value() != direction.has_value())
        p.complain(origin ? "origin" : "direction",
                   fmt::format("{} is given without {}, expected both, or to_world", origin ? "origin" : "direction",
                               origin ? "direction" : "origin"),
                   {"origin", "direction"});
    const Frame frame(read_direction(p, {"origin"}));
    SensorOptions camera;
    camera.to_world = Mat4(glm::dvec4(frame.s, 0.0), glm::dvec4(frame.t, 0.0), glm::dvec4(frame.n, 0.0),
                           glm::dvec4(origin.value_or(Vec3(p.transform("to_world")[3])), 1.0));
    camera.fov = 1e-6;
    camera.near_clip = 1e-6;
    camera.far_clip = 1e12;
    return camera;
}

// Reads what a distant sensor aims at, if that is not all of the scene.
void read_target(Properties& p, SensorOptions& camera, const Context& context) {
    if (const Element* shape = p.object("target", "shape")) {
        const std::string& type = shape->attribute("type").value;
        if (type == "instance" || type == "merge" || type == "shapegroup") {
            p.complain("target", fmt::format("the target is a shape '{}', expected a single shape or a point", type));
            return;
        }
        if (std::optional<ReadShape> read = p.attempt("target", [&] { return read_shape(*shape, context); }))
            camera.target = std::make_shared<const Shape>(std::move(read->shape));
    } else if (const std::optional<Vec3> point = p.point("target")) {
        camera.target = *point;
    }
}

SensorOptions read_distant(Properties& p, const Context& context) {
    SensorOptions camera;
    camera.kind = SensorOptions::Kind::distant;
    camera.to_world[2] = glm::dvec4(read_direction(p), 0.0);
    read_target(p, camera, context);
    return camera;
}

// Reads a sensor without its film and sampler, and the sensors of a batch.
class SensorReader {
public:
    SensorReader(const Context& context, const std::vector<ReadShape>& shapes) : context_(context), shapes_(shapes) {}

    SensorOptions read(const Element& e, const std::string& type, Properties& p) {
        if (type == "irradiancemeter") return read_irradiance_meter(e);
        if (is_on_shape(e))
            throw InputError(e.place, fmt::format("sensor '{}' stands in a shape, expected 'irradiancemeter' there", type));
        if (type == "batch") return read_batch(p);
        if (type == "distant") return read_distant(p, context_);
        if (type == "orthographic") return read_orthographic(p);
        if (type == "hemisphere") return read_hemisphere(p);
        return type == "radiancemeter" ? read_radiance_meter(p) : read_perspective(p, type);
    }
    std::string type(const Element& e) const {
        return type_of(e, sensor_types(), is_on_shape(e) ? "irradiancemeter" : "perspective", context_.problems());
    }
    std::set<const Element*> take_meters() { return std::move(meters_); }

private:
    bool is_on_shape(const Element& sensor) const {
        return std::ranges::any_of(shapes_, [&](const ReadShape& shape) { return shape.sensor == &sensor; });
    }

    SensorOptions read_irradiance_meter(const Element& e) {
        std::vector<std::uint32_t> on;
        for (std::uint32_t i = 0; i < shapes_.size(); ++i)
            if (shapes_[i].sensor == &e) on.push_back(i);
        if (on.size() != 1)
            throw InputError(e.place,
                             fmt::format("sensor 'irradiancemeter' stands in {} of the scene, expected the one on which it "
                                         "measures",
                                         on.empty() ? "no shape" : "several shapes"));
        meters_.insert(&e);
        SensorOptions meter;
        meter.kind = SensorOptions::Kind::irradiance_meter;
        meter.shape = on.front();
        return meter;
    }

    // The sensors inside have the film and the sampler of the batch, whatever they say.
    SensorOptions read_batch(Properties& p) {
        SensorOptions batch;
        batch.kind = SensorOptions::Kind::batch;
        const std::vector<const Element*> inside = p.all_nested({"sensor", "shape"});
        if (inside.empty()) p.fail_empty("sensor 'batch' has no <sensor> inside, expected at least one");
        for (const Element* e : inside)
            if (auto sensor = p.attempt("sensor", [&] { return read_part(*e, p); })) batch.sensors.push_back(std::move(*sensor));
        if (batch.sensors.size() < inside.size()) batch.sensors.clear();
        return batch;
    }
    SensorOptions read_part(const Element& e, const Properties& batch) {
        const Element& sensor = e.tag == "shape" ? sensor_of(e, batch) : e;
        const std::string kind = type(sensor);
        if (kind == "batch") throw InputError(sensor.place, "sensor 'batch' stands inside another one");
        Properties p(sensor, context_.objects);
        SensorOptions options = read(sensor, kind, p);
        for (const Element* film : p.nested("film")) read_film(*film, context_);
        for (const Element* sampler : p.nested("sampler")) read_sampler(*sampler, context_);
        p.finish();
        return options;
    }
    const Element& sensor_of(const Element& shape, const Properties& batch) const {
        for (const ReadShape& s : shapes_)
            if (s.element == &shape && s.sensor) return *s.sensor;
        if (context_.problems().any()) throw AlreadyReported();
        throw InputError(batch.element().place,
                         fmt::format("the shape at {} in sensor 'batch' has no sensor or is not in the scene, expected a reference "
                                     "to one with an 'irradiancemeter'",
                                     to_string(shape.place)));
    }

    const Context& context_;
    const std::vector<ReadShape>& shapes_;
    std::set<const Element*> meters_;
};

void check_film(const Film& film, const SensorOptions& camera, const std::string& type, const Element& e) {
    if ((type == "radiancemeter" || type == "distant") && (film.width != 1 || film.height != 1))
        throw InputError(e.place,
                         fmt::format("the film of sensor '{}' has {}×{} pixels, expected 1×1", type, film.width, film.height));
    if (type == "hemisphere" && film.width != film.height)
        throw InputError(e.place, fmt::format("the film of sensor 'hemisphere' has {}×{} pixels, expected as many across as down",
                                              film.width, film.height));
    if (type != "batch" || camera.sensors.empty()) return;
    const std::size_t count = camera.sensors.size();
    if (static_cast<std::size_t>(film.width) % count != 0)
        throw InputError(e.place,
                         fmt::format("the film of sensor 'batch' is {} pixels wide, expected a multiple of {}, the number of "
                                     "its sensors",
                                     film.width, count));
    const bool some_even = std::ranges::any_of(camera.sensors, &SensorOptions::is_even);
    if (some_even && !std::holds_alternative<BoxFilter>(film.filter))
        throw InputError(e.place,
                         "the film of a sensor 'batch' with an 'irradiancemeter' or 'distant' inside has another filter than "
                         "'box', expected that");
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
    // The focal length is for 35 mm film, 36 mm × 24 mm.
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

ReadSensor read_sensor(const Element& e, const Context& context, const std::vector<ReadShape>& shapes) {
    SensorReader reader(context, shapes);
    const std::string type = reader.type(e);
    Properties p(e, context.objects);
    ReadSensor s;
    s.camera = reader.read(e, type, p);
    s.meters = reader.take_meters();
    const std::vector<const Element*> films = p.nested("film"), samplers = p.nested("sampler");
    p.refuse_rest();
    Problems& problems = context.problems();
    const auto film = [&] {
        const Film read = films.empty() ? Film() : read_film(*films.front(), context);
        check_film(read, s.camera, type, films.empty() ? e : *films.front());
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
    // The command line decides about the number of samples and the seed.
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
