// Reads colours and numbers that may vary over a surface.
#pragma once

#include "core/reader/formats/tungsten/importing.h"
#include "core/reader/xml/element.h"

#include <map>

namespace neumann::reader::tungsten {

// A constant, or a <texture>.
struct TextureValue {
    Location place = {};
    Rgb constant{0.0};
    std::optional<Element> texture = {};
    // The file of a colour that is a picture, for light from afar.
    std::string filename = {};
    double picture_scale = 1.0;
    bool is_raw = false;

    bool is_black() const { return !texture && neumann::is_black(constant); }
};

TextureValue times(const TextureValue& value, double factor);

// These add the value as a parameter.
void add_color(Element& parent, const std::string& name, const TextureValue& value);
void add_number(Element& parent, const std::string& name, const TextureValue& value);

class Textures {
public:
    explicit Textures(Importing& importing) : importing_(importing) {}

    // These return nothing if the property is missing, or (with a problem) wrong. Numbers are the mean of a
    // picture's channels, and an opacity is its alpha.
    std::optional<TextureValue> find_color(JsonObject& object, const std::string& name) { return find(object, name, Kind::color); }
    std::optional<TextureValue> find_number(JsonObject& object, const std::string& name) { return find(object, name, Kind::mean); }
    std::optional<TextureValue> find_opacity(JsonObject& object, const std::string& name) {
        return find(object, name, Kind::alpha);
    }

private:
    enum class Kind { color, mean, alpha };

    std::optional<TextureValue> find(JsonObject& object, const std::string& name, Kind kind);
    TextureValue read(JsonObject texture, Kind kind);
    TextureValue read_checker(JsonObject& texture, Kind kind);
    TextureValue make_bitmap(const std::string& path, JsonObject* options, const Location& place, Kind kind);
    // The name of a picture in memory that holds the numbers.
    std::string number_picture(const std::string& path, const Location& place, Kind kind);

    Importing& importing_;
    std::map<std::pair<std::string, Kind>, std::string> made_;
};

}  // namespace neumann::reader::tungsten
