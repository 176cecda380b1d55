#include "core/reader/plugins/sensors.h"
#include "core/reader/xml/properties.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

constexpr int max_size = 65536, max_lobes = 64;

int read_size(Properties& p, const std::string& name, int missing) {
    const std::int64_t value = p.integer(name).value_or(missing);
    if (value < 1) p.complain(name, fmt::format("film {} is {}, expected at least 1", name, value));
    if (value > max_size) p.complain(name, fmt::format("film {} is {}, expected at most {}", name, value, max_size));
    return static_cast<int>(std::clamp<std::int64_t>(value, 1, max_size));
}

int read_offset(Properties& p, const std::string& name, int size, const std::string& size_name) {
    const std::int64_t value = p.integer(name).value_or(0);
    if (value >= 0 && value < size) return static_cast<int>(value);
    p.complain(name, fmt::format("film {} is {}, expected at least 0 and less than the {}, {}", name, value, size_name, size),
               {size_name});
    return 0;
}

int read_crop(Properties& p, const std::string& name, int rest, const std::vector<std::string>& beside) {
    const int value = read_size(p, name, rest);
    if (value > rest)
        p.complain(name, fmt::format("film {} is {}, but only {} pixels are left after the offset", name, value, rest), beside);
    return value;
}

double read_width(Properties& p, const std::string& name, double missing) {
    const double value = p.number(name).value_or(missing);
    if (value > 0.0) return value;
    p.complain(name, fmt::format("{} is {}, expected more than 0", name, value));
    return missing;
}

// Values are limited to the range of Mitchell and Netravali. Far outside of it, a filter that is cut off at the film's
// edge may have the integral 0.
double read_mitchell_parameter(Properties& p, const std::string& name) {
    const double value = p.number(name).value_or(1.0 / 3.0);
    if (value < 0.0 || value > 1.0) p.complain(name, fmt::format("{} is {}, expected from 0 to 1", name, value));
    return std::clamp(value, 0.0, 1.0);
}

PixelFilter read_filter_type(const std::string& type, Properties& p) {
    if (type == "box") return BoxFilter();
    if (type == "tent") return TentFilter(read_width(p, "radius", 1.0));
    if (type == "gaussian") return GaussianFilter(read_width(p, "stddev", 0.5));
    if (type == "catmullrom") return SignedFilter::catmull_rom();
    if (type == "lanczos") {
        const std::int64_t lobes = p.integer("lobes").value_or(3);
        if (lobes < 1 || lobes > max_lobes)
            p.complain("lobes", fmt::format("lobes is {}, expected from 1 to {}", lobes, max_lobes));
        return SignedFilter::lanczos(static_cast<int>(std::clamp<std::int64_t>(lobes, 1, max_lobes)));
    }
    const double b = read_mitchell_parameter(p, "B");
    return SignedFilter::mitchell(b, read_mitchell_parameter(p, "C"));
}

}  // namespace

Film read_film(const Element& e, const Context& context) {
    const bool is_known = e.attribute("type").value == "hdrfilm";
    type_of(e, {"hdrfilm"}, "hdrfilm", context.problems());
    Properties p(e, context.objects);
    Film film;
    film.width = read_size(p, "width", 768);
    film.height = read_size(p, "height", 576);
    film.crop_x = read_offset(p, "crop_offset_x", film.width, "width");
    film.crop_y = read_offset(p, "crop_offset_y", film.height, "height");
    film.crop_width = read_crop(p, "crop_width", film.width - film.crop_x, {"width", "crop_offset_x"});
    film.crop_height = read_crop(p, "crop_height", film.height - film.crop_y, {"height", "crop_offset_y"});
    // Pictures are always written as OpenEXR, float32 and RGB.
    p.choice("file_format", {"exr", "openexr"}, "openexr");
    p.choice("pixel_format", {"rgb", "rgba"}, "rgb");
    p.choice("component_format", {"float16", "float32", "uint32"}, "float16");
    p.boolean("banner");
    p.boolean("compensate");
    film.sample_border = p.boolean("sample_border").value_or(false);
    // A film of an unknown type may have as many filters as it has pictures.
    const std::vector<const Element*> filters = p.nested("rfilter", is_known ? 1 : std::numeric_limits<std::size_t>::max());
    for (std::size_t i = 1; i < filters.size(); ++i)
        context.problems().replace(Unknown(filters[i]->place, fmt::format("another <rfilter> in {}", p.title()), "", "ignored"),
                                   e.place);
    p.refuse_rest();
    if (!filters.empty())
        if (const auto filter = context.problems().attempt(e.place, [&] { return read_filter(*filters.front(), context); }))
            film.filter = *filter;
    p.finish();
    return film;
}

PixelFilter read_filter(const Element& e, const Context& context) {
    static const std::vector<std::string> types = {"box", "catmullrom", "gaussian", "lanczos", "mitchell", "tent"};
    const std::string type = type_of(e, types, "gaussian", context.problems());
    Properties p(e, context.objects);
    const PixelFilter filter = read_filter_type(type, p);
    p.finish();
    return filter;
}

}  // namespace neumann::reader
