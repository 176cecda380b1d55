#include "core/reader/xml/spectra.h"

#include "core/base/input_file.h"
#include "core/base/printable.h"
#include "core/image/colour/blackbody.h"
#include "core/image/colour/cie.h"
#include "core/reader/xml/numbers.h"
#include "core/reader/xml/properties.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

const std::vector<std::string> spectrum_types = {"blackbody", "d65", "irregular", "regular", "uniform"};

// Writes a list such as "400:0.5, 500:0.75".
class ListWriter {
public:
    void add(double wavelength, double value) { text_ += fmt::format("{}{}:{}", text_.empty() ? "" : ", ", wavelength, value); }
    const std::string& text() const { return text_; }

private:
    std::string text_;
};

// A line holds a wavelength in nm and a value, or nothing; # begins a comment.
std::string read_file(const std::string& path) {
    std::istringstream stream(read_input(path));
    ListWriter list;
    double last = 0.0;
    int number = 0;
    for (std::string line; std::getline(stream, line);) {
        ++number;
        const std::vector<std::string> words = split(line.substr(0, line.find('#')));
        if (words.empty()) continue;
        const Location place{path, number, static_cast<int>(line.find(words.front())) + 1};
        if (words.size() != 2)
            throw InputError(place, fmt::format("the line has {} numbers, expected a wavelength and a value", words.size()));
        for (const std::string& word : words)
            if (word.find_first_not_of("+-.0123456789eE") != std::string::npos)
                throw InputError(place, fmt::format("'{}' is not a number", glimpse_of(word)));
        const double wavelength = parse_number({"", words[0], place});
        if (!list.text().empty() && wavelength <= last)
            throw InputError(place, fmt::format("the wavelength {} follows {}, expected increasing ones", wavelength, last));
        last = wavelength;
        list.add(wavelength, parse_number({"", words[1], place}));
    }
    return list.text();
}

struct Range {
    double from, to;
};

Range read_range(Properties& p) {
    const std::optional<double> from = p.number("wavelength_min"), to = p.number("wavelength_max");
    const Range range{from.value_or(cie::first_wavelength), to.value_or(cie::last_wavelength)};
    if (!(range.from < range.to))
        p.fail(to ? "wavelength_max" : "wavelength_min",
               fmt::format("wavelength_max is {}, expected more than wavelength_min, {}", range.to, range.from));
    return range;
}

// In steps of 1 nm linear interpolation is right to 1e-5.
std::string read_blackbody(Properties& p) {
    p.require("temperature", {"float", "integer"});
    const double temperature = p.number("temperature").value_or(1.0);
    if (temperature <= 0.0) p.complain("temperature", fmt::format("temperature is {}, expected more than 0", temperature));
    const Range range = read_range(p);
    const double from = std::max(range.from, cie::first_wavelength), to = std::min(range.to, cie::last_wavelength);
    if (!(from < to)) p.fail("wavelength_min", "no wavelength from 360 to 830 is between wavelength_min and wavelength_max");
    const int cells = static_cast<int>(std::ceil(to - from));
    ListWriter list;
    for (int i = 0; i <= cells; ++i) {
        const double wavelength = from + (to - from) * i / cells;
        list.add(wavelength, blackbody_radiance(wavelength, temperature));
    }
    return list.text();
}

std::string read_regular(Properties& p) {
    const Range range = read_range(p);
    const Attribute& values = p.require("values", {"string"}).attribute("value");
    const std::vector<double> v = parse_numbers(values);
    if (v.size() < 2) throw InputError(values.place, fmt::format("values has {} numbers, expected at least 2", v.size()));
    ListWriter list;
    for (std::size_t i = 0; i < v.size(); ++i)
        list.add(range.from + (range.to - range.from) * static_cast<double>(i) / static_cast<double>(v.size() - 1), v[i]);
    return list.text();
}

