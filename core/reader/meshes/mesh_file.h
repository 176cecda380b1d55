// Readers of OBJ, PLY, Mitsuba's serialized and Tungsten's wo3 files. They are written by hand because vertices must be in double
// precision and errors need file:line:column; the available libraries (tinyobjloader as packaged, assimp) read floats and report no
// position.
#pragma once

#include "core/geometry/shape.h"

#include <string>
#include <vector>

namespace neumann {

struct MeshFile {
    TriangleMesh mesh;  // with texture coordinates, as in the file, and attributes, but without normals
    // One per vertex, or empty; in the file's space, not normalised.
    std::vector<Vec3> normals;
};

// The first two readers cut polygons into triangles (polygons.h) and refuse files without faces. Errors are InputError
// "file:line:column: …" or, where a binary body has no lines, "file: face 12: …", counted from 1.

// Ignores groups, materials, lines and points, and refuses free-form geometry. With normals or texture coordinates, a vertex is
// repeated for each of its normals and coordinates and left out if no face uses it. A triangle without normals among others with
// normals gets its geometric normal, of length 1, or 0 if it has no area, and one without coordinates (0, 0).
MeshFile read_obj(const std::string& path);

// Reads ASCII and binary files of both byte orders. Texture coordinates are the properties u and v, texture_u and texture_v, or s
// and t of a vertex. The named attributes (mesh_ply_header.h) are read if the file has them; whole numbers are divided by the
// largest number of their type and decoded as sRGB. Other elements and properties are skipped.
MeshFile read_ply(const std::string& path, const std::vector<std::string>& attributes = {});
// The same for the bytes of a file; `path` is for messages.
MeshFile parse_ply(const std::string& path, const std::string& bytes, const std::vector<std::string>& attributes = {});

// Reads versions 3 and 4, in single or double precision; `index` counts the meshes of a file from 0. Vertex colours are skipped.
// Errors are "file: mesh 0: byte 12: …", the byte of the compressed file, or "file: mesh 0: triangle 12: …", counted from 1.
struct SerializedMesh : MeshFile {
    bool face_normals = false;  // the file asks for a flat look
};
SerializedMesh read_serialized(const std::string& path, std::uint64_t index);

// Reads a .wo3 of Tungsten. Normals of length 0 are kept; v grows upwards. Errors are as above, without the mesh.
struct Wo3Mesh : MeshFile {
    std::vector<std::int32_t> materials;  // of each triangle; -1 for none
};
Wo3Mesh read_wo3(const std::string& path);

}  // namespace neumann
