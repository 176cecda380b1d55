#include "tests/reader/mesh_test_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <limits>

namespace neumann::mesh_ply_test {

// Builds the body of a binary file.
class Bytes {
public:
    explicit Bytes(std::endian order) : order_(order) {}

    template <class T>
    Bytes& add(T value) {
        char bytes[sizeof(T)];
        std::memcpy(bytes, &value, sizeof(T));
        if (order_ != std::endian::native) std::reverse(bytes, bytes + sizeof(T));
        text_.append(bytes, sizeof(T));
        return *this;
    }
    template <class T>
    Bytes& list(std::initializer_list<T> values) {
        add(static_cast<std::uint8_t>(values.size()));
        for (const T value : values) add(value);
        return *this;
    }
    Bytes& point(float x, float y, float z) { return add(x).add(y).add(z); }
    const std::string& text() const { return text_; }

private:
    std::endian order_;
    std::string text_;
};

const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
const std::string indices = "property list uchar int vertex_indices\n";

std::string head(const std::string& format, const std::string& vertices, const std::string& faces) {
    return "ply\nformat " + format + " 1.0\nelement vertex " + vertices + "\n" + xyz + "element face " + faces + "\n" + indices +
           "end_header\n";
}

class MeshPly : public MeshTestFile {
protected:
    MeshFile ply(const std::string& content, const std::vector<std::string>& attributes = {}) const {
        return read([&](const std::string& path) { return read_ply(path, attributes); }, content);
    }
    std::string error(const std::string& content) const {
        return MeshTestFile::error([](const std::string& path) { return read_ply(path); }, content);
    }
};

const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

TEST_F(MeshPly, ReadsAscii) {
    const auto [mesh, normals] = ply(head("ascii", "4", "2") + "0.1 -2.5e-3 +3\n1 0 0\n\n0 1 0\n  1 1 0\n3 0 1 2\n4 0 1 2 3\n");
    EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{Vec3(0.1, -0.0025, 3.0), x, y, Vec3(1, 1, 0)}));
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}}));
    EXPECT_TRUE(normals.empty());
}

TEST_F(MeshPly, ReadsBothByteOrders) {
    for (const auto order : {std::endian::little, std::endian::big}) {
        Bytes body(order);
        body.point(0.5f, -2.0f, 3.0f).point(1, 0, 0).point(0, 1, 0).point(1, 1, 0);
        body.list({0, 1, 2}).list({0, 1, 2, 3});
        const auto mesh =
            ply(head(order == std::endian::little ? "binary_little_endian" : "binary_big_endian", "4", "2") + body.text()).mesh;
        EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{Vec3(0.5, -2.0, 3.0), x, y, Vec3(1, 1, 0)}));
        EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}}));
    }
}

TEST_F(MeshPly, ReadsNormals) {
    const auto [mesh, normals] = ply("ply\nformat ascii 1.0\nelement vertex 3\nproperty float nz\n" + xyz +
                                     "property float nx\nproperty float ny\nelement face 1\n" + indices +
                                     "end_header\n9 0 0 0 7 8\n1 1 0 0 0 0\n1 0 1 0 0 0\n3 0 1 2\n");
    EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{Vec3(0.0), x, y}));
    EXPECT_EQ(normals, (std::vector<Vec3>{Vec3(7, 8, 9), z, z}));
}

TEST_F(MeshPly, ReadsTextureCoordinates) {
    for (const auto& [u, v] : {std::pair("u", "v"), std::pair("s", "t"), std::pair("texture_u", "texture_v")}) {
        const auto mesh =
            ply("ply\nformat ascii 1.0\nelement vertex 3\nproperty float " + std::string(v) + "\n" + xyz + "property double " + u +
                "\nelement face 1\n" + indices + "end_header\n0.5 0 0 0 0.1\n1 1 0 0 -2\n0 0 1 0 3\n3 0 1 2\n")
                .mesh;
        EXPECT_EQ(mesh.uv, (std::vector<Vec2>{Vec2(0.1, 0.5), Vec2(-2, 1), Vec2(3, 0)})) << u;
        EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{Vec3(0.0), x, y}));
    }
    // One alone means something else.
    EXPECT_TRUE(ply("ply\nformat ascii 1.0\nelement vertex 3\n" + xyz + "property float u\nproperty float t\nelement face 1\n" +
                    indices + "end_header\n0 0 0 1 2\n1 0 0 1 2\n0 1 0 1 2\n3 0 1 2\n")
                    .mesh.uv.empty());
}

