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

void insert(std::map<std::string, Location>& messages, const std::string& text, const Location& near) {
    Location& known = messages.try_emplace(text, near).first->second;
    if (key(near) < key(known)) known = near;
}

std::vector<std::string> in_order(const std::map<std::string, Location>& messages, const std::vector<std::string>& files) {
    std::vector<std::pair<Order, std::string>> sorted;
    for (const auto& [text, near] : messages) sorted.emplace_back(order_of(text, near, files), text);
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::string> texts;
    for (auto& [order, text] : sorted) texts.push_back(std::move(text));
    return texts;
}

}  // namespace

void Problems::add(const InputError& problem, const Location& near) {
    const auto* unknown = dynamic_cast<const Unknown*>(&problem);
    const std::scoped_lock lock(mutex_);
    if (unknown && lenient_) return insert(replaced_, unknown->replaced(), near);
    all_unknown_ = all_unknown_ && unknown;
    insert(near_, problem.what(), near);
}

void Problems::replace(const Unknown& unknown, const Location& near) {
    if (!lenient_) throw unknown;
    add(unknown, near);
}

void Problems::expect_reported(const Location& near) {
    if (lenient_ && !any()) add(InputError(near, "cannot be read without what is not known"), near);
}

bool Problems::any() const {
    const std::scoped_lock lock(mutex_);
    return !near_.empty();
}

void Problems::check(const std::vector<std::string>& files) const {
    const std::scoped_lock lock(mutex_);
    if (near_.empty()) return;
    const std::vector<std::string> sorted = in_order(near_, files);
    std::string all;
    for (std::size_t i = 0; i < std::min(sorted.size(), most_shown); ++i) all += (i > 0 ? "\n" : "") + sorted[i];
    if (sorted.size() > most_shown) all += fmt::format("\nand {} more", sorted.size() - most_shown);
    if (all_unknown_) throw UnknownError(all);
    throw InputError(all);
}

std::vector<std::string> Problems::replaced(const std::vector<std::string>& files) const {
    const std::scoped_lock lock(mutex_);
    return in_order(replaced_, files);
}

}  // namespace neumann::reader
