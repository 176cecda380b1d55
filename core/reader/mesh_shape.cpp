#include "core/reader/mesh_shape.h"

#include "core/reader/mesh_file.h"

#include <fmt/format.h>

namespace neumann::reader {

namespace {

// Of unit vectors, up to sign.
constexpr double flat_cosine = 1.0 - 1e-4;

// Length 1, or 0 where the triangle has no area; scaled first, since squares of small lengths vanish.
Vec3 unit(const Vec3& v) {
    const double largest = max_component(glm::abs(v));
    return largest > 0.0 ? glm::normalize(v / largest) : Vec3(0.0);
}

Vec3 triangle_normal(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
    const Vec3 a = unit(mesh.vertices[t[1]] - mesh.vertices[t[0]]), b = unit(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    return unit(glm::cross(a, b));
}

// Turns each triangle to the side that its vertex normals are on; false if some triangle is not flat.
bool orient_by_normals(TriangleMesh& mesh, const std::vector<Vec3>& normals) {
    for (std::array<std::uint32_t, 3>& t : mesh.triangles) {
        const Vec3 n = triangle_normal(mesh, t);
        if (n == Vec3(0.0)) continue;
        double least = 1.0, largest = -1.0;
        for (const std::uint32_t i : t) {
            const double cosine = glm::dot(n, normals[i]);
            least = std::min(least, cosine);
            largest = std::max(largest, cosine);
        }
        if (largest < -flat_cosine)
            std::swap(t[1], t[2]);
        else if (!(least > flat_cosine))
            return false;
    }
    return true;
}

bool shares_vertices_across_edges(const TriangleMesh& mesh) {
    std::vector<Vec3> normal_of_vertex(mesh.vertices.size(), Vec3(0.0));
    for (const std::array<std::uint32_t, 3>& t : mesh.triangles) {
        const Vec3 n = triangle_normal(mesh, t);
        if (n == Vec3(0.0)) continue;
        for (const std::uint32_t i : t) {
            Vec3& known = normal_of_vertex[i];
            if (known == Vec3(0.0)) known = n;
            if (glm::dot(known, n) < flat_cosine) return true;
        }
    }
    return false;
}

}  // namespace

TriangleMesh read_mesh_shape(Properties& p, const Context& context) {
    const Mat4 to_world = p.transform("to_world");
    const std::string& type = p.element().attribute("type").value;
    const Attribute& filename = p.require("filename", {"string"}).attribute("value");
    const bool flip_normals = p.boolean("flip_normals").value_or(false);
    bool face_normals = p.boolean("face_normals").value_or(false);
    const std::int64_t index = type == "serialized" ? p.integer("shape_index").value_or(0) : 0;
    if (index < 0) p.fail("shape_index", fmt::format("shape_index is {}, expected 0 or more", index));

    const std::string path = context.document.find_file(filename);
    context.mesh_files.push_back(path);
    MeshFile file;
    if (type == "serialized") {
        SerializedMesh serialized = read_serialized(path, static_cast<std::uint64_t>(index));
        face_normals = face_normals || serialized.face_normals;
        file = std::move(serialized);
    } else {
        file = type == "obj" ? read_obj(path) : read_ply(path);
    }
    TriangleMesh mesh = std::move(file.mesh);
    for (Vec3& v : mesh.vertices) {
        v = Vec3(to_world * glm::dvec4(v, 1.0));
        if (!is_finite(v)) p.fail("to_world", "moves a vertex out of the range of numbers");
    }

    if (!face_normals && !file.normals.empty()) {
        const glm::dmat3 to_world_normal = glm::transpose(glm::inverse(glm::dmat3(to_world)));
        for (Vec3& n : file.normals) n = unit(to_world_normal * n);
        if (!orient_by_normals(mesh, file.normals))
            throw InputError(filename.place,
                             fmt::format("'{}' has smooth vertex normals, which are not supported yet; set face_normals "
                                         "to true to render it flat",
                                         filename.value));
    } else if (!face_normals && shares_vertices_across_edges(mesh)) {
        context.warnings.add("mesh without vertex normals rendered flat, where Mitsuba smooths it unless face_normals is true");
    }
    if (flip_normals)
        for (std::array<std::uint32_t, 3>& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

}  // namespace neumann::reader