TEST_F(MeshPly, ReadsAttributesThatAreAskedFor) {
    using Values = std::vector<std::array<float, 3>>;
    const std::string file = "ply\nformat ascii 1.0\nelement vertex 3\n" + xyz +
                             "property float red\nproperty float green\nproperty float blue\nproperty float alpha\n"
                             "property float heat_0\nelement face 2\nproperty double shade_r\n" +
                             indices +
                             "property double shade_g\nproperty double shade_b\nend_header\n"
                             "0 0 0 0.25 0.5 0.75 1 7\n1 0 0 1 2 3 1 8\n0 1 0 0 0 0 1 9\n"
                             "0.5 3 0 1 2 0.25 0.125\n1 4 0 1 2 1 2 3\n";
    EXPECT_TRUE(ply(file).mesh.attributes.empty());
    const auto mesh = ply(file, {"face_shade_color", "vertex_heat", "vertex_color", "vertex_none", "face_color"}).mesh;
    ASSERT_EQ(mesh.attributes.size(), 3u);
    ASSERT_TRUE(mesh.attribute("vertex_color"));
    EXPECT_FALSE(mesh.attribute("vertex_color")->of_triangles);
    EXPECT_EQ(mesh.attribute("vertex_color")->values, (Values{{0.25f, 0.5f, 0.75f}, {1, 2, 3}, {0, 0, 0}}));
    EXPECT_EQ(mesh.attribute("vertex_heat")->values, (Values{{7, 7, 7}, {8, 8, 8}, {9, 9, 9}}));
    // Each triangle of a polygon has what the polygon has.
    ASSERT_TRUE(mesh.attribute("face_shade_color"));
    EXPECT_TRUE(mesh.attribute("face_shade_color")->of_triangles);
    EXPECT_EQ(mesh.attribute("face_shade_color")->values, (Values{{0.5f, 0.25f, 0.125f}, {1, 2, 3}, {1, 2, 3}}));
}

// Numbered channels, from 0 or 1, as many as there are; a colour may be numbered as well.
TEST_F(MeshPly, ChannelsOfAttributesMayBeNumbered) {
    using Values = std::vector<std::array<float, 3>>;
    const auto attribute = [&](const std::string& name, const std::vector<std::string>& channels) {
        std::string head = "ply\nformat ascii 1.0\nelement vertex 3\n" + xyz, row;
        for (std::size_t i = 0; i < channels.size(); ++i) {
            head += "property float " + channels[i] + "\n";
            row += " " + std::to_string(i + 1);
        }
        const auto mesh =
            ply(head + "element face 1\n" + indices + "end_header\n0 0 0" + row + "\n1 0 0" + row + "\n0 1 0" + row + "\n3 0 1 2\n",
                {name})
                .mesh;
        return mesh.attributes.empty() ? Values() : mesh.attributes[0].values;
    };
    const Values three(3, {1, 2, 3}), one(3, {1, 1, 1});
    EXPECT_EQ(attribute("vertex_color", {"color_0", "color_1", "color_2"}), three);
    EXPECT_EQ(attribute("vertex_color", {"color_1", "color_2", "color_3"}), three);
    EXPECT_EQ(attribute("vertex_color", {"color_0"}), one);
    EXPECT_EQ(attribute("vertex_heat", {"heat_0", "heat_1", "heat_2"}), three);
    EXPECT_EQ(attribute("vertex_heat", {"heat_1"}), one);
    EXPECT_EQ(attribute("vertex_sky_color", {"sky_color_0", "sky_color_1", "sky_color_2"}), three);
    EXPECT_EQ(attribute("vertex_sky_color", {"sky_r", "sky_g", "sky_b", "sky_a"}), three);
    EXPECT_EQ(attribute("vertex_color", {"r", "g", "b", "color_0"}), three);
    EXPECT_EQ(attribute("vertex_color", {"r", "g"}), Values());
    EXPECT_EQ(attribute("vertex_heat", {"heat_2", "heat_3"}), Values());
}

