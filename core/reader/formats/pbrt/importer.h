// What the parts of the importer share.
#pragma once

#include "core/base/warnings.h"
#include "core/image/texels.h"
#include "core/reader/formats/pbrt/pbrt_scene.h"
#include "core/reader/xml/problems.h"
#include "core/reader/xml/raw_scene.h"

#include <map>
#include <memory>
#include <string>

namespace neumann::reader::pbrt {

struct Importer {
    RawScene& scene;
    const NamedValues& definitions;
    Warnings& warnings;
    Problems& problems;
    double imaging_ratio = 1.0;  // what the film multiplies radiance by; the lights are as much brighter
    std::map<std::string, std::shared_ptr<const Texels>> pictures = {};  // that have been read, by path
    std::size_t baked_values = 0;                                        // floats of the pictures in memory

    const std::string& main_file() const { return scene.files.front(); }
    std::shared_ptr<const Texels> read_picture(const std::string& path);
    // "textures/wood-1.exr" for "textures/wood.exr": a name for a picture in memory that no file has.
    std::string unused_name(const std::string& name) const;
};

}  // namespace neumann::reader::pbrt
