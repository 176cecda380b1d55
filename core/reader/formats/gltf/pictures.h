// The pictures of a glTF file, and those that are made of them for Mitsuba: a factor multiplied into it, one channel alone. glTF's
// row 0 is at v = 0, as Mitsuba's.
#pragma once

#include "core/image/texels.h"
#include "core/reader/formats/gltf/accessors.h"
#include "core/reader/formats/names.h"
#include "core/reader/xml/raw_scene.h"

#include <functional>
#include <map>
#include <memory>

namespace neumann::reader::gltf {

class Pictures {
public:
    Pictures(JsonObject& root, Accessors& accessors, const std::string& path, std::vector<std::string>& files,
             FilesInMemory& in_memory)
        : images_(root.list("images")), accessors_(accessors), path_(path), files_(files), in_memory_(in_memory) {}

    const JsonList& list() const { return images_; }

    // If it is neither PNG nor JPEG, a lenient reader takes it as grey and opaque.
    bool is_known(std::size_t image);

    // These return the name of a picture in memory. A colour is sRGB where the factor is 1, and linear otherwise; the factor is
    // linear. Throw InputError, at the image's place, where the picture cannot be read.
    std::string colors(std::size_t image, const Rgb& factor);
    // Red, green, blue or alpha, 0 to 3; 1 if there is no alpha. Numbers as they are in the file.
    std::string channel(std::size_t image, int channel, double factor);
    // Of alpha where that is at least the cutoff 1, and elsewhere 0.
    std::string cut_out(std::size_t image, double factor, double cutoff);
    bool is_opaque(std::size_t image);
    // (n + 1)/2, with the tangential part of n times the scale; `flip_y`: the other way round along v.
    std::string normals(std::size_t image, double scale, bool flip_y);

private:
    using Make = std::function<Texels(const Texels&)>;
    // The same pictures are made once.
    std::string made(std::size_t image, const std::string& kind, const Make& make);
    const Texels& texels(std::size_t image);
    std::string bytes_of(JsonObject& image);

    JsonList images_;
    Accessors& accessors_;
    const std::string& path_;
    std::vector<std::string>& files_;
    FilesInMemory& in_memory_;
    Names names_;
    std::map<std::size_t, std::shared_ptr<const Texels>> texels_;  // null: told
    std::map<std::pair<std::size_t, std::string>, std::string> made_;
};

}  // namespace neumann::reader::gltf
