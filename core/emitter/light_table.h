// A table of all lights for sampling: the primitives of emitting shapes, then the distant lights.
#pragma once

#include "core/emitter/emitters.h"
#include "core/geometry/rectangle.h"

#include <algorithm>
#include <span>
#include <vector>

namespace neumann {

class LightTable {
public:
    // A primitive, or two triangles (`primitive` and the next) that form a rectangle.
    struct Part {
        static constexpr std::uint32_t no_rectangle = 0xffffffffu;
        std::uint32_t shape, primitive, rectangle = no_rectangle;
        bool is_rectangle() const { return rectangle != no_rectangle; }
    };
    // The parts of one light.
    struct Range {
        std::size_t first, end;
    };
    // A chosen part or distant light. `left` is a random number that is still uniform in [0, 1), for the point on it.
    struct Choice {
        std::size_t index;
        double probability, left;
    };

    enum class Rectangles { as_triangles, whole };

    // `share` holds the probability of each entry of Emitters::powers(). The table is empty if all are 0. Keeps a
    // reference to the geometry.
    LightTable(const Geometry& geometry, const Emitters& emitters, const std::vector<double>& share, Rectangles rectangles);

    bool empty() const { return cumulative_.empty(); }
    std::size_t size() const { return cumulative_.size(); }
    // The parts of surfaces; choices beyond them are distant lights.
    std::span<const Part> parts() const { return parts_; }
    bool is_distant(std::size_t index) const { return index >= parts_.size(); }
    std::size_t distant(std::size_t index) const { return index - parts_.size(); }
    // Lights with a positive probability.
    std::span<const Range> lights() const { return lights_; }
    double probability(std::size_t index) const { return cumulative_[index] - (index == 0 ? 0.0 : cumulative_[index - 1]); }

    // The part on which a point of an emitting surface lies.
    Part part_at(const SurfacePoint& y) const;
    // The index of a part in the table.
    std::size_t index_of(const Part& part) const;
    double area(const Part& part) const;
    const Rectangle& rectangle(const Part& part) const { return rectangles_[part.rectangle]; }

    Choice choose(double u) const { return choose(u, 0, cumulative_.size()); }
    // Chooses a part of one light, in proportion to probability; Choice::probability is relative to the whole table.
    Choice choose_of(const Range& light, double u) const {
        const double low = light.first == 0 ? 0.0 : cumulative_[light.first - 1], high = cumulative_[light.end - 1];
        return choose(low + u * (high - low), light.first, light.end);
    }

private:
    Choice choose(double u, std::size_t first, std::size_t end) const {
        // If there are few entries, all are compared: a search branches by which one is found, and that cannot be predicted.
        constexpr std::size_t few = 8;
        const double* const sums = cumulative_.data();
        std::size_t found = first;
        if (end - first <= few)
            for (std::size_t i = first; i + 1 < end; ++i) found += sums[i] <= u;
        else
            found = static_cast<std::size_t>(std::upper_bound(sums + first, sums + end - 1, u) - sums);
        const double below = found == 0 ? 0.0 : sums[found - 1], share = sums[found] - below;
        return {found, share, std::clamp((u - below) / share, 0.0, 0x1.fffffffffffffp-1)};
    }

    const Geometry* geometry_;
    std::vector<Part> parts_;
    std::vector<Range> lights_;
    std::vector<double> cumulative_;  // cumulative probabilities of parts_, then of the distant lights of Emitters
    std::vector<Rectangle> rectangles_;
    std::vector<std::vector<Part>> rectangular_;  // by shape and primitive, for shapes with rectangles
};

}  // namespace neumann
