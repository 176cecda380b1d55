// The elements of a COLLADA file, found by their ids.
#pragma once

#include "core/reader/xml/element.h"
#include "core/reader/xml/problems.h"

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace neumann::reader::collada {

// The first child of this tag, or null.
const Element* child(const Element& e, std::string_view tag);
// These throw InputError if there is none.
const Element& required_child(const Element& e, std::string_view tag);
const Attribute& required_attribute(const Element& e, std::string_view name);

// Adds a problem for every child whose tag is not among `known`: "unknown element <translat> in <node>; did you mean 'translate'?"
void check_children(const Element& e, std::span<const std::string> known, Problems& problems);

// The part of e that CMU 15-462 or Berkeley CS184 add to the common profile, <extra><technique profile="CMU462"> or
// "CGL"; null if there is none.
const Element* course_technique(const Element& e);

// The index of the axis that points up, 0 to 2; 1 if the file names none. Throws InputError if it names another.
int up_axis(const Element& root);

class File {
public:
    // Throws InputError if the file is not COLLADA 1.4 or 1.5.
    explicit File(Element root);

    const Element& root() const { return root_; }
    // Whether anything in the file is of a course's profile.
    bool is_of_course() const { return is_of_course_; }

    // The element of this tag to which "#id" or "id" refers. Throws InputError if there is none, or if there are several.
    const Element& find(const Attribute& url, const std::string& tag) const;
    // The same, or null if there is none.
    const Element* known(const std::string& id, const std::string& tag) const;

private:
    void add(const Element& e, int depth);
    Element root_;
    bool is_of_course_ = false;
    std::map<std::string, std::multimap<std::string, const Element*>> elements_;  // by tag and id
};

}  // namespace neumann::reader::collada
