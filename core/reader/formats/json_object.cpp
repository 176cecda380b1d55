#include "core/reader/formats/json_object.h"

#include "core/base/did_you_mean.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

// Escapes a name in a JSON pointer (RFC 6901).
std::string escaped(const std::string& name) {
    std::string result;
    for (const char c : name) result += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    return result;
}

std::string expected_in(const Range& range) {
    if (range.least == -std::numeric_limits<double>::max()) return "a finite number";
    if (range.most == std::numeric_limits<double>::max()) return fmt::format("at least {}", range.least);
    return fmt::format("{} to {}", range.least, range.most);
}

bool is_within(double value, const Range& range) { return value >= range.least && value <= range.most; }

}  // namespace

std::string with_article(const nlohmann::json& value) {
    if (value.is_null()) return "null";
    const std::string kind = value.type_name();
    return (kind == "array" || kind == "object" ? "an " : "a ") + kind;
}

void Notes::left_out(const std::string& extension) {
    if (extensions.insert(extension).second) warnings.add(fmt::format("the extension {} is not known and left out", extension));
}

Location below(const Location& place, const std::string& name) { return {place.file, 0, 0, place.pointer + "/" + escaped(name)}; }

Location below(const Location& place, std::size_t index) { return below(place, std::to_string(index)); }

JsonObject JsonList::object(std::size_t i) const { return {(*array_)[i], place_of(i), *notes_}; }

JsonObject::JsonObject(const nlohmann::json& value, Location place, Notes& notes)
    : value_(&value), place_(std::move(place)), notes_(&notes) {
    if (!value.is_object()) throw InputError(place_, fmt::format("{}, expected an object", with_article(value)));
}

const nlohmann::json* JsonObject::find(const std::string& name, bool (nlohmann::json::*is)() const noexcept, const char* kind) {
    queried_.push_back(name);
    const auto found = value_->find(name);
    if (found == value_->end()) return nullptr;
    if (((*found).*is)()) return &*found;
    complain(name, fmt::format("{} is {}, expected {}", name, with_article(*found), kind));
    return nullptr;
}

std::optional<double> JsonObject::find_number(const std::string& name, Range range) {
    const nlohmann::json* found = find(name, &nlohmann::json::is_number, "a number");
    if (!found) return std::nullopt;
    const double value = found->get<double>();
    if (is_within(value, range)) return value;
    complain(name, fmt::format("{} is {}, expected {}", name, value, expected_in(range)));
    return std::nullopt;
}

double JsonObject::number(const std::string& name, double missing, Range range) {
    return find_number(name, range).value_or(missing);
}

std::optional<std::int64_t> JsonObject::integer(const std::string& name, std::int64_t least, std::int64_t most) {
    const nlohmann::json* found = find(name, &nlohmann::json::is_number, "a whole number");
    if (!found) return std::nullopt;
    const double value = found->get<double>();  // "3.0" is a whole number, too
    if (value == std::floor(value) && value >= static_cast<double>(least) && value <= static_cast<double>(most))
        return static_cast<std::int64_t>(value);
    complain(name, fmt::format("{} is {}, expected a whole number from {} to {}", name, value, least, most));
    return std::nullopt;
}

bool JsonObject::boolean(const std::string& name, bool missing) {
    const nlohmann::json* found = find(name, &nlohmann::json::is_boolean, "true or false");
    return found ? found->get<bool>() : missing;
}

std::optional<std::string> JsonObject::text(const std::string& name) {
    const nlohmann::json* found = find(name, &nlohmann::json::is_string, "a text");
    return found ? std::optional(found->get<std::string>()) : std::nullopt;
}

std::vector<double> JsonObject::numbers(const std::string& name, std::vector<double> missing, Range range) {
    const nlohmann::json* found = find(name, &nlohmann::json::is_array, "an array of numbers");
    if (!found) return missing;
    if (found->size() != missing.size()) {
        complain(name, fmt::format("{} has {} numbers, expected {}", name, found->size(), missing.size()));
        return missing;
    }
    std::vector<double> values;
    for (std::size_t i = 0; i < found->size(); ++i) {
        const nlohmann::json& entry = (*found)[i];
        const double value = entry.is_number() ? entry.get<double>() : 0.0;
        if (!entry.is_number() || !is_within(value, range)) {
            complain(name, entry.is_number()
                               ? fmt::format("entry {} of {} is {}, expected {}", i, name, value, expected_in(range))
                               : fmt::format("entry {} of {} is {}, expected a number", i, name, with_article(entry)));
            return missing;
        }
        values.push_back(value);
    }
    return values;
}

