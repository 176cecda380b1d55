#include "core/reader/formats/pbrt/textures.h"

#include "core/base/did_you_mean.h"
#include "core/reader/formats/pbrt/colours.h"
#include "core/reader/meshes/mesh_text.h"
#include "core/reader/xml/element.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace neumann::reader::pbrt {

namespace {

// Reads a gamma such as "gamma 2.2".
double read_gamma(Parameters& p, const std::string& encoding) {
    double gamma = 0.0;
    const std::string digits = encoding.starts_with("gamma ") ? encoding.substr(6) : "";
    const auto [at, error] = std::from_chars(digits.data(), digits.data() + digits.size(), gamma);
    if (at == digits.data() + digits.size() && error == std::errc() && gamma > 0.0 && gamma < 100.0) return gamma;
    p.complain("encoding", fmt::format("encoding of {} is '{}'; allowed: sRGB, linear, and gamma with a number", p.title(),
                                       printable(encoding)));
    return 1.0;
}

const std::vector<std::string> texture_types = {"checkerboard", "constant", "imagemap", "mix", "scale"};

}  // namespace

Textures::Textures(PbrtScene& scene, Importer& importer) : importer_(importer) {
    std::map<std::string, Location> places[2];
    for (TextureEntity& e : scene.textures) {
        const auto known = places[e.is_float].try_emplace(e.name, e.place());
        importer.problems.attempt(e.place(), [&] {
            if (!known.second)
                throw InputError(e.place(), fmt::format("a second texture '{}', the first is at {}", printable(e.name),
                                                        to_string(known.first->second)));
        });
        const auto made = importer.problems.attempt(e.place(), [&] { return make(e); });
        textures_[e.is_float].try_emplace(e.name, made.value_or(TextureValue{Rgb(0.5)}));
    }
}

UvMapping Textures::read_mapping(Parameters& p) {
    p.choice("mapping", {"uv"}, "uv");
    UvMapping m;
    m.scale = {p.number("uscale", 1.0), p.number("vscale", 1.0)};
    m.offset = {p.number("udelta", 0.0), p.number("vdelta", 0.0)};
    for (const char* name : {"uscale", "vscale"})
        if (const double scale = name[0] == 'u' ? m.scale.x : m.scale.y; scale == 0.0)
            p.complain(name, fmt::format("{} of {} is 0", name, p.title()));
    return m;
}

TextureValue Textures::make_picture(TextureEntity& e) {
    Parameters& p = e.parameters;
    Picture picture;
    const std::optional<std::string> name = p.text("filename");
    if (!name) p.complain("filename", fmt::format("{} has no \"string filename\"", p.title()));
    picture.nearest = p.choice("filter", {"bilinear", "ewa", "point", "trilinear"}, "bilinear") == "point";
    picture.wrap = p.choice("wrap", {"clamp", "repeat"}, "repeat");
    p.ignore({"maxanisotropy"});  // for the filter ewa
    const double scale = p.number("scale", 1.0);
    if (scale < 0.0) p.complain("scale", fmt::format("scale of {} is negative: {}", p.title(), scale));
    const bool invert = p.boolean("invert").value_or(false);
    const std::string encoding = p.text("encoding").value_or("sRGB");
    picture.raw = encoding != "sRGB";
    const double gamma = encoding == "sRGB" || encoding == "linear" ? 1.0 : read_gamma(p, encoding);
    picture.mapping = read_mapping(p);
    p.finish();
    if (!name || p.is_wrong()) throw AlreadyReported();

    const Picture found = find_picture(*name, p.place("filename"), importer_);
    picture.path = found.path;
    picture.filename = found.filename;
    TextureValue result{picture};
    if (gamma != 1.0 && importer_.read_picture(picture.path)->is_encoded)
        result = apply(
            result, [&](const Rgb& c) { return glm::pow(c, Rgb(gamma)); }, importer_);
    if (scale != 1.0 || invert)
        result = apply(
            result, [&](const Rgb& c) { return invert ? glm::max(1.0 - scale * c, 0.0) : scale * c; }, importer_);
    return e.is_float ? as_number(result, importer_) : result;
}

TextureValue Textures::operand(TextureEntity& e, const std::string& name, double missing) {
    Parameters& p = e.parameters;
    if (e.is_float) return find_number(p, name).value_or(TextureValue{Rgb(missing)});
    if (const auto texture = find_texture(p, name, false)) return *texture;
    // Whether the value may be above 1 is checked where it is used.
    if (const Parameter* rgb = p.find(name, {"rgb"}); rgb && rgb->numbers.size() == 3) {
        const Rgb c(rgb->numbers[0], rgb->numbers[1], rgb->numbers[2]);
        if (std::min({c.r, c.g, c.b}) < 0.0) p.complain(name, fmt::format("{} of {} is negative", name, p.title()));
        return {c};
    }
    return {pbrt::find_reflectance(p, name, importer_).value_or(Rgb(missing))};
}

