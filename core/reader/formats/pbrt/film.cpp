#include "core/reader/formats/film.h"
#include "core/base/did_you_mean.h"
#include "core/reader/formats/make_elements.h"
#include "core/reader/formats/pbrt/sensor.h"
#include "core/reader/meshes/mesh_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace neumann::reader::pbrt {

namespace {

constexpr int max_film_size = 65536;

int read_resolution(Parameters& p, const std::string& name, int missing) {
    const std::int64_t value = p.integer(name).value_or(missing);
    if (value >= 1 && value <= max_film_size) return static_cast<int>(value);
    p.complain(name, fmt::format("{} of {} is {}, expected from 1 to {}", name, p.title(), value, max_film_size));
    return missing;
}

struct Crop {
    int x0, x1, y0, y1;
};

// Reads `cropwindow`, in fractions of the film, or `pixelbounds`; pbrt's order is x0 x1 y0 y1.
std::optional<Crop> read_film_crop(Parameters& p, int width, int height) {
    const std::vector<double> window = p.numbers("cropwindow", 4);
    const std::vector<std::int64_t> bounds = p.integers("pixelbounds");
    if (!bounds.empty() && bounds.size() != 4)
        p.complain("pixelbounds", fmt::format("pixelbounds of {} has {} values, expected 4", p.title(), bounds.size()));
    if (!window.empty() && !bounds.empty())
        p.complain("pixelbounds", fmt::format("{} has cropwindow and pixelbounds, expected one of them", p.title()));
    if (p.is_wrong() || (window.empty() && bounds.empty())) return std::nullopt;
    double v[4];
    for (std::size_t i = 0; i < 4; ++i) {
        const double size = i < 2 ? width : height;
        v[i] = std::clamp(window.empty() ? static_cast<double>(bounds[i]) : std::ceil(window[i] * size), 0.0, size);
    }
    const Crop crop{static_cast<int>(v[0]), static_cast<int>(v[1]), static_cast<int>(v[2]), static_cast<int>(v[3])};
    if (crop.x0 < crop.x1 && crop.y0 < crop.y1) return crop;
    const std::string name = window.empty() ? "pixelbounds" : "cropwindow";
    p.complain(name, fmt::format("{} of {} leaves no pixel", name, p.title()));
    return std::nullopt;
}

// Reads what a film does to colours.
void read_pixel_sensor(Parameters& p, Importer& importer) {
    const double iso = p.number("iso", 100.0);
    if (!(iso > 0.0)) p.complain("iso", fmt::format("iso of {} is {}, expected more than 0", p.title(), iso));
    importer.imaging_ratio *= iso / 100.0;
    if (const std::string sensor = p.text("sensor").value_or("cie1931"); sensor != "cie1931")
        importer.warnings.add("film with the sensor of a camera: colours are those of the sensor 'cie1931'");
    if (p.number("whitebalance", 0.0) != 0.0) importer.warnings.add("whitebalance of the film is left out");
    if (p.number("maxcomponentvalue").has_value())
        importer.warnings.add("maxcomponentvalue of the film is left out: no sample is cut off");
}

double read_filter_radius(Parameters& p, double missing, Importer& importer) {
    const double x = p.number("xradius", missing), y = p.number("yradius", missing);
    for (const auto& [name, value] : {std::pair("xradius", x), std::pair("yradius", y)})
        if (!(value > 0.0)) p.complain(name, fmt::format("{} of {} is {}, expected more than 0", name, p.title(), value));
    if (x != y) importer.warnings.add("pixel filter with xradius and yradius that differ: their mean is taken");
    return 0.5 * (x + y);
}

void warn_of_radius(const std::string& type, double given, double own, Importer& importer) {
    if (std::abs(given - own) > 1e-6)
        importer.warnings.add(fmt::format("pixel filter '{}' of radius {}: its radius is {} here", type, given, own));
}

}  // namespace

