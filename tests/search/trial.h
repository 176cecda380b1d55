// A scene rendered by several methods, in processes of their own, and what is wrong there.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace neumann::search {

struct Finding {
    enum class Kind { scene, died, not_finite, error, differs };
    Kind kind = Kind::differs;
    std::string method, other;  // the methods that differ; otherwise `other` is empty
    std::string what;           // in words, with the command that shows it
    bool same_as(const Finding& f) const { return kind == f.kind && method == f.method && other == f.other; }
};

// How closely methods look at a scene: each time with other seeds and more samples.
constexpr std::size_t looks = 3;

struct Trial {
    std::filesystem::path scene;
    std::vector<std::string> methods;  // words of read_method(); what others are compared with first
    std::uint64_t seed = 0;
    // What differs at one look is looked at again, until the last one.
    std::size_t first_look = 0, last_look = looks - 1;
    bool thorough = true;  // as of a look
};

struct Verdict {
    std::vector<Finding> findings;
    std::map<std::string, double> rendered;      // in so many seconds, at the first look
    std::map<std::string, std::string> refused;  // why, by method
    bool looked_again = false;
    double seconds = 0.0;
};

Verdict try_scene(const Trial& trial);

}  // namespace neumann::search
