// What was accepted although it is odd, each kind once with a count: "3 degenerate triangles left out".
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace neumann {

class Warnings {
public:
    void add(const std::string& text, std::uint64_t count = 1) {
        if (count > 0) counts_[text] += count;
    }
    const std::map<std::string, std::uint64_t>& counts() const { return counts_; }

private:
    std::map<std::string, std::uint64_t> counts_;
};

}  // namespace neumann
