// Textures as values that can be computed with: constants, pictures and checkerboards.
#pragma once

#include "core/base/vec.h"
#include "core/image/texels.h"
#include "core/reader/formats/pbrt/importer.h"
#include "core/reader/xml/element.h"

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <variant>

namespace neumann::reader::pbrt {

// pbrt's mapping "uv": s = scale · uv + offset.
struct UvMapping {
    Vec2 scale{1.0}, offset{0.0};
    bool operator==(const UvMapping&) const = default;
};

struct Picture {
    std::string filename, path;              // `filename` as elements name it; an empty `path`: in memory
    std::shared_ptr<const Texels> texels{};  // null: not read yet
    bool raw = false, nearest = false;
    std::string wrap = "repeat";
    UvMapping mapping = {};
};

// The picture in a file with this name. Throws InputError if there is none.
Picture find_picture(const std::string& name, const Location& place, Importer& importer);

struct TextureValue;

// A checkerboard: the first square where ⌊s⌋ + ⌊t⌋ is even, and the second elsewhere.
struct Checks {
    std::array<std::shared_ptr<const TextureValue>, 2> squares;
    UvMapping mapping;
    int depth = 1;  // nesting depth of checkerboards
};

struct TextureValue {
    std::variant<Rgb, Picture, Checks> value;

    const Rgb* constant() const { return std::get_if<Rgb>(&value); }
};

// Applies f to each texel; the result of a picture is in memory. f gets linear values. A picture has one channel in the
// result if `is_grey`. Throws InputError if a picture cannot be read.
TextureValue apply(const TextureValue& t, const std::function<Rgb(const Rgb&)>& f, Importer& importer, bool is_grey = false);
// Applies f to the texels of both. Throws InputError at `place` if they differ in kind, or in the squares of
// checkerboards or the size or mapping of pictures.
TextureValue combine(const TextureValue& a, const TextureValue& b, const std::function<Rgb(const Rgb&, const Rgb&)>& f,
                     Importer& importer, const Location& place);
// The mean of the channels, which pbrt takes as the number of a colour; the same texture if it is grey.
TextureValue as_number(const TextureValue& t, Importer& importer);
// The texture with values cut off at 1, as pbrt does for reflectances.
TextureValue at_most_one(const TextureValue& t, Importer& importer);
// A number cut off at `least` from below; the same texture if no value is smaller.
TextureValue at_least(const TextureValue& t, double least, Importer& importer);
// The largest value of each channel.
Rgb largest(const TextureValue& t, Importer& importer);

// Calls f with each texel, linear, and returns their number.
std::size_t for_each_texel(const Picture& picture, Importer& importer, const std::function<void(const Rgb&)>& f);

// How the texture coordinates of shapes here give those of pbrt: on spheres v is turned over; on discs pbrt's u is our
// v, and its v is 1 − u.
enum class Coordinates { same, sphere, disk };

// Adds the parameter that holds the value. With `is_number` constants become a <float>, and checkerboards are made for
// evaluation as numbers.
void add_texture(Element& parent, const std::string& name, const TextureValue& t, Coordinates coordinates, bool is_number,
                 const Location& place);

}  // namespace neumann::reader::pbrt
