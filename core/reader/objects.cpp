#include "core/reader/objects.h"

#include "core/reader/grammar.h"

#include <fmt/format.h>

namespace neumann::reader {

Objects::Objects(const Element& root) {
    add(root);
    for (const Element& e : root.children)
        if (e.tag == "alias") add(e.attribute("as"), find(e.attribute("id"), "alias of"));
}

void Objects::add(const Element& e) {
    if (const Attribute* id = is_object(e.tag) ? e.find("id") : nullptr) add(*id, e);
    for (const Element& child : e.children) add(child);
}

void Objects::add(const Attribute& id, const Element& e) {
    const auto [entry, is_new] = entries_.try_emplace(id.value, Entry{&e, id.place});
    if (!is_new)
        throw InputError(id.place, fmt::format("the id '{}' is taken already, at {}", id.value, to_string(entry->second.place)));
}

const Element& Objects::find(const Attribute& id, const std::string& what) const {
    const auto found = entries_.find(id.value);
    if (found != entries_.end()) return *found->second.object;
    std::vector<std::string> ids;
    for (const auto& [name, entry] : entries_) ids.push_back(name);
    throw InputError(id.place, fmt::format("{} '{}', which is not defined; {}", what, id.value,
                                           ids.empty() ? "no object has an id" : "defined: " + join(ids)));
}

}  // namespace neumann::reader
