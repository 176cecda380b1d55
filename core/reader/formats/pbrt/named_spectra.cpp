#include "core/reader/formats/pbrt/named_spectra.h"

#include "core/image/colour/metals.h"
#include "core/image/colour/spectrum_to_rgb.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace neumann::reader::pbrt {

namespace {

// Chromaticities of the CIE 1931 2° observer: CIE 15:2004, tables T.3 and T.8; of ACES, SMPTE ST 2065-1.
struct Chromaticity {
    std::string_view name;
    double x, y;
};
constexpr std::array chromaticities = {
    Chromaticity{"illum-acesD60", 0.32168, 0.33767}, Chromaticity{"stdillum-A", 0.44757, 0.40745},
    Chromaticity{"stdillum-D50", 0.34567, 0.35850},  Chromaticity{"stdillum-F1", 0.31310, 0.33727},
    Chromaticity{"stdillum-F10", 0.34609, 0.35986},  Chromaticity{"stdillum-F11", 0.38052, 0.37713},
    Chromaticity{"stdillum-F12", 0.43695, 0.40441},  Chromaticity{"stdillum-F2", 0.37208, 0.37529},
    Chromaticity{"stdillum-F3", 0.40910, 0.39430},   Chromaticity{"stdillum-F4", 0.44018, 0.40329},
    Chromaticity{"stdillum-F5", 0.31379, 0.34531},   Chromaticity{"stdillum-F6", 0.37790, 0.38835},
    Chromaticity{"stdillum-F7", 0.31292, 0.32933},   Chromaticity{"stdillum-F8", 0.34588, 0.35875},
    Chromaticity{"stdillum-F9", 0.37417, 0.37281}};

// Schott's nd, the index at 587.6 nm. What pbrt calls F5, F10 and F11 is SF5, SF10 and SF11.
struct Glass {
    std::string_view name;
    double index;
};
constexpr std::array glasses = {Glass{"glass-BAF10", 1.67003}, Glass{"glass-BK7", 1.51680}, Glass{"glass-F10", 1.72825},
                                Glass{"glass-F11", 1.78472},   Glass{"glass-F5", 1.67270},  Glass{"glass-FK51A", 1.48656},
                                Glass{"glass-LASF9", 1.85025}};

constexpr std::array<std::string_view, 4> metals_of_mitsuba = {"Ag", "Al", "Au", "Cu"};

// Brass by the spectra in pbrt's util/spectrum.cpp; core/image/colour/metals.h has the other metals.
constexpr std::string_view brass = "CuZn";
const Rgb brass_eta(0.519745, 0.488637, 1.04196), brass_k(4.33054, 2.54807, 1.59223);

}  // namespace

std::optional<Rgb> illuminant(const std::string& name) {
    if (name == "stdillum-D65") return Rgb(1.0);
    for (const Chromaticity& c : chromaticities)
        if (c.name == name) return rgb_from_xyz() * Vec3(c.x / c.y, 1.0, (1.0 - c.x - c.y) / c.y);
    return std::nullopt;
}

std::optional<double> glass(const std::string& name) {
    for (const Glass& g : glasses)
        if (g.name == name) return g.index;
    return std::nullopt;
}

std::optional<MetalSpectrum> metal(const std::string& name) {
    constexpr std::string_view before = "metal-", eta = "-eta", k = "-k";
    const bool is_k = name.ends_with(k);
    if (!name.starts_with(before) || !(is_k || name.ends_with(eta))) return std::nullopt;
    const std::size_t rest = before.size() + (is_k ? k.size() : eta.size());
    if (name.size() < rest) return std::nullopt;
    const std::string element = name.substr(before.size(), name.size() - rest);
    if (element == brass) return MetalSpectrum{element, is_k, is_k ? brass_k : brass_eta};
    if (std::find(metals_of_mitsuba.begin(), metals_of_mitsuba.end(), element) == metals_of_mitsuba.end()) return std::nullopt;
    for (const Metal& m : metals())
        if (m.name == element) return MetalSpectrum{element, is_k, is_k ? m.k : m.eta};
    return std::nullopt;
}

const std::vector<std::string>& spectrum_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all = {"stdillum-D65"};
        for (const Chromaticity& c : chromaticities) all.emplace_back(c.name);
        for (const Glass& g : glasses) all.emplace_back(g.name);
        for (const char* name : {"Ag", "Al", "Au", "Cu", "CuZn"})
            for (const char* end : {"-eta", "-k"}) all.push_back(std::string("metal-") + name + end);
        return all;
    }();
    return names;
}

}  // namespace neumann::reader::pbrt
