// One input of a fuzzer as a mesh file. An InputError is what the readers are for; anything else ends the process.
#pragma once

#include "core/base/error.h"
#include "core/reader/meshes/mesh_file.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <unistd.h>

namespace neumann::fuzz {

// In memory where there is a file system for that. Of formats only TGA is known by its name.
inline const std::string& path() {
    static const std::string result =
        fmt::format("{}/neumann_fuzz_{}.tga", std::filesystem::exists("/dev/shm") ? "/dev/shm" : "/tmp", getpid());
    return result;
}

inline void write_input(const std::uint8_t* data, std::size_t size) {
    std::FILE* file = std::fopen(path().c_str(), "wb");
    if (!file || std::fwrite(data, 1, size, file) != size || std::fclose(file) != 0) std::abort();
}

// What a mesh promises: triangles of vertices that exist, and finite numbers.
template <class Read>
int try_mesh(const std::uint8_t* data, std::size_t size, const Read& read) {
    write_input(data, size);
    try {
        const MeshFile file = read(path());
        if (file.mesh.triangles.empty()) std::abort();
        for (const auto& t : file.mesh.triangles)
            for (const std::uint32_t i : t)
                if (i >= file.mesh.vertices.size()) std::abort();
        for (const Vec3& v : file.mesh.vertices)
            if (!is_finite(v)) std::abort();
        if (!file.normals.empty() && file.normals.size() != file.mesh.vertices.size()) std::abort();
        if (!file.mesh.uv.empty() && file.mesh.uv.size() != file.mesh.vertices.size()) std::abort();
    } catch (const InputError&) {
    }
    return 0;
}

}  // namespace neumann::fuzz
