#include "apps/output/files/other_picture.h"

#include "core/base/error.h"
#include "core/image/image_io.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <vector>

namespace neumann {

namespace {

// "Combined" of "ViewLayer.Combined".
std::string end_of(const std::string& layer) { return layer.substr(layer.rfind('.') + 1); }

bool is_whole_picture(const std::string& layer) {
    std::string end = end_of(layer);
    std::ranges::transform(end, end.begin(), [](unsigned char c) { return std::tolower(c); });
    return end == "combined" || end == "beauty";
}

// The layers in the form that --channels takes.
std::string listed(std::vector<std::string> layers) {
    std::ranges::replace(layers, "", "RGB");
    return fmt::format("{}", fmt::join(layers, ", "));
}

std::string choose(const std::string& path, const std::vector<std::string>& layers, const std::optional<std::string>& wanted) {
    const auto has = [&](const std::string& layer) { return std::ranges::find(layers, layer) != layers.end(); };
    if (!wanted && layers.size() == 1) return layers.front();
    if (wanted && has(*wanted)) return *wanted;
    if ((!wanted || *wanted == "RGB") && has("")) return "";
    std::vector<std::string> fit;
    std::ranges::copy_if(layers, std::back_inserter(fit),
                         [&](const std::string& l) { return wanted ? end_of(l) == *wanted : is_whole_picture(l); });
    if (fit.size() == 1) return fit.front();
    if (wanted)
        throw InputError(
            fit.empty() ? fmt::format("{}: --channels {}: expected one of {}", path, *wanted, listed(layers))
                        : fmt::format("{}: --channels {}: is the end of {}; expected one of them", path, *wanted, listed(fit)));
    throw InputError(fmt::format("{}: which layer is the picture? Expected --channels with one of {}", path, listed(layers)));
}

}  // namespace

Image read_other_picture(const std::string& path, const std::optional<std::string>& layer) {
    const Texels texels = read_layer(path, choose(path, layers_in(path), layer));
    if (texels.values.empty() || texels.is_encoded)
        throw InputError(path + ": holds whole numbers, expected radiance in floats, such as OpenEXR");
    Image image(texels.width, texels.height);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c)
                image.at(x, y)[c] =
                    double{texels.values[texels.index(x, y) + static_cast<std::size_t>(texels.channels == 3 ? c : 0)]};
    return image;
}

}  // namespace neumann
