// The state that the parts of the importer share.
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
    double imaging_ratio = 1.0;  // the film multiplies radiance by this; the lights are made brighter instead
    std::map<std::string, std::shared_ptr<const Texels>> pictures = {};  // pictures read so far, by path
    std::size_t baked_values = 0;                                        // number of floats in the pictures in memory

    const std::string& main_file() const { return scene.files.front(); }
    std::shared_ptr<const Texels> read_picture(const std::string& path);
    // A name for a picture in memory that no file has, such as "textures/wood-1.exr" for "textures/wood.exr".
    std::string unused_name(const std::string& name) const;
};

}  // namespace neumann::reader::pbrt
