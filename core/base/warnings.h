// Warnings of what was accepted although it is odd, each kind once with a count: "3 degenerate triangles left out".
#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <string>

namespace neumann {

class Warnings {
    // Orders line 9 of a file before line 10.
    struct InOrder {
        bool operator()(const std::string& a, const std::string& b) const { return strverscmp(a.c_str(), b.c_str()) < 0; }
    };

public:
    using Counts = std::map<std::string, std::uint64_t, InOrder>;

    void add(const std::string& text, std::uint64_t count = 1) {
        if (count > 0) counts_[text] += count;
    }
    const Counts& counts() const { return counts_; }

private:
    Counts counts_;
};

}  // namespace neumann
