#include "core/reader/xml/grammar.h"

#include "core/base/did_you_mean.h"
#include "core/reader/xml/instead_of.h"
#include "core/reader/xml/problems.h"

#include <algorithm>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

enum class Kind { root, object, parameter, spectrum, transform, operation, instruction, top_instruction, reference };

struct Rule {
    std::string tag;
    Kind kind;
    std::vector<std::string> required, optional;
};

const std::vector<Rule>& rules() {
    static const std::vector<Rule> all = {
        {"scene", Kind::root, {"version"}, {}},
        {"alias", Kind::top_instruction, {"id", "as"}, {}},
        {"path", Kind::top_instruction, {"value"}, {}},
        {"default", Kind::instruction, {"name", "value"}, {}},
        {"include", Kind::instruction, {"filename"}, {}},
        {"ref", Kind::reference, {"id"}, {"name"}},
        {"bsdf", Kind::object, {"type"}, {"id", "name"}},
        {"emitter", Kind::object, {"type"}, {"id", "name"}},
        {"film", Kind::object, {"type"}, {"id", "name"}},
        {"integrator", Kind::object, {"type"}, {"id", "name"}},
        {"rfilter", Kind::object, {"type"}, {"id", "name"}},
        {"sampler", Kind::object, {"type"}, {"id", "name"}},
        {"sensor", Kind::object, {"type"}, {"id", "name"}},
        {"shape", Kind::object, {"type"}, {"id", "name"}},
        {"texture", Kind::object, {"type"}, {"id", "name"}},
        {"boolean", Kind::parameter, {"name", "value"}, {}},
        {"float", Kind::parameter, {"name", "value"}, {}},
        {"integer", Kind::parameter, {"name", "value"}, {}},
        {"point", Kind::parameter, {"name"}, {"value", "x", "y", "z"}},
        {"rgb", Kind::parameter, {"name", "value"}, {}},
        {"spectrum", Kind::spectrum, {"name"}, {"value", "filename", "type"}},
        {"string", Kind::parameter, {"name", "value"}, {}},
        {"transform", Kind::transform, {"name"}, {}},
        {"vector", Kind::parameter, {"name"}, {"value", "x", "y", "z"}},
        {"lookat", Kind::operation, {"origin", "target"}, {"up"}},
        {"matrix", Kind::operation, {"value"}, {}},
        {"rotate", Kind::operation, {"angle"}, {"value", "x", "y", "z"}},
        {"scale", Kind::operation, {}, {"value", "x", "y", "z"}},
        {"translate", Kind::operation, {}, {"value", "x", "y", "z"}},
    };
    return all;
}

const Rule* rule_of(std::string_view tag) {
    const auto found = std::find_if(rules().begin(), rules().end(), [&](const Rule& r) { return r.tag == tag; });
    return found == rules().end() ? nullptr : &*found;
}

bool allowed(Kind child, Kind parent) {
    switch (parent) {
        case Kind::root:
            return child == Kind::object || child == Kind::instruction || child == Kind::top_instruction;
        case Kind::object:
            return child != Kind::root && child != Kind::operation && child != Kind::top_instruction;
        case Kind::spectrum:
            return child == Kind::parameter;
        case Kind::transform:
            return child == Kind::operation;
        default:
            return false;
    }
}

}  // namespace

bool is_object(std::string_view tag) {
    const Rule* rule = rule_of(tag);
    return rule && rule->kind == Kind::object;
}

bool is_parameter(std::string_view tag) {
    const Rule* rule = rule_of(tag);
    return rule && (rule->kind == Kind::parameter || rule->kind == Kind::spectrum || rule->kind == Kind::transform);
}

void check_place(const Element& element, const std::string& parent_tag) {
    const Rule* rule = rule_of(element.tag);
    const Kind parent = rule_of(parent_tag)->kind;
    if (rule && allowed(rule->kind, parent)) return;
    if (const std::string_view advice = instead_of(element.tag, ""); !advice.empty())
        throw Unknown(element.place, fmt::format("<{}> is not supported", element.tag), fmt::format(": {}", advice), "left out");
    std::vector<std::string> tags;
    for (const Rule& r : rules())
        if (allowed(r.kind, parent)) tags.push_back(r.tag);
    std::sort(tags.begin(), tags.end());
    const std::string expected = tags.empty() ? "expected nothing inside" : allowed_instead(element.tag, tags);
    const std::string what = fmt::format("<{}> is not supported in <{}>", element.tag, parent_tag);
    if (!rule) throw Unknown(element.place, what, "; " + expected, "left out");
    throw InputError(element.place, what + "; " + expected);
}

void check_attributes(const Element& element) {
    const Rule& rule = *rule_of(element.tag);
    std::vector<std::string> names = rule.required;
    names.insert(names.end(), rule.optional.begin(), rule.optional.end());
    std::vector<std::string> seen;
    for (const Attribute& a : element.attributes) {
        if (std::find(names.begin(), names.end(), a.name) == names.end())
            throw InputError(
                a.place, fmt::format("unknown attribute '{}' of <{}>; {}", a.name, element.tag, allowed_instead(a.name, names)));
        if (std::find(seen.begin(), seen.end(), a.name) != seen.end())
            throw InputError(a.place, fmt::format("attribute '{}' of <{}> is given twice", a.name, element.tag));
        seen.push_back(a.name);
    }
    for (const std::string& name : rule.required) element.attribute(name);
}

}  // namespace neumann::reader
