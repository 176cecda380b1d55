#include "core/reader/plugins/color.h"

#include "core/reader/xml/numbers.h"

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

SpectrumTable parse_table(const Attribute& a) {
    SpectrumTable s;
    for (const std::string& pair : split(a.value)) {
        const std::size_t colon = pair.find(':');
        if (colon == std::string::npos) throw InputError(a.place, fmt::format("'{}' is not a pair wavelength:value", pair));
        s.wavelengths.push_back(parse_number({a.name, pair.substr(0, colon), a.place}));
        s.values.push_back(parse_number({a.name, pair.substr(colon + 1), a.place}));
        const std::size_t n = s.wavelengths.size();
        if (n > 1 && s.wavelengths[n - 1] <= s.wavelengths[n - 2])
            throw InputError(a.place, fmt::format("the wavelength {} follows {}, expected increasing ones", s.wavelengths[n - 1],
                                                  s.wavelengths[n - 2]));
    }
    if (s.wavelengths.size() < 2)
        throw InputError(a.place,
                         fmt::format("found {} of the at least 2 pairs wavelength:value of a spectrum", s.wavelengths.size()));
    return s;
}

// A neutral spectrum comes out as 1 ± 1e-4 in each channel, by the rounding of the matrix; that is not worth a warning.
constexpr double slack = 1e-3;

Rgb table_to_rgb(const SpectrumTable& s, Illuminant illuminant, double largest, Warnings& warnings) {
    const Rgb c = spectrum_to_rgb(s, illuminant);
    const Rgb inside = glm::clamp(c, Rgb(0.0), Rgb(largest));
    if (max_component(glm::abs(c - inside)) > slack * std::max(1.0, max_component(c)))
        warnings.add("spectrum outside the colours of sRGB, cut to them");
    return inside;
}

Rgb parse(const std::string& name, const Element& e, Illuminant illuminant, double largest, Warnings& warnings) {
    const Attribute& value = e.attribute("value");
    if (e.tag == "spectrum" && value.value.find(':') != std::string::npos) {
        if (illuminant == Illuminant::d65 && e.find("type"))
            throw InputError(e.place, fmt::format("{} is a spectrum 'blackbody', which is for what gives off light", name));
        const SpectrumTable s = parse_table(value);
        for (std::size_t i = 0; i < s.values.size(); ++i)
            if (s.values[i] < 0.0)
                throw InputError(value.place, fmt::format("{} is negative at {} nm: {}", name, s.wavelengths[i], s.values[i]));
        return table_to_rgb(s, illuminant, largest, warnings);
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
