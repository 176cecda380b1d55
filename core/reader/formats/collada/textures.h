// Follows a <texture>, by way of a sampler and a surface, to a picture.
#pragma once

#include "core/reader/formats/collada/import.h"

#include <map>
#include <string>

namespace neumann::reader::collada {

// The <newparam>s of an effect, by sid.
class Parameters {
public:
    explicit Parameters(const Element& effect);
    // Throws InputError if there is none.
    const Element& find(const std::string& sid, const Location& place) const;
    const Element* known(const std::string& sid) const;

private:
    void add(const Element& e);
    std::map<std::string, const Element*> parameters_;
};

// Makes <texture type="bitmap" name=…>. Throws InputError.
Element make_bitmap(const Element& texture, const std::string& name, const Parameters& parameters, const Import& import);

}  // namespace neumann::reader::collada
