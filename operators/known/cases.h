// Cases with known answers, for whoever wants to see that they come out: the `stress` command and the tests run the same.
#pragma once

#include "operators/known/figures.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace neumann::known {

struct Case {
    std::string name;    // group/…
    std::string source;  // of what is expected
    std::function<void(Figures&, std::uint64_t seed)> measure;

    std::string group() const { return name.substr(0, name.find('/')); }
};
using Cases = std::vector<Case>;

// All of them, group by group; no name is there twice.
const Cases& all_cases();
// In the same order.
std::vector<std::string> all_groups();

// `*` stands for any text, `?` for one character; a pattern without them is looked for anywhere in the name.
bool matches(const std::string& name, const std::string& pattern);

// What a case throws is a figure that fails.
std::vector<Figure> run(const Case& known, std::uint64_t seed = default_seed);

}  // namespace neumann::known
