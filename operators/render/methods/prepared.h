// Holds what methods prepare before their first sample, so that it is made once: a pilot that tries a method leaves its
// tables or fields to the render that follows.
#pragma once

#include "operators/render/from_paths/path_method.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

namespace neumann {

class Prepared {
public:
    // `seed`: the seed of the render; `bounces`: the least number of bounces.
    explicit Prepared(std::uint64_t seed, int bounces = 0) : seed_(seed), bounces_(bounces) {}

    std::uint64_t seed() const { return seed_; }
    int bounces(int wanted) const { return std::max(wanted, bounces_); }

    // The method that was kept under this name, or null. It refers to no scene, only to its geometry.
    std::shared_ptr<const PathMethod> of(const std::string& method) const;
    std::shared_ptr<const PathMethod> keep(const std::string& method, std::shared_ptr<const PathMethod> made);
    void keep_only(const std::string& method);

private:
    std::uint64_t seed_;
    int bounces_;
    std::map<std::string, std::shared_ptr<const PathMethod>> made_;
};

// Whether fields or tables that were made with settings `made` serve for settings `wanted`.
template <class Settings>
bool serves(const Settings& made, const Settings& wanted) {
    return made.patches == wanted.patches && made.rays == wanted.rays && made.bounces >= wanted.bounces;
}

}  // namespace neumann
