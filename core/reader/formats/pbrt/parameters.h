// The parameters of a directive of a pbrt file, "float radius" [ 2 ] and so on. The reader of a directive asks for
// those that it knows; finish() then refuses all others. What is wrong is added to the problems and counts as missing.
#pragma once

#include "core/base/vec.h"
#include "core/reader/formats/pbrt/tokens.h"
#include "core/reader/xml/problems.h"

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace neumann::reader {

struct Parameter {
    std::string type, name;
    Location place;
    std::vector<double> numbers = {};     // bool: 0 or 1
    std::vector<std::string> texts = {};  // strings, textures, and spectra with a name or in a file
    bool is_default = false;              // set by a directive Attribute for all that follows
};

class Parameters {
public:
    // `title` is like "shape 'sphere'".
    Parameters(std::string title, Location place, Problems& problems)
        : title_(std::move(title)), place_(std::move(place)), problems_(&problems) {}

    // Reads parameters up to the next word that is not in quotes. Wrong ones are left out and become problems.
    void read(Tokens& tokens);
    // Adds those of the defaults that are not given.
    void add_defaults(const std::vector<Parameter>& defaults);
    const std::vector<Parameter>& all() const { return all_; }

    const std::string& title() const { return title_; }
    const Location& place() const { return place_; }
    // The place of a parameter, or of the directive if the parameter is not given.
    const Location& place(const std::string& name) const;

    // A parameter of one of the types, or null. There may be another of the same name and another type.
    const Parameter* find(const std::string& name, std::initializer_list<const char*> types);
    bool has(const std::string& name) const;

    // These read parameters with exactly one value.
    std::optional<double> number(const std::string& name);
    double number(const std::string& name, double missing) { return number(name).value_or(missing); }
    std::optional<std::int64_t> integer(const std::string& name);
    std::optional<bool> boolean(const std::string& name);
    std::optional<std::string> text(const std::string& name);
    // Reads one of the allowed words.
    std::string choice(const std::string& name, const std::vector<std::string>& allowed, const std::string& missing);
    std::optional<Vec3> point(const std::string& name);

    // These read parameters with any number of values, and return nothing if they are not given.
    std::vector<double> numbers(const std::string& name, std::size_t count);  // exactly `count` floats
    std::vector<std::int64_t> integers(const std::string& name);
    std::vector<Vec3> triples(const std::string& name, std::initializer_list<const char*> types);
    std::vector<Vec2> pairs(const std::string& name);
    std::vector<std::string> texts(const std::string& name);

    // Accepts parameters, of any type, that have no effect on the picture here.
    void ignore(std::initializer_list<const char*> names);

    // Adds a problem at the parameter, or at the directive if the parameter is not given, unless the parameter has a
    // problem already.
    void complain(const std::string& name, const std::string& what);
    // The same with a message that has a place of its own.
    void complain_whole(const std::string& name, const InputError& problem);
    // Reports what is not known about a parameter; a lenient reader goes on without it. `expected` is as in Unknown.
    void refuse(const std::string& name, const std::string& what, const std::string& expected = "");
    bool is_spoilt(const std::string& name) const { return spoilt_.contains(name); }
    // Whether any parameter has a problem.
    bool is_wrong() const { return !spoilt_.empty(); }
    Problems& problems() const { return *problems_; }

    // Refuses the parameters that were not asked for.
    void finish();

private:
    const Parameter* single(const std::string& name, const char* type);
    void read_one(Tokens& tokens, const Token& declaration);
    void read_values(Tokens& tokens, Parameter& parameter);
    void check_count(Parameter& parameter);

    std::string title_;
    Location place_;
    Problems* problems_;
    std::vector<Parameter> all_;
    std::set<const Parameter*> read_;
    std::set<std::string> spoilt_, queried_;
};

}  // namespace neumann::reader
