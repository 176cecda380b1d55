#include "core/reader/light_images.h"

#include "core/image/image_io.h"

#include <fmt/format.h>
#include <algorithm>

namespace neumann::reader {

Slide read_bitmap(const Element& e, const Context& context) {
    static const std::map<std::string, Slide::Wrap> wraps = {
        {"repeat", Slide::Wrap::repeat}, {"mirror", Slide::Wrap::mirror}, {"clamp", Slide::Wrap::clamp}};
    if (e.attribute("type").value != "bitmap") fail_type(e, {"bitmap"});
    Properties p(e, context.objects);
    const Attribute& filename = p.require("filename", {"string"}).attribute("value");
    const std::string filter = p.choice("filter_type", {"bilinear", "nearest"}, "bilinear");
    const std::string wrap = p.choice("wrap_mode", {"repeat", "mirror", "clamp"}, "repeat");
    const bool raw = p.boolean("raw").value_or(false);
    // How Mitsuba stores it.
    p.choice("format", {"auto", "variant", "fp16"}, "auto");
    p.boolean("accel");
    p.finish();
    return Slide(read_light_image(filename, raw, context), filter == "bilinear", wraps.at(wrap));
}

Image read_light_image(const Attribute& filename, bool raw, const Context& context) {
    const std::string path = context.document.find_file(filename);
    context.mesh_files.push_back(path);
    Image image = neumann::read_light_image(path, raw);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const Rgb& c = image.at(x, y);
            if (!is_finite(c) || std::min({c.r, c.g, c.b}) < 0.0)
                throw InputError(
                    filename.place,
                    fmt::format("pixel ({}, {}) of '{}' is ({}, {}, {}), expected finite numbers that are not negative", x, y,
                                filename.value, c.r, c.g, c.b));
        }
    return image;
}

std::optional<Slide> read_slide(Properties& p, const std::string& name, const Context& context) {
    for (const Element& child : p.element().children) {
        if (child.tag != "texture" && child.tag != "ref") continue;
        const Element& object = child.tag == "ref" ? context.objects.find(child.attribute("id")) : child;
        const Attribute* given = child.find("name");
        if (object.tag == "texture" && (!given || given->value != name))
            throw InputError(given ? given->place : child.place,
                             fmt::format("a <texture> of {} {}, expected the name '{}'", p.title(),
                                         given ? "is named '" + given->value + "'" : "has no name", name));
    }
    const std::vector<const Element*> found = p.nested("texture");
    if (found.empty()) return std::nullopt;
    return read_bitmap(*found.front(), context);
}

}  // namespace neumann::reader