// Values of the sRGB transfer function: 0, its linear part at 10/255, 188/255, 1 (IEC 61966-2-1).
TEST_F(MeshPly, WholeNumbersOfAttributesAreSrgb) {
    Bytes body(std::endian::big);
    for (const std::array<std::uint8_t, 3>& c : {std::array<std::uint8_t, 3>{0, 10, 255}, {188, 188, 188}, {255, 255, 0}})
        body.point(0, 0, 0).add(c[0]).add(c[1]).add(c[2]);
    body.list({0, 1, 2});
    const auto mesh =
        ply("ply\nformat binary_big_endian 1.0\nelement vertex 3\n" + xyz +
                "property uchar r\nproperty uchar g\nproperty uchar b\nelement face 1\n" + indices + "end_header\n" + body.text(),
            {"vertex_color"})
            .mesh;
    ASSERT_EQ(mesh.attributes.size(), 1u);
    const auto& values = mesh.attributes[0].values;
    ASSERT_EQ(values.size(), 3u);
    EXPECT_EQ(values[0][0], 0.0f);
    EXPECT_NEAR(values[0][1], 10.0 / 255.0 / 12.92, 1e-9);
    EXPECT_EQ(values[0][2], 1.0f);
    EXPECT_NEAR(values[1][0], std::pow((188.0 / 255.0 + 0.055) / 1.055, 2.4), 1e-7);
}

TEST_F(MeshPly, ReadsEveryTypeAndSkipsWhatAMeshDoesNotNeed) {
    for (const auto order : {std::endian::little, std::endian::big}) {
        Bytes body(order);
        body.list<std::uint16_t>({1, 2, 3}).list<std::uint16_t>({});
        const auto vertex = [&](std::int8_t x, std::int16_t y, double z) {
            body.add(std::uint8_t{200}).add(x).list<float>({1.0f, 2.0f}).add(y).add(std::uint32_t{7}).add(z).add(std::int32_t{-1});
        };
        vertex(-5, -300, 0.1);
        vertex(1, 0, 0.0);
        vertex(0, 1, 0.0);
        const auto face = [&](std::uint16_t a, std::uint16_t b, std::uint16_t c) {
            body.add(std::int32_t{2}).add(0.5).add(0.5).add(std::uint32_t{3}).add(a).add(b).add(c).add(std::int8_t{1});
        };
        face(0, 1, 2);
        face(2, 1, 0);
        const auto mesh =
            ply(std::string("ply\nformat ") + (order == std::endian::little ? "binary_little_endian" : "binary_big_endian") +
                " 1.0\ncomment made by hand\nobj_info none\n\nelement empty 1000000000000\nelement strip 2\n"
                "property list uint8 uint16 items\nelement vertex 3\nproperty uint8 red\nproperty int8 x\n"
                "property list uchar float32 uv\nproperty short y\nproperty uint32 id\nproperty float64 z\nproperty int w\n"
                "element face 2\nproperty list int double texcoord\nproperty list uint ushort vertex_index\n"
                "property char flags\nend_header\n" +
                body.text())
                .mesh;
        EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{Vec3(-5, -300, 0.1), x, y}));
        EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {2, 1, 0}}));
    }
}

TEST_F(MeshPly, FacesMayPrecedeVertices) {
    const auto mesh =
        ply("ply\nformat ascii 1.0\nelement face 1\n" + indices + "element vertex 3\n" + xyz + "end_header\n3 0 1 2\n" + points)
            .mesh;
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
}

TEST_F(MeshPly, LineEnds) {
    const auto with = [](std::string text, const std::string& line_end) {
        for (std::size_t i = 0; (i = text.find('\n', i)) != std::string::npos; i += line_end.size()) text.replace(i, 1, line_end);
        return text;
    };
    // The first byte of the body is a line feed.
    Bytes body(std::endian::little);
    float feed = 0.0f;
    const std::uint32_t bits = 0x3f80000a;
    std::memcpy(&feed, &bits, sizeof(feed));
    body.point(feed, 0, 0).point(1, 0, 0).point(0, 1, 0).list({0, 1, 2});
    for (const std::string line_end : {"\n", "\r\n", "\r"}) {
        EXPECT_EQ(ply(with(head("ascii", "3", "1") + points + "3 0 1 2\n", line_end)).mesh.triangles, (Triangles{{0, 1, 2}}));
        const auto mesh = ply(with(head("binary_little_endian", "3", "1"), line_end) + body.text()).mesh;
        EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{Vec3(feed, 0, 0), x, y}));
        EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
    }
}

