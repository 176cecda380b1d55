#include "core/reader/formats/collada/sky.h"

#include "core/reader/formats/make_elements.h"

namespace neumann::reader::collada {

Element make_sky(const Rgb& radiance, int up, const Location& place, RawScene& scene) {
    constexpr int width = 4, height = 256;
    Texels picture{width, height, 3};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int channel = 0; channel < 3; ++channel)
                picture.values.push_back(y < height / 2 ? static_cast<float>(radiance[channel]) : 0.0F);
    const std::string name = "sky.exr";
    scene.in_memory.pictures[name] = std::make_shared<const Texels>(std::move(picture));

    Element emitter = make_object("emitter", "envmap", place);
    add_string(emitter, "filename", name, place);
    // Up is +y of the picture's own space; its other axes do not matter.
    Mat4 to_world(1.0);
    if (up == 0) to_world = Mat4(0.0, -1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    if (up == 2) to_world = Mat4(1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    add_matrix(emitter, "to_world", to_world, place);
    return emitter;
}

}  // namespace neumann::reader::collada
