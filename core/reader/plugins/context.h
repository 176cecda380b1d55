// Data shared by the readers of all plugins.
#pragma once

#include "core/base/vec.h"
#include "core/base/warnings.h"
#include "core/image/texels.h"
#include "core/reader/xml/document.h"
#include "core/reader/xml/objects.h"

#include <memory>
#include <set>

namespace neumann::reader {

// Data shared by textures, and by the meshes that have them.
struct TextureStore {
    std::map<std::string, std::shared_ptr<const Texels>> images;  // by path
    struct Range {
        Rgb smallest{0.0}, largest{0.0};
    };
    std::map<std::string, Range> attributes;  // of all meshes, by the attribute's name
    std::set<const Element*> open, known;     // elements being read, and elements already read
    std::size_t parts = 0;                    // textures that the outermost open one consists of so far

    void widen(const std::string& attribute, const Range& by) {
        Range& range = attributes.try_emplace(attribute, by).first->second;
        range = {glm::min(range.smallest, by.smallest), glm::max(range.largest, by.largest)};
    }
};

struct Context {
    const Document& document;
    const Objects& objects;
    Warnings& warnings;
    std::vector<std::string>& mesh_files;  // mesh and picture files that were read, in order
    TextureStore& textures;

    Problems& problems() const { return objects.problems(); }
};

}  // namespace neumann::reader
