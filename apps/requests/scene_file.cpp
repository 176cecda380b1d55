#include "apps/requests/scene_file.h"

#include "core/base/error.h"
#include "core/reader/read_scene.h"

#include <fmt/format.h>

#include <dlfcn.h>
#include <algorithm>
#include <cmath>
#include <filesystem>

namespace neumann {

Scene read_scene(const SceneFile& file) {
    Scene scene = read_scene(file.path, file.definitions, {.lenient = file.lenient});
    return file.hemisphere ? above_what_is_seen(scene, *file.hemisphere) : scene;
}

Scene above_what_is_seen(const Scene& scene, const std::array<int, 2>& pixel) {
    const auto [x, y] = pixel;
    const Film& film = scene.film;
    if (x < 0 || y < 0 || x >= film.width || y >= film.height)
        throw InputError(fmt::format("--hemisphere {},{}: the film has x from 0 to {} and y from 0 to {}", x, y, film.width - 1,
                                     film.height - 1));
    const CameraRay ray = scene.camera.ray({x + 0.5, y + 0.5});
    SurfacePoint p;
    if (!scene.geometry.first_hit(ray.origin, ray.direction, ray.length, p))
        throw InputError(fmt::format("--hemisphere {},{}: this pixel sees no surface", x, y));
    const double side = -glm::dot(p.normal, ray.direction);
    const Vec3 n = p.normal * std::copysign(1.0, side), up_of_camera(scene.camera.options().to_world[1]);
    // On a floor, on which the camera's up is the normal, up is away from the camera.
    const Vec3 along = std::abs(glm::dot(glm::normalize(up_of_camera), n)) < 0.99 ? up_of_camera : ray.direction;
    const Vec3 up = glm::normalize(along - n * glm::dot(along, n)), left = glm::cross(up, n);
    SensorOptions sensor;
    sensor.kind = SensorOptions::Kind::hemisphere;
    sensor.to_world =
        Mat4(glm::dvec4(left, 0.0), glm::dvec4(up, 0.0), glm::dvec4(n, 0.0), glm::dvec4(Geometry::leave(p, side), 1.0));
    Film square;
    square.width = square.height = square.crop_width = square.crop_height = std::min(film.width, film.height);
    square.filter = BoxFilter();
    return scene.with(sensor, square);
}

std::map<std::string, std::string> parse_definitions(const std::vector<std::string>& texts) {
    std::map<std::string, std::string> definitions;
    for (const std::string& text : texts) {
        const auto equals = text.find('=');
        if (equals == std::string::npos || equals == 0) throw InputError("-D " + text + ": expected name=value");
        if (!definitions.emplace(text.substr(0, equals), text.substr(equals + 1)).second)
            throw InputError("-D " + text + ": '" + text.substr(0, equals) + "' is given twice");
    }
    return definitions;
}

namespace {

namespace fs = std::filesystem;

// The file that contains this code: the program, or Python's module.
fs::path own_file() {
    std::error_code error;
    Dl_info info{};
    if (dladdr(reinterpret_cast<const void*>(&scene_along), &info) != 0 && fs::path(info.dli_fname).extension() == ".so")
        return fs::canonical(info.dli_fname, error);
    return fs::read_symlink("/proc/self/exe", error);
}

}  // namespace

std::string scene_along(const std::string& name) {
    std::error_code error;
    if (name.empty() || name.find_first_of("/.") != std::string::npos || fs::exists(name, error)) return name;
    // The own file is installed as bin/neumann or lib/python3/dist-packages/neumann/, and built as
    // build/release/apps/neumann or build/release/python/neumann/.
    fs::path folder = own_file().parent_path();
    for (int up = 0; up <= 4 && !folder.empty(); ++up, folder = folder.parent_path())
        for (const char* scenes : {"share/neumann/scenes", "scenes"}) {
            const fs::path file = folder / scenes / name / (name + ".xml");
            if (fs::exists(file, error)) return file.string();
        }
    return name;
}

}  // namespace neumann
