// What the readers of the single plugins share.
#pragma once

#include "core/base/vec.h"
#include "core/base/warnings.h"
#include "core/image/texels.h"
#include "core/reader/xml/document.h"
#include "core/reader/xml/objects.h"

#include <memory>
#include <set>

namespace neumann::reader {

// What textures have in common with each other and with the meshes they are on.
struct TextureStore {
    std::map<std::string, std::shared_ptr<const Texels>> images;  // by path
    struct Range {
        Rgb smallest{0.0}, largest{0.0};
    };
    std::map<std::string, Range> attributes;  // of all meshes, by the name of the attribute
    std::set<const Element*> open, known;     // being read, and read

    void widen(const std::string& attribute, const Range& by) {
        Range& range = attributes.try_emplace(attribute, by).first->second;
        range = {glm::min(range.smallest, by.smallest), glm::max(range.largest, by.largest)};
    }
};

struct Context {
    const Document& document;
    const Objects& objects;
    Warnings& warnings;
    std::vector<std::string>& mesh_files;  // and pictures, that were read, in their order
    TextureStore& textures;

    Problems& problems() const { return objects.problems(); }
};

}  // namespace neumann::reader
