// A glTF file as it is on disk.
#pragma once

#include "core/base/error.h"

#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace neumann::reader::gltf {

// A .gltf, which is JSON, or a .glb, as the first bytes tell. Throws InputError if it is neither.
class GltfFile {
public:
    explicit GltfFile(const std::string& path);

    const nlohmann::json& root() const { return root_; }
    // The binary chunk of a .glb.
    std::optional<std::string_view> binary() const {
        return has_binary_ ? std::optional(std::string_view(bytes_).substr(binary_at_, binary_size_)) : std::nullopt;
    }

private:
    // Returns the JSON of a .glb.
    std::string_view open_glb(const std::string& path);

    std::string bytes_;
    nlohmann::json root_;
    bool has_binary_ = false;
    std::size_t binary_at_ = 0, binary_size_ = 0;
};

}  // namespace neumann::reader::gltf
