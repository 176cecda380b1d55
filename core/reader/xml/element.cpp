#include "core/reader/xml/element.h"

#include "core/reader/xml/problems.h"

#include <algorithm>

namespace neumann::reader {

const Attribute* Element::find(std::string_view name) const {
    const auto found = std::find_if(attributes.begin(), attributes.end(), [&](const Attribute& a) { return a.name == name; });
    return found == attributes.end() ? nullptr : &*found;
}

const Attribute& Element::attribute(std::string_view name) const {
    if (const Attribute* a = find(name)) return *a;
    if (broken) throw AlreadyReported();
    throw InputError(place, "<" + tag + "> lacks the attribute '" + std::string(name) + "'");
}

std::string join(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

}  // namespace neumann::reader
