#include "core/reader/plugins/color.h"

#include "core/reader/xml/numbers.h"
#include "core/reader/xml/spectra.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

Rgb parse_hex(const Attribute& a) {
    double c[3] = {};
    bool good = a.value.size() == 7;
    for (std::size_t i = 0; good && i < 3; ++i) {
        int byte = 0;
        const char* at = a.value.data() + 1 + 2 * i;
        const auto [end, error] = std::from_chars(at, at + 2, byte, 16);
        good = error == std::errc() && end == at + 2 && *at != '-';
        c[i] = srgb_decode(byte / 255.0);
    }
    if (!good) throw InputError(a.place, fmt::format("'{}' is not a colour, expected #rrggbb", a.value));
    return {c[0], c[1], c[2]};
}

Rgb parse_rgb(const Attribute& a) {
    if (a.value.starts_with('#')) return parse_hex(a);
    const std::vector<double> v = parse_numbers(a);
    if (v.size() == 1) return Rgb(v[0]);
    if (v.size() == 3) return {v[0], v[1], v[2]};
    throw InputError(a.place, fmt::format("'{}' has {} numbers, expected 1 or 3", a.value, v.size()));
}

Rgb parse(const std::string& name, const Element& e, Illuminant illuminant, double largest, Warnings& warnings) {
    const Attribute& value = e.attribute("value");
    if (e.tag == "spectrum" && value.value.find(':') != std::string::npos) {
        if (illuminant == Illuminant::d65 && e.find("type"))
            throw InputError(e.place, fmt::format("{} is a spectrum 'blackbody', which is for what gives off light", name));
        const SpectrumTable s = parse_spectrum(value);
        for (std::size_t i = 0; i < s.values.size(); ++i)
            if (s.values[i] < 0.0)
                throw InputError(value.place, fmt::format("{} is negative at {} nm: {}", name, s.wavelengths[i], s.values[i]));
        return spectrum_within_srgb(s, illuminant, largest, warnings);
    }
    const Rgb c = e.tag == "rgb" ? parse_rgb(value) : Rgb(parse_number(value));
    if (std::min({c.r, c.g, c.b}) < 0.0) throw InputError(value.place, fmt::format("{} is negative: '{}'", name, value.value));
    // A spectrum of equal energy is not white in sRGB.
    return e.tag == "spectrum" && illuminant == Illuminant::equal_energy ? c * (rgb_from_xyz() * Vec3(1.0)) : c;
}

}  // namespace

Rgb parse_color(Properties& p, const std::string& name, const Element& e, Illuminant illuminant, Warnings& warnings) {
    const double largest = illuminant == Illuminant::d65 ? 1.0 : INFINITY;
    return p.attempt(name, [&] { return parse(name, e, illuminant, largest, warnings); }).value_or(Rgb(0.0));
}

Rgb parse_metal_index(Properties& p, const std::string& name, const Element& e, Warnings& warnings) {
    return p.attempt(name, [&] { return parse(name, e, Illuminant::d65, INFINITY, warnings); }).value_or(Rgb(0.0));
}

}  // namespace neumann::reader
