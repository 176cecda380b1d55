// The same scene of many meshes in each language that is read, for measuring how long that takes: 300 wavy squares of 5000
// triangles with normals and texture coordinates, as modelling programs write them.
#pragma once

#include <functional>
#include <map>
#include <string>

namespace neumann::wavy {

constexpr int meshes = 300, side = 50;  // side² squares of two triangles
constexpr double triangles = 2.0 * side * side * meshes;

// Writes into a folder, and returns the path of the scene.
using Writer = std::function<std::string(const std::string& folder)>;

// By name: "xml" (half of the meshes PLY, half OBJ), "glb", "dae", "pbrt" (meshes in the file) and "pbrt-ply".
const std::map<std::string, Writer>& writers();

}  // namespace neumann::wavy
