// The parameters and nested objects of one object. A plugin asks for those that it knows; finish() then refuses all others, so
// nothing is skipped silently. The list of allowed names in messages consists of the names asked for.
//
// A wrong parameter is added to the problems and counts as missing, so that the others are checked as well; finish() then throws. A
// plugin uses its parameters only after finish().
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
    // The object's tag and type, like "sensor 'perspective'".
    const std::string& title() const { return title_; }

    // A parameter of one of the types, or null.
    const Element* find(const std::string& name, const std::vector<std::string>& types);
    // The same, but throws InputError if it is missing.
    const Element& require(const std::string& name, const std::vector<std::string>& types);

    std::optional<double> number(const std::string& name);
    std::optional<std::int64_t> integer(const std::string& name);
    std::optional<bool> boolean(const std::string& name);
    std::optional<std::string> text(const std::string& name);
    // Reads one of several words.
    std::string choice(const std::string& name, const std::vector<std::string>& allowed, const std::string& missing);
    std::optional<Vec3> point(const std::string& name);
    Mat4 transform(const std::string& name);  // the identity if it is missing; always invertible

    // The nested object of one kind that has the name of a parameter, with references resolved, or null.
    const Element* object(const std::string& name, const std::string& tag);
    // Nested objects of one kind, with references resolved; at most `limit`.
    std::vector<const Element*> nested(const std::string& tag, std::size_t limit = 1);
    // All nested objects of several kinds, in the order of the file.
    std::vector<const Element*> all_nested(const std::vector<std::string>& tags);

    // Calls f and returns its result, or nothing if it throws InputError, which is then a problem of the parameter.
    template <class F>
    auto attempt(const std::string& name, F&& f) {
        auto result = problems().attempt(element_.place, f);
        if (!result) spoilt_.insert(name);
        return result;
    }

    // Adds the problem "… is …, expected …" at the parameter, or at the object if the parameter is missing. Does nothing if the
    // parameter, or one of those in `beside`, already has a problem.
    void complain(const std::string& name, const std::string& what, const std::vector<std::string>& beside = {});
    // Throws the same problem. No new problem is reported if any parameter already has one.
    [[noreturn]] void fail(const std::string& name, const std::string& what) const;
    // Fails with "… has no <bsdf> inside, expected …", unless a nested element that could not be read may have been one.
    [[noreturn]] void fail_empty(const std::string& what) const;

    // Reports that the word of a parameter is not known; a lenient reader goes on as if the parameter were missing.
    // `expected` is as in Unknown.
    void refuse_word(const std::string& name, const std::string& what, const std::string& expected);

    // Reports everything that was not asked for. Call it after asking for the last parameter.
    void refuse_rest();
    void finish();

private:
    Problems& problems() const { return objects_.problems(); }
    void add(const Location& place, const std::string& what);
    // Reports a parameter or object that is not known; a lenient reader goes on without it.
    void refuse(const Location& place, const std::string& what, const std::string& expected);
    const Element* parameter(const std::string& name) const;
    Location place_of(const std::string& name) const;
    // The object itself, or the one to which a reference refers; null if that is unknown.
    const Element* resolve(const Element& e);

    const Element& element_;
    const Objects& objects_;
    std::string title_;
    std::set<const Element*> read_;
    std::set<std::string> spoilt_;  // parameters with a problem
    bool reported_ = false;         // another problem has been reported
    bool incomplete_ = false;       // a nested element could not be read at all
    std::vector<std::string> queried_, queried_tags_;
};

// Throws Unknown "bsdf type 'wood' is not supported; allowed: …", or says what can be taken in place of a type that
// Mitsuba has. `instead` is what a lenient reader does.
[[noreturn]] void fail_type(const Element& e, const std::vector<std::string>& allowed, const std::string& instead);
// The type of an element if it is among the allowed ones. Otherwise throws as fail_type() does or, if the reader is
// lenient, returns `otherwise`.
std::string type_of(const Element& e, const std::vector<std::string>& allowed, const std::string& otherwise, Problems& problems);

}  // namespace neumann::reader
