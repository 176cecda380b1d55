// How long a scene of many meshes takes to read, and how much memory at the peak: 300 wavy squares of 5000 triangles, half of them
// binary PLY and half OBJ, with normals and texture coordinates as modelling programs write them.
#include "core/base/stopwatch.h"
#include "core/reader/read_scene.h"

#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

namespace {

constexpr int meshes = 300, side = 50;  // side² squares of two triangles
constexpr double triangles = 2.0 * side * side * meshes;

struct Vertex {
    float position[3], normal[3], uv[2];
};

std::vector<Vertex> wavy_vertices(int mesh) {
    std::vector<Vertex> vertices;
    for (int i = 0; i <= side; ++i)
        for (int j = 0; j <= side; ++j) {
            const float u = static_cast<float>(i) / side, v = static_cast<float>(j) / side, wave = 20.0f * u + 15.0f * v;
            const float slope = -0.02f * std::cos(wave);
            const neumann::Vec3 n = glm::normalize(neumann::Vec3(20.0f * slope, 15.0f * slope, 1.0f));
            vertices.push_back({{static_cast<float>(mesh % 20) + u, static_cast<float>(mesh / 20) + v, 0.02f * std::sin(wave)},
                                {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)},
                                {u, v}});
        }
    return vertices;
}

std::vector<std::array<int, 3>> faces() {
    std::vector<std::array<int, 3>> result;
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
            const int a = i * (side + 1) + j, b = a + side + 1;
            result.push_back({a, b, b + 1});
            result.push_back({a, b + 1, a + 1});
        }
    return result;
}

void write_ply(const std::string& path, const std::vector<Vertex>& vertices) {
    std::ofstream file(path, std::ios::binary);
    file << "ply\nformat binary_little_endian 1.0\nelement vertex " << vertices.size() << "\n";
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "u", "v"}) file << "property float " << name << "\n";
    file << "element face " << faces().size() << "\nproperty list uchar int vertex_indices\nend_header\n";
    file.write(reinterpret_cast<const char*>(vertices.data()), static_cast<std::streamsize>(vertices.size() * sizeof(Vertex)));
    for (const auto& face : faces()) {
        file.put(3);
        file.write(reinterpret_cast<const char*>(face.data()), sizeof(face));
    }
}

void write_obj(const std::string& path, const std::vector<Vertex>& vertices) {
    std::ofstream file(path);
    for (const Vertex& v : vertices) {
        file << fmt::format("v {} {} {}\n", v.position[0], v.position[1], v.position[2]);
        file << fmt::format("vt {} {}\n", v.uv[0], v.uv[1]);
        file << fmt::format("vn {} {} {}\n", v.normal[0], v.normal[1], v.normal[2]);
    }
    for (const auto& [a, b, c] : faces()) file << fmt::format("f {0}/{0}/{0} {1}/{1}/{1} {2}/{2}/{2}\n", a + 1, b + 1, c + 1);
}

void write_scene(const std::string& folder) {
    std::ofstream xml(folder + "/scene.xml");
    xml << "<scene version='3.0.0'><sensor type='perspective'><float name='fov' value='40'/></sensor>\n";
    for (int mesh = 0; mesh < meshes; ++mesh) {
        const char* type = mesh % 2 ? "obj" : "ply";
        const std::string name = fmt::format("{}.{}", mesh, type);
        (mesh % 2 ? write_obj : write_ply)(folder + "/" + name, wavy_vertices(mesh));
        xml << fmt::format("<shape type='{}'><string name='filename' value='{}'/>", type, name)
            << "<boolean name='face_normals' value='true'/></shape>\n";
    }
    xml << "</scene>\n";
}

rusage usage() {
    rusage result{};
    getrusage(RUSAGE_SELF, &result);
    return result;
}

double peak_bytes() { return 1024.0 * static_cast<double>(usage().ru_maxrss); }

// Of all threads, which a busy machine does not change.
double processor_seconds() {
    const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
    return seconds(usage().ru_utime) + seconds(usage().ru_stime);
}

}  // namespace

int main() {
    const std::string folder = std::filesystem::temp_directory_path() / fmt::format("neumann_bench_reading_{}", getpid());
    std::filesystem::create_directories(folder);
    write_scene(folder);
    malloc_trim(0);
    const double before = peak_bytes(), processor_before = processor_seconds();
    neumann::Stopwatch all;
    neumann::SceneParts parts = neumann::read_scene_parts(folder + "/scene.xml");
    const double files = all.seconds(), peak_of_files = peak_bytes();
    const neumann::Scene scene = neumann::make_scene(std::move(parts));
    const double seconds = all.seconds(), peak = peak_bytes();
    const struct mallinfo2 heap = mallinfo2();
    std::filesystem::remove_all(folder);
    fmt::print("{} meshes, {:.0f} triangles: {:.2f} s, of which {:.2f} s for the files; {:.2f} s of processors\n", meshes,
               triangles, seconds, files, processor_seconds() - processor_before);
    fmt::print("memory at the peak: {:.0f} MB, {:.0f} bytes a triangle ({:.0f} MB after the files, {:.0f} MB before)\n", peak / 1e6,
               peak / triangles, peak_of_files / 1e6, before / 1e6);
    fmt::print("in the end on the heap: {:.0f} MB\n", static_cast<double>(heap.uordblks + heap.hblkhd) / 1e6);
    return scene.geometry.shapes().size() == meshes ? 0 : 1;
}
