// The unit cube whose ceiling emits, seen at the middle of its floor.
#pragma once

#include "operators/experiments/known/figures.h"
#include "operators/experiments/known/probe.h"
#include "operators/experiments/known/scene_maker.h"

namespace neumann::known {

// ρ^i g_i Le at the floor's centre, i = 1 … 3, to 2.4e-8 (cubes.cpp).
std::vector<double> cube_terms(double rho, double radiance = 1.0);
// The scene; `floor_pieces`: the number of strips that form the floor.
SceneMaker lit_cube(double rho, double radiance, const Mat4& to_world = Mat4(1.0), int floor_pieces = 1);
// Samples these terms for a cube of albedo 0.8.
void sample_cube(Figures& figures, std::uint64_t seed, const Scene& scene, const Mat4& to_world = Mat4(1.0), double radiance = 1.0);

}  // namespace neumann::known
