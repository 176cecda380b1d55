#include "core/reader/formats/pbrt/colours.h"

#include "core/base/did_you_mean.h"
#include "core/image/colour/blackbody.h"
#include "core/image/colour/cie.h"
#include "core/reader/formats/find_file.h"
#include "core/reader/formats/pbrt/named_spectra.h"
#include "core/reader/formats/pbrt/unpack.h"
#include "core/reader/meshes/mesh_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace neumann::reader::pbrt {

namespace {

// The Fraunhofer line d, at which indices of glass are stated, in nm.
constexpr double line_d = 587.6;

Rgb first_rgb(const Parameter& p) { return {p.numbers[0], p.numbers[1], p.numbers[2]}; }

std::string shown(const Rgb& c) { return fmt::format("({}, {}, {})", c.r, c.g, c.b); }

const Parameter* find_rgb(Parameters& p, const std::string& name) {
    const Parameter* given = p.find(name, {"rgb"});
    if (!given) return nullptr;
    const Rgb c = first_rgb(*given);
    if (given->numbers.size() != 3)
        p.complain(name, fmt::format("{} of {} has {} colours, expected one", name, p.title(), given->numbers.size() / 3));
    else if (std::min({c.r, c.g, c.b}) < 0.0)
        p.complain(name, fmt::format("{} of {} is negative: {}", name, p.title(), shown(c)));
    else
        return given;
    return nullptr;
}

Rgb within_srgb(const Rgb& c, double largest, Warnings& warnings) {
    const Rgb inside = glm::clamp(c, Rgb(0.0), Rgb(largest));
    constexpr double slack = 1e-3;  // a neutral spectrum comes out as 1 ± 1e-4
    if (max_component(glm::abs(c - inside)) > slack * std::max(1.0, max_component(c)))
        warnings.add("spectrum outside the colours of sRGB, cut to them");
    return inside;
}

double value_at(const SpectrumTable& s, double wavelength) {
    const auto next = std::upper_bound(s.wavelengths.begin(), s.wavelengths.end(), wavelength);
    if (next == s.wavelengths.begin()) return s.values.front();
    if (next == s.wavelengths.end()) return s.values.back();
    const auto i = static_cast<std::size_t>(next - s.wavelengths.begin());
    const double t = (wavelength - s.wavelengths[i - 1]) / (s.wavelengths[i] - s.wavelengths[i - 1]);
    return s.values[i - 1] + t * (s.values[i] - s.values[i - 1]);
}

std::vector<double> read_numbers(const std::string& path) {
    Tokens tokens(path, read_unpacked(path));
    std::vector<double> numbers;
    while (const std::optional<Token> token = tokens.next()) {
        double value = 0.0;
        const char* end = token->text.data() + token->text.size();
        const auto [at, error] = std::from_chars(token->text.data(), end, value);
        if (token->is_string || at != end || error != std::errc() || !std::isfinite(value))
            throw InputError(tokens.place(*token), fmt::format("expected a number, found {}", token->shown()));
        numbers.push_back(value);
    }
    return numbers;
}

SpectrumTable table_of(const std::vector<double>& numbers, const std::string& title, const Location& place) {
    SpectrumTable table;
    if (numbers.size() % 2 != 0) throw InputError(place, fmt::format("{} has an odd number of numbers, expected pairs", title));
    for (std::size_t i = 0; i < numbers.size(); i += 2) {
        if (i > 0 && numbers[i] <= numbers[i - 2])
            throw InputError(place, fmt::format("the wavelength {} of {} follows {}, expected increasing ones", numbers[i], title,
                                                numbers[i - 2]));
        if (numbers[i + 1] < 0.0)
            throw InputError(place, fmt::format("{} is negative at {} nm: {}", title, numbers[i], numbers[i + 1]));
        table.wavelengths.push_back(numbers[i]);
        table.values.push_back(numbers[i + 1]);
    }
    if (table.wavelengths.size() < 2)
        throw InputError(
            place, fmt::format("{} has {} of the at least 2 pairs of a wavelength and a value", title, table.wavelengths.size()));
    return table;
}

// Throws InputError for a name that is neither known nor that of a file.
SpectrumTable read_table(const Parameter& p, const std::string& title, Importer& importer) {
    if (p.texts.empty()) return table_of(p.numbers, title, p.place);
    if (p.texts.size() > 1) throw InputError(p.place, fmt::format("{} has {} names, expected one", title, p.texts.size()));
    const std::string& name = p.texts.front();
    if (name.find('.') == std::string::npos)
        throw InputError(p.place, fmt::format("the spectrum '{}' of {} is not known here{}", printable(name), title,
                                              did_you_mean(name, spectrum_names())));
    const std::string path = find_file(name, importer.main_file(), p.place);
    importer.scene.files.push_back(path);
    return table_of(read_numbers(path), title, {path});
}

// The colour of a spectrum at luminance 1.
Rgb colour_of(const SpectrumTable& table, Parameters& p, const std::string& name, Importer& importer) {
    const Rgb c = spectrum_to_rgb(table, Illuminant::equal_energy);
    const double luminance = (glm::inverse(rgb_from_xyz()) * c).y;
    if (luminance > 0.0) return within_srgb(c / luminance, INFINITY, importer.warnings);
    p.complain(name, fmt::format("{} of {} is black between 360 and 830 nm", name, p.title()));
    return Rgb(0.0);
}

SpectrumTable blackbody(double temperature) {
    SpectrumTable table;
    for (double w = cie::first_wavelength; w <= cie::last_wavelength; w += 1.0) {
        table.wavelengths.push_back(w);
        // Values are relative to the last one, so that no temperature is beyond the range of numbers.
        table.values.push_back(blackbody_radiance(w, temperature) / blackbody_radiance(cie::last_wavelength, temperature));
    }
    return table;
}

}  // namespace

