// The numbers of a glTF file: buffers, views of buffers, and accessors, which say how the bytes of a view are to be read.
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

// `width` numbers each.
struct Numbers {
    std::size_t width = 0;
    std::vector<float> values = {};

    std::size_t count() const { return values.size() / width; }
    const float* operator[](std::size_t i) const { return &values[i * width]; }
};

// All functions throw InputError where an index is none of the file's or leads beyond the bytes that are there, and Told where that
// has been told before.
class Accessors {
public:
    // `files`: gets the names of those that are read.
    Accessors(const GltfFile& file, const std::string& path, JsonObject& root, std::vector<std::string>& files);

    const JsonList& list() const { return accessors_; }
    const JsonList& views() const { return views_; }
    std::string_view bytes_of_view(std::size_t view);

    // Read once; whole numbers are divided by the largest of their type where the accessor is `normalized`. `types`: "VEC3" or the
    // like, of which the accessor has to have one. All are finite.
    std::shared_ptr<const Numbers> numbers(std::size_t accessor, const std::vector<std::string>& types);
    // Whole numbers, such as the vertices of triangles.
    std::vector<std::uint32_t> indices(std::size_t accessor);
    // Without reading it.
    bool has_numbers(std::size_t accessor) const;  // or only zeros
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
    std::map<std::size_t, std::optional<std::string>> contents_;  // of buffers that are no part of the file; nothing: told
    std::map<std::size_t, std::shared_ptr<const Numbers>> numbers_;
};

}  // namespace neumann::reader::gltf
