#include "core/reader/properties.h"
#include "core/reader/sensor.h"

#include <fmt/format.h>

namespace neumann::reader {

namespace {

constexpr int max_size = 65536;

int read_size(Properties& p, const std::string& name, int missing) {
    const std::int64_t value = p.integer(name).value_or(missing);
    if (value < 1) p.fail(name, fmt::format("film {} is {}, expected at least 1", name, value));
    if (value > max_size) p.fail(name, fmt::format("film {} is {}, expected at most {}", name, value, max_size));
    return static_cast<int>(value);
}

int read_offset(Properties& p, const std::string& name, int size, const std::string& size_name) {
    const std::int64_t value = p.integer(name).value_or(0);
    if (value < 0 || value >= size)
        p.fail(name, fmt::format("film {} is {}, expected at least 0 and less than the {}, {}", name, value, size_name, size));
    return static_cast<int>(value);
}

int read_crop(Properties& p, const std::string& name, int rest) {
    const int value = read_size(p, name, rest);
    if (value > rest) p.fail(name, fmt::format("film {} is {}, but only {} pixels are left after the offset", name, value, rest));
    return value;
}

}  // namespace

Film read_film(const Element& e, const Context& context) {
    if (e.attribute("type").value != "hdrfilm") fail_type(e, {"hdrfilm"});
    Properties p(e, context.objects);
    Film film;
    film.width = read_size(p, "width", 768);
    film.height = read_size(p, "height", 576);
    film.crop_x = read_offset(p, "crop_offset_x", film.width, "width");
    film.crop_y = read_offset(p, "crop_offset_y", film.height, "height");
    film.crop_width = read_crop(p, "crop_width", film.width - film.crop_x);
    film.crop_height = read_crop(p, "crop_height", film.height - film.crop_y);
    // Pictures are written as OpenEXR, float32 and RGB.
    p.choice("file_format", {"openexr"}, "openexr");
    p.choice("pixel_format", {"rgb", "rgba"}, "rgb");
    p.choice("component_format", {"float16", "float32", "uint32"}, "float16");
    p.boolean("banner");
    p.boolean("compensate");
    if (p.boolean("sample_border").value_or(false))
        p.fail("sample_border", "sample_border is true, which is not supported; allowed: false");
    const std::vector<const Element*> filters = p.nested("rfilter");
    p.finish();
    if (!filters.empty()) film.filter = read_filter(*filters.front(), context);
    return film;
}

PixelFilter read_filter(const Element& e, const Context& context) {
    const std::string& type = e.attribute("type").value;
    if (type != "box" && type != "gaussian") fail_type(e, {"box", "gaussian"});
    Properties p(e, context.objects);
    PixelFilter filter = BoxFilter();
    if (type == "gaussian") {
        const double stddev = p.number("stddev").value_or(0.5);
        if (stddev <= 0.0) p.fail("stddev", fmt::format("stddev is {}, expected more than 0", stddev));
        filter = GaussianFilter(stddev);
    }
    p.finish();
    return filter;
}

}  // namespace neumann::reader
