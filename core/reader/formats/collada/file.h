// A COLLADA file as its elements, which are found by their ids.
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
// Throws InputError if there is none.
const Element& required_child(const Element& e, std::string_view tag);
const Attribute& required_attribute(const Element& e, std::string_view name);

// Adds the problem of every child whose tag is none of these: "unknown element <translat> in <node>; did you mean 'translate'?"
void check_children(const Element& e, std::span<const std::string> known, Problems& problems);

// What a CMU 15-462 or Berkeley CS184 file says beside the common profile: <extra><technique profile="CMU462"> or "CGL" in e; null
// if it says nothing.
const Element* course_technique(const Element& e);

// The axis that points up: 0, 1, 2 for x, y, z. Throws InputError if the file names another.
int up_axis(const Element& root);

class File {
public:
    // Throws InputError if it is not COLLADA 1.4 or 1.5.
    explicit File(Element root);

    const Element& root() const { return root_; }
    // Whether anything in it is of a course's profile.
    bool is_of_course() const { return is_of_course_; }

    // The element of this tag that "#id" or "id" means. Throws InputError if there is none, or if there are several.
    const Element& find(const Attribute& url, const std::string& tag) const;
    // Or null, where it is no error that there is none.
    const Element* known(const std::string& id, const std::string& tag) const;

private:
    void add(const Element& e, int depth);
    Element root_;
    bool is_of_course_ = false;
    std::map<std::string, std::multimap<std::string, const Element*>> elements_;  // by tag and id
};

}  // namespace neumann::reader::collada
