// The cube whose ceiling emits, at the middle of its floor.
#pragma once

#include "operators/experiments/known/figures.h"
#include "operators/experiments/known/probe.h"
#include "operators/experiments/known/scene_maker.h"

namespace neumann::known {

// ρ^i g_i Le at the floor's centre, i = 1 … 3, to 2.4e-8 (cubes.cpp).
std::vector<double> cube_terms(double rho, double radiance = 1.0);
// `floor_pieces` strips in place of the floor.
SceneMaker lit_cube(double rho, double radiance, const Mat4& to_world = Mat4(1.0), int floor_pieces = 1);
// Those terms, of a cube of albedo 0.8, sampled.
void sample_cube(Figures& figures, std::uint64_t seed, const Scene& scene, const Mat4& to_world = Mat4(1.0), double radiance = 1.0);

}  // namespace neumann::known
