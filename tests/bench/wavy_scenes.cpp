#include "tests/bench/wavy_scenes.h"

#include "core/base/vec.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace neumann::wavy {

namespace {

struct Vertex {
    float position[3], normal[3], uv[2];
};

std::vector<Vertex> vertices_of(int mesh) {
    std::vector<Vertex> vertices;
    for (int i = 0; i <= side; ++i)
        for (int j = 0; j <= side; ++j) {
            const float u = static_cast<float>(i) / side, v = static_cast<float>(j) / side, wave = 20.0f * u + 15.0f * v;
            const float slope = -0.02f * std::cos(wave);
            const Vec3 n = glm::normalize(Vec3(20.0f * slope, 15.0f * slope, 1.0f));
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

// Numbers one after the other, of all vertices.
std::vector<float> positions(const std::vector<Vertex>& vertices) {
    std::vector<float> all;
    for (const Vertex& v : vertices) all.insert(all.end(), v.position, v.position + 3);
    return all;
}

std::vector<float> normals(const std::vector<Vertex>& vertices) {
    std::vector<float> all;
    for (const Vertex& v : vertices) all.insert(all.end(), v.normal, v.normal + 3);
    return all;
}

std::vector<float> coordinates(const std::vector<Vertex>& vertices) {
    std::vector<float> all;
    for (const Vertex& v : vertices) all.insert(all.end(), v.uv, v.uv + 2);
    return all;
}

std::vector<std::uint32_t> indices() {
    std::vector<std::uint32_t> all;
    for (const auto& face : faces())
        for (const int i : face) all.push_back(static_cast<std::uint32_t>(i));
    return all;
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

std::string write_xml(const std::string& folder) {
    const std::string path = folder + "/scene.xml";
    std::ofstream xml(path);
    xml << "<scene version='3.0.0'><sensor type='perspective'><float name='fov' value='40'/></sensor>\n";
    for (int mesh = 0; mesh < meshes; ++mesh) {
        const char* type = mesh % 2 ? "obj" : "ply";
        const std::string name = fmt::format("{}.{}", mesh, type);
        (mesh % 2 ? write_obj : write_ply)(folder + "/" + name, vertices_of(mesh));
        xml << fmt::format("<shape type='{}'><string name='filename' value='{}'/>", type, name)
            << "<boolean name='face_normals' value='true'/></shape>\n";
    }
    xml << "</scene>\n";
    return path;
}

std::string write_glb(const std::string& folder) {
    std::string buffer;
    std::vector<std::string> views, accessors, primitives, nodes, numbers;
    const auto add = [&](const auto& values, const char* type, int component, std::size_t width) {
        const std::size_t size = values.size() * sizeof(values[0]);
        views.push_back(fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":{}}})", buffer.size(), size));
        accessors.push_back(fmt::format(R"({{"bufferView":{},"componentType":{},"count":{},"type":"{}"}})", views.size() - 1,
                                        component, values.size() / width, type));
        buffer.append(reinterpret_cast<const char*>(values.data()), size);
        return accessors.size() - 1;
    };
    for (int mesh = 0; mesh < meshes; ++mesh) {
        const std::vector<Vertex> vertices = vertices_of(mesh);
        const std::size_t p = add(positions(vertices), "VEC3", 5126, 3), n = add(normals(vertices), "VEC3", 5126, 3),
                          t = add(coordinates(vertices), "VEC2", 5126, 2), i = add(indices(), "SCALAR", 5125, 1);
        primitives.push_back(fmt::format(
            R"({{"primitives":[{{"attributes":{{"POSITION":{},"NORMAL":{},"TEXCOORD_0":{}}},"indices":{}}}]}})", p, n, t, i));
        nodes.push_back(fmt::format(R"({{"mesh":{}}})", mesh));
        numbers.push_back(std::to_string(mesh));
    }
    std::string json = fmt::format(R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[{}]}}],"nodes":[{}],)"
                                   R"("meshes":[{}],"accessors":[{}],"bufferViews":[{}],"buffers":[{{"byteLength":{}}}]}})",
                                   fmt::join(numbers, ","), fmt::join(nodes, ","), fmt::join(primitives, ","),
                                   fmt::join(accessors, ","), fmt::join(views, ","), buffer.size());
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::string path = folder + "/scene.glb";
    std::ofstream file(path, std::ios::binary);
    const auto word = [&](std::size_t value) {
        const auto bits = static_cast<std::uint32_t>(value);
        file.write(reinterpret_cast<const char*>(&bits), sizeof bits);
    };
    file << "glTF";
    word(2);
    word(28 + json.size() + buffer.size());
    word(json.size());
    file << "JSON" << json;
    word(buffer.size());
    file.write("BIN\0", 4);
    file << buffer;
    return path;
}

