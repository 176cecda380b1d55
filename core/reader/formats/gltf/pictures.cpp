#include "core/reader/formats/gltf/pictures.h"

#include "core/image/colour/spectrum_to_rgb.h"
#include "core/image/colour/srgb_bytes.h"
#include "core/image/image_io.h"
#include "core/reader/formats/gltf/uri.h"

#include <array>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

namespace neumann::reader::gltf {

namespace {

// The number in the file, from 0 to 1; a grey picture has red, green and blue, too.
double value_of(const Texels& t, std::size_t texel, int channel) {
    const bool has_alpha = t.channels == 2 || t.channels == 4, is_grey_picture = t.channels < 3;
    if (channel == 3 && !has_alpha) return 1.0;
    const int place = channel == 3 ? t.channels - 1 : is_grey_picture ? 0 : channel;
    const std::size_t i = texel * static_cast<std::size_t>(t.channels) + static_cast<std::size_t>(place);
    return t.bytes.empty() ? static_cast<double>(t.values[i]) : t.bytes[i] / 255.0;
}

// The picture in place of one that is not known.
const auto grey = std::make_shared<const Texels>(Texels{1, 1, 4, {}, {0.5f, 0.5f, 0.5f, 1.0f}});

std::size_t texel_count(const Texels& t) { return static_cast<std::size_t>(t.width) * static_cast<std::size_t>(t.height); }

// A picture of the same size with the numbers value(texel, channel).
template <class Value>
Texels of_values(const Texels& t, int channels, const Value& value) {
    Texels result{t.width, t.height, channels};
    result.values.reserve(texel_count(t) * static_cast<std::size_t>(channels));
    for (std::size_t i = 0; i < texel_count(t); ++i)
        for (int c = 0; c < channels; ++c) result.values.push_back(static_cast<float>(value(i, c)));
    return result;
}

// A picture of some of the channels, which stay sRGB bytes.
Texels pick_bytes(const Texels& t, int first, int channels) {
    Texels result{t.width, t.height, channels};
    result.is_encoded = true;
    result.bytes.reserve(texel_count(t) * static_cast<std::size_t>(channels));
    for (std::size_t i = 0; i < texel_count(t); ++i)
        for (int c = first; c < first + channels; ++c)
            result.bytes.push_back(t.bytes[i * static_cast<std::size_t>(t.channels) + static_cast<std::size_t>(c)]);
    return result;
}

double decoded(const Texels& t, std::size_t texel, int channel) {
    const double value = value_of(t, texel, channel);
    if (!t.bytes.empty()) return decoded_srgb_bytes()[static_cast<std::size_t>(value * 255.0 + 0.5)];
    return t.is_encoded ? srgb_decode(value) : value;
}

std::string name_of(const std::optional<std::string>& name, const std::optional<std::string>& uri, std::size_t image) {
    if (name && !name->empty()) return *name;
    if (uri && !uri->starts_with("data:")) return std::filesystem::path(*uri).stem().string();
    return fmt::format("image_{}", image);
}

}  // namespace

std::string Pictures::bytes_of(JsonObject& image) {
    const std::optional<std::string> uri = image.text("uri");
    if (uri) return read_uri(*uri, path_, image.place_of("uri"), files_);
    const auto view = image.index("bufferView", accessors_.views(), "bufferView");
    if (!view) image.fail_missing("uri", "that or a bufferView");
    return std::string(accessors_.bytes_of_view(*view));
}

const Texels& Pictures::texels(std::size_t image) {
    const auto [found, is_new] = texels_.try_emplace(image);
    if (is_new) {
        JsonObject object = images_.object(image);
        const std::string bytes = bytes_of(object);
        const bool is_known = bytes.starts_with("\x89PNG") || bytes.starts_with("\xff\xd8\xff");
        if (!is_known)
            object.notes().problems.replace(Unknown(object.place(), "the picture is neither a PNG nor a JPEG file", "",
                                                    "taken as 0.5, opaque and flat, and as black in lights"),
                                            object.place());
        object.ignore({"mimeType", "name", "bufferView", "uri"});
        object.finish();
        found->second = is_known ? std::make_shared<const Texels>(decode_texels(bytes, to_string(object.place()))) : grey;
    }
    if (!found->second) throw AlreadyReported();
    return *found->second;
}

std::string Pictures::made(std::size_t image, const std::string& kind, const Make& make) {
    std::string& name = made_[{image, kind}];
    if (!name.empty()) return name;
    auto result = std::make_shared<Texels>(make(texels(image)));
    JsonObject object = images_.object(image);
    const std::string wished = name_of(object.text("name"), object.text("uri"), image);
    name = fmt::format("textures/{}.{}", names_.unique(wished), result->bytes.empty() ? "exr" : "png");
    in_memory_.pictures[name] = std::move(result);
    return name;
}

bool Pictures::is_known(std::size_t image) { return &texels(image) != grey.get(); }

std::string Pictures::colors(std::size_t image, const Rgb& factor) {
    return made(image, fmt::format("colors {} {} {}", factor.r, factor.g, factor.b), [&](const Texels& t) {
        if (factor == Rgb(1.0) && !t.bytes.empty()) return pick_bytes(t, 0, t.channels < 3 ? 1 : 3);
        return of_values(t, 3, [&](std::size_t i, int c) { return decoded(t, i, c) * factor[c]; });
    });
}

std::string Pictures::channel(std::size_t image, int channel, double factor) {
    return made(image, fmt::format("channel {} {}", channel, factor), [&](const Texels& t) {
        if (factor == 1.0 && !t.bytes.empty() && channel < t.channels && t.channels > 2) return pick_bytes(t, channel, 1);
        return of_values(t, 1, [&](std::size_t i, int) { return value_of(t, i, channel) * factor; });
    });
}

std::string Pictures::cut_out(std::size_t image, double factor, double cutoff) {
    return made(image, fmt::format("cut out {} {}", factor, cutoff), [&](const Texels& t) {
        return of_values(t, 1, [&](std::size_t i, int) { return value_of(t, i, 3) * factor >= cutoff ? 1.0 : 0.0; });
    });
}

bool Pictures::is_opaque(std::size_t image) {
    const Texels& t = texels(image);
    for (std::size_t i = 0; i < texel_count(t); ++i)
        if (value_of(t, i, 3) < 1.0) return false;
    return true;
}

std::string Pictures::normals(std::size_t image, double scale, bool flip_y) {
    return made(image, fmt::format("normals {} {}", scale, flip_y), [&](const Texels& t) {
        if (scale == 1.0 && !flip_y && t.channels > 2 && !t.bytes.empty()) return pick_bytes(t, 0, 3);
        const double factor[3] = {scale, flip_y ? -scale : scale, 1.0};
        return of_values(t, 3, [&](std::size_t i, int c) { return 0.5 + factor[c] * (value_of(t, i, c) - 0.5); });
    });
}

}  // namespace neumann::reader::gltf
