#include "core/reader/textures.h"

namespace neumann::reader {

SurfaceFunction read_color_texture(Properties& p, const std::string& name, double missing, Illuminant illuminant,
                                   const Context& context) {
    const Element* e = p.find(name, color_types);
    return e ? parse_color(p, name, *e, illuminant, context.warnings) : Rgb(missing);
}

SurfaceFunction read_number_texture(Properties& p, const std::string& name, double missing, const Context&) {
    return Rgb(p.number(name).value_or(missing));
}

}  // namespace neumann::reader
