#include "operators/experiments/known/cases.h"

#include "operators/experiments/known/groups.h"

#include <algorithm>
#include <exception>

namespace neumann::known {

namespace {

// Glob matching; after a mismatch it goes back to the last star.
bool fits(const char* name, const char* pattern) {
    const char *star = nullptr, *after_star = nullptr;
    while (*name) {
        if (*pattern == '*') {
            star = pattern++;
            after_star = name;
        } else if (*pattern == '?' || *pattern == *name) {
            ++pattern;
            ++name;
        } else if (star) {
            pattern = star + 1;
            name = ++after_star;
        } else {
            return false;
        }
    }
    while (*pattern == '*') ++pattern;
    return !*pattern;
}

}  // namespace

const Cases& all_cases() {
    static const Cases all = [] {
        Cases cases;
        for (const auto group : {furnace_cases, microfacet_cases, sphere_cases, two_patch_cases, direct_light_cases, cube_cases,
                                 mirror_cases, glass_cases, glowing_cases, mesh_cases, open_cases, series_cases, spectrum_cases,
                                 acceleration_cases, rounding_cases, monte_carlo_cases, stiff_cases, extreme_cases})
            for (Case& known : group()) cases.push_back(std::move(known));
        return cases;
    }();
    return all;
}

std::vector<std::string> all_groups() {
    std::vector<std::string> groups;
    for (const Case& known : all_cases())
        if (groups.empty() || groups.back() != known.group()) groups.push_back(known.group());
    return groups;
}

bool matches(const std::string& name, const std::string& pattern) {
    if (pattern.find_first_of("*?") == std::string::npos) return name.find(pattern) != std::string::npos;
    return fits(name.c_str(), pattern.c_str());
}

std::vector<Figure> run(const Case& known, std::uint64_t seed) {
    Figures figures;
    try {
        known.measure(figures, seed);
        if (figures.all().empty()) figures.fail("figures", "nothing was measured");
    } catch (const std::exception& error) {
        figures.fail("not measured", error.what());
    }
    return figures.all();
}

}  // namespace neumann::known
