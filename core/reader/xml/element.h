// The elements and attributes of a scene with their places in its file.
#pragma once

#include "core/base/error.h"

#include <string>
#include <string_view>
#include <vector>

namespace neumann::reader {

struct Attribute {
    std::string name, value;
    Location place;
};

struct Element {
    std::string tag;
    std::vector<Attribute> attributes;
    std::vector<Element> children;
    Location place;
    std::string text = {};  // between the children; an error in an XML file
    // Its error is already reported; the element is not used.
    bool broken = false;

    const Attribute* find(std::string_view name) const;
    // The attribute must exist; those that grammar.h requires exist in every element of a document.
    const Attribute& attribute(std::string_view name) const;
};

// "a, b, c".
std::string join(const std::vector<std::string>& names);

}  // namespace neumann::reader
