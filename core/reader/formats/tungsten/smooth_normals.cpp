#include "core/reader/formats/tungsten/smooth_normals.h"

#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace neumann::reader::tungsten {

namespace {

const double least_cosine = std::cos(0.15 * std::numbers::pi);

// Triangles at one place whose normals are near that of the first of them. A place has at most some dozens of clusters,
// as many as there are directions 27° apart.
struct Cluster {
    Vec3 first, sum{0.0};
};

// Numbers the places of a mesh; each vertex has one.
std::vector<std::size_t> places_of(const TriangleMesh& mesh, std::size_t& count) {
    std::map<std::tuple<double, double, double>, std::size_t> known;
    std::vector<std::size_t> places;
    for (const Vec3& v : mesh.vertices) places.push_back(known.try_emplace({v.x, v.y, v.z}, known.size()).first->second);
    count = known.size();
    return places;
}

std::size_t cluster_of(const std::vector<Cluster>& clusters, const Vec3& normal) {
    std::size_t i = 0;
    while (i < clusters.size() && glm::dot(clusters[i].first, normal) < least_cosine) ++i;
    return i;
}

}  // namespace

MeshFile with_smooth_normals(const MeshFile& file) {
    const TriangleMesh& mesh = file.mesh;
    std::size_t count = 0;
    const std::vector<std::size_t> places = places_of(mesh, count);
    std::vector<std::vector<Cluster>> clusters(count);
    const auto normal_of = [&](const std::array<std::uint32_t, 3>& t) {
        return glm::cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    };
    const auto unit = [](const Vec3& v) {
        const double length = length_of(v);
        return length > 0.0 ? v / length : Vec3(0.0, 1.0, 0.0);
    };
    for (const auto& t : mesh.triangles)
        for (const std::uint32_t vertex : t) {
            std::vector<Cluster>& there = clusters[places[vertex]];
            const Vec3 n = unit(normal_of(t));
            if (cluster_of(there, n) == there.size()) there.push_back({n});
        }
    for (const auto& t : mesh.triangles)
        for (const std::uint32_t vertex : t)
            for (Cluster& cluster : clusters[places[vertex]])
                if (glm::dot(cluster.first, unit(normal_of(t))) >= least_cosine) cluster.sum += normal_of(t);
    MeshFile result;
    std::map<std::pair<std::uint32_t, std::size_t>, std::uint32_t> vertices;
    for (const auto& t : mesh.triangles) {
        std::array<std::uint32_t, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::vector<Cluster>& there = clusters[places[t[i]]];
            const std::size_t cluster = cluster_of(there, unit(normal_of(t)));
            const auto [known, is_new] =
                vertices.try_emplace({t[i], cluster}, static_cast<std::uint32_t>(result.mesh.vertices.size()));
            corners[i] = known->second;
            if (!is_new) continue;
            result.mesh.vertices.push_back(mesh.vertices[t[i]]);
            if (!mesh.uv.empty()) result.mesh.uv.push_back(mesh.uv[t[i]]);
            result.normals.push_back(there[cluster].sum);
        }
        result.mesh.triangles.push_back(corners);
    }
    return result;
}

}  // namespace neumann::reader::tungsten
