// The pictures of a glTF file, and those that are made of them for Mitsuba: multiplied by a factor, or one channel
// alone. Row 0 of a picture is at v = 0 in glTF as in Mitsuba.
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

    // Whether the picture is a PNG or a JPEG file; a lenient reader takes any other as grey and opaque.
    bool is_known(std::size_t image);

    // These return the name of a picture in memory, and throw InputError at the image's place if it cannot be read.
    // Colours are sRGB if the factor is 1, and linear otherwise; the factor is linear.
    std::string colors(std::size_t image, const Rgb& factor);
    // One channel, 0 to 3 for red, green, blue and alpha, times the factor. Alpha is 1 if there is none. Numbers are as
    // in the file.
    std::string channel(std::size_t image, int channel, double factor);
    // 1 where alpha times the factor is at least the cutoff, and 0 elsewhere.
    std::string cut_out(std::size_t image, double factor, double cutoff);
    bool is_opaque(std::size_t image);
    // Normals n as (n + 1)/2, with the tangential part of n times the scale; `flip_y` turns them around along v.
    std::string normals(std::size_t image, double scale, bool flip_y);

private:
    using Make = std::function<Texels(const Texels&)>;
    // Makes each picture once.
    std::string made(std::size_t image, const std::string& kind, const Make& make);
    const Texels& texels(std::size_t image);
    std::string bytes_of(JsonObject& image);

    JsonList images_;
    Accessors& accessors_;
    const std::string& path_;
    std::vector<std::string>& files_;
    FilesInMemory& in_memory_;
    Names names_;
    std::map<std::size_t, std::shared_ptr<const Texels>> texels_;  // null: a reported error
    std::map<std::pair<std::size_t, std::string>, std::string> made_;
};

}  // namespace neumann::reader::gltf
