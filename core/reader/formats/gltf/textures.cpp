#include "core/reader/formats/gltf/textures.h"

#include "core/reader/formats/make_elements.h"

#include <cmath>

#include <fmt/format.h>

namespace neumann::reader::gltf {

namespace {

constexpr std::int64_t nearest = 9728, linear = 9729, clamp = 33071, mirror = 33648, repeat = 10497;

std::string wrap_mode(JsonObject& sampler, const std::string& name) {
    const std::int64_t mode = sampler.integer(name, 0, 65535).value_or(repeat);
    if (mode == clamp) return "clamp";
    if (mode == mirror) return "mirror";
    if (mode != repeat) sampler.complain(name, fmt::format("{} is {}, expected 10497, 33071 or 33648", name, mode));
    return "repeat";
}

// KHR_texture_transform scales, rotates from v towards u, and moves.
void read_transform(JsonObject info, Texture& texture) {
    const auto offset = info.numbers("offset", {0.0, 0.0}), scale = info.numbers("scale", {1.0, 1.0});
    const double angle = info.number("rotation", 0.0), c = std::cos(angle), s = std::sin(angle);
    texture.to_uv[0] = {c * scale[0], -s * scale[0], 0.0, 0.0};
    texture.to_uv[1] = {s * scale[1], c * scale[1], 0.0, 0.0};
    texture.to_uv[3] = {offset[0], offset[1], 0.0, 1.0};
    if (scale[0] == 0.0 || scale[1] == 0.0)
        info.complain("scale", fmt::format("scale is {} and {}, expected none to be 0", scale[0], scale[1]));
    if (const auto other = info.integer("texCoord", 0, 99)) texture.coordinates = static_cast<int>(*other);
    info.finish();
}

}  // namespace

void Textures::read_sampler(JsonObject sampler, Texture& texture) const {
    texture.wrap = wrap_mode(sampler, "wrapS");
    if (wrap_mode(sampler, "wrapT") != texture.wrap)
        sampler.notes().warnings.add(
            "a sampler whose wrapS and wrapT differ: textures have one way to go on beyond their edges, and wrapS is taken for "
            "both");
    const std::int64_t filter = sampler.integer("magFilter", 0, 65535).value_or(linear);
    if (filter != nearest && filter != linear)
        sampler.complain("magFilter", fmt::format("magFilter is {}, expected 9728 or 9729", filter));
    texture.is_nearest = filter == nearest;
    sampler.ignore({"name", "minFilter"});  // pixels are averaged over their area
    sampler.finish();
}

std::optional<Texture> Textures::read(JsonObject info) const {
    Texture result;
    result.place = info.place();
    result.coordinates = static_cast<int>(info.integer("texCoord", 0, 99).value_or(0));
    if (auto transform = info.extension("KHR_texture_transform")) read_transform(*transform, result);
    result.amount = info.number("scale", 1.0);
    info.ignore({"strength"});  // strength of occlusion
    const auto index = info.index("index", textures_, "texture");
    if (!index) info.fail_missing("index", "that of a texture");
    info.finish();
    JsonObject texture = textures_.object(*index);
    if (const auto sampler = texture.index("sampler", samplers_, "sampler")) read_sampler(samplers_.object(*sampler), result);
    auto image = texture.index("source", images_, "image");
    for (const char* coding : {"KHR_texture_basisu", "EXT_texture_webp", "EXT_texture_avif", "MSFT_texture_dds"})
        if (auto other = texture.extension(coding); other && !image) image = other->index("source", images_, "image");
    if (!image) texture.fail_missing("source", "the index of an image, a PNG or a JPEG");
    texture.ignore({"name"});
    texture.finish();
    result.image = *image;
    return result;
}

std::optional<Texture> Textures::read(JsonObject& parent, const std::string& name) const {
    const auto info = parent.object(name);
    if (!info) return std::nullopt;
    return parent.notes().problems.attempt(info->place(), [&] { return read(*info); }).value_or(std::nullopt);
}

Element make_bitmap(const Texture& texture, const std::string& name, const std::string& filename, bool raw) {
    Element e = make_object("texture", "bitmap", texture.place);
    e.attributes.push_back({"name", name, texture.place});
    add_string(e, "filename", filename, texture.place);
    if (raw) add_boolean(e, "raw", true, texture.place);
    if (texture.wrap != "repeat") add_string(e, "wrap_mode", texture.wrap, texture.place);
    if (texture.is_nearest) add_string(e, "filter_type", "nearest", texture.place);
    if (texture.to_uv != Mat4(1.0)) add_matrix(e, "to_uv", texture.to_uv, texture.place);
    return e;
}

}  // namespace neumann::reader::gltf
