#include "core/reader/plugins/mesh_shape.h"

#include "core/reader/meshes/mesh_file.h"
#include "core/reader/plugins/textures.h"

#include <algorithm>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

// Normalises v; 0 if the triangle has no area. v is scaled first, because squares of small lengths underflow.
Vec3 unit(const Vec3& v) {
    const double largest = max_component(glm::abs(v));
    return largest > 0.0 ? glm::normalize(v / largest) : Vec3(0.0);
}

Vec3 triangle_normal(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
    const Vec3 a = unit(mesh.vertices[t[1]] - mesh.vertices[t[0]]), b = unit(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    return unit(glm::cross(a, b));
}

// Orients each triangle to the side of its vertex normals. Returns how many of them the file has on the other side: seen from
// there, before they were mirrored, their corners are counter-clockwise.
std::size_t orient_by_normals(TriangleMesh& mesh, bool mirrored) {
    std::size_t others = 0;
    for (std::array<std::uint32_t, 3>& t : mesh.triangles) {
        const double side = glm::dot(triangle_normal(mesh, t), mesh.normals[t[0]] + mesh.normals[t[1]] + mesh.normals[t[2]]);
        if (side < 0.0) std::swap(t[1], t[2]);
        if (mirrored ? side > 0.0 : side < 0.0) ++others;
    }
    return others;
}

// Computes vertex normals by Thürmer and Wüthrich, Computing Vertex Normals from Polygonal Facets, 1998.
void smooth(TriangleMesh& mesh) {
    mesh.normals.assign(mesh.vertices.size(), Vec3(0.0));
    for (const std::array<std::uint32_t, 3>& t : mesh.triangles) {
        const Vec3 n = triangle_normal(mesh, t);
        if (n == Vec3(0.0)) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3& corner = mesh.vertices[t[i]];
            const Vec3 a = unit(mesh.vertices[t[(i + 1) % 3]] - corner), b = unit(mesh.vertices[t[(i + 2) % 3]] - corner);
            mesh.normals[t[i]] += n * std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
        }
    }
    for (Vec3& n : mesh.normals) n = unit(n);
}

// Whether vertex normals equal the triangles' normals, up to the rounding of normals in files, which no picture shows.
bool is_flat(const TriangleMesh& mesh) {
    constexpr double flat_cosine = 1.0 - 1e-8;
    return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const std::array<std::uint32_t, 3>& t) {
        const Vec3 n = triangle_normal(mesh, t);
        return n == Vec3(0.0) || std::all_of(t.begin(), t.end(), [&](std::uint32_t i) {
                   return mesh.normals[i] == Vec3(0.0) || glm::dot(n, mesh.normals[i]) > flat_cosine;
               });
    });
}

}  // namespace

TriangleMesh read_mesh_shape(Properties& p, const Context& context) {
    const Mat4 to_world = p.transform("to_world");
    const std::string& type = p.element().attribute("type").value;
    const Attribute& filename = p.require("filename", {"string"}).attribute("value");
    const bool flip_normals = p.boolean("flip_normals").value_or(false);
    bool face_normals = p.boolean("face_normals").value_or(false);
    const std::int64_t index = type == "serialized" ? p.integer("shape_index").value_or(0) : 0;
    if (index < 0) p.complain("shape_index", fmt::format("shape_index is {}, expected 0 or more", index));

    const bool flip_coordinates = p.boolean("flip_tex_coords").value_or(type == "obj");

    p.refuse_rest();
    if (index < 0) throw AlreadyReported();
    const auto& in_memory = context.document.in_memory.meshes;
    const auto ready = in_memory.find(filename.value);
    const bool is_on_disk = type != "ply" || ready == in_memory.end();
    const std::string path = is_on_disk ? context.document.find_file(filename) : "";
    if (is_on_disk) context.mesh_files.push_back(path);
    MeshFile file;
    if (!is_on_disk) {
        file = *ready->second;
    } else if (type == "serialized") {
        SerializedMesh serialized = read_serialized(path, static_cast<std::uint64_t>(index));
        face_normals = face_normals || serialized.face_normals;
        file = std::move(serialized);
    } else if (type == "obj") {
        file = read_obj(path);
    } else {
        std::vector<std::string> attributes;
        for (const auto& [name, e] : mesh_attributes_of(p.element(), context.objects)) attributes.push_back(name);
        file = read_ply(path, attributes);
    }
    TriangleMesh mesh = std::move(file.mesh);
    const bool mirrored = glm::determinant(glm::dmat3(to_world)) < 0.0;
    std::size_t others = mirrored ? mesh.triangles.size() : 0;  // triangles that have another front in Mitsuba 3.10
    for (Vec3& v : mesh.vertices) {
        v = Vec3(to_world * glm::dvec4(v, 1.0));
        if (!is_finite(v)) p.fail("to_world", "moves a vertex out of the range of numbers");
    }
    if (flip_coordinates)
        for (Vec2& uv : mesh.uv) uv.y = 1.0 - uv.y;

    if (!face_normals) {
        mesh.normals = std::move(file.normals);
        if (mesh.normals.empty()) {
            smooth(mesh);
        } else {
            const glm::dmat3 linear(to_world);
            const double scale = max_component(
                {max_component(glm::abs(linear[0])), max_component(glm::abs(linear[1])), max_component(glm::abs(linear[2]))});
            const glm::dmat3 to_world_normal = glm::transpose(glm::inverse(linear / scale));
            for (Vec3& n : mesh.normals) n = unit(to_world_normal * n);
            others = orient_by_normals(mesh, mirrored);
        }
        if (is_flat(mesh)) mesh.normals = {};
    }
    if (others > 0 && p.element().place.file.ends_with(".xml"))
        context.warnings.add(
            fmt::format("'{}': {} of {} triangles have the front that they have in Mitsuba up to 3.9.1: the side of "
                        "their normals, or without normals that from which their corners are counter-clockwise "
                        "after to_world; in 3.10 it is the other side",
                        filename.value, others, mesh.triangles.size()));
    if (flip_normals) {
        for (std::array<std::uint32_t, 3>& t : mesh.triangles) std::swap(t[1], t[2]);
        for (Vec3& n : mesh.normals) n = -n;
    }
    return mesh;
}

}  // namespace neumann::reader
