// A scene rendered by one method, with as many samples as a look asks for.
#pragma once

#include "tests/search/measured.h"

#include "core/scene/scene.h"
#include "operators/render/from_paths/pilot.h"

#include <cstdint>
#include <string>

namespace neumann::search {

struct Look {
    std::size_t number = 0;
    std::uint64_t seed = 0;
    bool thorough = true;  // with the rest, the health and what no sample met, which take most of the time of small pictures
};

// The method with its numbers of patches and directions, where it has them: a word of read_method().
std::string as_looked_at(const std::string& method, const Look& look);
// The command that renders the same.
std::string command(const std::string& scene, const Film& film, const std::string& method, const Look& look);

// `pilot`: one for all methods. Throws as render() does.
Measured look_at(const Scene& scene, const Pilot& pilot, const std::string& method, const Look& look);

}  // namespace neumann::search
