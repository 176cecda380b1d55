// Mitsuba's serialized meshes: for each mesh the numbers 0x041C and a version, and then, compressed by zlib, flags, a name (version
// 4), the counts, and array after array. A dictionary at the end of the file says where each mesh begins: offsets of 32 bits
// (version 3) or 64 (version 4), and their count. All is little-endian.
#include "core/base/error.h"
#include "core/reader/meshes/mesh_file.h"
#include "core/reader/meshes/mesh_text.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include <fmt/format.h>
#include <zlib.h>

namespace neumann {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::uint16_t magic = 0x041c;

enum Flags : std::uint32_t {
    has_normals = 0x0001,
    has_uv = 0x0002,
    has_colors = 0x0008,
    face_normals = 0x0010,
    single_precision = 0x1000,
    double_precision = 0x2000,
};
constexpr std::uint32_t all_flags = has_normals | has_uv | has_colors | face_normals | single_precision | double_precision;

// zlib makes at most 1032 bytes of one (its technical details).
constexpr std::uint64_t largest_ratio = 1032;

// Decompresses the bytes of one mesh.
class Inflater {
public:
    // The file must be positioned at `offset`.
    Inflater(std::FILE* file, std::uint64_t offset, const std::string& mesh) : file_(file), offset_(offset), mesh_(mesh) {
        if (inflateInit(&stream_) != Z_OK) throw RunError("zlib could not be started");
    }
    ~Inflater() { inflateEnd(&stream_); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    void read(void* to, std::size_t size, const char* what) {
        if (read_some(to, size) < size) fail(fmt::format("the compressed data end within {}", what));
    }
    template <class T>
    T number(const char* what) {
        T value;
        read(&value, sizeof(value), what);
        return value;
    }
    // Checks that nothing follows, and that zlib's checksum is right.
    void check_end() {
        char byte;
        if (read_some(&byte, 1) > 0) fail("the compressed data go on after the triangles");
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(fmt::format("{}: byte {}: {}", mesh_, offset_ + stream_.total_in, what));
    }

private:
    // Returns less than `size` only at the end of the compressed data.
    std::size_t read_some(void* to, std::size_t size) {
        stream_.next_out = static_cast<Bytef*>(to);
        stream_.avail_out = static_cast<uInt>(size);
        while (stream_.avail_out > 0 && !ended_) {
            if (stream_.avail_in == 0) {
                stream_.next_in = buffer_;
                stream_.avail_in = static_cast<uInt>(std::fread(buffer_, 1, sizeof(buffer_), file_));
                if (stream_.avail_in == 0) fail(std::ferror(file_) ? "cannot be read" : "the file ends within the mesh");
            }
            const int result = inflate(&stream_, Z_NO_FLUSH);
            if (result == Z_MEM_ERROR) throw RunError("not enough memory to read " + mesh_);
            if (result != Z_OK && result != Z_STREAM_END) fail("not zlib's data, or damaged");
            ended_ = result == Z_STREAM_END;
        }
        return size - stream_.avail_out;
    }

    std::FILE* file_;
    std::uint64_t offset_;
    const std::string& mesh_;
    z_stream stream_{};
    Bytef buffer_[1 << 14];
    bool ended_ = false;
};

class SerializedReader {
public:
    SerializedReader(const std::string& path, std::uint64_t index)
        : path_(path), index_(index), mesh_(fmt::format("{}: mesh {}", path, index)), open_(open_mesh_file(path)) {}

    SerializedMesh read() {
        std::uint64_t start = 0;
        const std::uint16_t version = read_version(start);
        if (index_ > 0) {
            start = find_start(version);
            read_version(start);
        }
        Inflater data(open_.file.get(), start + 4, mesh_);
        const auto flags = data.number<std::uint32_t>("the flags");
        if (flags & ~all_flags)
            data.fail(fmt::format("unknown flags {:#x}, expected some of {:#x}", flags & ~all_flags, all_flags));
        if (version == 4)
            while (data.number<char>("the name") != '\0') continue;
        const auto vertices = data.number<std::uint64_t>("the number of vertices");
        const auto triangles = data.number<std::uint64_t>("the number of triangles");
        check_counts(data, flags, vertices, triangles, open_.size - start);
        if (flags & double_precision)
            read_arrays<double>(data, flags, vertices);
        else
            read_arrays<float>(data, flags, vertices);
        read_triangles(data, vertices, triangles);
        data.check_end();
        result_.face_normals = flags & face_normals;
        return std::move(result_);
    }

private:
    template <class T>
    T number_at(std::uint64_t offset) {
        T value;
        if (std::fseek(open_.file.get(), static_cast<long>(offset), SEEK_SET) != 0 ||
            std::fread(&value, sizeof(value), 1, open_.file.get()) != 1)
            throw InputError(fmt::format("{}: byte {}: the file ends", path_, offset));
        return value;
    }

