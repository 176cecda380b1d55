// Reads meshes from files, as Tungsten shows them.
#pragma once

#include "core/reader/formats/tungsten/importing.h"

#include <map>
#include <memory>

namespace neumann::reader::tungsten {

// What a primitive says about its mesh.
struct MeshLook {
    bool is_smooth = false;   // otherwise flat, whatever normals the file has
    bool recomputes = false;  // a smooth mesh gets new normals
    bool emits = false;
    std::size_t materials = 1;
    auto operator<=>(const MeshLook&) const = default;
};

// The triangles of one material.
struct MeshPart {
    std::size_t material;
    std::string filename;  // names a mesh in memory
    std::shared_ptr<const MeshFile> file;
};

class MeshParts {
public:
    explicit MeshParts(Importing& importing) : importing_(importing) {}

    // Reads a .wo3 or a .obj. Throws InputError.
    const std::vector<MeshPart>& read(const std::string& path, const Location& place, const MeshLook& look);
    // Keeps a mesh in memory.
    MeshPart keep(MeshFile file, const std::string& name, std::size_t material = 0);

private:
    Importing& importing_;
    std::map<std::pair<std::string, MeshLook>, std::vector<MeshPart>> known_;
};

// The area of the mesh in the scene.
double area_of(const TriangleMesh& mesh, const Mat4& to_world);

}  // namespace neumann::reader::tungsten
