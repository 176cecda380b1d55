// Reads the numbers of a glTF file: buffers, views of buffers, and accessors, which say how the bytes of a view are to be read.
#pragma once

#include "core/reader/formats/gltf/gltf_file.h"
#include "core/reader/formats/json_object.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace neumann::reader::gltf {

// Elements of `width` numbers each.
struct Numbers {
    std::size_t width = 0;
    std::vector<float> values = {};

    std::size_t count() const { return values.size() / width; }
    const float* operator[](std::size_t i) const { return &values[i * width]; }
};

// All functions throw InputError if an index is not in the file or leads beyond the bytes that are there, and AlreadyReported if
// that has been reported before.
class Accessors {
public:
    // `files` receives the names of the files that are read.
    Accessors(const GltfFile& file, const std::string& path, JsonObject& root, std::vector<std::string>& files);

    const JsonList& list() const { return accessors_; }
    const JsonList& views() const { return views_; }
    std::string_view bytes_of_view(std::size_t view);

    // The numbers of an accessor, all finite and read once. Whole numbers are divided by the largest of their type if
    // the accessor is `normalized`. The accessor must have one of these `types`, such as "VEC3".
    std::shared_ptr<const Numbers> numbers(std::size_t accessor, const std::vector<std::string>& types);
    // Reads whole numbers, such as the vertices of triangles.
    std::vector<std::uint32_t> indices(std::size_t accessor);
    // These do not read the numbers.
    bool has_numbers(std::size_t accessor) const;  // false: all are 0
    std::size_t count(std::size_t accessor) const;

private:
    struct Stored;
    Stored stored(std::size_t accessor, const std::vector<std::string>& types);
    std::string_view bytes_of_buffer(std::size_t buffer);
    template <class Put>
    void read(std::size_t accessor, const std::vector<std::string>& types, const Put& put);
    std::vector<std::size_t> read_sparse_places(JsonObject& sparse, std::size_t count);

    const GltfFile& file_;
    const std::string& path_;
    std::vector<std::string>& files_;
    JsonList buffers_, views_, accessors_;
    std::map<std::size_t, std::optional<std::string>> contents_;  // of buffers with a URI; nothing: a reported error
    std::map<std::size_t, std::shared_ptr<const Numbers>> numbers_;
};

}  // namespace neumann::reader::gltf
