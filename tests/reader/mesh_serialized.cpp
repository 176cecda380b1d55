#include "tests/reader/mesh_test_file.h"

#include <cstring>
#include <limits>

#include <zlib.h>

namespace neumann::mesh_serialized_test {

// Builds a file byte by byte.
class Bytes {
public:
    template <class T>
    Bytes& add(T value) {
        char bytes[sizeof(T)];
        std::memcpy(bytes, &value, sizeof(T));
        text_.append(bytes, sizeof(T));
        return *this;
    }
    template <class T>
    Bytes& add(std::initializer_list<T> values) {
        for (const T value : values) add(value);
        return *this;
    }
    Bytes& add_text(const std::string& text) { return text_ += text, *this; }
    const std::string& text() const { return text_; }

private:
    std::string text_;
};

std::string compressed(const std::string& text) {
    uLongf size = compressBound(text.size());
    std::string result(size, '\0');
    compress(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(text.data()), text.size());
    result.resize(size);
    return result;
}

std::string mesh(std::uint16_t version, const Bytes& content) {
    return Bytes().add<std::uint16_t>({0x041c, version}).text() + compressed(content.text());
}

// Flags, name and counts; the arrays follow.
Bytes head(std::uint32_t flags, std::uint64_t vertices, std::uint64_t triangles) {
    return Bytes().add(flags).add_text(std::string("name", 5)).add(vertices).add(triangles);
}

// A triangle with its right angle at (0, 0, z).
std::string flat_triangle(double z) {
    return mesh(4, head(0x2000, 3, 1).add({0.0, 0.0, z, 1.0, 0.0, z, 0.0, 1.0, z}).add<std::uint32_t>({0, 1, 2}));
}

// Two meshes and the dictionary of version 4.
std::string two_meshes() {
    const std::string first = flat_triangle(0.5), second = flat_triangle(0.25);
    return Bytes().add_text(first + second).add<std::uint64_t>({0, first.size()}).add(std::uint32_t{2}).text();
}

const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

class MeshSerialized : public MeshTestFile {
protected:
    template <std::uint64_t index = 0>
    static MeshFile reader(const std::string& path) {
        return read_serialized(path, index);
    }
    MeshFile serialized(const std::string& content) const { return read(reader<0>, content); }
    template <std::uint64_t index = 0>
    std::string error(const std::string& content) const {
        return MeshTestFile::error(reader<index>, content);
    }
};

TEST_F(MeshSerialized, SinglePrecisionWithAllArrays) {
    const auto [mesh_read, normals] =
        serialized(mesh(4, head(0x100b, 4, 2)
                               .add({0.1f, -2.5f, 3.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 1.0f, 1.0f, 0.0f})
                               .add({0.0f, 0.0f, 1.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f})
                               .add({0.0f, 0.25f, 0.5f, 0.75f, 1.0f, 0.0f, 1.0f, 2.0f})
                               .add({1.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f})
                               .add<std::uint32_t>({0, 1, 2, 3, 2, 1})));
    EXPECT_EQ(mesh_read.vertices, (std::vector<Vec3>{{0.1f, -2.5, 3}, x, y, {1, 1, 0}}));
    EXPECT_EQ(normals, (std::vector<Vec3>{z, x, y, z}));
    EXPECT_EQ(mesh_read.uv, (std::vector<Vec2>{{0, 0.25}, {0.5, 0.75}, {1, 0}, {1, 2}}));
    EXPECT_EQ(mesh_read.triangles, (Triangles{{0, 1, 2}, {3, 2, 1}}));
}

TEST_F(MeshSerialized, DoublePrecisionKeepsDoubles) {
    const auto [mesh_read, normals] =
        serialized(mesh(4, head(0x2000, 3, 1).add({0.1, 0.2, 0.3, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0}).add<std::uint32_t>({0, 1, 2})));
    EXPECT_EQ(mesh_read.vertices, (std::vector<Vec3>{{0.1, 0.2, 0.3}, x, y}));
    EXPECT_TRUE(normals.empty());
    EXPECT_TRUE(mesh_read.uv.empty());
}

// Version 3 has no name, and offsets of 32 bits.
TEST_F(MeshSerialized, VersionThree) {
    const auto content = [](float height) {
        return mesh(3, Bytes()
                           .add(std::uint32_t{0x1000})
                           .add<std::uint64_t>({3, 1})
                           .add({0.0f, 0.0f, height, 1.0f, 0.0f, height, 0.0f, 1.0f, height})
                           .add<std::uint32_t>({2, 1, 0}));
    };
    const std::string first = content(0.5f);
    const std::string file =
        Bytes().add_text(first + content(0.25f)).add<std::uint32_t>({0, static_cast<std::uint32_t>(first.size()), 2}).text();
    EXPECT_EQ(read(reader<0>, file).mesh.vertices.front(), Vec3(0, 0, 0.5));
    EXPECT_EQ(read(reader<1>, file).mesh.vertices.front(), Vec3(0, 0, 0.25));
    EXPECT_EQ(read(reader<1>, file).mesh.triangles, (Triangles{{2, 1, 0}}));
}

TEST_F(MeshSerialized, PicksAMesh) {
    EXPECT_EQ(read(reader<0>, two_meshes()).mesh.vertices.front(), Vec3(0, 0, 0.5));
    EXPECT_EQ(read(reader<1>, two_meshes()).mesh.vertices.front(), Vec3(0, 0, 0.25));
}

TEST_F(MeshSerialized, AsksForAFlatLook) {
    const std::string path = folder() + "/flat";
    for (const std::uint32_t flag : {0x0u, 0x10u}) {
        std::ofstream(path, std::ios::binary)
            << mesh(4, head(0x2000 | flag, 3, 1).add({0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0}).add<std::uint32_t>({0, 1, 2}));
        EXPECT_EQ(read_serialized(path, 0).face_normals, flag != 0);
    }
}

// More than the blocks in which the arrays are read.
TEST_F(MeshSerialized, LargeMesh) {
    constexpr std::uint32_t n = 10'001;
    Bytes content = head(0x1000, n, n - 2);
    for (std::uint32_t i = 0; i < n; ++i) content.add({static_cast<float>(i), static_cast<float>(i % 7), 0.0f});
    for (std::uint32_t i = 2; i < n; ++i) content.add<std::uint32_t>({i - 2, i - 1, i});
    const MeshFile file = serialized(mesh(4, content));
    ASSERT_EQ(file.mesh.vertices.size(), n);
    ASSERT_EQ(file.mesh.triangles.size(), n - 2);
    EXPECT_EQ(file.mesh.vertices[n - 1], Vec3(n - 1, (n - 1) % 7, 0));
    EXPECT_EQ(file.mesh.triangles[n - 3], (std::array<std::uint32_t, 3>{n - 3, n - 2, n - 1}));
}

TEST_F(MeshSerialized, OtherFiles) {
    EXPECT_EQ(error("\x1c"), "FILE: byte 0: the file ends");
    EXPECT_EQ(error("\x1c\x04"), "FILE: byte 2: the file ends");
    EXPECT_EQ(error(mesh(2, {})), "FILE: byte 2: version 2, expected 3 or 4");
    EXPECT_EQ(MeshTestFile::error([](const std::string&) { return static_cast<MeshFile>(read_serialized("/", 0)); }, ""),
              "/: is a folder, expected a file");
}

TEST_F(MeshSerialized, Dictionary) {
    EXPECT_EQ(error<2>(two_meshes()), "FILE: has no mesh 2, only 2 meshes, counted from 0");
    const std::string one = flat_triangle(0.5);
    const auto with = [&](std::uint64_t offset, std::uint32_t count) {
        return Bytes().add_text(one).add<std::uint64_t>({0, offset}).add(count).text();
    };
    const auto at = [&](std::size_t offset) { return std::to_string(one.size() + offset); };
    EXPECT_EQ(error<1>(with(0, 1)), "FILE: has no mesh 1, only 1 mesh, counted from 0");
    EXPECT_EQ(error<1>(with(0, 0xffffffff)),
              "FILE: byte " + at(16) + ": a dictionary of 4294967295 meshes, more than the file can hold");
    EXPECT_EQ(error<1>(with(one.size(), 2)),
              "FILE: byte " + at(8) + ": mesh 1 begins at byte " + at(0) + ", expected a place before the dictionary at " + at(0));
    EXPECT_EQ(
        error<1>(with(~std::uint64_t{0}, 2)),
        "FILE: byte " + at(8) + ": mesh 1 begins at byte 18446744073709551615, expected a place before the dictionary at " + at(0));
    EXPECT_EQ(error<1>(with(2, 2)), "FILE: byte 2: 0x0004 where a serialized mesh begins, expected 0x041c");
}

// Cut anywhere, a file ends within its mesh.
TEST_F(MeshSerialized, Truncated) {
    const std::string whole = flat_triangle(0.5);
    for (std::size_t size = 4; size < whole.size(); ++size)
        EXPECT_EQ(error(whole.substr(0, size)), "FILE: mesh 0: byte " + std::to_string(size) + ": the file ends within the mesh");
}

TEST_F(MeshSerialized, Damaged) {
    EXPECT_EQ(error(Bytes().add<std::uint16_t>({0x041c, 4}).add_text("not zlib").text()),
              "FILE: mesh 0: byte 6: not zlib's data, or damaged");
    std::string wrong_sum = flat_triangle(0.5);
    wrong_sum.back() = static_cast<char>(wrong_sum.back() ^ 1);
    EXPECT_EQ(error(wrong_sum), "FILE: mesh 0: byte " + std::to_string(wrong_sum.size()) + ": not zlib's data, or damaged");
}

TEST_F(MeshSerialized, TooLittle) {
    const auto ends = [&](const Bytes& content, const std::string& within) {
        const std::string file = mesh(4, content);
        EXPECT_EQ(error(file), "FILE: mesh 0: byte " + std::to_string(file.size()) + ": the compressed data end within " + within);
    };
    ends({}, "the flags");
    ends(Bytes().add(std::uint32_t{0x1000}).add_text("na"), "the name");
    ends(Bytes().add(std::uint32_t{0x1000}).add('\0').add(std::uint32_t{7}), "the number of vertices");
    ends(Bytes().add(std::uint32_t{0x1000}).add('\0').add(std::uint64_t{7}), "the number of triangles");
    ends(head(0x1000, 1, 1).add({1.0f, 2.0f}), "the positions");
    ends(head(0x1001, 1, 1).add({1.0f, 2.0f, 3.0f}), "the normals");
    ends(head(0x1002, 1, 1).add({1.0f, 2.0f, 3.0f, 4.0f}), "the texture coordinates");
    ends(head(0x1008, 1, 1).add({1.0f, 2.0f, 3.0f}), "the colours");
    ends(head(0x1000, 1, 1).add({1.0f, 2.0f, 3.0f}).add(std::uint32_t{0}), "the triangles");
}

// The byte is how far zlib came, which is its own affair.
TEST_F(MeshSerialized, TooMuch) {
    const std::string what = error(mesh(4, head(0x1000, 1, 1).add({1.0f, 2.0f, 3.0f}).add<std::uint32_t>({0, 0, 0, 0})));
    EXPECT_EQ(what.substr(0, 19), "FILE: mesh 0: byte ");
    EXPECT_EQ(what.substr(what.rfind(": ")), ": the compressed data go on after the triangles");
}

TEST_F(MeshSerialized, CountsAreCheckedBeforeAnythingIsAllocated) {
    const auto counts_error = [&](std::uint32_t flags, std::uint64_t vertices, std::uint64_t triangles) {
        const std::string what = error(mesh(4, head(flags, vertices, triangles)));
        return what.substr(what.find(": ", what.find("byte ")) + 2);
    };
    constexpr std::uint64_t huge = std::numeric_limits<std::uint64_t>::max();
    EXPECT_EQ(counts_error(0x1000, huge, 1), "more than 4294967295 vertices");
    EXPECT_EQ(counts_error(0x1000, 1, huge), "more than 4294967295 triangles");
    EXPECT_EQ(counts_error(0x1000, 1'000'000'000, 1), "1000000000 vertices and 1 triangle, more than the file can hold");
    EXPECT_EQ(counts_error(0x200b, 1, 1'000'000'000), "1 vertex and 1000000000 triangles, more than the file can hold");
    EXPECT_EQ(counts_error(0x1000, 3, 0), "has no triangles");
    EXPECT_EQ(counts_error(0x1004, 3, 1), "unknown flags 0x4, expected some of 0x301b");
}

TEST_F(MeshSerialized, WrongNumbers) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(error(mesh(4, head(0x1000, 2, 1).add({1.0f, 2.0f, 3.0f, 1.0f, 2.0f, nan}).add<std::uint32_t>({0, 0, 0}))),
              "FILE: mesh 0: vertex 2: coordinate is not finite");
    EXPECT_EQ(error(mesh(4, head(0x1001, 1, 1).add({1.0f, 2.0f, 3.0f, 1.0f, nan, 3.0f}).add<std::uint32_t>({0, 0, 0}))),
              "FILE: mesh 0: vertex 1: normal is not finite");
    EXPECT_EQ(error(mesh(4, head(0x1002, 1, 1).add({1.0f, 2.0f, 3.0f, nan, 1.0f}).add<std::uint32_t>({0, 0, 0}))),
              "FILE: mesh 0: vertex 1: texture coordinate is not finite");
    EXPECT_EQ(error(mesh(4, head(0x1000, 1, 2).add({1.0f, 2.0f, 3.0f}).add<std::uint32_t>({0, 0, 0, 0, 1, 0}))),
              "FILE: mesh 0: triangle 2: vertex index 1 is out of range, the mesh has 1 vertex, counted from 0");
}

}  // namespace neumann::mesh_serialized_test
