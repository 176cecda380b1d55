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
    std::string filename, path;              // as elements name it; empty path: in memory
    std::shared_ptr<const Texels> texels{};  // null: not read yet
    bool raw = false, nearest = false;
    std::string wrap = "repeat";
    UvMapping mapping = {};
};

// The picture in a file with this name. Throws InputError if there is none.
Picture find_picture(const std::string& name, const Location& place, Importer& importer);

struct TextureValue;

// Where ⌊s⌋ + ⌊t⌋ is even the first, elsewhere the second.
struct Checks {
    std::array<std::shared_ptr<const TextureValue>, 2> squares;
    UvMapping mapping;
    int depth = 1;  // of checkerboards within each other
};

struct TextureValue {
    std::variant<Rgb, Picture, Checks> value;

    const Rgb* constant() const { return std::get_if<Rgb>(&value); }
};

// f of each texel, in memory where that is a picture; f gets linear values. The result is a picture of one channel if `is_grey`.
// Throws InputError if a picture cannot be read.
TextureValue apply(const TextureValue& t, const std::function<Rgb(const Rgb&)>& f, Importer& importer, bool is_grey = false);
// f of the texels of both. Throws InputError at `place` if that is no texture of the same kind: for checkerboards of other squares
// and pictures of different size or mapping.
TextureValue combine(const TextureValue& a, const TextureValue& b, const std::function<Rgb(const Rgb&, const Rgb&)>& f,
                     Importer& importer, const Location& place);
// The mean of the channels, as pbrt makes numbers of colours; the same texture where it is grey.
TextureValue as_number(const TextureValue& t, Importer& importer);
// With no value above 1, as pbrt cuts off reflectances.
TextureValue at_most_one(const TextureValue& t, Importer& importer);
// A number with no value below `least`; the same texture where there is none.
TextureValue at_least(const TextureValue& t, double least, Importer& importer);
// The largest value of each channel.
Rgb largest(const TextureValue& t, Importer& importer);

// Calls f with each texel, linear, and returns their number.
std::size_t for_each_texel(const Picture& picture, Importer& importer, const std::function<void(const Rgb&)>& f);

// How the texture coordinates of shapes here give those of pbrt: on spheres v is turned over; on discs pbrt's u is our v, and its v
// is 1 − u.
enum class Coordinates { same, sphere, disk };

// Adds the parameter that says so. Numbers where a number is expected: <float>, and checkerboards that are evaluated as such.
void add_texture(Element& parent, const std::string& name, const TextureValue& t, Coordinates coordinates, bool is_number,
                 const Location& place);

}  // namespace neumann::reader::pbrt