std::string write_dae(const std::string& folder) {
    const std::string path = folder + "/scene.dae";
    std::ofstream dae(path);
    dae << "<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n"
           "<library_geometries>\n";
    const auto source = [&](const std::string& id, const std::vector<float>& values, const std::vector<const char*>& names) {
        dae << fmt::format("<source id=\"{0}\"><float_array id=\"{0}-array\" count=\"{1}\">{2}</float_array>", id, values.size(),
                           fmt::join(values, " "))
            << fmt::format("<technique_common><accessor source=\"#{}-array\" count=\"{}\" stride=\"{}\">", id,
                           values.size() / names.size(), names.size());
        for (const char* name : names) dae << fmt::format("<param name=\"{}\" type=\"float\"/>", name);
        dae << "</accessor></technique_common></source>\n";
    };
    for (int mesh = 0; mesh < meshes; ++mesh) {
        const std::vector<Vertex> vertices = vertices_of(mesh);
        const std::string id = fmt::format("mesh-{}", mesh);
        dae << fmt::format("<geometry id=\"{}\"><mesh>\n", id);
        source(id + "-positions", positions(vertices), {"X", "Y", "Z"});
        source(id + "-normals", normals(vertices), {"X", "Y", "Z"});
        source(id + "-map-0", coordinates(vertices), {"S", "T"});
        dae << fmt::format("<vertices id=\"{0}-vertices\"><input semantic=\"POSITION\" source=\"#{0}-positions\"/></vertices>\n",
                           id)
            << fmt::format(
                   "<triangles count=\"{1}\"><input semantic=\"VERTEX\" source=\"#{0}-vertices\" offset=\"0\"/>"
                   "<input semantic=\"NORMAL\" source=\"#{0}-normals\" offset=\"1\"/>"
                   "<input semantic=\"TEXCOORD\" source=\"#{0}-map-0\" offset=\"2\" set=\"0\"/><p>",
                   id, faces().size());
        for (const std::uint32_t i : indices()) dae << fmt::format("{0} {0} {0} ", i);
        dae << "</p></triangles></mesh></geometry>\n";
    }
    dae << "</library_geometries>\n<library_visual_scenes><visual_scene id=\"Scene\">\n";
    for (int mesh = 0; mesh < meshes; ++mesh)
        dae << fmt::format("<node id=\"node-{0}\"><instance_geometry url=\"#mesh-{0}\"/></node>\n", mesh);
    dae << "</visual_scene></library_visual_scenes>\n<scene><instance_visual_scene url=\"#Scene\"/></scene>\n</COLLADA>\n";
    return path;
}

std::string write_pbrt(const std::string& folder, bool in_file) {
    const std::string path = folder + "/scene.pbrt";
    std::ofstream pbrt(path);
    pbrt << "LookAt 10 8 20  10 8 0  0 1 0\nCamera \"perspective\"\nWorldBegin\nLightSource \"infinite\"\n";
    for (int mesh = 0; mesh < meshes; ++mesh) {
        const std::vector<Vertex> vertices = vertices_of(mesh);
        if (in_file) {
            pbrt << fmt::format("Shape \"trianglemesh\"\n\"point3 P\" [ {} ]\n\"normal N\" [ {} ]\n\"point2 uv\" [ {} ]\n",
                                fmt::join(positions(vertices), " "), fmt::join(normals(vertices), " "),
                                fmt::join(coordinates(vertices), " "))
                 << fmt::format("\"integer indices\" [ {} ]\n", fmt::join(indices(), " "));
        } else {
            write_ply(fmt::format("{}/{}.ply", folder, mesh), vertices);
            pbrt << fmt::format("Shape \"plymesh\" \"string filename\" \"{}.ply\"\n", mesh);
        }
    }
    return path;
}

}  // namespace

const std::map<std::string, Writer>& writers() {
    static const std::map<std::string, Writer> all = {
        {"xml", write_xml},
        {"glb", write_glb},
        {"dae", write_dae},
        {"pbrt", [](const std::string& folder) { return write_pbrt(folder, true); }},
        {"pbrt-ply", [](const std::string& folder) { return write_pbrt(folder, false); }},
    };
    return all;
}

}  // namespace neumann::wavy
