#include "core/reader/formats/collada/file.h"

#include "core/base/did_you_mean.h"
#include "core/reader/formats/collada/texts.h"
#include "core/reader/formats/percent_encoding.h"
#include "core/reader/xml/parse_xml.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace neumann::reader::collada {

const Element* child(const Element& e, std::string_view tag) {
    const auto found = std::find_if(e.children.begin(), e.children.end(), [&](const Element& c) { return c.tag == tag; });
    return found != e.children.end() ? &*found : nullptr;
}

const Element& required_child(const Element& e, std::string_view tag) {
    if (const Element* found = child(e, tag)) return *found;
    throw InputError(e.place, fmt::format("<{}> has no <{}> inside, expected one", e.tag, tag));
}

const Attribute& required_attribute(const Element& e, std::string_view name) {
    if (const Attribute* found = e.find(name)) return *found;
    throw InputError(e.place, fmt::format("<{}> lacks the attribute '{}'", e.tag, name));
}

void check_children(const Element& e, std::span<const std::string> known, Problems& problems) {
    for (const Element& c : e.children) {
        if (std::find(known.begin(), known.end(), c.tag) != known.end()) continue;
        std::string hint = did_you_mean(c.tag, known);
        if (hint.empty()) hint = "; allowed: " + join({known.begin(), known.end()});
        problems.add(Unknown(c.place, fmt::format("unknown element <{}> in <{}>", c.tag, e.tag), hint, "left out"), c.place);
    }
}

namespace {

bool is_course_profile(const Element& technique) {
    const Attribute* profile = technique.find("profile");
    return technique.tag == "technique" && profile && (profile->value == "CMU462" || profile->value == "CGL");
}

bool is_same(const Element& a, const Element& b) {
    return a.tag == b.tag && a.text == b.text &&
           std::ranges::equal(a.attributes, b.attributes,
                              [](const Attribute& x, const Attribute& y) { return x.name == y.name && x.value == y.value; }) &&
           std::ranges::equal(a.children, b.children, is_same);
}

void check_root(const Element& root) {
    if (root.tag != "COLLADA")
        throw InputError(root.place, fmt::format("the outermost element is <{}>, expected <COLLADA>", root.tag));
    const Attribute* version = root.find("version");
    if (version && !version->value.starts_with("1.4") && !version->value.starts_with("1.5"))
        throw InputError(version->place, fmt::format("COLLADA version {} is not known, expected 1.4 or 1.5", version->value));
}

}  // namespace

const Element* course_technique(const Element& e) {
    for (const Element& extra : e.children)
        if (extra.tag == "extra")
            for (const Element& technique : extra.children)
                if (is_course_profile(technique)) return &technique;
    return nullptr;
}

int up_axis(const Element& root) {
    const Element* asset = child(root, "asset");
    const Element* axis = asset ? child(*asset, "up_axis") : nullptr;
    if (!axis) return 1;
    const std::string text = trimmed_text(*axis);
    if (text == "X_UP") return 0;
    if (text == "Y_UP") return 1;
    if (text == "Z_UP") return 2;
    throw InputError(axis->place, fmt::format("the up axis is '{}', expected X_UP, Y_UP or Z_UP", text));
}

File::File(Element root) : root_(std::move(root)) {
    check_root(root_);
    add(root_, 0);
}

void File::add(const Element& e, int depth) {
    if (depth > max_element_depth)
        throw InputError(e.place, fmt::format("elements are nested more than {} deep", max_element_depth));
    if (const Attribute* id = e.find("id")) elements_[e.tag].emplace(id->value, &e);
    is_of_course_ = is_of_course_ || is_course_profile(e);
    for (const Element& c : e.children) add(c, depth + 1);
}

const Element* File::known(const std::string& id, const std::string& tag) const {
    const auto of_tag = elements_.find(tag);
    if (of_tag == elements_.end()) return nullptr;
    const auto found = of_tag->second.find(id);
    return found != of_tag->second.end() ? found->second : nullptr;
}

const Element& File::find(const Attribute& url, const std::string& tag) const {
    const std::size_t hash = url.value.find('#');
    if (hash != std::string::npos && hash > 0)
        throw InputError(url.place, fmt::format("'{}' is in another file, expected '#' and an id of this one", url.value));
    const std::string given = url.value.substr(hash == 0 ? 1 : 0);
    const auto of_tag = elements_.find(tag);
    if (of_tag == elements_.end())
        throw InputError(url.place, fmt::format("there is no <{}> '{}'; the file has none with an id", tag, given));
    const auto& ids = of_tag->second;
    const std::string id = ids.contains(given) ? given : percent_decoded(given);
    const auto [first, last] = ids.equal_range(id);
    if (first == last) {
        std::vector<std::string> names;
        for (const auto& [name, e] : ids) names.push_back(name);
        throw InputError(url.place, fmt::format("there is no <{}> '{}'{}", tag, given, did_you_mean(given, names)));
    }
    // Some programs write the same element twice.
    const Element& found = *first->second;
    if (std::any_of(std::next(first), last, [&](const auto& other) { return !is_same(*other.second, found); }))
        throw InputError(url.place, fmt::format("there are several <{}> '{}', at {} and at {}, expected one", tag, id,
                                                to_string(found.place), to_string(std::next(first)->second->place)));
    return found;
}

}  // namespace neumann::reader::collada
