// The objects and arrays of a JSON file, with their places. The reader of an object asks for the properties that it
// knows; finish() reports all others, so that nothing is skipped silently. A property that is wrong is added to the
// problems and counts as missing, and the others are read as well.
#pragma once

#include "core/base/vec.h"
#include "core/base/warnings.h"
#include "core/reader/xml/problems.h"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace neumann::reader {

// Where the problems and warnings of a file go.
struct Notes {
    Warnings& warnings;
    Problems& problems;
    // Whether an extension of glTF changes no picture; null for formats whose objects have no `extensions` and `extras`.
    bool (*has_no_effect)(const std::string& extension) = nullptr;
    std::set<std::string> extensions = {};  // unknown ones that have been reported
    std::set<std::string> refused = {};     // those among them that the file requires

    void left_out(const std::string& extension);
};

// The place of a property or an element of the value at `place`.
Location below(const Location& place, const std::string& name);
Location below(const Location& place, std::size_t index);

// What kind of value it is: "a number", "an array", "null".
std::string with_article(const nlohmann::json& value);

struct Range {
    double least = -std::numeric_limits<double>::max(), most = std::numeric_limits<double>::max();
};
constexpr Range share = {0.0, 1.0}, not_negative = {0.0, std::numeric_limits<double>::max()};

class JsonObject;

// An array, or one that is missing and therefore empty.
class JsonList {
public:
    JsonList(const nlohmann::json* array, Location place, Notes& notes, bool broken = false)
        : array_(array), place_(std::move(place)), notes_(&notes), broken_(broken) {}

    std::size_t size() const { return array_ ? array_->size() : 0; }
    Location place_of(std::size_t i) const { return below(place_, i); }
    const nlohmann::json& operator[](std::size_t i) const { return (*array_)[i]; }
    // Throws InputError if the element is no object.
    JsonObject object(std::size_t i) const;
    // Whether it was there, but is no array.
    bool broken() const { return broken_; }

private:
    const nlohmann::json* array_;
    Location place_;
    Notes* notes_;
    bool broken_;
};

class JsonObject {
public:
    // Throws InputError if the value is no object.
    JsonObject(const nlohmann::json& value, Location place, Notes& notes);

    const Location& place() const { return place_; }
    Location place_of(const std::string& name) const { return below(place_, name); }
    Notes& notes() const { return *notes_; }
    bool has(const std::string& name) const { return value_->contains(name); }

    double number(const std::string& name, double missing, Range range = {});
    std::optional<double> find_number(const std::string& name, Range range = {});
    std::optional<std::int64_t> integer(const std::string& name, std::int64_t least, std::int64_t most);
    bool boolean(const std::string& name, bool missing);
    std::optional<std::string> text(const std::string& name);
    // Returns as many numbers as `missing` has.
    std::vector<double> numbers(const std::string& name, std::vector<double> missing, Range range = {});
    Rgb color(const std::string& name, double missing, Range range);

    // The property, of any kind, or null.
    const nlohmann::json* value(const std::string& name);
    std::optional<JsonObject> object(const std::string& name);
    JsonList list(const std::string& name);
    std::optional<JsonObject> extension(const std::string& name);
    // The index in the property, which must be one of the list.
    std::optional<std::size_t> index(const std::string& name, const JsonList& list, const std::string& what);
    // The indices in the property, an array; each must be one of the list.
    std::vector<std::size_t> indices(const std::string& name, const JsonList& list, const std::string& what);

    // Throws InputError, or AlreadyReported if the property is there but wrong.
    [[noreturn]] void fail_missing(const std::string& name, const std::string& expected) const;
    bool is_wrong(const std::string& name) const { return wrong_.count(name) > 0; }
    // Adds a problem at the property.
    void complain(const std::string& name, const std::string& what);
    // Accepts properties that have no effect on a picture.
    void ignore(std::initializer_list<std::string> names);
    std::vector<std::string> names() const;
    void finish();

private:
    // The property, or null if it is missing, or (with a problem) of another kind.
    const nlohmann::json* find(const std::string& name, bool (nlohmann::json::*is)() const noexcept, const char* kind);

    const nlohmann::json* value_;
    Location place_;
    Notes* notes_;
    std::vector<std::string> queried_, queried_extensions_;
    std::set<std::string> wrong_;
};

// Whether the value is an index of the list; otherwise adds a problem, unless the list is broken itself.
bool is_index(const nlohmann::json& value, const JsonList& list, const std::string& what, const Location& place, Notes& notes);

}  // namespace neumann::reader
