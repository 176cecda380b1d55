// Values that users give by their names.
#pragma once

#include "core/base/did_you_mean.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace neumann {

template <class Value>
using Named = std::vector<std::pair<std::string, Value>>;

template <class Value>
std::vector<std::string> names(const Named<Value>& all) {
    std::vector<std::string> found;
    for (const auto& [name, value] : all) found.push_back(name);
    return found;
}

template <class Value>
std::optional<Value> value(const Named<Value>& all, const std::string& name) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto& entry) { return entry.first == name; });
    return found == all.end() ? std::nullopt : std::optional(found->second);
}

template <class Value>
std::string name(const Named<Value>& all, const Value& value) {
    return std::find_if(all.begin(), all.end(), [&](const auto& entry) { return entry.second == value; })->first;
}

// "wlak not in {walk,light}; did you mean 'walk'?"
inline std::string not_in(const std::string& text, const std::vector<std::string>& names) {
    return fmt::format("{} not in {{{}}}{}", text, fmt::join(names, ","), did_you_mean(text, names));
}

}  // namespace neumann
