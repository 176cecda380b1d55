#include "core/reader/xml/objects.h"

#include "core/reader/xml/grammar.h"

#include <fmt/format.h>

namespace neumann::reader {

Objects::Objects(const Element& root, Problems& problems, LostIds lost) : problems_(problems), lost_(std::move(lost)) {
    add(root);
    for (const Element& e : root.children) {
        if (e.tag != "alias") continue;
        const Attribute *as = e.find("as"), *id = e.find("id");
        if (problems_.lenient() && as && id && is_lost(*id)) {
            problems_.add(Unknown(id->place, fmt::format("alias of '{}', which is left out", id->value), "", "left out"), e.place);
            lost_.ids.insert(as->value);
            continue;
        }
        if (e.broken || !problems_.attempt(e.place, [&] { add(*as, find(e.attribute("id"), "alias of")); }))
            if (as) lost_.ids.insert(as->value);
    }
}

void Objects::add(const Element& e) {
    if (const Attribute* id = is_object(e.tag) ? e.find("id") : nullptr) problems_.attempt(e.place, [&] { add(*id, e); });
    for (const Element& child : e.children) add(child);
}

void Objects::add(const Attribute& id, const Element& e) {
    const auto [entry, is_new] = entries_.try_emplace(id.value, Entry{&e, id.place});
    if (!is_new)
        throw InputError(id.place, fmt::format("the id '{}' is taken already, at {}", id.value, to_string(entry->second.place)));
}

const Element* Objects::known(const Element& reference) const {
    const Attribute* id = reference.find("id");
    const auto found = id ? entries_.find(id->value) : entries_.end();
    return found != entries_.end() ? found->second.object : nullptr;
}

const Element& Objects::find(const Attribute& id, const std::string& what) const {
    const auto found = entries_.find(id.value);
    if (found != entries_.end()) return *found->second.object;
    if (lost_.others || lost_.ids.count(id.value)) throw AlreadyReported();
    std::vector<std::string> ids;
    for (const auto& [name, entry] : entries_) ids.push_back(name);
    throw InputError(id.place, fmt::format("{} '{}', which is not defined; {}", what, id.value,
                                           ids.empty() ? "no object has an id" : "defined: " + join(ids)));
}

}  // namespace neumann::reader
