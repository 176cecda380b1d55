#include "core/reader/formats/tungsten/mesh_parts.h"

#include "core/geometry/affine.h"
#include "core/reader/formats/find_file.h"
#include "core/reader/formats/tungsten/smooth_normals.h"
#include "core/reader/meshes/mesh_text.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

namespace neumann::reader::tungsten {

namespace {

std::string lower_ending(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return ending;
}

Wo3Mesh read_file(const std::string& path, const Location& place) {
    const std::string ending = lower_ending(path);
    if (ending == ".wo3") return read_wo3(path);
    if (ending != ".obj")
        throw InputError(place, fmt::format("'{}' is no mesh that is known, expected a .wo3 or a .obj",
                                            printable(std::filesystem::path(path).filename().string())));
    Wo3Mesh mesh{read_obj(path), {}};
    mesh.materials.assign(mesh.mesh.triangles.size(), -1);
    return mesh;
}

Vec3 normal_of(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
    return glm::cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]);
}

// Gives vertices without a normal that of their triangles.
void fill_normals(MeshFile& file) {
    std::vector<Vec3> sums(file.normals.size(), Vec3(0.0));
    for (const auto& t : file.mesh.triangles)
        for (const std::uint32_t i : t) sums[i] += normal_of(file.mesh, t);
    for (std::size_t i = 0; i < sums.size(); ++i)
        if (length_of(file.normals[i]) == 0.0) file.normals[i] = sums[i];
}

// Turns normals to the side from which triangles are counter-clockwise. Tungsten's light leaves that side, whatever the
// normals say, while meshes here turn to the side of their normals.
void turn_normals_to_light(MeshFile& file) {
    for (const auto& t : file.mesh.triangles) {
        const Vec3 n = normal_of(file.mesh, t);
        for (const std::uint32_t i : t)
            if (glm::dot(n, file.normals[i]) < 0.0) file.normals[i] = -file.normals[i];
    }
}

// The triangles of one material, with the vertices that they use.
MeshFile part_of(const Wo3Mesh& all, const std::vector<std::size_t>& triangles) {
    constexpr std::uint32_t unused = 0xffffffff;
    MeshFile part;
    std::vector<std::uint32_t> number(all.mesh.vertices.size(), unused);
    for (const std::size_t i : triangles) {
        std::array<std::uint32_t, 3> t = all.mesh.triangles[i];
        for (std::uint32_t& vertex : t) {
            std::uint32_t& known = number[vertex];
            if (known == unused) {
                known = static_cast<std::uint32_t>(part.mesh.vertices.size());
                part.mesh.vertices.push_back(all.mesh.vertices[vertex]);
                if (!all.mesh.uv.empty()) part.mesh.uv.push_back(all.mesh.uv[vertex]);
                if (!all.normals.empty()) part.normals.push_back(all.normals[vertex]);
            }
            vertex = known;
        }
        part.mesh.triangles.push_back(t);
    }
    return part;
}

}  // namespace

MeshPart MeshParts::keep(MeshFile file, const std::string& name, std::size_t material) {
    MeshPart part{material, fmt::format("meshes/{}.ply", importing_.mesh_names.unique(name)),
                  std::make_shared<const MeshFile>(std::move(file))};
    importing_.scene.in_memory.meshes[part.filename] = part.file;
    return part;
}

const std::vector<MeshPart>& MeshParts::read(const std::string& path, const Location& place, const MeshLook& look) {
    std::vector<MeshPart>& parts = known_[{path, look}];
    if (!parts.empty()) return parts;
    Wo3Mesh mesh = read_file(path, place);
    importing_.scene.files.push_back(path);
    if (look.is_smooth && look.recomputes) {
        static_cast<MeshFile&>(mesh) = with_smooth_normals(mesh);
    } else if (!look.is_smooth) {
        mesh.normals.clear();
    }
    if (!mesh.normals.empty()) {
        fill_normals(mesh);
        if (look.emits) turn_normals_to_light(mesh);
    }
    std::vector<std::vector<std::size_t>> of_material(look.materials);
    for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
        const std::int64_t material = std::clamp<std::int64_t>(mesh.materials[i], 0, static_cast<std::int64_t>(look.materials) - 1);
        of_material[static_cast<std::size_t>(material)].push_back(i);
    }
    for (std::size_t i = 0; i < of_material.size(); ++i)
        if (!of_material[i].empty()) parts.push_back(keep(part_of(mesh, of_material[i]), stem_of(path), i));
    return parts;
}

double area_of(const TriangleMesh& mesh, const Mat4& to_world) {
    TriangleMesh placed = mesh;
    for (Vec3& v : placed.vertices) v = transformed_point(to_world, v);
    double area = 0.0;
    for (const auto& t : placed.triangles) area += 0.5 * length_of(normal_of(placed, t));
    return area;
}

}  // namespace neumann::reader::tungsten
