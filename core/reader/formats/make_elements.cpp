#include "core/reader/formats/make_elements.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace neumann::reader {

namespace {

std::string as_it_is(const std::string& text) {
    std::string escaped;
    for (const char c : text) escaped += c == '$' ? "\\$" : std::string(1, c);
    return escaped;
}

Element& add_parameter(Element& parent, const std::string& tag, const std::string& name, const std::string& value,
                       const Location& place) {
    return add(parent, {tag, {{"name", as_it_is(name), place}, {"value", value, place}}, {}, place});
}

void add_matrix_text(Element& parent, const std::string& name, const std::string& rows, const Location& place) {
    Element& transform = add(parent, {"transform", {{"name", as_it_is(name), place}}, {}, place});
    add(transform, {"matrix", {{"value", rows, place}}, {}, place});
}

void add_default(Element& scene, const std::string& definition, const std::string& value, const Location& place) {
    Element given{"default", {{"name", definition, place}, {"value", as_it_is(value), place}}, {}, place};
    const auto others =
        std::find_if(scene.children.begin(), scene.children.end(), [](const Element& e) { return e.tag != "default"; });
    scene.children.insert(others, std::move(given));  // before the elements that use it
}

std::string numbers(std::initializer_list<double> values) {
    std::string text;
    for (const double v : values) text += fmt::format("{}{}", text.empty() ? "" : ", ", v);
    return text;
}

}  // namespace

Element make_scene_element(const Location& place) { return {"scene", {{"version", "3.0.0", place}}, {}, place}; }

Element make_object(const std::string& tag, const std::string& type, const Location& place, const std::string& id) {
    Element e{tag, {{"type", type, place}}, {}, place};
    if (!id.empty()) e.attributes.push_back({"id", as_it_is(id), place});
    return e;
}

Element& add(Element& parent, Element child) { return parent.children.emplace_back(std::move(child)); }

void add_reference(Element& parent, const std::string& id, const Location& place, const std::string& name) {
    Element& e = add(parent, {"ref", {{"id", as_it_is(id), place}}, {}, place});
    if (!name.empty()) e.attributes.push_back({"name", name, place});
}

void add_float(Element& parent, const std::string& name, double value, const Location& place) {
    add_parameter(parent, "float", name, fmt::format("{}", value), place);
}

void add_integer(Element& parent, const std::string& name, std::int64_t value, const Location& place) {
    add_parameter(parent, "integer", name, fmt::format("{}", value), place);
}

void add_boolean(Element& parent, const std::string& name, bool value, const Location& place) {
    add_parameter(parent, "boolean", name, value ? "true" : "false", place);
}

void add_string(Element& parent, const std::string& name, const std::string& value, const Location& place) {
    add_parameter(parent, "string", name, as_it_is(value), place);
}

void add_rgb(Element& parent, const std::string& name, const Rgb& value, const Location& place) {
    add_parameter(parent, "rgb", name, numbers({value.r, value.g, value.b}), place);
}

void add_point(Element& parent, const std::string& name, const Vec3& value, const Location& place) {
    add_parameter(parent, "point", name, numbers({value.x, value.y, value.z}), place);
}

void add_vector(Element& parent, const std::string& name, const Vec3& value, const Location& place) {
    add_parameter(parent, "vector", name, numbers({value.x, value.y, value.z}), place);
}

void add_matrix(Element& parent, const std::string& name, const Mat4& value, const Location& place) {
    add_matrix_text(parent, name, matrix_text(value), place);
}

void add_defined(Element& scene, Element& parent, const std::string& tag, const std::string& name, const std::string& definition,
                 const std::string& value, const Location& place) {
    add_default(scene, definition, value, place);
    add_parameter(parent, tag, name, "$" + definition, place);
}

void add_defined_type(Element& scene, Element& object, const std::string& definition, const std::string& type) {
    add_default(scene, definition, type, object.place);
    object.attributes.front().value = "$" + definition;
}

void add_defined_matrix(Element& scene, Element& parent, const std::string& name, const std::string& definition, const Mat4& value,
                        const Location& place) {
    add_default(scene, definition, matrix_text(value), place);
    add_matrix_text(parent, name, "$" + definition, place);
}

std::string matrix_text(const Mat4& m) {
    std::string rows;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) rows += fmt::format("{}{}", rows.empty() ? "" : " ", m[column][row]);
    return rows;
}

}  // namespace neumann::reader
