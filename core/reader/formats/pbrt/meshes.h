// Shapes that are meshes.
#pragma once

#include "core/reader/formats/pbrt/importer.h"
#include "core/reader/meshes/mesh_file.h"

#include <functional>
#include <optional>
#include <string>

namespace neumann::reader::pbrt {

struct MadeMesh {
    MeshFile file;
    // How many triangles in succession are one shape of pbrt, which counts each as a light of its own; nothing: their number
    // varies.
    std::optional<std::size_t> triangles_of_light = 1;
};

// All throw InputError, or Told if parameters are wrong.

// "trianglemesh", by its parameters.
MadeMesh make_triangle_mesh(Parameters& p);
// "plymesh", in its file, which may be packed.
MadeMesh read_ply_mesh(Parameters& p, Importer& importer);
// "bilinearmesh". Patches that are flat are two triangles; others are cut into 16 × 16 pairs, with a warning.
MadeMesh make_bilinear_mesh(Parameters& p, Importer& importer);
// "loopsubdiv": Loop's subdivision, with the limit's positions and normals, as pbrt has it.
MadeMesh make_loop_surface(Parameters& p);

// Where a plane through the z axis cuts a surface: distance from the axis and height of a point, and the normal there.
struct Profile {
    Vec2 point, normal;
};
// The profile, which v in [0, 1] runs along, turned from the x axis by u · `phi_max`: with its normals, cut into `rows` along v and
// cuts_of(phi_max) along u. At a radius r it is within r (1 − cos(π / 256)) < 8e-5 r of the round surface.
MadeMesh make_surface_of_revolution(const std::function<Profile(double v)>& profile, std::uint32_t rows, double phi_max);
// At 256 to the whole turn; at least 1.
std::uint32_t cuts_of(double angle);

// The parameter `indices`, checked against the number of vertices; `size`: how many make a face.
std::vector<std::uint32_t> read_indices(Parameters& p, std::size_t vertex_count, std::size_t size);

// pbrt's coordinates of triangles without any: (0, 0), (1, 0) and (1, 1) in each.
MeshFile with_coordinates(const MeshFile& file);

}  // namespace neumann::reader::pbrt
