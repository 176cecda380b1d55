// A density over the numbers in [0, 1) from which paths are made, learned from paths that were made before: importance sampling
// in primary sample space (Guo, Bauszat, Bikker and Eisemann, Primary Sample Space Path Guiding, 2018). Boxes are halved where
// what was found lies on one side; numbers are moved by stretching the two halves, so that nets of points stay well spread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace neumann {

class NumberTree {
public:
    static constexpr std::size_t dimensions = 8;
    using Numbers = std::array<double, dimensions>;

    // Where something was found, how much, and this over the density with which the numbers were drawn.
    struct Found {
        Numbers at;
        double value, amount;
    };
    // The uniform density.
    NumberTree() : nodes_(1) {}
    // In each box about in proportion to the root of the mean square of what is there, and above 0 everywhere.
    explicit NumberTree(std::vector<Found> found);

    // The place to which uniform numbers are moved.
    Numbers draw(Numbers uniform) const;
    double density(const Numbers& at) const;

private:
    struct Node {
        std::uint32_t halves = 0;     // index of the lower half, which the upper one follows; 0: a leaf
        std::uint32_t dimension = 0;  // in which it is halved
        double in_lower = 0.5;        // probability of the lower half
    };
    // Halves a node as often as it pays. `lower` and `upper`: the corners of its box. Returns the integral of the root.
    double halve(std::uint32_t node, std::vector<Found>::iterator begin, std::vector<Found>::iterator end, Numbers lower,
                 Numbers upper);

    std::vector<Node> nodes_;
};

}  // namespace neumann
