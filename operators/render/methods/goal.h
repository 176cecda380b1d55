// The goal of a render, which does not depend on the method.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>

namespace neumann {

// The k-th of n renders that share the replicates of one seed.
struct PartOfSamples {
    std::uint32_t k = 1, n = 1;
};

// A render stops at the first of the given limits that it reaches. If samples, seconds and error are all missing, it aims at
// default_error for at most default_seconds.
struct Goal {
    std::optional<int> bounces = {};            // N, the last one with a picture of its own
    std::optional<double> tail = {};            // instead of N: N is raised until the rest is below this part of the sum
    std::optional<std::uint64_t> samples = {};  // per pixel
    std::optional<PartOfSamples> part = {};     // a part of the samples, which then count all parts; paths only
    // The number of independent replicates from which standard errors are estimated. Each takes the same power of two of samples
    // per pixel. The default depends on the samples.
    std::optional<std::uint32_t> replicates = {};
    std::optional<double> seconds = {};
    std::optional<double> relative_error = {};  // for every bounce
    std::optional<double> memory = {};          // approximate limit in bytes; the default is half of the machine's memory
    std::uint64_t seed = 0;
    std::optional<glm::dmat3> colors = {};  // from linear RGB to the colours of the pictures and their errors; paths only
    bool only_pictures = false;             // skip the rest, the errors at fewer samples, and the health
};

// Samples per pixel in each of goal.replicates. Throws InputError if they are not a power of two.
std::uint32_t share_of_replicate(const Goal& goal);

// The default limits of a render without samples, seconds or error.
constexpr double default_seconds = 20.0, default_error = 0.02;
// Time limit in seconds of a render that has an error to reach and no time limit of its own.
constexpr double longest_search = 600.0;

// The goal, with the default limits if it has none.
Goal with_default_limits(Goal goal);

}  // namespace neumann
