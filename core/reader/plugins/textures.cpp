#include "core/reader/plugins/textures.h"

#include "core/base/printable.h"
#include "core/image/bitmap.h"
#include "core/image/display.h"
#include "core/image/image_io.h"
#include "core/image/uv_transform.h"

#include <fmt/format.h>
#include <algorithm>

namespace neumann::reader {

namespace {

Texture read_bitmap(Properties& p, const Context& context) {
    const Attribute& filename = p.require("filename", {"string"}).attribute("value");
    const bool nearest = p.choice("filter_type", {"bilinear", "nearest"}, "bilinear") == "nearest";
    const std::string wrap = p.choice("wrap_mode", {"repeat", "mirror", "clamp"}, "repeat");
    const bool raw = p.boolean("raw").value_or(false);
    const UvTransform to_uv(p.transform("to_uv"));
    // These choose Mitsuba's storage and lookup of texels, and change rounding only.
    p.choice("format", {"auto", "variant", "fp16"}, "auto");
    p.boolean("accel");
    p.refuse_rest();
    const auto texels = p.attempt("filename", [&] { return read_texels(filename, context); });
    p.finish();

    using Wrap = Bitmap::Wrap;
    const auto bitmap = std::make_shared<const Bitmap>(*texels, nearest ? Bitmap::Filter::nearest : Bitmap::Filter::bilinear,
                                                       wrap == "repeat"   ? Wrap::repeat
                                                       : wrap == "mirror" ? Wrap::mirror
                                                                          : Wrap::clamp,
                                                       raw);
    return {{[bitmap, to_uv](const ShadingPoint& at) { return (*bitmap)(to_uv(texture_coordinates(at))); }, bitmap->largest(),
             bitmap->is_grey()},
            bitmap->smallest(),
            [bitmap, to_uv](const ShadingPoint& at) { return to_uv.slope(bitmap->slope(to_uv(texture_coordinates(at)))); },
            bitmap->width(),
            bitmap->height()};
}

// Reads a number that is given as a colour: the mean of its channels.
Rgb read_mean(Properties& p, const std::string& name, const Element& e, const Context& context) {
    const Rgb c = parse_color(p, name, e, Illuminant::d65, context.warnings);
    if (is_grey(c)) return c;
    context.warnings.add("a colour where a number is expected, taken as the mean of its channels");
    return Rgb((c.r + c.g + c.b) / 3.0);
}

SurfaceFunction read_square(Properties& p, const std::string& name, double missing, std::optional<Illuminant> illuminant,
                            const Context& context) {
    if (illuminant) return read_color_texture(p, name, missing, *illuminant, context);
    if (p.object(name, "texture")) return read_number_texture(p, name, missing, context);
    const Element* e = p.find(name, color_types);
    return e ? read_mean(p, name, *e, context) : Rgb(missing);
}

Texture read_checkerboard(Properties& p, std::optional<Illuminant> illuminant, const Context& context) {
    SurfaceFunction color0 = read_square(p, "color0", 0.4, illuminant, context),
                    color1 = read_square(p, "color1", 0.2, illuminant, context);
    // Mitsuba's checkerboard swaps the squares if it is evaluated as a number (eval_1 and not eval).
    if (!illuminant) std::swap(color0, color1);
    const UvTransform to_uv(p.transform("to_uv"));
    p.finish();
    return {{[color0, color1, to_uv](const ShadingPoint& at) {
                 const Vec2 uv = to_uv(texture_coordinates(at)), part = uv - glm::floor(uv);
                 return ((part.x > 0.5) == (part.y > 0.5) ? color0 : color1)(at);
             },
             glm::max(color0.upper_bound(), color1.upper_bound()), color0.is_grey() && color1.is_grey()}};
}

// Colours of a rawconstant are neither decoded nor clipped.
Texture read_raw_constant(Properties& p, bool is_number) {
    const Element& e = p.require("value", {"float", "integer", "vector"});
    const bool is_vector = e.tag == "vector";
    const Rgb value = is_vector ? p.point("value").value_or(Vec3(0.0)) : Rgb(p.number("value").value_or(0.0));
    if (is_vector && is_number) p.complain("value", fmt::format("{} has three numbers, expected one", p.title()));
    p.finish();
    return {value, value};
}

// Reads another texture times `scale` (Mitsuba 0.6). The factor of a colour may be a colour.
Texture read_scaled(Properties& p, std::optional<Illuminant> illuminant, const Context& context) {
    const Element* given = p.find("scale", color_types);
    const Rgb scale = !given       ? Rgb(1.0)
                      : illuminant ? parse_metal_index(p, "scale", *given, context.warnings)
                                   : read_mean(p, "scale", *given, context);
    const std::vector<const Element*> nested = p.nested("texture");
    p.finish();
    if (nested.empty()) p.fail_empty(fmt::format("{} has no <texture> inside, expected one", p.title()));
    Texture texture = read_texture(*nested.front(), illuminant, context);
    const SurfaceFunction value = texture.value;
    if (!is_finite(value.upper_bound() * scale)) p.fail("scale", fmt::format("scale of {} gives numbers out of range", p.title()));
    texture.value = {[value, scale](const ShadingPoint& at) { return value(at) * scale; }, value.upper_bound() * scale,
                     value.is_grey() && is_grey(scale)};
    if (value.is_constant()) texture.value = value.upper_bound() * scale;
    texture.smallest *= scale;
    if (!is_grey(scale))
        texture.slope = {};
    else if (texture.slope)
        texture.slope = [slope = texture.slope, factor = scale.r](const ShadingPoint& at) { return slope(at) * factor; };
    return texture;
}

std::string attribute_name(Properties& p) {
    const Attribute& name = p.require("name", {"string"}).attribute("value");
    if (!name.value.starts_with("vertex_") && !name.value.starts_with("face_"))
        throw InputError(
            name.place,
            fmt::format("'{}' is not the name of a mesh attribute, expected vertex_ or face_ and what follows", name.value));
    return name.value;
}

Texture read_mesh_attribute(Properties& p, const Context& context) {
    const std::string name = attribute_name(p);
    const double scale = p.number("scale").value_or(1.0);
    if (scale < 0.0) p.complain("scale", fmt::format("scale is negative: {}", scale));
    p.finish();
    const TextureStore::Range range = context.textures.attributes[name];
    return {{[name, scale](const ShadingPoint& at) {
                 const MeshAttribute& a = *mesh_of(*at.on)->attribute(name);
                 const auto value = [&](std::uint32_t i) { return Rgb(a.values[i][0], a.values[i][1], a.values[i][2]); };
                 if (a.of_triangles) return value(at.primitive) * scale;
                 const auto [t, weights] = vertex_weights(*at.on, at);
                 const Vec3 w = glm::max(weights, 0.0);
                 return (value(t[0]) * w.x + value(t[1]) * w.y + value(t[2]) * w.z) * (scale / (w.x + w.y + w.z));
             },
             range.largest * scale},
            range.smallest * scale};
}

void find_mesh_attributes(const Element& e, const Objects& objects, std::set<const Element*>& seen,
                          std::map<std::string, const Element*>& found) {
    if (!seen.insert(&e).second) return;
    const Attribute* type = e.find("type");
    if (e.tag == "texture" && type && type->value == "mesh_attribute")
        objects.problems().attempt(e.place, [&] {
            Properties p(e, objects);
            found.try_emplace(attribute_name(p), p.find("name", {"string"}));
        });
    for (const Element& child : e.children)
        if (const Element* object = child.tag == "ref" ? objects.known(child) : &child)
            find_mesh_attributes(*object, objects, seen, found);
}

// Marks an element as being read, to detect textures that contain themselves.
class Opened {
public:
    Opened(const Element& e, const Context& context) : e_(e), open_(context.textures.open) {
        constexpr std::size_t most_parts = 1024;
        std::size_t& parts = context.textures.parts;
        parts = open_.empty() ? 1 : parts + 1;
        if (parts > most_parts) throw InputError(e.place, fmt::format("a texture is made of more than {} textures", most_parts));
        if (open_.size() >= max_nesting)
            throw InputError(e.place, fmt::format("textures are nested more than {} deep", max_nesting));
        if (!open_.insert(&e).second) throw InputError(e.place, "the texture stands inside itself");
        context.textures.known.insert(&e);
    }
    ~Opened() { open_.erase(&e_); }
    Opened(const Opened&) = delete;
    Opened& operator=(const Opened&) = delete;

private:
    const Element& e_;
    std::set<const Element*>& open_;
};

std::optional<SurfaceFunction> find_texture(Properties& p, const std::string& name, std::optional<Illuminant> illuminant,
                                            const Context& context) {
    const Element* e = p.object(name, "texture");
    if (!e) return std::nullopt;
    return p.attempt(name, [&] { return read_not_negative(*e, name, illuminant, context).value; });
}

}  // namespace

std::shared_ptr<const Texels> read_texels(const Attribute& filename, const Context& context) {
    const auto& in_memory = context.document.in_memory.pictures;
    if (const auto found = in_memory.find(filename.value); found != in_memory.end()) return found->second;
    const std::string path = context.document.find_file(filename);
    auto& texels = context.textures.images[path];
    if (!texels) {
        texels = std::make_shared<const Texels>(neumann::read_texels(path));
        context.mesh_files.push_back(path);
    }
    return texels;
}

Texture read_texture(const Element& e, std::optional<Illuminant> illuminant, const Context& context) {
    const Opened opened(e, context);
    Properties p(e, context.objects);
    const std::string& type = e.attribute("type").value;
    if (type == "bitmap") return read_bitmap(p, context);
    if (type == "checkerboard") return read_checkerboard(p, illuminant, context);
    if (type == "mesh_attribute") return read_mesh_attribute(p, context);
    if (type == "rawconstant") return read_raw_constant(p, !illuminant);
    if (type == "scale") return read_scaled(p, illuminant, context);
    const bool emits = illuminant == Illuminant::equal_energy;
    try {
        fail_type(e, {"bitmap", "checkerboard", "mesh_attribute", "rawconstant", "scale"},
                  emits ? "taken as black" : "taken as 0.5");
    } catch (const Unknown& unknown) {
        context.problems().replace(unknown, e.place);
    }
    const Rgb everywhere(emits ? 0.0 : 0.5);
    return {everywhere, everywhere};
}

Texture read_not_negative(const Element& e, const std::string& name, std::optional<Illuminant> illuminant, const Context& context) {
    Texture texture = read_texture(e, illuminant, context);
    if (const Rgb& s = texture.smallest; std::min({s.r, s.g, s.b}) < 0.0)
        throw InputError(e.place, fmt::format("the texture is negative somewhere, down to {}, expected {} of at least 0",
                                              std::min({s.r, s.g, s.b}), with_article(name)));
    return texture;
}

std::optional<SurfaceFunction> find_color_texture(Properties& p, const std::string& name, Illuminant illuminant,
                                                  const Context& context) {
    return find_texture(p, name, illuminant, context);
}

SurfaceFunction read_color_texture(Properties& p, const std::string& name, double missing, Illuminant illuminant,
                                   const Context& context) {
    if (const auto texture = find_color_texture(p, name, illuminant, context)) return *texture;
    const Element* e = p.find(name, color_types);
    return e ? parse_color(p, name, *e, illuminant, context.warnings) : Rgb(missing);
}

SurfaceFunction read_number_texture(Properties& p, const std::string& name, double missing, const Context& context) {
    const auto texture = find_texture(p, name, std::nullopt, context);
    if (!texture) {
        const Element* e = p.find(name, color_types);
        const bool is_color = e && (e->tag == "rgb" || e->tag == "spectrum");
        return is_color ? read_mean(p, name, *e, context) : Rgb(p.number(name).value_or(missing));
    }
    const auto number = [](const Rgb& c) { return Rgb(is_grey(c) ? c.r : luminance(c)); };
    if (texture->is_constant()) return number(texture->upper_bound());
    return {[f = *texture, number](const ShadingPoint& at) { return number(f(at)); }, number(texture->upper_bound()), true};
}

std::map<std::string, const Element*> mesh_attributes_of(const Element& shape, const Objects& objects) {
    std::set<const Element*> seen;
    std::map<std::string, const Element*> found;
    find_mesh_attributes(shape, objects, seen, found);
    return found;
}

}  // namespace neumann::reader
