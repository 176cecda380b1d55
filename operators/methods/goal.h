// What a render is to reach, whatever its method.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>

namespace neumann {

// What is given holds together, whichever comes first. Without samples, seconds and error: a good picture, or what a short wait
// gives.
struct Goal {
    std::optional<int> bounces = {};            // N, the last one with a picture of its own
    std::optional<double> tail = {};            // or as many as it takes until the rest is below this part of the sum
    std::optional<std::uint64_t> samples = {};  // a pixel
    // Of which the standard errors are made: that many, which divide the samples into powers of two. Chosen without it.
    std::optional<std::uint32_t> replicates = {};
    std::optional<double> seconds = {};
    std::optional<double> relative_error = {};  // of every bounce
    std::optional<double> memory = {};          // bytes that may be taken, about; half of the machine's without it
    std::uint64_t seed = 0;
    std::optional<glm::dmat3> colors = {};  // those of the pictures and their errors, from linear RGB; paths only
    bool only_pictures = false;             // neither the rest nor the errors at fewer samples nor the health are wanted
};

// Samples a pixel in each of goal.replicates. Throws InputError where they are not a power of two.
std::uint32_t share_of_replicate(const Goal& goal);

// Of a render without samples, seconds or error.
constexpr double default_seconds = 20.0, default_error = 0.02;
// The most that an error takes by fields on patches, where no seconds are given.
constexpr double longest_search = 600.0;

}  // namespace neumann
