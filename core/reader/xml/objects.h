// The objects of a document by their ids.
#pragma once

#include "core/reader/xml/element.h"
#include "core/reader/xml/problems.h"

#include <map>
#include <set>

namespace neumann::reader {

// The limit for textures, and materials, inside each other: as deep as elements in a file may stand, but by references as well.
inline constexpr std::size_t max_nesting = 100;

// Ids of what could not be read.
struct LostIds {
    std::set<std::string> ids;
    bool others = false;  // there may be more, whose ids are unknown
};

class Objects {
public:
    // Registers objects at any depth, and aliases. An id that is given twice is a problem.
    Objects(const Element& root, Problems& problems, LostIds lost = {});

    // The object to which <ref id=…> refers; throws InputError if there is none.
    const Element& find(const Attribute& id, const std::string& what = "reference to") const;
    // Whether the object with this id could not be read.
    bool is_lost(const Attribute& id) const { return lost_.ids.contains(id.value); }
    // The object to which a <ref> refers, or null.
    const Element* known(const Element& reference) const;

    Problems& problems() const { return problems_; }

private:
    void add(const Element& e);
    void add(const Attribute& id, const Element& e);
    struct Entry {
        const Element* object;
        Location place;
    };
    Problems& problems_;
    LostIds lost_;
    std::map<std::string, Entry> entries_;
};

}  // namespace neumann::reader
