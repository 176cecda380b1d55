// A picture whose blocks and bounces are weighted means of the pictures of several unbiased methods (best_mixture.h).
// Weights and numbers of samples come from pilots whose samples are used for nothing else, so the mean is unbiased.
#pragma once

#include "operators/paths/walk/walk_settings.h"
#include "operators/render/from_paths/path_method.h"
#include "operators/render/from_paths/pixel_blocks.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace neumann {

struct Allocation;

struct Mixture {
    struct Part {
        std::string method;  // the method's name
        std::shared_ptr<const PathMethod> path_method;
        LeftOut left_out = {};                              // the work that the plan leaves out
        std::shared_ptr<const Allocation> allocation = {};  // some pixels may have no samples
        std::int8_t exponent = 0;  // without an allocation: the exponent of all pixels, as in an allocation
        double share = 1.0;        // part of the work
    };
    std::vector<Part> parts;
    PixelBlocks blocks;
    std::vector<double> weights;  // of bounces 0 … N, part by part, bounce by bounce, block by block; Σ over parts is 1
    std::size_t bounces = 0;      // N + 1
    std::uint64_t rays = 0;       // cast before the first sample

    // The weight of a quantity; the rest beyond N has the weights of bounce N.
    double weight(std::size_t part, std::size_t quantity, std::size_t block) const {
        return weights[(part * bounces + std::min(quantity, bounces - 1)) * blocks.count() + block];
    }
};

}  // namespace neumann
