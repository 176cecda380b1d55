// The unit cube [0, 1]³ with n × n patches a face: exact form factors, piecewise constant radiance.
#pragma once

#include "operators/fields/matrix/form_factors.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <tuple>

namespace neumann::known {

enum CubeFace { x0, x1, y0, y1, cube_floor, cube_ceiling };

inline const std::array<Parallelogram, 6>& cube_faces() {
    static const std::array<Parallelogram, 6> faces = {{{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                                        {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                                        {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}},
                                                        {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                                        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                                        {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}}};
    return faces;
}

struct Cube {
    std::vector<Parallelogram> patches;  // one patch for each unknown
    std::vector<int> face;               // CubeFace of each unknown
    FormFactors factors;

    Eigen::Index size() const { return factors.area.size(); }
    Vector on_faces(const std::array<double, 6>& value) const {
        Vector x(size());
        for (Eigen::Index u = 0; u < size(); ++u) x[u] = value[face[u]];
        return x;
    }
    Vector ceiling() const { return on_faces({0, 0, 0, 0, 0, 1}); }
    DenseChannel channel(const Vector& rho) const { return {rho.asDiagonal() * factors.F, factors.area}; }
    DenseChannel channel(double rho) const { return channel(Vector::Constant(size(), rho)); }
    // The mean over the part of a face in which `inside` is true.
    template <class Inside>
    double mean(const Vector& x, int of_face, const Inside& inside) const {
        double sum = 0.0, area = 0.0;
        for (Eigen::Index u = 0; u < size(); ++u)
            if (face[u] == of_face && inside(patches[u].centre())) {
                sum += factors.area[u] * x[u];
                area += factors.area[u];
            }
        return sum / area;
    }
};

inline Cube patched_cube(int n) {
    Cube cube;
    for (int f = 0; f < 6; ++f)
        for (const Parallelogram& patch : cells(cube_faces()[f], n, n)) {
            cube.patches.push_back(patch);
            cube.face.push_back(f);
        }
    cube.factors = form_factors(cube.patches);
    return cube;
}

// The cube for functions with the eight symmetries of the square (x, y): all patches that these map to each other are
// one unknown with their total area. All walls are x0. A method that treats equal unknowns equally, and weights them by
// their area, has the same iterates as on the whole cube.
inline Cube symmetric_cube(int n) {
    const auto kind = [n](const Vec3& centre) {
        const auto folded = [n](double x) {
            const long k = std::lround(2 * n * x);
            return std::min(k, 2 * n - k);
        };
        const long x = folded(centre.x), y = folded(centre.y);
        return std::tuple(std::min(x, y), std::max(x, y), std::lround(2 * n * centre.z));
    };
    std::map<std::tuple<long, long, long>, int> orbit;
    std::vector<Parallelogram> all;
    std::vector<int> orbit_of;
    Cube cube;
    for (int f = 0; f < 6; ++f)
        for (const Parallelogram& patch : cells(cube_faces()[f], n, n)) {
            const auto [found, added] = orbit.emplace(kind(patch.centre()), static_cast<int>(cube.patches.size()));
            if (added) {
                cube.patches.push_back(patch);
                cube.face.push_back(f);
            }
            all.push_back(patch);
            orbit_of.push_back(found->second);
        }
    const auto size = static_cast<Eigen::Index>(cube.patches.size());
    cube.factors = {DenseChannel::Matrix::Zero(size, size), Vector::Zero(size)};
    ExchangeAreas exchange;
    for (std::size_t v = 0; v < all.size(); ++v) cube.factors.area[orbit_of[v]] += all[v].area();
    for (Eigen::Index u = 0; u < size; ++u)
        for (std::size_t v = 0; v < all.size(); ++v)
            if (!(all[v].corner == cube.patches[u].corner && all[v].u == cube.patches[u].u))
                cube.factors.F(u, orbit_of[v]) += exchange(cube.patches[u], all[v]) / cube.patches[u].area();
    return cube;
}

}  // namespace neumann::known
