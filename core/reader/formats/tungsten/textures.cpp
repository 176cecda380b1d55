#include "core/reader/formats/tungsten/textures.h"

#include "core/image/image_io.h"
#include "core/reader/formats/find_file.h"
#include "core/reader/formats/json_file.h"
#include "core/reader/formats/make_elements.h"

#include <memory>

#include <fmt/format.h>

namespace neumann::reader::tungsten {

namespace {

// In pictures, Tungsten's v grows upwards and Mitsuba's downwards.
Mat4 upside_down() {
    Mat4 m(1.0);
    m[1][1] = -1.0;
    m[3][1] = 1.0;
    return m;
}

Element scaled(Element texture, double factor, const Location& place) {
    Element e = make_object("texture", "scale", place);
    add_float(e, "scale", factor, place);
    add(e, std::move(texture));
    return e;
}

void add_texture(Element& parent, const std::string& name, const TextureValue& value) {
    Element& e = add(parent, *value.texture);
    e.attributes.push_back({"name", name, value.place});
}

// The mean of the colours, or alpha. Without alpha, pictures of whole numbers are opaque and those of floats use the
// mean, as in Tungsten.
Texels numbers_of(const Texels& from, bool alpha) {
    Texels result{from.width, from.height, 1};
    const std::size_t channels = static_cast<std::size_t>(from.channels), count = from.values.size() + from.bytes.size();
    const bool has_alpha = channels == 2 || channels == 4;
    const auto value = [&](std::size_t i) {
        return from.bytes.empty() ? static_cast<double>(from.values[i]) : from.bytes[i] / 255.0;
    };
    for (std::size_t i = 0; i + channels <= count; i += channels) {
        double number = 1.0;
        if (!alpha || (!has_alpha && !from.is_encoded))
            number = channels < 3 ? value(i) : (value(i) + value(i + 1) + value(i + 2)) / 3.0;
        else if (has_alpha)
            number = value(i + channels - 1);
        result.values.push_back(static_cast<float>(number));
    }
    return result;
}

}  // namespace

TextureValue times(const TextureValue& value, double factor) {
    TextureValue result = value;
    result.constant *= factor;
    result.picture_scale *= factor;
    if (result.texture && factor != 1.0) result.texture = scaled(std::move(*result.texture), factor, value.place);
    return result;
}

void add_color(Element& parent, const std::string& name, const TextureValue& value) {
    if (value.texture)
        add_texture(parent, name, value);
    else
        add_rgb(parent, name, value.constant, value.place);
}

void add_number(Element& parent, const std::string& name, const TextureValue& value) {
    if (value.texture)
        add_texture(parent, name, value);
    else
        add_float(parent, name, value.constant.r, value.place);
}

std::optional<TextureValue> Textures::find(JsonObject& object, const std::string& name, Kind kind) {
    const nlohmann::json* value = object.value(name);
    if (!value) return std::nullopt;
    const Location place = object.place_of(name);
    return importing_.notes.problems.attempt(place, [&]() -> TextureValue {
        if (value->is_string()) {
            const std::optional<std::string> path = find_named_file(object, name, importing_);
            if (!path) throw AlreadyReported();
            return make_bitmap(*path, nullptr, place, kind);
        }
        if (value->is_object()) return read({*value, place, importing_.notes}, kind);
        const std::optional<Vec3> constant = find_vector(object, name);
        if (!constant) throw AlreadyReported();
        return {place, kind == Kind::color ? *constant : Rgb(constant->r)};
    });
}

TextureValue Textures::read(JsonObject texture, Kind kind) {
    static const std::vector<std::string> types = {"bitmap", "checker", "constant"};
    const std::string type = read_type(texture, "texture", types, "taken as 0.5", importing_);
    if (type.empty()) return {texture.place(), Rgb(0.5)};
    texture.ignore({"name"});
    if (type == "checker") return read_checker(texture, kind);
    if (type == "constant") {
        const std::optional<Vec3> value = find_vector(texture, "value");
        texture.finish();
        return {texture.place(), kind == Kind::color ? value.value_or(Vec3(0.0)) : Rgb(value.value_or(Vec3(0.0)).r)};
    }
    const std::optional<std::string> path = find_named_file(texture, "file", importing_);
    if (!path && texture.has("file")) throw AlreadyReported();
    if (!path) texture.fail_missing("file", "the name of a picture");
    TextureValue value = make_bitmap(*path, &texture, texture.place(), kind);
    texture.finish();
    return value;
}

TextureValue Textures::make_bitmap(const std::string& path, JsonObject* options, const Location& place, Kind kind) {
    const bool is_color = kind == Kind::color;
    const auto flag = [&](const char* name, bool missing) { return options ? options->boolean(name, missing) : missing; };
    const bool is_raw = !flag("gamma_correct", true), is_nearest = !flag("interpolate", true), ends = flag("clamp", false);
    const double scale = options ? options->number("scale", 1.0, not_negative) : 1.0;
    const std::string filename = is_color ? name_for_elements(path, importing_.main_file()) : number_picture(path, place, kind);
    Element e = make_object("texture", "bitmap", place);
    add_string(e, "filename", filename, place);
    if (is_raw || !is_color) add_boolean(e, "raw", true, place);
    if (is_nearest) add_string(e, "filter_type", "nearest", place);
    if (ends) add_string(e, "wrap_mode", "clamp", place);
    add_matrix(e, "to_uv", upside_down(), place);
    return times({place, Rgb(1.0), std::move(e), filename, 1.0, is_raw}, scale);
}

std::string Textures::number_picture(const std::string& path, const Location& place, Kind kind) {
    std::string& name = made_[{path, kind}];
    if (!name.empty()) return name;
    const Texels from = decode_texels(read_bytes(path, place), path);
    importing_.scene.files.push_back(path);
    if (kind == Kind::alpha && from.is_encoded && from.channels != 2 && from.channels != 4)
        importing_.notes.warnings.add("an opacity that is a picture without alpha: opaque, as in Tungsten");
    name = fmt::format("textures/{}.exr", importing_.picture_names.unique(stem_of(path)));
    importing_.scene.in_memory.pictures[name] = std::make_shared<Texels>(numbers_of(from, kind == Kind::alpha));
    return name;
}

// A checkerboard of res_u × res_v squares, of which the one at (0, 0) is off.
TextureValue Textures::read_checker(JsonObject& texture, Kind kind) {
    constexpr std::int64_t usual_squares = 20, most_squares = 1 << 20;
    const Vec3 on = find_vector(texture, "on_color").value_or(Vec3(0.8)),
               off = find_vector(texture, "off_color").value_or(Vec3(0.2));
    const auto squares = [&](const std::string& name) {
        return static_cast<double>(texture.integer(name, 1, most_squares).value_or(usual_squares));
    };
    const double across = squares("res_u"), up = squares("res_v");
    texture.finish();
    Element e = make_object("texture", "checkerboard", texture.place());
    // A checkerboard that is evaluated as a number has its squares swapped.
    const bool is_color = kind == Kind::color;
    const auto add_square = [&](const std::string& name, const Vec3& value, const std::string& from) {
        if (is_color)
            add_rgb(e, name, value, texture.place_of(from));
        else
            add_float(e, name, value.r, texture.place_of(from));
    };
    add_square(is_color ? "color0" : "color1", off, "off_color");
    add_square(is_color ? "color1" : "color0", on, "on_color");
    Mat4 to_uv(1.0);
    to_uv[0][0] = 0.5 * across;
    to_uv[1][1] = 0.5 * up;
    add_matrix(e, "to_uv", to_uv, texture.place());
    return {texture.place(), Rgb(1.0), std::move(e)};
}

}  // namespace neumann::reader::tungsten