TEST_F(MeshPly, RefusesBinaryBodies) {
    const std::string header = head("binary_little_endian", "3", "2");
    const auto body = [] { return Bytes(std::endian::little); };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(error(header + body().point(0, 0, 0).point(0, nan, 0).text()), "FILE: vertex 2: vertex coordinate is not finite");
    const std::string corners = body().point(0, 0, 0).point(1, 0, 0).point(0, 1, 0).list({0, 1, 2}).text();
    EXPECT_EQ(error(header + corners + body().list({0, 1, 99}).text()),
              "FILE: face 2: vertex index 99 is out of range, the file has 3 vertices");
    EXPECT_EQ(error(header + corners + body().list({0, 1, -1}).text()),
              "FILE: face 2: vertex index -1 is out of range, the file has 3 vertices");
    EXPECT_EQ(error(header + corners + body().list({0, 1}).text()), "FILE: face 2: a face needs at least 3 vertices, found 2");
    EXPECT_EQ(error(header + corners + body().list({2, 1, 0}).list({0, 1, 2}).text()), "FILE: 13 bytes after the last element");
    EXPECT_EQ(ply(header + corners + body().list({2, 1, 0}).text() + "\n").mesh.triangles.size(), 2u);
    EXPECT_EQ(error("ply\nformat binary_big_endian 1.0\nelement edge\x01 1\nproperty list char int b\nelement vertex 3\n" + xyz +
                    "element face 1\n" + indices + "end_header\n\xFE"),
              "FILE: edge? 1: a list of length -2");
}

TEST_F(MeshPly, RefusesTruncatedFiles) {
    const std::string ascii = head("ascii", "3", "2");
    EXPECT_EQ(error(ascii + "0 0 0\n1 0 0\n0 1"), "FILE: ends after vertex 2 of 3");
    EXPECT_EQ(error(ascii + points + "3 0 1 2\n3 0 1"), "FILE: ends after face 1 of 2");
    for (const auto order : {std::endian::little, std::endian::big}) {
        const std::string binary = head(order == std::endian::little ? "binary_little_endian" : "binary_big_endian", "3", "1");
        const std::string body = Bytes(order).point(0, 0, 0).point(1, 0, 0).point(0, 1, 0).list({0, 1, 2}).text();
        EXPECT_EQ(error(binary + body.substr(0, 11)), "FILE: ends before vertex 1 of 3");
        EXPECT_EQ(error(binary + body.substr(0, 35)), "FILE: ends after vertex 2 of 3");
        EXPECT_EQ(error(binary + body.substr(0, 36)), "FILE: ends before face 1 of 1");
        EXPECT_EQ(error(binary + body.substr(0, body.size() - 1)), "FILE: ends before face 1 of 1");
    }
}

TEST_F(MeshPly, CountsOfTheHeaderAllocateNothing) {
    EXPECT_EQ(error("ply\nformat binary_little_endian 1.0\nelement a 9223372036854775807\nproperty list uint double b\n"
                    "element vertex 0\n" +
                    xyz + "element face 0\n" + indices + "end_header\n\xFF\xFF\xFF\xFF"),
              "FILE: ends before a 1 of 9223372036854775807");
    const Bytes polygon = Bytes(std::endian::little).point(0, 0, 0).add(std::int32_t{2147483647}).add(0).add(0).add(0);
    EXPECT_EQ(error("ply\nformat binary_little_endian 1.0\nelement vertex 1\n" + xyz +
                    "element face 1\nproperty list int int vertex_indices\nend_header\n" + polygon.text()),
              "FILE: ends before face 1 of 1");
}

TEST_F(MeshPly, RefusesFilesThatCannotBeOpened) {
    const std::string path = folder() + "/none";
    try {
        read_ply(path);
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_EQ(error.what(), path + ": there is no such file");
    }
}

}  // namespace neumann::mesh_ply_test