MadeFilm make_film(PbrtScene& from, Element& scene, Importer& importer) {
    if (!from.film) from.film = missing_entity("film", "rgb", from, importer);
    Entity& e = *from.film;
    Parameters& p = e.parameters;
    MadeFilm film{make_object("film", "hdrfilm", e.place()), 1280, 720};
    importer.problems.attempt(e.place(), [&] {
        if (e.type != "rgb" && e.type != "gbuffer") {
            static const std::vector<std::string> types = {"gbuffer", "rgb"};
            importer.problems.replace(Unknown(e.place(), fmt::format("film type '{}' is not supported", printable(e.type)),
                                              "; " + allowed_instead(e.type, types), "taken as 'rgb'"),
                                      e.place());
        }
        film.width = read_resolution(p, "xresolution", film.width);
        film.height = read_resolution(p, "yresolution", film.height);
        const std::optional<Crop> crop = read_film_crop(p, film.width, film.height);
        read_pixel_sensor(p, importer);
        // These say where and how pbrt writes the picture, and how large the film is in a camera of lenses.
        p.ignore({"filename", "savefp16", "diagonal", "coordinatesystem"});
        p.finish();
        add_film_size(
            scene, film.element,
            {static_cast<double>(film.width), static_cast<double>(film.height), p.place("xresolution"), p.place("yresolution")},
            importer.definitions);
        if (crop) {
            const Location& place = p.place(p.has("cropwindow") ? "cropwindow" : "pixelbounds");
            add_integer(film.element, "crop_offset_x", crop->x0, place);
            add_integer(film.element, "crop_offset_y", crop->y0, place);
            add_integer(film.element, "crop_width", crop->x1 - crop->x0, place);
            add_integer(film.element, "crop_height", crop->y1 - crop->y0, place);
        }
    });
    if (!from.filter) from.filter = missing_entity("pixel filter", "gaussian", from, importer);
    if (auto filter = importer.problems.attempt(from.filter->place(), [&] { return make_filter(*from.filter, importer); }))
        add(film.element, std::move(*filter));
    return film;
}

Element make_filter(Entity& e, Importer& importer) {
    Parameters& p = e.parameters;
    const auto finished = [&](Element filter) {
        p.finish();
        if (p.is_wrong()) throw AlreadyReported();
        return filter;
    };
    if (e.type == "box") {
        warn_of_radius("box", read_filter_radius(p, 0.5, importer), 0.5, importer);
        return finished(make_object("rfilter", "box", e.place()));
    }
    if (e.type == "triangle") {
        Element filter = make_object("rfilter", "tent", e.place());
        add_float(filter, "radius", read_filter_radius(p, 2.0, importer), p.place("xradius"));
        return finished(std::move(filter));
    }
    if (e.type == "mitchell") {
        warn_of_radius("mitchell", read_filter_radius(p, 2.0, importer), 2.0, importer);
        Element filter = make_object("rfilter", "mitchell", e.place());
        for (const char* name : {"B", "C"}) add_float(filter, name, p.number(name, 1.0 / 3.0), p.place(name));
        return finished(std::move(filter));
    }
    if (e.type == "sinc") {
        const double radius = read_filter_radius(p, 4.0, importer), tau = p.number("tau", 3.0);
        const double lobes = std::clamp(std::round(tau), 1.0, 64.0);
        if (std::abs(lobes - tau) > 1e-6)
            importer.warnings.add(fmt::format("pixel filter 'sinc' with tau {}: it is {} here", tau, lobes));
        warn_of_radius("sinc", radius, lobes, importer);
        Element filter = make_object("rfilter", "lanczos", e.place());
        add_integer(filter, "lobes", static_cast<std::int64_t>(lobes), p.place("tau"));
        return finished(std::move(filter));
    }
    static const std::vector<std::string> types = {"box", "gaussian", "mitchell", "sinc", "triangle"};
    if (e.type != "gaussian")
        importer.problems.replace(Unknown(e.place(), fmt::format("pixel filter type '{}' is not supported", printable(e.type)),
                                          "; " + allowed_instead(e.type, types), "taken as 'gaussian'"),
                                  e.place());
    const double radius = read_filter_radius(p, 1.5, importer), sigma = p.number("sigma", 0.5);
    if (!(sigma > 0.0)) p.complain("sigma", fmt::format("sigma of {} is {}, expected more than 0", p.title(), sigma));
    // Only a 370th of the filter lies beyond 3 σ.
    if (radius < 3.0 * sigma * (1.0 - 1e-6)) warn_of_radius("gaussian", radius, 4.0 * sigma, importer);
    Element filter = make_object("rfilter", "gaussian", e.place());
    add_float(filter, "stddev", sigma, p.place("sigma"));
    return finished(std::move(filter));
}

}  // namespace neumann::reader::pbrt
