#include "core/reader/formats/pbrt/meshes.h"

#include "core/reader/formats/find_file.h"
#include "core/reader/formats/pbrt/unpack.h"
#include "core/reader/meshes/mesh_ply_header.h"

#include <fmt/format.h>

namespace neumann::reader::pbrt {

std::vector<std::uint32_t> read_indices(Parameters& p, std::size_t vertex_count, std::size_t size) {
    if (p.is_wrong()) throw AlreadyReported();
    std::vector<std::int64_t> given = p.integers("indices");
    if (given.empty() && !p.has("indices") && vertex_count == size)
        for (std::size_t i = 0; i < size; ++i) given.push_back(static_cast<std::int64_t>(i));
    if (given.empty() || given.size() % size != 0)
        p.complain("indices",
                   fmt::format("indices of {} are {} numbers, expected {} for each face", p.title(), given.size(), size));
    std::vector<std::uint32_t> indices;
    for (const std::int64_t i : given) {
        if (i < 0 || static_cast<std::size_t>(i) >= vertex_count)
            p.complain("indices", fmt::format("an index of {} is {}, but there are {} points", p.title(), i, vertex_count));
        indices.push_back(static_cast<std::uint32_t>(i));
    }
    if (p.is_wrong()) throw AlreadyReported();
    return indices;
}

namespace {

// Reads P, N and uv.
MeshFile read_vertices(Parameters& p) {
    MeshFile file;
    file.mesh.vertices = p.triples("P", {"point3"});
    file.normals = p.triples("N", {"normal"});
    file.mesh.uv = p.pairs("uv");
    const std::size_t count = file.mesh.vertices.size();
    if (count == 0) p.complain("P", fmt::format("{} has no \"point3 P\"", p.title()));
    const auto check = [&](const std::string& name, std::size_t found) {
        if (found != 0 && found != count)
            p.complain(name, fmt::format("{} of {} has {} values, expected {}, as P has", name, p.title(), found, count));
    };
    check("N", file.normals.size());
    check("uv", file.mesh.uv.size());
    return file;
}

std::uint64_t face_count(const std::string& path, const std::string& bytes) {
    MeshText text(path, bytes, MeshText::Syntax::plain);
    for (const PlyElement& e : read_ply_header(text, {}).elements)
        if (e.name == "face") return e.count;
    return 0;
}

}  // namespace

MadeMesh make_triangle_mesh(Parameters& p) {
    MeshFile file = read_vertices(p);
    p.ignore({"S", "faceIndices"});  // tangents, and face numbers for ptex
    const std::vector<std::uint32_t> indices = read_indices(p, file.mesh.vertices.size(), 3);
    for (std::size_t i = 0; i < indices.size(); i += 3) file.mesh.triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
    return {std::move(file)};
}

MadeMesh read_ply_mesh(Parameters& p, Importer& importer) {
    const std::optional<std::string> name = p.text("filename");
    if (!name) p.complain("filename", fmt::format("{} has no \"string filename\"", p.title()));
    if (p.find("displacement", {"texture"}))
        p.refuse("displacement", fmt::format("displacement of {} is not supported", p.title()), "; that of materials is");
    p.ignore({"edgelength"});  // for displacement
    if (!name || p.is_wrong()) throw AlreadyReported();
    const std::string path = find_file(*name, importer.main_file(), p.place("filename"));
    const std::string bytes = read_unpacked(path);
    importer.scene.files.push_back(path);
    MadeMesh result{parse_ply(path, bytes)};
    if (result.file.mesh.triangles.size() > face_count(path, bytes)) {
        importer.warnings.add("plymesh with faces of four corners: two triangles each, where pbrt has a bilinear patch");
        result.triangles_of_light.reset();
    }
    return result;
}

MeshFile with_coordinates(const MeshFile& file) {
    MeshFile result;
    for (const auto& t : file.mesh.triangles) {
        const auto first = static_cast<std::uint32_t>(result.mesh.vertices.size());
        for (const std::uint32_t i : t) {
            result.mesh.vertices.push_back(file.mesh.vertices[i]);
            if (!file.normals.empty()) result.normals.push_back(file.normals[i]);
        }
        for (const Vec2 uv : {Vec2(0.0, 0.0), Vec2(1.0, 0.0), Vec2(1.0, 1.0)}) result.mesh.uv.push_back(uv);
        result.mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return result;
}

}  // namespace neumann::reader::pbrt
