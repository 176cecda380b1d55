#include "core/reader/formats/pbrt/parameters.h"

#include "core/base/did_you_mean.h"
#include "core/reader/meshes/mesh_text.h"
#include "core/reader/xml/element.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

bool is_in(std::initializer_list<const char*> types, const std::string& type) {
    return std::any_of(types.begin(), types.end(), [&](const char* t) { return type == t; });
}

}  // namespace

const Location& Parameters::place(const std::string& name) const {
    const auto found = std::find_if(all_.begin(), all_.end(), [&](const Parameter& p) { return p.name == name; });
    return found == all_.end() ? place_ : found->place;
}

bool Parameters::has(const std::string& name) const {
    return std::any_of(all_.begin(), all_.end(), [&](const Parameter& p) { return p.name == name; });
}

void Parameters::add_defaults(const std::vector<Parameter>& defaults) {
    const std::size_t given = all_.size();
    for (const Parameter& d : defaults) {
        const auto is_same = [&](const Parameter& p) { return p.name == d.name; };
        if (std::none_of(all_.begin(), all_.begin() + static_cast<std::ptrdiff_t>(given), is_same) && !spoilt_.contains(d.name)) {
            std::erase_if(all_, [&](const Parameter& p) { return p.is_default && is_same(p); });  // the last one counts
            all_.push_back(d);
            all_.back().is_default = true;
        }
    }
}

const Parameter* Parameters::find(const std::string& name, std::initializer_list<const char*> types) {
    queried_.insert(name);
    for (const Parameter& p : all_)
        if (p.name == name && is_in(types, p.type)) {
            read_.insert(&p);
            return &p;
        }
    return nullptr;
}

const Parameter* Parameters::single(const std::string& name, const char* type) {
    const Parameter* p = find(name, {type});
    const std::size_t count = p ? p->numbers.size() + p->texts.size() : 0;
    const std::size_t expected = p && p->type == "point3" ? 3 : 1;
    if (!p || count == expected) return p;
    complain(name, fmt::format("{} of {} has {} values, expected one {}", name, title_, count / expected, type));
    return nullptr;
}

std::optional<double> Parameters::number(const std::string& name) {
    const Parameter* p = single(name, "float");
    return p ? std::optional(p->numbers[0]) : std::nullopt;
}

std::optional<std::int64_t> Parameters::integer(const std::string& name) {
    const Parameter* p = single(name, "integer");
    return p ? std::optional(static_cast<std::int64_t>(p->numbers[0])) : std::nullopt;
}

std::optional<bool> Parameters::boolean(const std::string& name) {
    const Parameter* p = single(name, "bool");
    return p ? std::optional(p->numbers[0] != 0.0) : std::nullopt;
}

std::optional<std::string> Parameters::text(const std::string& name) {
    const Parameter* p = single(name, "string");
    return p ? std::optional(p->texts[0]) : std::nullopt;
}

std::string Parameters::choice(const std::string& name, const std::vector<std::string>& allowed, const std::string& missing) {
    const std::string value = text(name).value_or(missing);
    if (std::find(allowed.begin(), allowed.end(), value) != allowed.end()) return value;
    complain(name, fmt::format("{} of {} is '{}'; {}", name, title_, printable(value), allowed_instead(value, allowed)));
    return missing;
}

std::optional<Vec3> Parameters::point(const std::string& name) {
    const Parameter* p = single(name, "point3");
    return p ? std::optional(Vec3(p->numbers[0], p->numbers[1], p->numbers[2])) : std::nullopt;
}

std::vector<double> Parameters::numbers(const std::string& name, std::size_t count) {
    const Parameter* p = find(name, {"float"});
    if (!p) return {};
    if (p->numbers.size() == count) return p->numbers;
    complain(name, fmt::format("{} of {} has {} values, expected {}", name, title_, p->numbers.size(), count));
    return {};
}

std::vector<std::int64_t> Parameters::integers(const std::string& name) {
    std::vector<std::int64_t> values;
    if (const Parameter* p = find(name, {"integer"}))
        for (const double v : p->numbers) values.push_back(static_cast<std::int64_t>(v));
    return values;
}

std::vector<Vec3> Parameters::triples(const std::string& name, std::initializer_list<const char*> types) {
    std::vector<Vec3> values;
    if (const Parameter* p = find(name, types))
        for (std::size_t i = 0; i + 2 < p->numbers.size(); i += 3)
            values.emplace_back(p->numbers[i], p->numbers[i + 1], p->numbers[i + 2]);
    return values;
}

std::vector<Vec2> Parameters::pairs(const std::string& name) {
    std::vector<Vec2> values;
    if (const Parameter* p = find(name, {"point2", "vector2"}))
        for (std::size_t i = 0; i + 1 < p->numbers.size(); i += 2) values.emplace_back(p->numbers[i], p->numbers[i + 1]);
    return values;
}

std::vector<std::string> Parameters::texts(const std::string& name) {
    const Parameter* p = find(name, {"string"});
    return p ? p->texts : std::vector<std::string>();
}

void Parameters::ignore(std::initializer_list<const char*> names) {
    for (const char* name : names) {
        queried_.insert(name);
        for (const Parameter& p : all_)
            if (p.name == name) read_.insert(&p);
    }
}

void Parameters::complain(const std::string& name, const std::string& what) { complain_whole(name, InputError(place(name), what)); }

void Parameters::complain_whole(const std::string& name, const InputError& problem) {
    if (spoilt_.insert(name).second) problems_->add(problem, place_);
}

void Parameters::refuse(const std::string& name, const std::string& what, const std::string& expected) {
    const Unknown unknown(place(name), what, expected, "ignored");
    if (problems_->lenient())
        problems_->add(unknown, place_);
    else
        complain_whole(name, unknown);
}

void Parameters::finish() {
    const std::vector<std::string> known(queried_.begin(), queried_.end());
    for (const Parameter& p : all_) {
        if (p.is_default || read_.contains(&p) || spoilt_.contains(p.name)) continue;
        if (queried_.contains(p.name))
            complain(p.name, fmt::format("{} of {} is of the type {}, which is not expected here", p.name, title_, p.type));
        else
            refuse(p.name, fmt::format("unknown parameter '{}' of {}", printable(p.name), title_),
                   "; " + (known.empty() ? "it has none" : allowed_instead(p.name, known)));
    }
}

}  // namespace neumann::reader
