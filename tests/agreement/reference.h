// What methods are compared with, bounce by bounce: pictures of 32×32 pixels by a method that makes all the paths of a scene well.
#pragma once

#include "tests/physics/picture_blocks.h"

#include <functional>
#include <string>

namespace neumann::agreement {

inline constexpr std::size_t bounces = 4;
inline constexpr int block = 8;  // blocks of 8×8 pixels

struct Reference {
    std::string name;
    Scene scene;
    bool knows_rest;  // walks from the camera measure it, and may be too rare for it where the terms have paths from both ends
    physics::Blocks blocks;
    SeriesMoments::Result pixels;  // of the same paths, or of paths from both ends where walks meet caustics rarely
};

// Made once. Its seed is the fixed one, so that other pictures need another.
const Reference& reference(const std::string& scene);

struct Count {
    int within = 0, all = 0;
    void operator+=(const Count& other) { within += other.within, all += other.all; }
};

struct Comparison {
    std::string what;  // the method
    double known;      // values are left out that the reference does not know to this part
    // The bias that the method states of the mean of a block, for a term and a channel.
    std::function<double(std::size_t block, std::size_t term, std::size_t channel)> bias = {};
    // Of another seed, with four times as many replicates: for rare paths that make the spread of few replicates too small. Values
    // that are too far off are looked at in it once more.
    std::function<physics::Blocks()> once_more = {};
};

// All terms of all blocks, in each channel, and the rest if the reference knows it. Where both are exact they are the same;
// elsewhere |found − reference| ≤ 4.5 SE + 2 bias is expected, and counted how many are within t SE + bias, 95% of them in the long
// run.
Count compare(const physics::Blocks& found, const Reference& reference, const Comparison& comparison);

}  // namespace neumann::agreement
