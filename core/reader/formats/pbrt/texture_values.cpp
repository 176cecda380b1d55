#include "core/reader/formats/pbrt/texture_values.h"

#include "core/base/error.h"
#include "core/image/colour/spectrum_to_rgb.h"
#include "core/image/colour/srgb_bytes.h"
#include "core/image/image_io.h"
#include "core/reader/formats/find_file.h"
#include "core/reader/formats/make_elements.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

namespace neumann::reader::pbrt {

std::shared_ptr<const Texels> Importer::read_picture(const std::string& path) {
    auto& texels = pictures[path];
    if (!texels) {
        texels = std::make_shared<const Texels>(read_texels(path));
        scene.files.push_back(path);
    }
    return texels;
}

std::string Importer::unused_name(const std::string& name) const {
    namespace fs = std::filesystem;
    const fs::path path = name;
    const fs::path folder = fs::path(main_file()).parent_path();
    std::string result;
    std::error_code error;
    int number = 1;
    do {
        result = fmt::format("{}/{}-{}{}", path.parent_path().string(), path.stem().string(), number++, path.extension().string());
    } while (scene.in_memory.pictures.contains(result) || fs::exists(folder / result, error));
    return result;
}

namespace {

constexpr std::size_t max_baked_values = std::size_t(1) << 30;

const Texels& texels_of(const Picture& p, Importer& importer, std::shared_ptr<const Texels>& kept) {
    kept = p.texels ? p.texels : importer.read_picture(p.path);
    return *kept;
}

Rgb linear_texel(const Texels& t, bool raw, std::size_t pixel) {
    const bool decode = t.is_encoded && !raw;
    const auto channel = [&](std::size_t c) {
        const std::size_t i = pixel * static_cast<std::size_t>(t.channels) + (t.channels < 3 ? 0 : c);
        if (t.values.empty()) return decode ? decoded_srgb_bytes()[t.bytes[i]] : t.bytes[i] / 255.0;
        const double v = t.values[i];
        return decode ? srgb_decode(v) : v;
    };
    return {channel(0), channel(1), channel(2)};
}

std::size_t pixel_count(const Texels& t) { return static_cast<std::size_t>(t.width) * static_cast<std::size_t>(t.height); }

// The picture with f(number of the pixel) in each pixel.
Picture baked(const Picture& from, const Texels& size, const std::function<Rgb(std::size_t)>& f, bool is_grey, Importer& importer) {
    importer.baked_values += pixel_count(size) * (is_grey ? 1 : 3);
    if (importer.baked_values > max_baked_values)
        throw InputError(from.path + ": with this picture, those that are computed from others take more than 4 GiB");
    auto result = std::make_shared<Texels>();
    result->width = size.width;
    result->height = size.height;
    result->channels = is_grey ? 1 : 3;
    result->values.reserve(pixel_count(size) * static_cast<std::size_t>(result->channels));
    for (std::size_t i = 0; i < pixel_count(size); ++i) {
        const Rgb c = f(i);
        for (int k = 0; k < result->channels; ++k) result->values.push_back(static_cast<float>(c[k]));
    }
    Picture picture = from;
    picture.filename = importer.unused_name("textures/" + stem_of(from.path) + ".exr");
    picture.texels = result;
    picture.raw = false;
    importer.scene.in_memory.pictures[picture.filename] = result;
    return picture;
}

Mat4 coordinates_of_pbrt(Coordinates coordinates) {
    Mat4 m(1.0);
    if (coordinates == Coordinates::sphere) {
        m[1][1] = -1.0;
        m[3][1] = 1.0;
    } else if (coordinates == Coordinates::disk) {
        m[0] = {0.0, -1.0, 0.0, 0.0};
        m[1] = {1.0, 0.0, 0.0, 0.0};
        m[3] = {0.0, 1.0, 0.0, 1.0};
    }
    return m;
}

Mat4 matrix_of(const UvMapping& m) {
    Mat4 result(1.0);
    result[0][0] = m.scale.x;
    result[1][1] = m.scale.y;
    result[3] = {m.offset.x, m.offset.y, 0.0, 1.0};
    return result;
}

// The first row of a picture is at t = 1 in pbrt and at v = 0 here.
Mat4 turned_over() {
    Mat4 m(1.0);
    m[1][1] = -1.0;
    m[3][1] = 1.0;
    return m;
}

// A square of a checkerboard is half as wide here.
Mat4 halved() {
    Mat4 m(1.0);
    m[0][0] = m[1][1] = 0.5;
    return m;
}

void add_named_object(Element& parent, Element e, const std::string& name, const Location& place) {
    e.attributes.push_back({"name", name, place});
    add(parent, std::move(e));
}

bool is_alike(const Picture& a, const Picture& b) { return a.nearest == b.nearest && a.wrap == b.wrap && a.mapping == b.mapping; }

}  // namespace

Picture find_picture(const std::string& name, const Location& place, Importer& importer) {
    const std::string path = find_file(name, importer.main_file(), place);
    return {name_for_elements(path, importer.main_file()), path};
}

TextureValue apply(const TextureValue& t, const std::function<Rgb(const Rgb&)>& f, Importer& importer, bool is_grey) {
    if (const Rgb* c = t.constant()) return {f(*c)};
    if (const auto* checks = std::get_if<Checks>(&t.value)) {
        Checks result = *checks;
        for (auto& square : result.squares) square = std::make_shared<const TextureValue>(apply(*square, f, importer, is_grey));
        return {result};
    }
    const auto& picture = std::get<Picture>(t.value);
    std::shared_ptr<const Texels> kept;
    const Texels& texels = texels_of(picture, importer, kept);
    return {baked(
        picture, texels, [&](std::size_t i) { return f(linear_texel(texels, picture.raw, i)); }, is_grey, importer)};
}

TextureValue combine(const TextureValue& a, const TextureValue& b, const std::function<Rgb(const Rgb&, const Rgb&)>& f,
                     Importer& importer, const Location& place) {
    if (const Rgb* c = b.constant())
        return apply(
            a, [&, second = *c](const Rgb& first) { return f(first, second); }, importer);
    if (const Rgb* c = a.constant())
        return apply(
            b, [&, first = *c](const Rgb& second) { return f(first, second); }, importer);
    const auto *first = std::get_if<Picture>(&a.value), *second = std::get_if<Picture>(&b.value);
    if (first && second && is_alike(*first, *second)) {
        std::shared_ptr<const Texels> kept[2];
        const Texels &s = texels_of(*first, importer, kept[0]), &t = texels_of(*second, importer, kept[1]);
        if (s.width == t.width && s.height == t.height)
            return {baked(
                *first, s, [&](std::size_t i) { return f(linear_texel(s, first->raw, i), linear_texel(t, second->raw, i)); }, false,
                importer)};
    }
    throw InputError(place,
                     "two textures that vary can be combined only if both are pictures of the same size, filter, wrap and mapping");
}

TextureValue as_number(const TextureValue& t, Importer& importer) {
    const auto mean = [](const Rgb& c) { return is_grey(c) ? c : Rgb((c.r + c.g + c.b) / 3.0); };
    if (const auto* picture = std::get_if<Picture>(&t.value)) {
        std::shared_ptr<const Texels> kept;
        const Texels& texels = texels_of(*picture, importer, kept);
        bool grey = true;
        for (std::size_t i = 0; grey && i < pixel_count(texels); ++i) grey = is_grey(linear_texel(texels, picture->raw, i));
        if (grey) return t;
    }
    return apply(t, mean, importer, true);
}

TextureValue at_most_one(const TextureValue& t, Importer& importer) {
    if (const auto* picture = std::get_if<Picture>(&t.value); picture && !picture->texels) {
        // Values of whole-number formats are at most 1; only files of floats are worth reading.
        std::string ending = std::filesystem::path(picture->path).extension().string();
        std::transform(ending.begin(), ending.end(), ending.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        if (ending != ".exr" && ending != ".hdr" && ending != ".pfm" && ending != ".tif" && ending != ".tiff") return t;
    }
    if (max_component(largest(t, importer)) <= 1.0) return t;
    return apply(
        t, [](const Rgb& c) { return glm::min(c, 1.0); }, importer);
}

TextureValue at_least(const TextureValue& t, double least, Importer& importer) {
    if (const auto* picture = std::get_if<Picture>(&t.value)) {
        bool is_below = false;
        for_each_texel(*picture, importer, [&](const Rgb& c) { is_below = is_below || std::min({c.r, c.g, c.b}) < least; });
        if (!is_below) return t;
    }
    return apply(
        t, [least](const Rgb& c) { return glm::max(c, least); }, importer, true);
}

Rgb largest(const TextureValue& t, Importer& importer) {
    if (const Rgb* c = t.constant()) return *c;
    if (const auto* checks = std::get_if<Checks>(&t.value))
        return glm::max(largest(*checks->squares[0], importer), largest(*checks->squares[1], importer));
    Rgb result(0.0);
    for_each_texel(std::get<Picture>(t.value), importer, [&](const Rgb& c) { result = glm::max(result, c); });
    return result;
}

std::size_t for_each_texel(const Picture& picture, Importer& importer, const std::function<void(const Rgb&)>& f) {
    std::shared_ptr<const Texels> kept;
    const Texels& texels = texels_of(picture, importer, kept);
    for (std::size_t i = 0; i < pixel_count(texels); ++i) f(linear_texel(texels, picture.raw, i));
    return pixel_count(texels);
}

void add_texture(Element& parent, const std::string& name, const TextureValue& t, Coordinates coordinates, bool is_number,
                 const Location& place) {
    if (const Rgb* c = t.constant()) {
        if (is_number)
            add_float(parent, name, c->r, place);
        else
            add_rgb(parent, name, *c, place);
        return;
    }
    const Mat4 of_pbrt = coordinates_of_pbrt(coordinates);
    if (const auto* checks = std::get_if<Checks>(&t.value)) {
        Element e = make_object("texture", "checkerboard", place);
        // Mitsuba swaps the squares of a checkerboard of numbers.
        for (const std::size_t i : {0, 1})
            add_texture(e, is_number == (i == 0) ? "color1" : "color0", *checks->squares[i], coordinates, is_number, place);
        add_matrix(e, "to_uv", halved() * matrix_of(checks->mapping) * of_pbrt, place);
        add_named_object(parent, std::move(e), name, place);
        return;
    }
    const auto& picture = std::get<Picture>(t.value);
    Element e = make_object("texture", "bitmap", place);
    add_string(e, "filename", picture.filename, place);
    if (picture.raw) add_boolean(e, "raw", true, place);
    if (picture.nearest) add_string(e, "filter_type", "nearest", place);
    if (picture.wrap != "repeat") add_string(e, "wrap_mode", picture.wrap, place);
    add_matrix(e, "to_uv", turned_over() * matrix_of(picture.mapping) * of_pbrt, place);
    add_named_object(parent, std::move(e), name, place);
}

}  // namespace neumann::reader::pbrt
