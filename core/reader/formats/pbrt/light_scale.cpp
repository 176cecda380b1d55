#include "core/reader/formats/pbrt/light_scale.h"

#include "core/image/display.h"

#include <algorithm>

#include <fmt/format.h>

namespace neumann::reader::pbrt {

double read_scale(Parameters& p) {
    const double scale = p.number("scale", 1.0);
    if (scale >= 0.0) return scale;
    p.complain("scale", fmt::format("scale of {} is {}, expected at least 0", p.title(), scale));
    return 1.0;
}

double read_positive(Parameters& p, const std::string& name) { return std::max(p.number(name, 0.0), 0.0); }

double mean_luminance(const Picture& picture, Importer& importer) {
    double sum = 0.0;
    const std::size_t count = for_each_texel(picture, importer, [&](const Rgb& c) { sum += luminance(c); });
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

}  // namespace neumann::reader::pbrt
