// The parameters and nested objects of one object. A plugin asks for what it knows; finish() then refuses whatever is left, so
// nothing is skipped in silence and the list of allowed names is what was asked for.
//
// A parameter that is wrong is added to the problems and counts as missing, so that the others are looked at as well; finish() then
// throws. What a plugin makes of its parameters comes after that.
#pragma once

#include "core/base/vec.h"
#include "core/reader/xml/objects.h"

#include <cstdint>
#include <optional>
#include <set>

namespace neumann::reader {

class Properties {
public:
    Properties(const Element& element, const Objects& objects);

    const Element& element() const { return element_; }
    // "sensor 'perspective'".
    const std::string& title() const { return title_; }

    // A parameter of one of the types, or null.
    const Element* find(const std::string& name, const std::vector<std::string>& types);
    // The same, where it must be there; throws InputError otherwise.
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

    // What `f` makes of a parameter; nothing where it throws InputError, which is then a problem of that parameter.
    template <class F>
    auto attempt(const std::string& name, F&& f) {
        auto result = problems().attempt(element_.place, f);
        if (!result) spoilt_.insert(name);
        return result;
    }

    // "… is …, expected …" at the parameter, or at the object where the parameter is missing. Nothing is said where it, or one of
    // those that it is compared with, is wrong already.
    void complain(const std::string& name, const std::string& what, const std::vector<std::string>& beside = {});
    // The same, where there is no going on. Nothing is said where any parameter is wrong already.
    [[noreturn]] void fail(const std::string& name, const std::string& what) const;
    // "… has no <bsdf> inside, expected …", unless what could not be read may have been one.
    [[noreturn]] void fail_empty(const std::string& what) const;

    // Complains of what was not asked for. After that, it is too late to ask.
    void refuse_rest();
    void finish();

private:
    Problems& problems() const { return objects_.problems(); }
    void add(const Location& place, const std::string& what);
    const Element* parameter(const std::string& name) const;
    Location place_of(const std::string& name) const;
    // The object itself or what a reference means; null where that is not known.
    const Element* resolve(const Element& e);

    const Element& element_;
    const Objects& objects_;
    std::string title_;
    std::set<const Element*> read_;
    std::set<std::string> spoilt_;  // parameters
    bool told_ = false;             // of something else
    bool incomplete_ = false;       // something in it could not be read at all
    std::vector<std::string> asked_, asked_tags_;
};

// Throws InputError "bsdf type 'plastic' is not supported; allowed: …".
[[noreturn]] void fail_type(const Element& e, const std::vector<std::string>& allowed);

}  // namespace neumann::reader
