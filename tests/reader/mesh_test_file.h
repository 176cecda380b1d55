// Meshes written to a temporary file and read back.
#pragma once

#include "core/base/error.h"
#include "core/reader/meshes/mesh_file.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <unistd.h>

#include <gtest/gtest.h>

namespace neumann {

class MeshTestFile : public testing::Test {
protected:
    using Reader = std::function<MeshFile(const std::string&)>;
    using Triangles = std::vector<std::array<std::uint32_t, 3>>;

    MeshTestFile() { std::filesystem::create_directories(folder_); }
    ~MeshTestFile() override { std::filesystem::remove_all(folder_); }

    const std::string& folder() const { return folder_; }

    MeshFile read(const Reader& reader, const std::string& content) const {
        std::ofstream(path_, std::ios::binary) << content;
        return reader(path_);
    }
    // The whole message, FILE standing for the path.
    std::string error(const Reader& reader, const std::string& content) const {
        try {
            read(reader, content);
        } catch (const InputError& error) {
            std::string what = error.what();
            if (what.starts_with(path_)) what.replace(0, path_.size(), "FILE");
            return what;
        }
        return "no error";
    }

private:
    // Tests run as processes side by side.
    std::string folder_ = testing::TempDir() + "neumann_mesh_" + std::to_string(getpid());
    std::string path_ = folder_ + "/mesh";
};

}  // namespace neumann
