#include "core/reader/xml/problems.h"

#include <algorithm>
#include <charconv>
#include <tuple>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

constexpr std::size_t most_shown = 20;

auto key(const Location& place) { return std::tie(place.file, place.line, place.column, place.pointer); }

// Sort key: number of the file, line, column, pointer.
using Order = std::tuple<std::size_t, int, int, std::string>;

// The place of a message "file:12:3: what is wrong", if it is in this file.
std::optional<Order> order_in(const std::string& text, const std::string& file, std::size_t number) {
    if (!text.starts_with(file + ":")) return std::nullopt;
    int places[2] = {0, 0};
    const char *at = text.data() + file.size() + 1, *end = text.data() + text.size();
    for (int& place : places) {
        const auto [next, error] = std::from_chars(at, end, place);
        if (error != std::errc() || next == end || *next != ':') break;
        at = next + 1;
    }
    return Order(number, places[0], places[1], "");
}

Order order_of(const std::string& text, const Location& near, const std::vector<std::string>& files) {
    for (std::size_t i = 0; i < files.size(); ++i)
        if (const auto found = order_in(text, files[i], i)) return *found;
    const auto file = std::find(files.begin(), files.end(), near.file);
    return {static_cast<std::size_t>(file - files.begin()), near.line, near.column, near.pointer};
}

}  // namespace

void Problems::add(const InputError& problem, const Location& near) {
    const std::scoped_lock lock(mutex_);
    Location& known = near_.try_emplace(problem.what(), near).first->second;
    if (key(near) < key(known)) known = near;
}

bool Problems::any() const {
    const std::scoped_lock lock(mutex_);
    return !near_.empty();
}

void Problems::check(const std::vector<std::string>& files) const {
    const std::scoped_lock lock(mutex_);
    if (near_.empty()) return;
    std::vector<std::pair<Order, std::string>> sorted;
    for (const auto& [text, near] : near_) sorted.emplace_back(order_of(text, near, files), text);
    std::sort(sorted.begin(), sorted.end());
    std::string all;
    for (std::size_t i = 0; i < std::min(sorted.size(), most_shown); ++i) all += (i > 0 ? "\n" : "") + sorted[i].second;
    if (sorted.size() > most_shown) all += fmt::format("\nand {} more", sorted.size() - most_shown);
    throw InputError(all);
}

}  // namespace neumann::reader
