// Cases with known answers. The `stress` command shows them, and the tests run the same cases.
#pragma once

#include "operators/experiments/known/figures.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace neumann::known {

struct Case {
    std::string name;    // group/…
    std::string source;  // where the expected values come from: a formula, a paper, or a computation with its error
    std::function<void(Figures&, std::uint64_t seed)> measure;

    std::string group() const { return name.substr(0, name.find('/')); }
};
using Cases = std::vector<Case>;

// All cases, group by group. Names are unique.
const Cases& all_cases();
// The names of the groups, in the same order.
std::vector<std::string> all_groups();

// `*` stands for any text and `?` for one character. A pattern without either matches if the name contains it.
bool matches(const std::string& name, const std::string& pattern);

// An exception from a case becomes a figure that fails.
std::vector<Figure> run(const Case& known, std::uint64_t seed = default_seed);

}  // namespace neumann::known