TextureValue Textures::make_checks(TextureEntity& e) {
    Parameters& p = e.parameters;
    if (const std::int64_t dimension = p.integer("dimension").value_or(2); dimension != 2)
        p.refuse("dimension", fmt::format("dimension of {} is {}", p.title(), dimension),
                 ", expected 2; solid textures are not supported");
    Checks checks;
    checks.squares = {std::make_shared<const TextureValue>(operand(e, "tex1", 1.0)),
                      std::make_shared<const TextureValue>(operand(e, "tex2", 0.0))};
    checks.mapping = read_mapping(p);
    for (const auto& square : checks.squares)
        if (const auto* inner = std::get_if<Checks>(&square->value)) checks.depth = std::max(checks.depth, inner->depth + 1);
    constexpr int max_check_depth = 6;  // each holds two, so their number doubles
    if (checks.depth > max_check_depth)
        throw InputError(e.place(), fmt::format("checkerboards are nested more than {} deep", max_check_depth));
    return {checks};
}

TextureValue Textures::make(TextureEntity& e) {
    Parameters& p = e.parameters;
    if (e.type == "imagemap") return make_picture(e);
    const auto finished = [&](TextureValue t) {
        p.finish();
        if (p.is_wrong()) throw AlreadyReported();
        return t;
    };
    if (e.type == "constant") return finished(operand(e, "value", 1.0));
    if (e.type == "checkerboard") return finished(make_checks(e));
    if (e.type == "scale") {
        const TextureValue value = operand(e, "tex", 1.0);
        const TextureValue scale = find_number(p, "scale").value_or(TextureValue{Rgb(1.0)});
        return finished(combine(
            value, scale, [](const Rgb& a, const Rgb& b) { return a * b; }, importer_, e.place()));
    }
    if (e.type == "mix") {
        const TextureValue first = operand(e, "tex1", 0.0), second = operand(e, "tex2", 1.0);
        const TextureValue amount = find_number(p, "amount").value_or(TextureValue{Rgb(0.5)});
        const auto times = [](const Rgb& a, const Rgb& b) { return a * b; };
        const auto rest = [](const Rgb& a, const Rgb& b) { return (1.0 - a) * b; };
        const TextureValue a = combine(amount, first, rest, importer_, e.place()),
                           b = combine(amount, second, times, importer_, e.place());
        return finished(combine(
            a, b, [](const Rgb& x, const Rgb& y) { return x + y; }, importer_, e.place()));
    }
    throw Unknown(e.place(), fmt::format("texture type '{}' is not supported", printable(e.type)),
                  "; " + allowed_instead(e.type, texture_types), "taken as 0.5");
}

std::optional<TextureValue> Textures::find_texture(Parameters& p, const std::string& name, bool is_float) {
    const Parameter* given = p.find(name, {"texture"});
    if (!given) return std::nullopt;
    const auto& known = textures_[is_float];
    const auto found = given->texts.size() == 1 ? known.find(given->texts.front()) : known.end();
    if (found != known.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& [other, texture] : known) names.push_back(other);
    p.complain(name, fmt::format("{} of {}: there is no {} texture '{}'{}", name, p.title(), is_float ? "float" : "spectrum",
                                 printable(given->texts.front()), did_you_mean(given->texts.front(), names)));
    return std::nullopt;
}

std::optional<TextureValue> Textures::find_number(Parameters& p, const std::string& name) {
    if (const auto texture = find_texture(p, name, true)) return texture;
    const std::optional<double> number = p.number(name);
    return number ? std::optional(TextureValue{Rgb(*number)}) : std::nullopt;
}

std::optional<TextureValue> Textures::find_reflectance(Parameters& p, const std::string& name) {
    if (const auto texture = find_texture(p, name, false)) {
        if (const Rgb* c = texture->constant(); c && max_component(*c) > 1.0)
            p.complain(name, fmt::format("{} of {} is ({}, {}, {}) by its texture, expected at most 1", name, p.title(), c->r, c->g,
                                         c->b));
        return texture;
    }
    const std::optional<Rgb> c = pbrt::find_reflectance(p, name, importer_);
    return c ? std::optional(TextureValue{*c}) : std::nullopt;
}

}  // namespace neumann::reader::pbrt