std::optional<SpectrumTable> find_table(Parameters& p, const std::string& name, Importer& importer) {
    const Parameter* given = p.find(name, {"spectrum"});
    if (!given) return std::nullopt;
    try {
        return read_table(*given, fmt::format("{} of {}", name, p.title()), importer);
    } catch (const InputError& e) {
        p.complain_whole(name, e);
        return std::nullopt;
    }
}

std::optional<Rgb> find_reflectance(Parameters& p, const std::string& name, Importer& importer) {
    if (const Parameter* given = find_rgb(p, name)) {
        const Rgb c = first_rgb(*given);
        if (max_component(c) <= 1.0) return c;
        p.complain(name, fmt::format("{} of {} is {}, expected at most 1", name, p.title(), shown(c)));
        return std::nullopt;
    }
    const std::optional<SpectrumTable> table = find_table(p, name, importer);
    if (!table) return std::nullopt;
    return within_srgb(spectrum_to_rgb(*table, Illuminant::d65), 1.0, importer.warnings);
}

std::optional<Rgb> find_light_colour(Parameters& p, const std::string& name, Importer& importer) {
    if (const Parameter* given = find_rgb(p, name)) return first_rgb(*given);
    if (const Parameter* given = p.find(name, {"blackbody"})) {
        const double temperature = given->numbers[0];
        if (given->numbers.size() != 1)
            p.complain(name,
                       fmt::format("{} of {} has {} values, expected one temperature", name, p.title(), given->numbers.size()));
        else if (!(temperature >= 100.0 && temperature <= 1e6))
            p.complain(name, fmt::format("{} of {} is {} K, expected from 100 to 1000000", name, p.title(), temperature));
        else
            return colour_of(blackbody(temperature), p, name, importer);
        return std::nullopt;
    }
    if (const Parameter* given = p.find(name, {"spectrum"}); given && given->texts.size() == 1)
        if (const std::optional<Rgb> c = illuminant(given->texts.front())) return within_srgb(*c, INFINITY, importer.warnings);
    const std::optional<SpectrumTable> table = find_table(p, name, importer);
    return table ? std::optional(colour_of(*table, p, name, importer)) : std::nullopt;
}

std::optional<double> find_index(Parameters& p, const std::string& name, Importer& importer) {
    std::optional<double> index = p.number(name);
    const Parameter* given = p.find(name, {"spectrum"});
    if (!index && !given) return std::nullopt;
    if (given) {
        bool disperses = true;
        if (given->texts.size() == 1) index = glass(given->texts.front());
        if (!index) {
            const std::optional<SpectrumTable> table = find_table(p, name, importer);
            if (!table) return std::nullopt;
            index = value_at(*table, line_d);
            disperses = std::any_of(table->values.begin(), table->values.end(), [&](double v) { return v != *index; });
        }
        if (disperses)
            importer.warnings.add("glass refracts all colours alike, as yellow light (587.6 nm): dispersion is left out");
    }
    if (*index > 0.0) return index;
    p.complain(name, fmt::format("{} of {} is {}, expected more than 0", name, p.title(), *index));
    return std::nullopt;
}

std::optional<Rgb> find_metal_index(Parameters& p, const std::string& name, Importer& importer) {
    if (const Parameter* given = find_rgb(p, name)) return first_rgb(*given);
    if (const Parameter* given = p.find(name, {"spectrum"}); given && given->texts.size() == 1)
        if (const std::optional<MetalSpectrum> known = metal(given->texts.front())) return known->value;
    const std::optional<SpectrumTable> table = find_table(p, name, importer);
    if (!table) return std::nullopt;
    return glm::max(spectrum_to_rgb(*table, Illuminant::equal_energy), Rgb(0.0));
}

}  // namespace neumann::reader::pbrt
