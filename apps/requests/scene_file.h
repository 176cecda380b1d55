// The scene of a request.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

struct Scene;

struct SceneFile {
    std::string path;
    std::map<std::string, std::string> definitions = {};  // -D name=value
    bool lenient = false;
    // In place of the camera a hemisphere above the point that this pixel sees.
    std::optional<std::array<int, 2>> hemisphere = {};
    bool operator==(const SceneFile&) const = default;
};

// Reads the scene. Throws InputError.
Scene read_scene(const SceneFile& file);

// The scene with its camera above the point that a ray through the middle of this pixel hits, on the side that it sees; up is where
// the camera has it, and the film is square. Throws InputError if the pixel is not of the film, or sees no surface.
Scene above_what_is_seen(const Scene& scene, const std::array<int, 2>& pixel);

// Reads texts "name=value". Throws InputError for others, and for a name that is given twice.
std::map<std::string, std::string> parse_definitions(const std::vector<std::string>& texts);

// The file of the bundled scene with this name, which is beside the program or Python's module as it was installed or
// built; the text itself if it is a file's name, or there is no such scene.
std::string scene_along(const std::string& name);

}  // namespace neumann
