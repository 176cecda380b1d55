#include "core/reader/meshes/polygons.h"

#include "core/base/frame.h"

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

// Twice the area of a triangle, positive if it is counter-clockwise.
double area(const Vec2& a, const Vec2& b, const Vec2& c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

bool is_within(const Vec2& p, const Vec2& a, const Vec2& b, const Vec2& c) {
    return area(a, b, p) >= 0.0 && area(b, c, p) >= 0.0 && area(c, a, p) >= 0.0;
}

bool turns_back(const std::vector<Vec2>& p) {
    // In radians; less is rounding in the file.
    constexpr double least = 1e-5;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Vec2 &a = p[i], &b = p[(i + 1) % p.size()], &c = p[(i + 2) % p.size()];
        if (area(a, b, c) < -least * glm::length(b - a) * glm::length(c - b)) return true;
    }
    return false;
}

// Cuts one polygon after the other, in the same memory.
class EarCutter {
public:
    // Returns triangles of the corners' numbers; empty if a fan is right, or nothing is.
    const CornerTriples& cut(const std::vector<Vec3>& corners) {
        triangles_.clear();
        if (see_from_above(corners) && turns_back(flat_)) cut_ears();
        return triangles_;
    }

private:
    // Projects the polygon as seen from the side from which it is counter-clockwise as a whole. Returns false if it has no area.
    bool see_from_above(const std::vector<Vec3>& corners) {
        double size = 0.0;
        for (const Vec3& p : corners) size = std::max(size, max_component(glm::abs(p - corners[0])));
        if (!(size > 0.0) || !std::isfinite(size)) return false;
        const auto at = [&](std::size_t i) { return (corners[i] - corners[0]) / size; };  // products neither underflow nor overflow
        Vec3 normal(0.0);
        for (std::size_t i = 2; i < corners.size(); ++i) normal += glm::cross(at(i - 1), at(i));
        const double length = glm::length(normal);
        if (!(length > 0.0)) return false;
        const Frame frame(normal / length);
        flat_.clear();
        for (std::size_t i = 0; i < corners.size(); ++i) flat_.emplace_back(glm::dot(at(i), frame.s), glm::dot(at(i), frame.t));
        return true;
    }

    bool is_ear(const std::array<std::uint32_t, 3>& corners) const {
        const Vec2 &a = flat_[corners[0]], &b = flat_[corners[1]], &c = flat_[corners[2]];
        return area(a, b, c) >= 0.0 && std::ranges::none_of(left_, [&](std::uint32_t i) {
                   return flat_[i] != a && flat_[i] != b && flat_[i] != c && is_within(flat_[i], a, b, c);
               });
    }

    void cut_ears() {
        left_.clear();
        for (std::uint32_t i = 0; i < flat_.size(); ++i) left_.push_back(i);
        std::size_t at = 0, tried = 0;
        while (left_.size() > 3 && tried < left_.size()) {
            const std::size_t n = left_.size();
            const std::array<std::uint32_t, 3> ear = {left_[(at + n - 1) % n], left_[at % n], left_[(at + 1) % n]};
            if (is_ear(ear)) {
                triangles_.push_back(ear);
                left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(at % n));
                tried = 0;
            } else {
                ++at;
                ++tried;
            }
            at %= left_.size();
        }
        if (left_.size() > 3)
            triangles_.clear();
        else
            triangles_.push_back({left_[0], left_[1], left_[2]});
    }

    std::vector<Vec2> flat_;
    std::vector<std::uint32_t> left_;
    CornerTriples triangles_;
};

// Finds the outline in the memory of `outline`.
void find_outline(const Fan& fan, const CornerTriples& triangles, std::vector<std::uint32_t>& outline) {
    outline = {triangles[fan.first_triangle][0], triangles[fan.first_triangle][1]};
    for (std::size_t i = 0; i + 2 < fan.corners; ++i) outline.push_back(triangles[fan.first_triangle + i][2]);
}

}  // namespace

void cut_fans(const std::vector<Fan>& fans, CornerTriples& triangles, const std::function<Vec3(std::uint32_t corner)>& position,
              std::initializer_list<CornerTriples*> beside) {
    EarCutter cutter;
    std::vector<std::uint32_t> outline;
    std::vector<Vec3> places;
    for (const Fan& fan : fans) {
        find_outline(fan, triangles, outline);
        places.clear();
        for (const std::uint32_t corner : outline) places.push_back(position(corner));
        const CornerTriples& cut = cutter.cut(places);
        if (cut.empty()) continue;
        const auto replace = [&](CornerTriples& corners) {
            find_outline(fan, corners, outline);
            for (std::size_t i = 0; i < cut.size(); ++i)
                for (std::size_t k = 0; k < 3; ++k) corners[fan.first_triangle + i][k] = outline[cut[i][k]];
        };
        replace(triangles);
        for (CornerTriples* const other : beside)
            if (!other->empty()) replace(*other);
    }
}

}  // namespace neumann
