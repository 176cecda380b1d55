#include "core/reader/xml/did_you_mean.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// The fewest insertions, deletions and replacements of characters; case does not count. V. I. Levenshtein, 1966.
std::size_t edits(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i + 1);
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (lower(a[i]) != lower(b[j]));
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, diagonal + 1, row[j] + 1});
        }
    }
    return row.back();
}

}  // namespace

std::string did_you_mean(std::string_view given, std::span<const std::string> known) {
    constexpr std::size_t longest = 64;
    if (given.size() > longest) return "";
    std::size_t best = given.size() / 3 + 1;  // a third of the characters may be wrong
    const std::string* closest = nullptr;
    for (const std::string& name : known)
        if (const std::size_t n = edits(given, name); n < best) {
            best = n;
            closest = &name;
        }
    return closest ? fmt::format("; did you mean '{}'?", *closest) : "";
}

}  // namespace neumann::reader
