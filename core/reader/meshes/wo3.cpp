// Tungsten's meshes: a count of 64 bits and as many vertices, of a position, a normal, u and v in single precision; a count and as
// many triangles, of three vertices, counted from 0, and the number of a material. All is little-endian.
#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/reader/meshes/mesh_file.h"
#include "core/reader/meshes/mesh_text.h"

#include <bit>
#include <cstring>

#include <fmt/format.h>

namespace neumann {
namespace {

static_assert(std::endian::native == std::endian::little);

struct Wo3Vertex {
    float position[3], normal[3], uv[2];
};
struct Wo3Triangle {
    std::uint32_t vertices[3];
    std::int32_t material;
};
static_assert(sizeof(Wo3Vertex) == 32 && sizeof(Wo3Triangle) == 16);

class Wo3Reader {
public:
    explicit Wo3Reader(const std::string& path) : path_(path), bytes_(read_input(path)) {}

    Wo3Mesh read() {
        const std::uint64_t vertices = count("vertex", sizeof(Wo3Vertex));
        for (std::uint64_t i = 1; i <= vertices; ++i) {
            const auto v = next<Wo3Vertex>();
            result_.mesh.vertices.emplace_back(finite(v.position[0], i), finite(v.position[1], i), finite(v.position[2], i));
            result_.normals.emplace_back(finite(v.normal[0], i), finite(v.normal[1], i), finite(v.normal[2], i));
            result_.mesh.uv.emplace_back(finite(v.uv[0], i), finite(v.uv[1], i));
        }
        const std::uint64_t triangles = count("triangle", sizeof(Wo3Triangle));
        if (triangles == 0) throw InputError(path_ + ": has no triangles");
        for (std::uint64_t i = 1; i <= triangles; ++i) {
            const auto t = next<Wo3Triangle>();
            for (const std::uint32_t vertex : t.vertices)
                if (vertex >= vertices)
                    throw InputError(fmt::format("{}: triangle {}: vertex index {} {}, counted from 0", path_, i, vertex,
                                                 out_of_range(vertices, "vertex")));
            result_.mesh.triangles.push_back({t.vertices[0], t.vertices[1], t.vertices[2]});
            result_.materials.push_back(t.material);
        }
        if (at_ < bytes_.size()) throw InputError(fmt::format("{}: byte {}: the file goes on after the triangles", path_, at_));
        return std::move(result_);
    }

private:
    template <class T>
    T next() {
        T value;
        std::memcpy(&value, bytes_.data() + at_, sizeof value);
        at_ += sizeof value;
        return value;
    }

    // Reads the number of the items that follow, of `size` bytes each, and checks that they are there.
    std::uint64_t count(const char* noun, std::size_t size) {
        if (bytes_.size() - at_ < sizeof(std::uint64_t))
            throw InputError(fmt::format("{}: the file ends after {} bytes, before it says how many {} follow", path_,
                                         bytes_.size(), counted(2, noun).substr(2)));
        const auto number = next<std::uint64_t>();
        if (number > max_mesh_count || (bytes_.size() - at_) / size < number)
            throw InputError(fmt::format("{}: the file ends after {} bytes, but {} {} from byte {}", path_, bytes_.size(),
                                         counted(number, noun), number == 1 ? "follows" : "follow", at_));
        return number;
    }

    double finite(float value, std::uint64_t vertex) const {
        if (!std::isfinite(value)) throw InputError(fmt::format("{}: vertex {}: a number is not finite", path_, vertex));
        return double{value};
    }

    const std::string& path_;
    std::string bytes_;
    std::size_t at_ = 0;
    Wo3Mesh result_;
};

}  // namespace

Wo3Mesh read_wo3(const std::string& path) { return Wo3Reader(path).read(); }

}  // namespace neumann
