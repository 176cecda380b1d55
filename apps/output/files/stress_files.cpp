#include "apps/output/files/stress_files.h"

#include "core/base/error.h"
#include "core/image/image_io.h"
#include "core/reader/read_scene.h"

#include <fmt/format.h>
#include <unistd.h>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>

namespace neumann {

namespace {

namespace fs = std::filesystem;
using known::Figures;

class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string name = (fs::temp_directory_path() / "neumann-stress-XXXXXX").string();
        if (!mkdtemp(name.data())) throw RunError("no folder can be made in " + fs::temp_directory_path().string());
        path_ = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    void write(const std::string& name, const std::string& content) const {
        std::ofstream file(path_ / name, std::ios::binary);
        if (!(file << content)) throw RunError((path_ / name).string() + ": cannot be written");
    }
    std::string operator/(const std::string& name) const { return (path_ / name).string(); }

private:
    fs::path path_;
};

// The message for a scene, without the folder's name.
std::string answer(const TemporaryFolder& folder, const std::string& shapes) {
    folder.write("scene.xml", "<scene version='3.0.0'>\n<sensor type='perspective'><float name='fov' value='45'/></sensor>\n" +
                                  shapes + "</scene>");
    try {
        (void)read_scene(folder / "scene.xml");
        return "no error";
    } catch (const InputError& error) {
        std::string message = error.what();
        for (std::size_t at; (at = message.find(folder / "")) != std::string::npos;) message.erase(at, (folder / "").size());
        return message;
    }
}

void vertices(Figures& figures, std::uint64_t) {
    const TemporaryFolder folder;
    for (const std::string number : {"nan", "inf", "-inf", "1e999"}) {
        const std::string why =
            number == "1e999" ? "number '1e999' is beyond the range of double precision" : "vertex coordinate is not finite";
        folder.write("mesh.obj", fmt::format("v 0 0 0\nv 1 0 0\nv 0 {} 0\nf 1 2 3\n", number));
        figures.equal(fmt::format("obj, a coordinate {}", number),
                      answer(folder, "<shape type='obj'><string name='filename' value='mesh.obj'/></shape>"),
                      "mesh.obj:3:5: " + why);
        folder.write("mesh.ply",
                     fmt::format("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                                 "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                                 "0 0 0\n1 0 0\n0 {} 0\n3 0 1 2\n",
                                 number));
        figures.equal(fmt::format("ply, a coordinate {}", number),
                      answer(folder, "<shape type='ply'><string name='filename' value='mesh.ply'/></shape>"),
                      "mesh.ply:12:3: " + why);
    }
}

void textures(Figures& figures, std::uint64_t) {
    const TemporaryFolder folder;
    const double inf = std::numeric_limits<double>::infinity();
    for (const auto& [name, value] : {std::pair{"nan", std::numeric_limits<double>::quiet_NaN()}, {"inf", inf}, {"-1", -1.0}}) {
        Estimate picture{Image(2, 2), {}};
        for (Rgb& pixel : picture.mean.pixels) pixel = Rgb(0.5);
        picture.mean.at(1, 0) = Rgb(value);
        folder.write("bad.exr", encode_exr(picture, {}));
        const bool negative = value < 0.0;
        const std::string why = "bad.exr: the pixel in column 1 and row 0 is not finite";
        figures.equal(
            fmt::format("reflectance with a texel {}", name),
            answer(folder,
                   "<shape type='rectangle'><bsdf type='diffuse'><texture type='bitmap' name='reflectance'>"
                   "<string name='filename' value='bad.exr'/></texture></bsdf></shape>"),
            negative ? "scene.xml:3:46: the texture is negative somewhere, down to -1, expected a reflectance of at least 0" : why);
        figures.equal(
            fmt::format("envmap with a texel {}", name),
            answer(folder, "<emitter type='envmap'><string name='filename' value='bad.exr'/></emitter>"),
            negative ? "scene.xml:3:48: pixel (1, 0) of 'bad.exr' is (-1, -1, -1), expected numbers that are not negative" : why);
    }
}

void numbers(Figures& figures, std::uint64_t) {
    const TemporaryFolder folder;
    for (const char* number : {"nan", "inf"}) {
        figures.equal(fmt::format("radius {}", number),
                      answer(folder, fmt::format("<shape type='sphere'><float name='radius' value='{}'/></shape>", number)),
                      fmt::format("scene.xml:3:43: '{}' is not a finite number", number));
        figures.equal(
            fmt::format("radiance {}", number),
            answer(folder,
                   fmt::format("<shape type='sphere'><emitter type='area'><rgb name='radiance' value='{}'/></emitter></shape>",
                               number)),
            fmt::format("scene.xml:3:64: '{}' is not a finite number", number));
    }
}

}  // namespace

known::Cases stress_file_cases() {
    return {{"extreme/not-finite/vertices", "refused, with its place", vertices},
            {"extreme/not-finite/textures", "refused, with its place", textures},
            {"extreme/not-finite/numbers", "refused, with its place", numbers}};
}

}  // namespace neumann