    std::uint16_t read_version(std::uint64_t offset) {
        if (const auto found = number_at<std::uint16_t>(offset); found != magic)
            throw InputError(
                fmt::format("{}: byte {}: {:#06x} where a serialized mesh begins, expected {:#06x}", path_, offset, found, magic));
        const auto version = number_at<std::uint16_t>(offset + 2);
        if (version != 3 && version != 4)
            throw InputError(fmt::format("{}: byte {}: version {}, expected 3 or 4", path_, offset + 2, version));
        return version;
    }

    std::uint64_t find_start(std::uint16_t version) {
        const std::uint64_t width = version == 4 ? 8 : 4, end = open_.size - 4;
        const auto count = number_at<std::uint32_t>(end);
        if (count > end / width)
            throw InputError(fmt::format("{}: byte {}: a dictionary of {} meshes, more than the file can hold", path_, end, count));
        if (index_ >= count)
            throw InputError(fmt::format("{}: has no mesh {}, only {}, counted from 0", path_, index_, counted(count, "mesh")));
        const std::uint64_t dictionary = end - width * count, entry = dictionary + width * index_;
        const std::uint64_t start = version == 4 ? number_at<std::uint64_t>(entry) : number_at<std::uint32_t>(entry);
        if (start >= dictionary)
            throw InputError(fmt::format("{}: byte {}: mesh {} begins at byte {}, expected a place before the dictionary at {}",
                                         path_, entry, index_, start, dictionary));
        return start;
    }

    // Checks the counts before anything is allocated.
    static void check_counts(const Inflater& data, std::uint32_t flags, std::uint64_t vertices, std::uint64_t triangles,
                             std::uint64_t file_bytes) {
        if (vertices > max_mesh_count) data.fail(fmt::format("more than {}", counted(max_mesh_count, "vertex")));
        if (triangles > max_mesh_count) data.fail(fmt::format("more than {}", counted(max_mesh_count, "triangle")));
        const std::uint64_t numbers = 3 + (flags & has_normals ? 3 : 0) + (flags & has_uv ? 2 : 0) + (flags & has_colors ? 3 : 0);
        const std::uint64_t bytes = vertices * numbers * (flags & double_precision ? 8 : 4) + triangles * 12;
        if (bytes / largest_ratio > file_bytes)
            data.fail(
                fmt::format("{} and {}, more than the file can hold", counted(vertices, "vertex"), counted(triangles, "triangle")));
        if (triangles == 0) data.fail("has no triangles");
    }

    // Reads `count` rows of n numbers block by block, so that memory grows with the data present and not with the header's counts.
    template <class T, std::size_t n, class Take>
    static void rows(Inflater& data, std::uint64_t count, const char* what, const Take& take) {
        constexpr std::uint64_t at_once = 4096;
        std::vector<std::array<T, n>> block(std::min(count, at_once));
        for (std::uint64_t i = 0; i < count;) {
            const std::uint64_t size = std::min(count - i, at_once);
            data.read(block.data(), size * sizeof(block[0]), what);
            for (std::uint64_t k = 0; k < size; ++k) take(block[k], ++i);
        }
    }

    template <class T>
    void read_arrays(Inflater& data, std::uint32_t flags, std::uint64_t vertices) {
        const auto finite = [&](double x, std::uint64_t vertex, const char* what) {
            if (!std::isfinite(x)) throw InputError(fmt::format("{}: vertex {}: {} is not finite", mesh_, vertex, what));
            return x;
        };
        const auto triples = [&](std::vector<Vec3>& to, const char* array, const char* what) {
            rows<T, 3>(data, vertices, array, [&](const std::array<T, 3>& v, std::uint64_t vertex) {
                to.emplace_back(finite(v[0], vertex, what), finite(v[1], vertex, what), finite(v[2], vertex, what));
            });
        };
        triples(result_.mesh.vertices, "the positions", "coordinate");
        if (flags & has_normals) triples(result_.normals, "the normals", "normal");
        if (flags & has_uv)
            rows<T, 2>(data, vertices, "the texture coordinates", [&](const std::array<T, 2>& v, std::uint64_t vertex) {
                result_.mesh.uv.emplace_back(finite(v[0], vertex, "texture coordinate"),
                                             finite(v[1], vertex, "texture coordinate"));
            });
        if (flags & has_colors) rows<T, 3>(data, vertices, "the colours", [](const auto&, std::uint64_t) {});
    }

    void read_triangles(Inflater& data, std::uint64_t vertices, std::uint64_t triangles) {
        rows<std::uint32_t, 3>(
            data, triangles, "the triangles", [&](const std::array<std::uint32_t, 3>& t, std::uint64_t triangle) {
                for (const std::uint32_t vertex : t)
                    if (vertex >= vertices)
                        throw InputError(
                            fmt::format("{}: triangle {}: vertex index {} is out of range, the mesh has {}, counted from 0", mesh_,
                                        triangle, vertex, counted(vertices, "vertex")));
                result_.mesh.triangles.push_back(t);
            });
    }

    const std::string& path_;
    std::uint64_t index_;
    std::string mesh_;  // for messages
    OpenFile open_;
    SerializedMesh result_;
};

}  // namespace

SerializedMesh read_serialized(const std::string& path, std::uint64_t index) { return SerializedReader(path, index).read(); }

}  // namespace neumann
