#include "core/reader/xml/properties.h"

#include "core/base/did_you_mean.h"
#include "core/base/printable.h"
#include "core/reader/xml/grammar.h"
#include "core/reader/xml/instead_of.h"
#include "core/reader/xml/numbers.h"
#include "core/reader/xml/transform.h"

#include <algorithm>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

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
    if (element.broken) throw AlreadyReported();
    std::map<std::string, const Element*> seen;
    for (const Element& e : element.children) {
        const Attribute* name = e.find("name");
        if (e.broken && is_parameter(e.tag) && name) spoilt_.insert(name->value);
        if (e.broken && !(is_parameter(e.tag) && name) && !is_object(e.tag)) incomplete_ = true;
        if (!is_parameter(e.tag) || !name) continue;
        const auto [first, is_new] = seen.try_emplace(name->value, &e);
        if (is_new) continue;
        add(name->place,
            fmt::format("parameter '{}' of {} is given twice, first at {}", name->value, title_, to_string(first->second->place)));
        read_.insert(&e);
    }
}

void Properties::add(const Location& place, const std::string& what) {
    problems().add(InputError(place, what), element_.place);
    reported_ = true;
}

void Properties::refuse(const Location& place, const std::string& what, const std::string& expected) {
    problems().add(Unknown(place, what, expected, "ignored"), element_.place);
    reported_ = reported_ || !problems().lenient();
}

const Element* Properties::parameter(const std::string& name) const {
    for (const Element& e : element_.children)
        if (const Attribute* given = is_parameter(e.tag) ? e.find("name") : nullptr; given && given->value == name) return &e;
    return nullptr;
}

const Element* Properties::resolve(const Element& e) {
    if (e.tag != "ref") return &e;
    if (e.broken) return nullptr;
    const Attribute& id = e.attribute("id");
    if (problems().lenient() && objects_.is_lost(id)) {
        problems().add(
            Unknown(id.place, fmt::format("reference to '{}' in {}, which is left out", id.value, title_), "", "ignored"),
            element_.place);
        read_.insert(&e);
        return nullptr;
    }
    const Element* object = nullptr;
    if (!problems().attempt(element_.place, [&] { object = &objects_.find(id); })) reported_ = incomplete_ = true;
    return object;
}

const Element* Properties::find(const std::string& name, const std::vector<std::string>& types) {
    if (!contains(queried_, name)) queried_.push_back(name);
    const Element* e = parameter(name);
    if (!e || e->broken) return nullptr;
    if (contains(types, e->tag)) {
        read_.insert(e);
        return e;
    }
    if (read_.insert(e).second)
        add(e->place, fmt::format("parameter '{}' of {} is {}, expected {}", name, title_, with_article(e->tag), join_or(types)));
    spoilt_.insert(name);
    return nullptr;
}

const Element& Properties::require(const std::string& name, const std::vector<std::string>& types) {
    if (const Element* e = find(name, types)) return *e;
    if (incomplete_ || spoilt_.count(name)) throw AlreadyReported();
    throw InputError(element_.place, fmt::format("{} lacks the parameter '{}', expected {}", title_, name, join_or(types)));
}

std::optional<double> Properties::number(const std::string& name) {
    const Element* e = find(name, {"float", "integer"});
    if (!e) return std::nullopt;
    const Attribute& value = e->attribute("value");
    return attempt(name, [&] { return e->tag == "integer" ? static_cast<double>(parse_integer(value)) : parse_number(value); });
}

std::optional<std::int64_t> Properties::integer(const std::string& name) {
    const Element* e = find(name, {"integer"});
    return e ? attempt(name, [&] { return parse_integer(e->attribute("value")); }) : std::nullopt;
}

std::optional<bool> Properties::boolean(const std::string& name) {
    const Element* e = find(name, {"boolean"});
    return e ? attempt(name, [&] { return parse_boolean(e->attribute("value")); }) : std::nullopt;
}

std::optional<std::string> Properties::text(const std::string& name) {
    const Element* e = find(name, {"string"});
    return e ? std::optional(e->attribute("value").value) : std::nullopt;
}

std::string Properties::choice(const std::string& name, const std::vector<std::string>& allowed, const std::string& missing) {
    const std::string value = text(name).value_or(missing);
    if (contains(allowed, value)) return value;
    refuse_word(name, fmt::format("{} is '{}'", name, value), fmt::format("; {}", allowed_instead(value, allowed)));
    return missing;
}

std::optional<Vec3> Properties::point(const std::string& name) {
    const Element* e = find(name, {"point", "vector"});
    if (!e) return std::nullopt;
    return attempt(name, [&] {
        if (!e->find("value"))
            for (const char* axis : {"x", "y", "z"}) e->attribute(axis);
        return parse_xyz(*e, 0.0);
    });
}

Mat4 Properties::transform(const std::string& name) {
    const Element* e = find(name, {"transform"});
    if (!e) return Mat4(1.0);
    return attempt(name,
                   [&] {
                       const Mat4 m = parse_transform(*e);
                       if (!is_invertible(m)) throw InputError(e->place, fmt::format("{} of {} has no inverse", name, title_));
                       return m;
                   })
        .value_or(Mat4(1.0));
}

