// Elements of a scene file.
#pragma once

#include "tests/search/random_numbers.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <map>
#include <string>
#include <vector>

namespace neumann::search {

using Node = pugi::xml_node;

inline Node add(Node parent, const char* tag) { return parent.append_child(tag); }
// <tag type="…" name="…">
inline Node add_object(Node parent, const char* tag, const std::string& type, const std::string& name = "") {
    Node node = add(parent, tag);
    node.append_attribute("type") = type.c_str();
    if (!name.empty()) node.append_attribute("name") = name.c_str();
    return node;
}
// <tag name="…" value="…">
inline void add_value(Node parent, const char* tag, const std::string& name, const std::string& value) {
    Node node = add(parent, tag);
    node.append_attribute("name") = name.c_str();
    node.append_attribute("value") = value.c_str();
}
inline void add_number(Node parent, const std::string& name, double value) {
    add_value(parent, "float", name, fmt::format("{}", value));
}
inline void add_whole(Node parent, const std::string& name, std::uint64_t value) {
    add_value(parent, "integer", name, fmt::format("{}", value));
}
inline Node add_transform(Node parent, const std::string& name = "to_world") {
    Node node = add(parent, "transform");
    node.append_attribute("name") = name.c_str();
    return node;
}
inline void add_operation(Node transform, const char* tag, const std::string& value) {
    add(transform, tag).append_attribute("value") = value.c_str();
}
inline void add_lookat(Node transform, const std::string& origin, const std::string& target) {
    Node lookat = add(transform, "lookat");
    lookat.append_attribute("origin") = origin.c_str();
    lookat.append_attribute("target") = target.c_str();
    lookat.append_attribute("up") = "0.05, 0.1, 1";
}

// What the parts of a scene are made with.
struct Making {
    RandomNumbers& random;
    std::map<std::string, std::string>& files;
};

// A colour, at most `most` in each channel, or a texture of such.
void add_colour(Node parent, const std::string& name, double most, Making& making);
// A number from 0 to 1, or a texture of such.
void add_share(Node parent, const std::string& name, Making& making);

// Which materials may be made.
enum class Sides { any, reflecting };
void add_material(Node parent, Sides sides, Making& making, int depth = 0);

// Shapes in the order of the file; those that an irradiance meter may stand on.
std::vector<Node> add_shapes(Node scene, bool room, Making& making);
// Lights that belong to no shape. `needed`: at least one.
void add_lights(Node scene, bool needed, Making& making);
// `meters`: shapes for an irradiance meter.
void add_camera(Node scene, bool room, const std::vector<Node>& meters, Making& making);

}  // namespace neumann::search
