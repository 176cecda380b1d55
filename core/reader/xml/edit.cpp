#include "core/reader/xml/edit.h"

#include "core/base/did_you_mean.h"
#include "core/reader/xml/grammar.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

namespace neumann::reader {

namespace {

std::string value_of(const Element& e, std::string_view attribute) {
    const Attribute* found = e.find(attribute);
    return found ? found->value : "";
}

void for_objects(Element& parent, const std::function<void(Element&)>& each) {
    for (Element& e : parent.children)
        if (is_object(e.tag)) {
            each(e);
            for_objects(e, each);
        }
}

Element* with_id(Element& root, const std::string& id) {
    Element* found = nullptr;
    for_objects(root, [&](Element& e) { found = !found && value_of(e, "id") == id ? &e : found; });
    return found;
}

// The only object of the scene with this tag and without an id.
Element* alone(Element& root, const std::string& tag) {
    Element* found = nullptr;
    for (Element& e : root.children) {
        if (e.tag != tag || !is_object(tag) || e.find("id")) continue;
        if (found) return nullptr;
        found = &e;
    }
    return found;
}

Element* inside(Element& root, Element& parent, const std::string& part) {
    for (Element& e : parent.children) {
        Element* const object = e.tag == "ref" ? with_id(root, value_of(e, "id")) : is_object(e.tag) ? &e : nullptr;
        if (object && (value_of(e, "name") == part || value_of(e, "id") == part || (!e.find("name") && object->tag == part)))
            return object;
    }
    return nullptr;
}

std::vector<std::string> parts_of(const std::string& name) {
    std::vector<std::string> parts(1);
    for (const char c : name) {
        if (c == '.')
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

// Whether the tag is that of a number.
bool is_number(const std::string& tag) { return tag == "float" || tag == "integer"; }

Element parameter(const std::string& name, const Edit& edit, const std::string& before, const Location& place) {
    const auto attribute = [&](const char* key, const std::string& value) { return Attribute{key, value, place}; };
    if (edit.tag == "transform")
        return {edit.tag, {attribute("name", name)}, {Element{"matrix", {attribute("value", edit.value)}, {}, place}}, place};
    const bool is_whole = edit.value.find_first_of(".e") == std::string::npos;
    const bool stays = edit.tag == "rgb" ? before == "point" || before == "vector"
                                         : is_number(edit.tag) && (before == "float" || (before == "integer" && is_whole));
    // A number in place of a colour is grey.
    const bool is_grey = edit.tag == "integer" && (before == "rgb" || before == "spectrum" || before == "texture");
    return {stays ? before : is_grey ? "float" : edit.tag, {attribute("name", name), attribute("value", edit.value)}, {}, place};
}

}  // namespace

void apply(const Edit& edit, Element& root) {
    std::vector<std::string> parts = parts_of(edit.name);
    const bool has_value = parts.size() > 2 && parts.back() == "value";
    if (has_value) parts.pop_back();
    if (parts.size() < 2)
        throw InputError(fmt::format("{}: expected an object and a parameter, as in white.reflectance.value", edit.name));
    // An id may contain dots.
    Element* object = nullptr;
    for (std::size_t n = parts.size() - 1; n > 0 && !object; --n) {
        const auto end = parts.begin() + static_cast<std::ptrdiff_t>(n);
        const std::string id = fmt::format("{}", fmt::join(parts.begin(), end, "."));
        object = with_id(root, id);
        if (!object) continue;
        parts.erase(parts.begin() + 1, end);
        parts[0] = id;
    }
    if (!object) object = alone(root, parts[0]);
    if (!object) {
        std::vector<std::string> ids;
        for_objects(root, [&](Element& e) {
            if (e.find("id")) ids.push_back(value_of(e, "id"));
        });
        throw InputError(fmt::format("{}: nothing has the id '{}'; {}", edit.name, parts[0],
                                     ids.empty() ? "nothing has one" : allowed_instead(parts[0], ids)));
    }
    std::string so_far = parts[0];
    for (std::size_t i = 1; i + 1 < parts.size(); ++i) {
        Element* const next = inside(root, *object, parts[i]);
        if (!next) throw InputError(fmt::format("{}: {} has no '{}' inside", edit.name, so_far, parts[i]));
        object = next;
        so_far += "." + parts[i];
    }
    const auto found =
        std::ranges::find_if(object->children, [&](const Element& e) { return value_of(e, "name") == parts.back(); });
    if (found == object->children.end()) {
        if (has_value)
            throw InputError(fmt::format("{}: {} has no '{}'; to add it leave out .value", edit.name, so_far, parts.back()));
        object->children.push_back(parameter(parts.back(), edit, "", object->place));
        return;
    }
    if (has_value && !is_parameter(found->tag))
        throw InputError(fmt::format("{}: that is <{}> and no value; to replace it leave out .value", edit.name, found->tag));
    *found = parameter(parts.back(), edit, found->tag, found->place);
}

}  // namespace neumann::reader
