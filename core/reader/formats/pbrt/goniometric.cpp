#include "core/reader/formats/pbrt/goniometric.h"

#include "core/reader/formats/find_file.h"
#include "core/reader/formats/make_elements.h"
#include "core/reader/formats/pbrt/octahedral.h"
#include "core/reader/meshes/mesh_text.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace neumann::reader::pbrt {

namespace {

// Pixels along an edge of the cube's faces: as many as across the picture, which is finer, and enough for a smooth cos³θ.
constexpr int min_face = 256, max_face = 1024;

// The rotation that takes +z to an axis.
Mat4 towards(int axis, double sign) {
    Mat4 m(0.0);
    m[2][axis] = sign;
    m[0][(axis + 1) % 3] = 1.0;
    m[1][(axis + 2) % 3] = sign;
    m[3][3] = 1.0;
    return m;
}

}  // namespace

std::vector<Element> make_projectors(const Picture& square, const Rgb& intensity, const Mat4& to_world, const Location& place,
                                     Importer& importer) {
    // As in pbrt, the intensity is the mean of the channels, at the nearest pixel.
    std::vector<double> from;
    for_each_texel(square, importer, [&](const Rgb& c) { from.push_back((c.r + c.g + c.b) / 3.0); });
    const auto size = static_cast<int>(std::lround(std::sqrt(static_cast<double>(from.size()))));
    const auto at = [&](const Vec3& w) {
        const Vec2 p = square_of_direction(w) * static_cast<double>(size);
        const auto x = static_cast<std::size_t>(std::clamp(static_cast<int>(p.x), 0, size - 1)),
                   y = static_cast<std::size_t>(std::clamp(static_cast<int>(p.y), 0, size - 1));
        return from[y * static_cast<std::size_t>(size) + x];
    };
    const int face = std::clamp(size, min_face, max_face);
    std::vector<Element> lights;
    for (int side = 0; side < 6; ++side) {
        const Mat4 turn = towards(side / 2, side % 2 == 0 ? 1.0 : -1.0);
        auto slide = std::make_shared<Texels>();
        slide->width = slide->height = face;
        slide->channels = 3;
        for (int y = 0; y < face; ++y)
            for (int x = 0; x < face; ++x) {
                // A projector of 90° has +x at the left and +y above. Its intensity is π E / cos³θ, where a pixel of the area dA
                // has the solid angle cos³θ dA: the mean of E over the pixel keeps the power.
                constexpr int parts = 4;
                double sum = 0.0;
                for (int i = 0; i < parts; ++i)
                    for (int j = 0; j < parts; ++j) {
                        const Vec3 local(1.0 - 2.0 * (x + (j + 0.5) / parts) / face, 1.0 - 2.0 * (y + (i + 0.5) / parts) / face,
                                         1.0);
                        const double length = length_of(local);
                        sum += at(Vec3(turn * glm::dvec4(local / length, 0.0))) / (length * length * length);
                    }
                for (int c = 0; c < 3; ++c)
                    slide->values.push_back(static_cast<float>(sum / (parts * parts) * std::numbers::inv_pi * intensity[c]));
            }
        const std::string name = importer.unused_name(fmt::format("textures/{}-{}.exr", stem_of(square.path), side + 1));
        importer.scene.in_memory.pictures[name] = std::move(slide);
        Element light = make_object("emitter", "projector", place);
        Element texture = make_object("texture", "bitmap", place);
        texture.attributes.push_back({"name", "irradiance", place});
        add_string(texture, "filename", name, place);
        add_string(texture, "wrap_mode", "clamp", place);
        add_boolean(texture, "raw", true, place);
        add(light, std::move(texture));
        add_float(light, "fov", 90.0, place);
        add_matrix(light, "to_world", to_world * turn, place);
        lights.push_back(std::move(light));
    }
    return lights;
}

}  // namespace neumann::reader::pbrt
