#include "core/reader/plugins/ior.h"

#include "core/base/did_you_mean.h"
#include "core/reader/xml/grammar.h"
#include "core/reader/xml/numbers.h"

#include <algorithm>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

struct Named {
    std::string name;
    double ior;
};

// Indices are those at 589 nm and between 0 and 20 °C: Hecht, Optics, 4th edition, and further names of Mitsuba.
const std::vector<Named> table = {{"vacuum", 1.0},      {"helium", 1.000036},        {"hydrogen", 1.000132},
                                  {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.333},
                                  {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
                                  {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
                                  {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
                                  {"pyrex", 1.47},      {"acrylic glass", 1.49},     {"polypropylene", 1.49},
                                  {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
                                  {"pet", 1.575},       {"diamond", 2.419}};

const Named* find(std::string name) {
    for (char& c : name) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    const auto found = std::find_if(table.begin(), table.end(), [&](const Named& n) { return n.name == name; });
    return found != table.end() ? &*found : nullptr;
}

}  // namespace

double read_ior(Properties& p, const std::string& name, const std::string& missing, const Context&) {
    const Element* e = p.find(name, {"float", "integer", "string"});
    if (!e) return find(missing)->ior;
    const Attribute& value = e->attribute("value");
    if (e->tag == "string") {
        if (const Named* known = find(value.value)) return known->ior;
        std::vector<std::string> names;
        for (const Named& n : table) names.push_back(n.name);
        p.complain(name, fmt::format("{} is '{}'; allowed: {}, or a number{}", name, value.value, join(names),
                                     did_you_mean(value.value, names)));
        return find(missing)->ior;
    }
    const auto ior = p.attempt(name, [&] { return parse_number(value); });
    if (ior && !(*ior > 0.0)) p.complain(name, fmt::format("{} is {}, expected more than 0", name, *ior));
    return ior.value_or(find(missing)->ior);
}

}  // namespace neumann::reader
