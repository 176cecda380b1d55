// The parameters $name of a scene file, from -D name=value (which take precedence) and from <default> elements.
#pragma once

#include "core/reader/xml/element.h"

#include <map>

namespace neumann::reader {

class Definitions {
public:
    explicit Definitions(const std::map<std::string, std::string>& from_command_line);

    // Does nothing if the name is defined already.
    void add_default(const std::string& name, const std::string& value);
    // Records a <default> with an error, so that uses of its name are not reported again. An empty name may stand for any.
    void lose_default(const std::string& name);
    // Replaces each $name, using the longest name that matches; \$ stands for $ itself. Substituted text is not substituted again.
    // Throws InputError if there is no such name.
    void substitute(Attribute& a);
    // Records that a name was used, if it is defined.
    void use(const std::string& name);
    // Throws InputError for a -D that was not used.
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
