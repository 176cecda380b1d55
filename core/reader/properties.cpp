#include "core/reader/properties.h"

#include "core/reader/grammar.h"
#include "core/reader/numbers.h"
#include "core/reader/transform.h"

#include <algorithm>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

std::string with_article(const std::string& type) {
    return (type.find_first_of("aeiou") == 0 || type == "rgb" ? "an " : "a ") + type;
}

// "a, b or c".
std::string join_or(const std::vector<std::string>& names) {
    if (names.size() < 2) return join(names);
    return join({names.begin(), names.end() - 1}) + " or " + names.back();
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

Properties::Properties(const Element& element, const Objects& objects)
    : element_(element), objects_(objects), title_(fmt::format("{} '{}'", element.tag, element.attribute("type").value)) {
    std::map<std::string, const Element*> seen;
    for (const Element& e : element.children) {
        if (!is_parameter(e.tag)) continue;
        const Attribute& name = e.attribute("name");
        const auto [first, is_new] = seen.try_emplace(name.value, &e);
        if (!is_new)
            throw InputError(name.place, fmt::format("parameter '{}' of {} is given twice, first at {}", name.value, title_,
                                                     to_string(first->second->place)));
    }
}

const Element* Properties::parameter(const std::string& name) const {
    for (const Element& e : element_.children)
        if (is_parameter(e.tag) && e.attribute("name").value == name) return &e;
    return nullptr;
}

const Element* Properties::find(const std::string& name, const std::vector<std::string>& types) {
    if (!contains(asked_, name)) asked_.push_back(name);
    const Element* e = parameter(name);
    if (!e) return nullptr;
    if (!contains(types, e->tag))
        throw InputError(
            e->place, fmt::format("parameter '{}' of {} is {}, expected {}", name, title_, with_article(e->tag), join_or(types)));
    read_.insert(e);
    return e;
}

const Element& Properties::require(const std::string& name, const std::vector<std::string>& types) {
    if (const Element* e = find(name, types)) return *e;
    throw InputError(element_.place, fmt::format("{} lacks the parameter '{}', expected {}", title_, name, join_or(types)));
}

std::optional<double> Properties::number(const std::string& name) {
    const Element* e = find(name, {"float", "integer"});
    return e ? std::optional(e->tag == "integer" ? static_cast<double>(parse_integer(e->attribute("value")))
                                                 : parse_number(e->attribute("value")))
             : std::nullopt;
}

std::optional<std::int64_t> Properties::integer(const std::string& name) {
    const Element* e = find(name, {"integer"});
    return e ? std::optional(parse_integer(e->attribute("value"))) : std::nullopt;
}

std::optional<bool> Properties::boolean(const std::string& name) {
    const Element* e = find(name, {"boolean"});
    return e ? std::optional(parse_boolean(e->attribute("value"))) : std::nullopt;
}

std::optional<std::string> Properties::text(const std::string& name) {
    const Element* e = find(name, {"string"});
    return e ? std::optional(e->attribute("value").value) : std::nullopt;
}

std::string Properties::choice(const std::string& name, const std::vector<std::string>& allowed, const std::string& missing) {
    const std::string value = text(name).value_or(missing);
    if (!contains(allowed, value)) fail(name, fmt::format("{} is '{}'; allowed: {}", name, value, join(allowed)));
    return value;
}

std::optional<Vec3> Properties::point(const std::string& name) {
    const Element* e = find(name, {"point", "vector"});
    if (!e) return std::nullopt;
    if (!e->find("value"))
        for (const char* axis : {"x", "y", "z"}) e->attribute(axis);
    return parse_xyz(*e, 0.0);
}

Mat4 Properties::transform(const std::string& name) {
    const Element* e = find(name, {"transform"});
    if (!e) return Mat4(1.0);
    const Mat4 m = parse_transform(*e);
    if (!is_invertible(m)) throw InputError(e->place, fmt::format("{} of {} has no inverse", name, title_));
    return m;
}

const Element* Properties::object(const std::string& name, const std::string& tag) {
    if (!contains(asked_, name)) asked_.push_back(name);
    const Element *first = parameter(name), *found = nullptr;
    for (const Element& e : element_.children) {
        const Attribute* given = is_parameter(e.tag) ? nullptr : e.find("name");
        if (!given || given->value != name) continue;
        const Element& object = e.tag == "ref" ? objects_.find(e.attribute("id")) : e;
        if (object.tag != tag) continue;
        if (first)
            throw InputError(given->place, fmt::format("parameter '{}' of {} is given twice, first at {}", name, title_,
                                                       to_string(first->attribute("name").place)));
        read_.insert(&e);
        first = &e;
        found = &object;
    }
    return found;
}

std::vector<const Element*> Properties::nested(const std::string& tag, std::size_t limit) {
    if (!contains(asked_tags_, tag)) asked_tags_.push_back(tag);
    std::vector<const Element*> found;
    for (const Element& e : element_.children) {
        if (is_parameter(e.tag)) continue;
        const Element& object = e.tag == "ref" ? objects_.find(e.attribute("id")) : e;
        if (object.tag != tag) continue;
        if (found.size() == limit)
            throw InputError(e.place, fmt::format("{} has more than {} <{}>", title_, limit == 1 ? "one" : "two", tag));
        read_.insert(&e);
        found.push_back(&object);
    }
    return found;
}

void Properties::fail(const std::string& name, const std::string& what) const {
    const Element* e = parameter(name);
    const Attribute* value = e ? e->find("value") : nullptr;
    throw InputError(value ? value->place : e ? e->place : element_.place, what);
}

void Properties::finish() const {
    for (const Element& e : element_.children) {
        if (read_.count(&e)) continue;
        if (is_parameter(e.tag)) {
            const Attribute& name = e.attribute("name");
            throw InputError(name.place, fmt::format("unknown parameter '{}' of {}; {}", name.value, title_,
                                                     asked_.empty() ? "it has none" : "allowed: " + join(asked_)));
        }
        const bool is_reference = e.tag == "ref";
        const Element& object = is_reference ? objects_.find(e.attribute("id")) : e;
        const Attribute* name = object.tag == "texture" && !contains(asked_tags_, "texture") ? e.find("name") : nullptr;
        if (name && contains(asked_, name->value))
            throw InputError(name->place,
                             fmt::format("parameter '{}' of {} is a texture, which is not supported there", name->value, title_));
        if (name)
            throw InputError(name->place, fmt::format("unknown parameter '{}' of {}; {}", name->value, title_,
                                                      asked_.empty() ? "it has none" : "allowed: " + join(asked_)));
        throw InputError(e.place,
                         fmt::format("unexpected {}<{}> in {}; {}", is_reference ? "reference to a " : "", object.tag, title_,
                                     asked_tags_.empty() ? "nothing is nested in it" : "allowed: " + join(asked_tags_)));
    }
}

void fail_type(const Element& e, const std::vector<std::string>& allowed) {
    const Attribute& type = e.attribute("type");
    throw InputError(type.place, fmt::format("{} type '{}' is not supported; allowed: {}", e.tag, type.value, join(allowed)));
}

}  // namespace neumann::reader
