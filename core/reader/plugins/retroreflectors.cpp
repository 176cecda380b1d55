#include "core/reader/plugins/retroreflectors.h"

#include "core/reader/plugins/textures.h"

#include <fmt/format.h>

namespace neumann::reader {

Bsdf read_retroreflector(const Element& e, const Context& context) {
    Properties p(e, context.objects);
    const SurfaceFunction reflectance = read_color_texture(p, "reflectance", 1.0, Illuminant::d65, context);
    const std::optional<double> alpha = p.number("alpha");
    if (alpha && *alpha < 1e-4) p.complain("alpha", fmt::format("alpha is {}, expected at least 0.0001, or none", *alpha));
    p.finish();
    if (alpha) return RoughRetroreflector(Ggx(*alpha), reflectance);
    return Retroreflector(reflectance);
}

}  // namespace neumann::reader
