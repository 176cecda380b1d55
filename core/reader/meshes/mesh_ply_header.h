// Reads the header of a PLY file and checks that it describes a mesh.
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
    PlyType type;  // type of the items, for a list
    bool is_list = false;
    PlyType count_type = PlyType::u8;
    // The role of the property: 0 … 7 for x, y, z, nx, ny, nz and the texture coordinates of a vertex, 0 for the vertex indices of
    // a face, first_attribute + 3 i + c for channel c of the i-th attribute of the element, −1 for all others.
    int slot = -1;
    static constexpr int first_attribute = 8;
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
    MeshText::LineColumn place;
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

// Leaves the cursor at the body. Attributes are named as in Mitsuba: the properties r, g, b or red, green, blue of a vertex are
// "vertex_color"; p_r, p_g, p_b are "vertex_p_color"; p_x, p_y, p_z, or p_0, p_1, p_2, or p_1, p_2, p_3, or the first of these
// alone, are "vertex_p"; those of a face are "face_…". Refuses a requested attribute with another number of channels; alpha is
// ignored.
PlyHeader read_ply_header(MeshText& text, const std::vector<std::string>& attributes);

}  // namespace neumann
