#include "core/reader/plugins/light_images.h"

#include "core/image/bitmap.h"
#include "core/reader/plugins/textures.h"

#include <fmt/format.h>

#include <algorithm>

namespace neumann::reader {

Image read_light_image(const Attribute& filename, const Context& context) {
    Image image = Bitmap(read_texels(filename, context), Bitmap::Filter::nearest, Bitmap::Wrap::clamp, false).image();
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const Rgb& c = image.at(x, y);
            if (std::min({c.r, c.g, c.b}) < 0.0)
                throw InputError(filename.place,
                                 fmt::format("pixel ({}, {}) of '{}' is ({}, {}, {}), expected numbers that are not negative", x, y,
                                             filename.value, c.r, c.g, c.b));
        }
    return image;
}

std::optional<Slide> read_slide(Properties& p, const std::string& name, const Context& context) {
    for (const Element& child : p.element().children) {
        if (child.tag != "texture" && child.tag != "ref") continue;
        const Element* object = child.tag == "ref" ? context.objects.known(child) : &child;
        const Attribute* given = child.find("name");
        if (object && object->tag == "texture" && (!given || given->value != name))
            throw InputError(given ? given->place : child.place,
                             fmt::format("a <texture> of {} {}, expected the name '{}'", p.title(),
                                         given ? "is named '" + given->value + "'" : "has no name", name));
    }
    const Element* e = p.object(name, "texture");
    if (!e) return std::nullopt;
    for (const auto& [attribute, place] : mesh_attributes_of(*e, context.objects))
        throw InputError(place->place, fmt::format("the mesh attribute '{}' is thrown by a light, which has no mesh", attribute));
    const auto read = p.attempt(name, [&] { return read_not_negative(*e, name, Illuminant::equal_energy, context); });
    if (!read) return std::nullopt;
    const Texture& texture = *read;
    const auto at = [f = texture.value](const Vec2& uv) { return f(point_with_coordinates(uv)); };
    return Slide(at, texture.width, texture.height, texture.value.is_grey());
}

}  // namespace neumann::reader