const Element* Properties::object(const std::string& name, const std::string& tag) {
    if (!contains(queried_, name)) queried_.push_back(name);
    const Element *first = parameter(name), *found = nullptr;
    for (const Element& e : element_.children) {
        const Attribute* given = is_parameter(e.tag) ? nullptr : e.find("name");
        if (!given || given->value != name) continue;
        const Element* object = resolve(e);
        if (!object && !read_.contains(&e)) spoilt_.insert(name);
        if (!object || object->tag != tag) continue;
        if (first) {
            add(given->place, fmt::format("parameter '{}' of {} is given twice, first at {}", name, title_,
                                          to_string(first->attribute("name").place)));
            read_.insert(first);
        }
        read_.insert(&e);
        first = &e;
        found = object;
    }
    return found;
}

std::vector<const Element*> Properties::nested(const std::string& tag, std::size_t limit) {
    if (!contains(queried_tags_, tag)) queried_tags_.push_back(tag);
    std::vector<const Element*> found;
    for (const Element& e : element_.children) {
        if (is_parameter(e.tag)) continue;
        const Element* object = resolve(e);
        if (!object || object->tag != tag) continue;
        read_.insert(&e);
        if (found.size() == limit)
            add(e.place, fmt::format("{} has more than {} <{}>", title_, limit == 1 ? "one" : "two", tag));
        else
            found.push_back(object);
    }
    return found;
}

std::vector<const Element*> Properties::all_nested(const std::vector<std::string>& tags) {
    for (const std::string& tag : tags)
        if (!contains(queried_tags_, tag)) queried_tags_.push_back(tag);
    std::vector<const Element*> found;
    for (const Element& e : element_.children) {
        if (is_parameter(e.tag)) continue;
        const Element* object = resolve(e);
        if (!object || !contains(tags, object->tag)) continue;
        read_.insert(&e);
        found.push_back(object);
    }
    return found;
}

Location Properties::place_of(const std::string& name) const {
    const Element* e = parameter(name);
    const Attribute* value = e ? e->find("value") : nullptr;
    return value ? value->place : e ? e->place : element_.place;
}

void Properties::complain(const std::string& name, const std::string& what, const std::vector<std::string>& beside) {
    const bool is_first = std::none_of(beside.begin(), beside.end(), [&](const std::string& n) { return spoilt_.count(n) > 0; });
    if (spoilt_.insert(name).second && is_first) add(place_of(name), what);
}

void Properties::fail(const std::string& name, const std::string& what) const {
    if (reported_ || !spoilt_.empty()) throw AlreadyReported();
    throw InputError(place_of(name), what);
}

void Properties::fail_empty(const std::string& what) const {
    if (incomplete_) throw AlreadyReported();
    throw InputError(element_.place, what);
}

void Properties::refuse_word(const std::string& name, const std::string& what, const std::string& expected) {
    if (spoilt_.count(name)) return;
    if (!problems().lenient()) spoilt_.insert(name);
    refuse(place_of(name), what, expected);
}

void Properties::refuse_rest() {
    for (const Element& e : element_.children) {
        if (e.broken || !read_.insert(&e).second) continue;
        const auto unknown = [&](const Attribute& name) {
            refuse(name.place, fmt::format("unknown parameter '{}' of {}", name.value, title_),
                   "; " + (queried_.empty() ? "it has none" : allowed_instead(name.value, queried_)));
        };
        if (is_parameter(e.tag)) {
            unknown(e.attribute("name"));
            continue;
        }
        const Element* object = resolve(e);
        if (!object) continue;
        const Attribute* name = object->tag == "texture" && !contains(queried_tags_, "texture") ? e.find("name") : nullptr;
        if (name && contains(queried_, name->value))
            refuse(name->place, fmt::format("parameter '{}' of {} is a texture, which is not supported there", name->value, title_),
                   "");
        else if (name)
            unknown(*name);
        else
            refuse(e.place, fmt::format("unexpected {}<{}> in {}", e.tag == "ref" ? "reference to a " : "", object->tag, title_),
                   queried_tags_.empty() ? "; nothing is nested in it" : "; allowed: " + join(queried_tags_));
    }
}

void Properties::finish() {
    refuse_rest();
    if (reported_ || !spoilt_.empty()) throw AlreadyReported();
}

void fail_type(const Element& e, const std::vector<std::string>& allowed, const std::string& instead) {
    if (e.broken) throw AlreadyReported();
    const Attribute& type = e.attribute("type");
    const std::string_view advice = instead_of(e.tag, type.value);
    throw Unknown(type.place, fmt::format("{} type '{}' is not supported", e.tag, type.value),
                  advice.empty() ? "; " + allowed_instead(type.value, allowed) : fmt::format(": {}", advice), instead);
}

std::string type_of(const Element& e, const std::vector<std::string>& allowed, const std::string& otherwise, Problems& problems) {
    const std::string& type = e.attribute("type").value;
    if (contains(allowed, type)) return type;
    try {
        fail_type(e, allowed, fmt::format("taken as '{}'", otherwise));
    } catch (const Unknown& unknown) {
        problems.replace(unknown, e.place);
    }
    return otherwise;
}

}  // namespace neumann::reader
