#include "apps/output/files/rendered_picture.h"

#include <array>

namespace neumann {

namespace {

struct PartOfMeans {
    const char* suffix;
    MeanWithError& (*of)(PictureMeans&);
};
constexpr std::array<PartOfMeans, 4> parts{{{"", [](PictureMeans& m) -> MeanWithError& { return m.all; }},
                                            {".R", [](PictureMeans& m) -> MeanWithError& { return m.channel[0]; }},
                                            {".G", [](PictureMeans& m) -> MeanWithError& { return m.channel[1]; }},
                                            {".B", [](PictureMeans& m) -> MeanWithError& { return m.channel[2]; }}}};
struct Figure {
    const char* name;
    double MeanWithError::*value;
};
constexpr std::array<Figure, 3> figures{{{"neumann:mean", &MeanWithError::mean},
                                         {"neumann:mean_stderr", &MeanWithError::standard_error},
                                         {"neumann:mean_degrees_of_freedom", &MeanWithError::degrees_of_freedom}}};

std::optional<double> number(const Attributes& attributes, const std::string& name) {
    const auto found = attributes.find(name);
    if (found == attributes.end()) return std::nullopt;
    if (const auto* whole = std::get_if<std::int64_t>(&found->second)) return static_cast<double>(*whole);
    if (const auto* real = std::get_if<double>(&found->second)) return *real;
    return std::nullopt;
}

std::optional<PictureMeans> means_in(const Attributes& attributes) {
    PictureMeans means;
    for (const PartOfMeans& part : parts)
        for (const auto& [name, value] : figures) {
            const auto found = number(attributes, name + std::string(part.suffix));
            if (!found) return std::nullopt;
            part.of(means).*value = *found;
        }
    return means;
}

}  // namespace

Attributes mean_attributes(const PictureMeans& means) {
    Attributes attributes;
    PictureMeans copy = means;
    for (const PartOfMeans& part : parts)
        for (const auto& [name, value] : figures) attributes[name + std::string(part.suffix)] = part.of(copy).*value;
    return attributes;
}

RenderedPicture read_rendered_picture(const std::string& path) {
    RenderedPicture result;
    Attributes attributes;
    result.picture = read_exr(path, &attributes);
    result.picture.pixels_are_independent = !attributes.contains("neumann:pixels");
    const auto variance = attributes.find("neumann:variance");
    if (variance != attributes.end()) {
        const auto* text = std::get_if<std::string>(&variance->second);
        result.infinite_variance = text != nullptr && text->starts_with("infinite");
    }
    result.means = means_in(attributes);
    result.degrees_of_freedom = number(attributes, "neumann:degrees_of_freedom");
    result.picture.degrees_of_freedom = result.degrees_of_freedom.value_or(0.0);
    return result;
}

}  // namespace neumann
