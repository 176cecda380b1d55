// The parameters and nested objects of one object. A plugin asks for what it knows; finish() then refuses whatever is left, so
// nothing is skipped in silence and the list of allowed names is what was asked for.
#pragma once

#include "core/base/vec.h"
#include "core/reader/objects.h"

#include <cstdint>
#include <optional>
#include <set>

namespace neumann::reader {

class Properties {
public:
    // Throws InputError for a parameter given twice.
    Properties(const Element& element, const Objects& objects);

    const Element& element() const { return element_; }
    // "sensor 'perspective'".
    const std::string& title() const { return title_; }

    // A parameter of one of the types, or null; throws InputError if it has another type.
    const Element* find(const std::string& name, const std::vector<std::string>& types);
    // The same, where it must be there.
    const Element& require(const std::string& name, const std::vector<std::string>& types);

    std::optional<double> number(const std::string& name);
    std::optional<std::int64_t> integer(const std::string& name);
    std::optional<bool> boolean(const std::string& name);
    std::optional<std::string> text(const std::string& name);
    // One of several words.
    std::string choice(const std::string& name, const std::vector<std::string>& allowed, const std::string& missing);
    std::optional<Vec3> point(const std::string& name);
    Mat4 transform(const std::string& name);  // the identity where it is missing; invertible

    // The nested object of one kind that has the name of a parameter, a reference resolved, or null.
    const Element* object(const std::string& name, const std::string& tag);
    // Nested objects of one kind, references resolved. At most `limit`.
    std::vector<const Element*> nested(const std::string& tag, std::size_t limit = 1);

    // "… is …, expected …" at the parameter, or at the object where the parameter is missing.
    [[noreturn]] void fail(const std::string& name, const std::string& what) const;

    void finish() const;

private:
    const Element* parameter(const std::string& name) const;

    const Element& element_;
    const Objects& objects_;
    std::string title_;
    std::set<const Element*> read_;
    std::vector<std::string> asked_, asked_tags_;
};

// Throws InputError "bsdf type 'plastic' is not supported; allowed: …".
[[noreturn]] void fail_type(const Element& e, const std::vector<std::string>& allowed);

}  // namespace neumann::reader
