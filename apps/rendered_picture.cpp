#include "apps/rendered_picture.h"

#include "core/image/image_io.h"

namespace neumann {

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
    const auto found = attributes.find("neumann:degrees_of_freedom");
    if (found == attributes.end()) return result;
    if (const auto* whole = std::get_if<std::int64_t>(&found->second)) result.degrees_of_freedom = static_cast<double>(*whole);
    if (const auto* real = std::get_if<double>(&found->second)) result.degrees_of_freedom = *real;
    result.picture.degrees_of_freedom = result.degrees_of_freedom.value_or(0.0);
    return result;
}

}  // namespace neumann