Rgb JsonObject::color(const std::string& name, double missing, Range range) {
    const std::vector<double> c = numbers(name, {missing, missing, missing}, range);
    return {c[0], c[1], c[2]};
}

const nlohmann::json* JsonObject::value(const std::string& name) {
    queried_.push_back(name);
    const auto found = value_->find(name);
    return found == value_->end() ? nullptr : &*found;
}

std::optional<JsonObject> JsonObject::object(const std::string& name) {
    const nlohmann::json* found = find(name, &nlohmann::json::is_object, "an object");
    return found ? std::optional(JsonObject(*found, place_of(name), *notes_)) : std::nullopt;
}

JsonList JsonObject::list(const std::string& name) {
    const nlohmann::json* found = find(name, &nlohmann::json::is_array, "an array");
    return {found, place_of(name), *notes_, !found && has(name)};
}

std::optional<JsonObject> JsonObject::extension(const std::string& name) {
    queried_extensions_.push_back(name);
    const auto all = value_->find("extensions");
    if (all == value_->end() || !all->is_object()) return std::nullopt;
    const auto found = all->find(name);
    if (found == all->end()) return std::nullopt;
    const Location place = below(place_of("extensions"), name);
    if (found->is_object()) return JsonObject(*found, place, *notes_);
    notes_->problems.add(InputError(place, fmt::format("{} is {}, expected an object", name, with_article(*found))), place);
    return std::nullopt;
}

bool is_index(const nlohmann::json& value, const JsonList& list, const std::string& what, const Location& place, Notes& notes) {
    if (value.is_number_integer() && value >= 0 && value < list.size()) return true;
    if (list.broken()) return false;
    notes.problems.add(InputError(place, value.is_number_integer()
                                             ? fmt::format("there is no {} {}; the file has {}", what, value.dump(), list.size())
                                             : fmt::format("{}, expected the index of a {}, of which the file has {}",
                                                           with_article(value), what, list.size())),
                       place);
    return false;
}

std::optional<std::size_t> JsonObject::index(const std::string& name, const JsonList& list, const std::string& what) {
    queried_.push_back(name);
    const auto found = value_->find(name);
    if (found == value_->end()) return std::nullopt;
    if (is_index(*found, list, what, place_of(name), *notes_)) return found->get<std::size_t>();
    wrong_.insert(name);
    return std::nullopt;
}

std::vector<std::size_t> JsonObject::indices(const std::string& name, const JsonList& list, const std::string& what) {
    const JsonList given = this->list(name);
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < given.size(); ++i)
        if (is_index(given[i], list, what, given.place_of(i), *notes_))
            result.push_back(given[i].get<std::size_t>());
        else
            wrong_.insert(name);
    return result;
}

void JsonObject::fail_missing(const std::string& name, const std::string& expected) const {
    if (wrong_.count(name)) throw AlreadyReported();
    throw InputError(place_, fmt::format("{} is missing, expected {}", name, expected));
}

void JsonObject::complain(const std::string& name, const std::string& what) {
    if (!wrong_.insert(name).second) return;
    notes_->problems.add(InputError(place_of(name), what), place_of(name));
}

void JsonObject::ignore(std::initializer_list<std::string> names) { queried_.insert(queried_.end(), names.begin(), names.end()); }

std::vector<std::string> JsonObject::names() const {
    std::vector<std::string> result;
    for (const auto& [name, value] : value_->items()) result.push_back(name);
    return result;
}

void JsonObject::finish() {
    const auto is_queried = [](const std::vector<std::string>& names, const std::string& name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    for (const auto& [name, value] : value_->items()) {
        if (is_queried(queried_, name) || (notes_->has_no_effect && name == "extras")) continue;
        if (!notes_->has_no_effect || name != "extensions") {
            const std::string meant = did_you_mean(name, queried_);
            if (meant.empty())
                notes_->warnings.add(fmt::format("the unknown property '{}' left out", name));
            else if (wrong_.insert(name).second)
                notes_->problems.add(Unknown(place_of(name), fmt::format("unknown property '{}'", name), meant, "left out"),
                                     place_of(name));
            continue;
        }
        if (!value.is_object()) {
            complain(name, fmt::format("extensions is {}, expected an object", with_article(value)));
            continue;
        }
        for (const auto& [extension, what] : value.items())
            if (!is_queried(queried_extensions_, extension) && !notes_->has_no_effect(extension)) notes_->left_out(extension);
    }
}

}  // namespace neumann::reader
