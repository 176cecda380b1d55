// The objects of a document by their ids.
#pragma once

#include "core/reader/element.h"

#include <map>

namespace neumann::reader {

class Objects {
public:
    // Registers objects at any depth, and aliases. Throws InputError for an id given twice.
    explicit Objects(const Element& root);

    // The object that <ref id=…> means; throws InputError if there is none.
    const Element& find(const Attribute& id, const std::string& what = "reference to") const;

private:
    void add(const Element& e);
    void add(const Attribute& id, const Element& e);
    struct Entry {
        const Element* object;
        Location place;
    };
    std::map<std::string, Entry> entries_;
};

}  // namespace neumann::reader
