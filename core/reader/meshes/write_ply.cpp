#include "core/reader/meshes/write_ply.h"

#include <algorithm>
#include <array>
#include <bit>
#include <functional>

#include <fmt/format.h>

namespace neumann {

namespace {

static_assert(std::endian::native == std::endian::little);

// Properties of a vertex or a triangle that are written together.
struct Column {
    std::vector<std::string> names;
    std::function<double(std::size_t, std::size_t)> value;  // of element i, for the j-th name
};

template <class T>
void append(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

bool are_floats(const Column& column, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < column.names.size(); ++c) {
            const double v = column.value(i, c);
            if (static_cast<double>(static_cast<float>(v)) != v) return false;
        }
    return true;
}

// The properties of vertex_color are r, g, b; of vertex_p_color p_r, p_g, p_b; of vertex_p p_0, p_1, p_2.
Column attribute_column(const MeshAttribute& attribute) {
    constexpr std::string_view color = "color";
    const std::string name = attribute.name.substr(attribute.name.find('_') + 1);
    const bool is_color = name == color || name.ends_with("_color");
    const std::string prefix = is_color ? name.substr(0, name.size() - color.size()) : name + "_";
    Column column{{}, [&attribute](std::size_t i, std::size_t c) { return double{attribute.values[i][c]}; }};
    for (const char end : std::string_view(is_color ? "rgb" : "012")) column.names.push_back(prefix + end);
    return column;
}

class Elements {
public:
    Elements(std::string name, std::size_t count) : name_(std::move(name)), count_(count) {}
    void add(Column column) {
        are_floats_.push_back(are_floats(column, count_));
        columns_.push_back(std::move(column));
    }
    std::string header(std::string_view list) const {
        std::string text = fmt::format("element {} {}\n{}", name_, count_, list);
        for (std::size_t k = 0; k < columns_.size(); ++k)
            for (const std::string& name : columns_[k].names)
                text += fmt::format("property {} {}\n", are_floats_[k] ? "float" : "double", name);
        return text;
    }
    void append_to(std::string& bytes, std::size_t i) const {
        for (std::size_t k = 0; k < columns_.size(); ++k)
            for (std::size_t c = 0; c < columns_[k].names.size(); ++c) {
                const double v = columns_[k].value(i, c);
                if (are_floats_[k])
                    append(bytes, static_cast<float>(v));
                else
                    append(bytes, v);
            }
    }

private:
    std::string name_;
    std::size_t count_;
    std::vector<Column> columns_;
    std::vector<bool> are_floats_;
};

}  // namespace

std::string encode_ply(const MeshFile& file) {
    const TriangleMesh& mesh = file.mesh;
    const auto components_of = [](const auto& vectors) {
        return [&vectors](std::size_t i, std::size_t c) { return vectors[i][static_cast<glm::length_t>(c)]; };
    };
    Elements vertices("vertex", mesh.vertices.size()), faces("face", mesh.triangles.size());
    vertices.add({{"x", "y", "z"}, components_of(mesh.vertices)});
    if (!file.normals.empty()) vertices.add({{"nx", "ny", "nz"}, components_of(file.normals)});
    if (!mesh.uv.empty()) vertices.add({{"u", "v"}, components_of(mesh.uv)});
    for (const MeshAttribute& a : mesh.attributes) (a.of_triangles ? faces : vertices).add(attribute_column(a));

    std::string bytes = "ply\nformat binary_little_endian 1.0\n" + vertices.header("") +
                        faces.header("property list uchar uint vertex_indices\n") + "end_header\n";
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) vertices.append_to(bytes, i);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        append(bytes, std::uint8_t{3});
        for (const std::uint32_t v : mesh.triangles[i]) append(bytes, v);
        faces.append_to(bytes, i);
    }
    return bytes;
}

}  // namespace neumann
