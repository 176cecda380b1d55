// The header of a PLY file, checked for what a mesh needs.
#pragma once

#include "core/reader/mesh_text.h"

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
    // What it is to a mesh: x, y, z, nx, ny, nz of a vertex are 0 … 5, the vertex indices of a face 0, all else −1.
    int slot = -1;
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
    MeshText::Place place;

    const PlyProperty* find(int slot) const;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    std::uint64_t vertex_count = 0;
    bool has_normals = false;
};

// Leaves the cursor at the body.
PlyHeader read_ply_header(MeshText& text);

}  // namespace neumann
