// The parameters $name of a scene file: from <default> elements and from -D name=value, which come first.
#pragma once

#include "core/reader/xml/element.h"

#include <map>

namespace neumann::reader {

class Definitions {
public:
    explicit Definitions(const std::map<std::string, std::string>& from_command_line);

    // Does nothing if the name is defined already.
    void add_default(const std::string& name, const std::string& value);
    // A <default> that is wrong; if its name is not known either, that may be any.
    void lose_default(const std::string& name);
    // Replaces each $name, of several that fit the longest; \$ stands for $ itself. What is put in is not looked at again. Throws
    // InputError where there is no such name.
    void substitute(Attribute& a);
    // Throws InputError for a -D that nothing used.
    void check_used(const std::string& file) const;

private:
    struct Value {
        std::string text;
        bool from_command_line = false, used = false, lost = false;
    };
    std::map<std::string, Value>::iterator longest(std::string_view text);
    std::string names() const;
    std::map<std::string, Value> values_;
    bool lost_ = false;
};

}  // namespace neumann::reader
