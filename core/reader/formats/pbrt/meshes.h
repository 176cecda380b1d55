// Makes shapes that are meshes.
#pragma once

#include "core/reader/formats/pbrt/importer.h"
#include "core/reader/meshes/mesh_file.h"

#include <functional>
#include <optional>
#include <string>

namespace neumann::reader::pbrt {

struct MadeMesh {
    MeshFile file;
    // How many triangles in succession are one shape of pbrt, which counts each as a light of its own; nothing if their
    // number varies.
    std::optional<std::size_t> triangles_of_light = 1;
};

// All functions throw InputError, or AlreadyReported if parameters are wrong.

// Makes the "trianglemesh" that its parameters hold.
MadeMesh make_triangle_mesh(Parameters& p);
// Reads the file of a "plymesh", which may be packed.
MadeMesh read_ply_mesh(Parameters& p, Importer& importer);
// Makes a "bilinearmesh". Flat patches are two triangles; others are cut into 16 × 16 pairs, with a warning.
MadeMesh make_bilinear_mesh(Parameters& p, Importer& importer);
// Makes a "loopsubdiv" by Loop's subdivision, with the positions and normals of the limit, as pbrt does.
MadeMesh make_loop_surface(Parameters& p);

// A point where a plane through the z axis cuts a surface: its distance from the axis, its height, and the normal there.
struct Profile {
    Vec2 point, normal;
};
// The surface of a profile, along which v runs in [0, 1], turned from the x axis by u · `phi_max`. It has normals, and is cut into
// `rows` along v and cuts_of(phi_max) along u. At a radius r it is within r (1 − cos(π / 256)) < 8e-5 r of the round surface.
MadeMesh make_surface_of_revolution(const std::function<Profile(double v)>& profile, std::uint32_t rows, double phi_max);
// The number of cuts, at 256 to the whole turn, and at least 1.
std::uint32_t cuts_of(double angle);

// Reads the parameter `indices` and checks it against the number of vertices; `size` indices make a face.
std::vector<std::uint32_t> read_indices(Parameters& p, std::size_t vertex_count, std::size_t size);

// Adds pbrt's coordinates for triangles that have none: (0, 0), (1, 0) and (1, 1) in each.
MeshFile with_coordinates(const MeshFile& file);

}  // namespace neumann::reader::pbrt
