// The header of a PLY file, checked for what a mesh needs.
#pragma once

#include "core/reader/meshes/mesh_text.h"

#include <string>
#include <vector>

namespace neumann {

enum class PlyFormat { ascii, little_endian, big_endian };
enum class PlyType { i8, u8, i16, u16, i32, u32, f32, f64 };

std::size_t size_of(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type;  // of the items of a list
    bool is_list = false;
    PlyType count_type = PlyType::u8;
    // What it is to a mesh: x, y, z, nx, ny, nz and the texture coordinates of a vertex are 0 … 7, the vertex indices of a face 0,
    // channel c of the i-th attribute of the element is first_attribute + 3 i + c, all else −1.
    int slot = -1;
    static constexpr int first_attribute = 8;
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
    MeshText::Place place;
    struct Attribute {
        std::string name;
        bool is_grey;  // has one channel
    };
    std::vector<Attribute> attributes = {};

    const PlyProperty* find(int slot) const;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    std::uint64_t vertex_count = 0;
    bool has_normals = false, has_coordinates = false;
};

// Leaves the cursor at the body. The attributes are named as by Mitsuba: of properties r, g, b or red, green, blue of a vertex
// "vertex_color", of p_r, p_g, p_b "vertex_p_color", and of p_x, p_y, p_z, or p_0, p_1, p_2, or p_1, p_2, p_3, or the first of them
// alone "vertex_p"; likewise "face_…". One that is asked for and has another number of channels is refused; alpha is left out.
PlyHeader read_ply_header(MeshText& text, const std::vector<std::string>& attributes);

}  // namespace neumann
