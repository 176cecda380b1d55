#include "core/base/did_you_mean.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace neumann {

namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// The fewest insertions, deletions, replacements and exchanges of neighbouring characters, none of which is changed twice; case
// does not count. F. J. Damerau, A technique for computer detection and correction of spelling errors, CACM 7, 1964.
std::size_t edits(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
    std::iota(last.begin(), last.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            row[j + 1] = std::min({last[j] + (lower(a[i]) != lower(b[j])), last[j + 1] + 1, row[j] + 1});
            if (i > 0 && j > 0 && lower(a[i]) == lower(b[j - 1]) && lower(a[i - 1]) == lower(b[j]))
                row[j + 1] = std::min(row[j + 1], before[j - 1] + 1);
        }
        before = std::exchange(last, row);
    }
    return last.back();
}

}  // namespace

std::string did_you_mean(std::string_view given, std::span<const std::string> known) {
    constexpr std::size_t longest = 64;
    if (given.size() > longest) return "";
    // A match may have one edit, and another for every four characters, but none if names are so short that any would do.
    std::size_t best = given.size() < 3 ? 1 : std::max<std::size_t>(2, given.size() / 4 + 1);
    const std::string* closest = nullptr;
    for (const std::string& name : known)
        if (const std::size_t n = edits(given, name); n < best) {
            best = n;
            closest = &name;
        }
    return closest ? fmt::format("; did you mean '{}'?", *closest) : "";
}

std::string allowed_instead(std::string_view given, std::span<const std::string> known) {
    return fmt::format("allowed: {}{}", fmt::join(known, ", "), did_you_mean(given, known));
}

}  // namespace neumann
