#include "core/reader/formats/pbrt/sensor.h"

#include "core/base/did_you_mean.h"
#include "core/reader/formats/make_elements.h"
#include "core/reader/formats/pbrt/rigid.h"
#include "core/reader/meshes/mesh_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

namespace neumann::reader::pbrt {

namespace {

// pbrt clips nothing. These depths are far enough, and near enough to keep numbers exact.
constexpr double nearest_depth = 1e-4, farthest_depth = 1e7;

struct Screen {
    double x0, x1, y0, y1;
    bool is_given;
};

// What the film sees, −1 … 1 along the shorter side. The unit is the half angle of view, or that of the scene for an
// orthographic camera.
Screen read_screen(Parameters& p, int width, int height) {
    const double pixels = static_cast<double>(width) / height, aspect = p.number("frameaspectratio", pixels);
    if (!(aspect > 0.0))
        p.complain("frameaspectratio", fmt::format("frameaspectratio of {} is {}, expected more than 0", p.title(), aspect));
    const std::vector<double> window = p.numbers("screenwindow", 4);
    Screen s = aspect > 1.0 ? Screen{-aspect, aspect, -1.0, 1.0, false} : Screen{-1.0, 1.0, -1.0 / aspect, 1.0 / aspect, false};
    if (!window.empty()) s = {window[0], window[1], window[2], window[3], true};
    const std::string name = window.empty() ? "frameaspectratio" : "screenwindow";
    if (p.is_wrong()) return {-1.0, 1.0, -1.0, 1.0, false};
    const double across = s.x1 - s.x0, down = s.y1 - s.y0;
    if (!(across > 0.0 && down > 0.0))
        p.complain(name, fmt::format("{} of {} is empty, expected x0 x1 y0 y1 with x0 < x1 and y0 < y1", name, p.title()));
    else if (std::abs(across / down / pixels - 1.0) > 1e-3)
        p.complain(name, fmt::format("{} of {} makes pixels that are not square: its aspect ratio is {}, that of the film is {}",
                                     name, p.title(), across / down, pixels));
    return s;
}

// The map to the world from a camera with +x to the left, as Mitsuba has it.
Rigid to_world_of(const Entity& e) {
    const Mat4 mirror = glm::scale(Mat4(1.0), Vec3(-1.0, 1.0, 1.0));
    return without_scale(glm::inverse(e.to_world) * mirror);
}

void add_clipping(Element& sensor, const Location& place) {
    add_float(sensor, "near_clip", nearest_depth, place);
    add_float(sensor, "far_clip", farthest_depth, place);
}

Element make_perspective(Entity& e, const Screen& screen, Importer&) {
    Parameters& p = e.parameters;
    const double fov = p.number("fov", 90.0), radius = p.number("lensradius", 0.0), distance = p.number("focaldistance", 1e6);
    if (!(fov > 0.0 && fov < 180.0))
        p.complain("fov", fmt::format("fov of {} is {}, expected more than 0 and less than 180 degrees", p.title(), fov));
    if (radius < 0.0) p.complain("lensradius", fmt::format("lensradius of {} is {}, expected at least 0", p.title(), radius));
    if (!(distance > 0.0))
        p.complain("focaldistance", fmt::format("focaldistance of {} is {}, expected more than 0", p.title(), distance));
    const double x = 0.5 * (screen.x0 + screen.x1), y = 0.5 * (screen.y0 + screen.y1);
    const bool is_off_centre = std::abs(x) > 1e-9 || std::abs(y) > 1e-9;
    if (is_off_centre && radius > 0.0)
        p.complain("screenwindow",
                   fmt::format("screenwindow of {}, which has a lens, is off the centre, which is not supported", p.title()));

    const Rigid to_world = to_world_of(e);
    Element sensor = make_object("sensor", radius > 0.0 ? "thinlens" : "perspective", e.place());
    add_matrix(sensor, "to_world", to_world.matrix, e.place());
    const double across = screen.x1 - screen.x0, down = screen.y1 - screen.y0;
    if (screen.is_given) {
        const double half_width = 0.5 * across * std::tan(0.5 * glm::radians(fov));
        add_float(sensor, "fov", glm::degrees(2.0 * std::atan(half_width)), p.place("fov"));
        add_string(sensor, "fov_axis", "x", p.place("screenwindow"));
    } else {
        add_float(sensor, "fov", fov, p.place("fov"));
        add_string(sensor, "fov_axis", "smaller", p.place("fov"));
    }
    if (is_off_centre) {
        add_float(sensor, "principal_point_offset_x", -x / across, p.place("screenwindow"));
        add_float(sensor, "principal_point_offset_y", y / down, p.place("screenwindow"));
    }
    if (radius > 0.0) {
        add_float(sensor, "aperture_radius", radius * to_world.scale, p.place("lensradius"));
        add_float(sensor, "focus_distance", distance * to_world.scale, p.place("focaldistance"));
    }
    return sensor;
}

Element make_orthographic(Entity& e, const Screen& screen, Importer&) {
    Parameters& p = e.parameters;
    if (p.number("lensradius", 0.0) != 0.0)
        p.refuse("lensradius", fmt::format("lensradius of {} is not supported", p.title()), ": parallel rays are sharp everywhere");
    p.number("focaldistance");
    Element sensor = make_object("sensor", "orthographic", e.place());
    // The film covers −1 … 1 along x.
    const double half = 0.5 * (screen.x1 - screen.x0);
    const Vec3 centre(-0.5 * (screen.x0 + screen.x1), 0.5 * (screen.y0 + screen.y1), 0.0);
    const Mat4 mirror = glm::scale(Mat4(1.0), Vec3(-1.0, 1.0, 1.0));
    const Mat4 to_world = glm::inverse(e.to_world) * mirror * glm::scale(glm::translate(Mat4(1.0), centre), Vec3(half, half, 1.0));
    add_matrix(sensor, "to_world", to_world, e.place());
    return sensor;
}

// The time for which the shutter is open is a factor of the imaging ratio.
void read_shutter(Parameters& p, Importer& importer) {
    const double open = p.number("shutteropen", 0.0), close = p.number("shutterclose", 1.0);
    if (close > open)
        importer.imaging_ratio *= close - open;
    else
        p.complain("shutterclose",
                   fmt::format("shutterclose of {} is {}, expected more than shutteropen, {}", p.title(), close, open));
}

Element make_sampler(PbrtScene& from, Element& scene, Importer& importer) {
    if (!from.sampler) from.sampler = missing_entity("sampler", "zsobol", from, importer);
    Entity& e = *from.sampler;
    Parameters& p = e.parameters;
    static const std::vector<std::string> types = {"halton", "independent", "paddedsobol", "pmj02bn",
                                                   "sobol",  "stratified",  "zsobol"};
    if (std::find(types.begin(), types.end(), e.type) == types.end())
        importer.problems.replace(Unknown(e.place(), fmt::format("sampler type '{}' is not supported", printable(e.type)),
                                          "; " + allowed_instead(e.type, types), "taken as 'zsobol'"),
                                  e.place());
    std::int64_t count = 0;
    Location place = e.place();
    if (e.type == "stratified") {
        count = p.integer("xsamples").value_or(4) * p.integer("ysamples").value_or(4);
        p.ignore({"jitter"});
    } else {
        count = p.integer("pixelsamples").value_or(16);
        place = p.place("pixelsamples");
    }
    if (count < 1) p.complain("pixelsamples", fmt::format("{} takes {} samples of a pixel, expected at least 1", p.title(), count));
    p.ignore({"seed", "randomization"});
    p.finish();
    if (p.is_wrong()) throw AlreadyReported();
    Element sampler = make_object("sampler", e.type == "independent" ? "independent" : "multijitter", e.place());
    add_defined(scene, sampler, "integer", "sample_count", "spp", std::to_string(count), place);
    return sampler;
}

}  // namespace

Entity missing_entity(const std::string& noun, const std::string& type, const PbrtScene& from, Importer& importer) {
    return {type, Parameters(fmt::format("{} '{}'", noun, type), from.start, importer.problems)};
}

Element make_sensor(PbrtScene& from, Element& scene, Importer& importer) {
    if (!from.camera) from.camera = missing_entity("camera", "perspective", from, importer);
    Entity& e = *from.camera;
    Parameters& p = e.parameters;
    MadeFilm film = make_film(from, scene, importer);
    std::optional<Element> sensor = importer.problems.attempt(e.place(), [&] {
        if (e.type != "perspective" && e.type != "orthographic") {
            static const std::vector<std::string> types = {"orthographic", "perspective"};
            importer.problems.replace(Unknown(e.place(), fmt::format("camera type '{}' is not supported", printable(e.type)),
                                              "; " + allowed_instead(e.type, types), "taken as 'perspective'"),
                                      e.place());
        }
        read_shutter(p, importer);
        const Screen screen = read_screen(p, film.width, film.height);
        Element made = e.type == "orthographic" ? make_orthographic(e, screen, importer) : make_perspective(e, screen, importer);
        add_clipping(made, e.place());
        p.finish();
        if (p.is_wrong()) throw AlreadyReported();
        return made;
    });
    if (!sensor) sensor = make_object("sensor", "perspective", e.place());  // unused, because there is a problem
    add(*sensor, std::move(film.element));
    const auto sampler = importer.problems.attempt(from.start, [&] { return make_sampler(from, scene, importer); });
    if (sampler) add(*sensor, *sampler);
    return std::move(*sensor);
}

}  // namespace neumann::reader::pbrt