std::string read_irregular(Properties& p) {
    const std::vector<double> w = parse_numbers(p.require("wavelengths", {"string"}).attribute("value"));
    const Attribute& values = p.require("values", {"string"}).attribute("value");
    const std::vector<double> v = parse_numbers(values);
    if (v.size() != w.size())
        throw InputError(values.place, fmt::format("values has {} numbers, expected {}, as wavelengths has", v.size(), w.size()));
    ListWriter list;
    for (std::size_t i = 0; i < v.size(); ++i) list.add(w[i], v[i]);
    return list.text();
}

// Reads a spectrum that has the same value in all colour channels.
std::string read_number(Properties& p, const std::string& type) {
    if (type == "d65") return fmt::format("{}", p.number("scale").value_or(1.0));
    p.require("value", {"float", "integer"});
    read_range(p);
    return fmt::format("{}", p.number("value").value_or(0.0));
}

void write_out_object(Element& e, const std::string& type, Problems& problems) {
    for (const Attribute& a : e.attributes)
        if (a.name == "value" || a.name == "filename")
            throw InputError(a.place, fmt::format("<spectrum> has both 'type' and '{}', expected one of them", a.name));
    const Objects none(Element{}, problems);
    Properties p(e, none);
    const bool is_number = type == "d65" || type == "uniform";
    const std::string text = is_number             ? read_number(p, type)
                             : type == "blackbody" ? read_blackbody(p)
                             : type == "regular"   ? read_regular(p)
                                                   : read_irregular(p);
    p.finish();
    if (is_number) e.tag = "float";
    if (type != "blackbody") std::erase_if(e.attributes, [](const Attribute& a) { return a.name == "type"; });
    e.attributes.push_back({"value", text, e.place});
    e.children.clear();
}

}  // namespace

SpectrumTable parse_spectrum(const Attribute& a) {
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

Rgb spectrum_within_srgb(const SpectrumTable& s, Illuminant illuminant, double largest, Warnings& warnings) {
    // A neutral spectrum comes out as 1 ± 1e-4 in each channel, by the rounding of the matrix; that is not worth a warning.
    constexpr double slack = 1e-3;
    const Rgb c = spectrum_to_rgb(s, illuminant);
    const Rgb inside = glm::clamp(c, Rgb(0.0), Rgb(largest));
    if (max_component(glm::abs(c - inside)) > slack * std::max(1.0, max_component(c)))
        warnings.add("spectrum outside the colours of sRGB, cut to them");
    return inside;
}

void take_textures_apart(Element& e) {
    static const std::vector<std::string> textures = {"bitmap", "checkerboard", "mesh_attribute", "rawconstant"};
    const Attribute* type = e.find("type");
    if (!type) return;
    const auto is_among = [&](const std::vector<std::string>& types) {
        return std::find(types.begin(), types.end(), type->value) != types.end();
    };
    if (e.tag == "spectrum" && is_among(textures))
        e.tag = "texture";
    else if (e.tag == "texture" && is_among(spectrum_types) && e.find("name") && !e.find("id"))
        e.tag = "spectrum";
}

void write_out_spectrum(Element& e, const std::string& parent_tag, Document& document, Problems& problems) {
    if (e.find("type")) {
        const std::string otherwise = parent_tag == "emitter" ? "0" : "0.5";
        if (const std::string known = type_of(e, spectrum_types, otherwise, problems); known != otherwise)
            write_out_object(e, known, problems);
        else
            e = {"float", {e.attribute("name"), {"value", otherwise, e.place}}, {}, e.place};
        return;
    }
    if (!e.children.empty())
        throw InputError(e.children.front().place,
                         fmt::format("<{}> is not supported in <spectrum> without 'type'", e.children.front().tag));
    const Attribute* filename = e.find("filename");
    if (!filename) {
        e.attribute("value");
        return;
    }
    if (const Attribute* value = e.find("value"))
        throw InputError(value->place, "<spectrum> has both 'filename' and 'value', expected one of them");
    const std::string path = document.find_file(*filename);
    document.files.push_back(path);
    e.attributes.push_back({"value", read_file(path), filename->place});
}

}  // namespace neumann::reader
