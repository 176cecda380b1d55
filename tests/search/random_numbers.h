// The numbers that a random scene is made of: the same for the same number of the scene, with every compiler and library.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

namespace neumann::search {

class RandomNumbers {
public:
    explicit RandomNumbers(std::uint64_t scene) : engine_(scene) {}

    // Of three decimals, as they are written into the file.
    double between(double low, double high) { return std::round((low + (high - low) * unit()) * 1000.0) / 1000.0; }
    std::uint64_t below(std::uint64_t end) { return static_cast<std::uint64_t>(unit() * static_cast<double>(end)); }
    bool chance(double probability) { return unit() < probability; }
    template <class Value, std::size_t n>
    const Value& one_of(const std::array<Value, n>& all) {
        return all[below(n)];
    }

    // Three numbers, as an attribute.
    std::string triple(double low, double high) {
        const double x = between(low, high), y = between(low, high), z = between(low, high);
        return fmt::format("{}, {}, {}", x, y, z);
    }
    // Some grey, some with channels that are 0, for what is taken as a whole and what by channels are different code.
    std::string colour(double low, double high) {
        if (chance(0.3)) return fmt::format("{}", between(low, high));
        std::string text = triple(low, high);
        if (chance(0.1)) text = fmt::format("{}, 0, {}", between(low, high), between(low, high));
        return text;
    }

private:
    double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    std::mt19937_64 engine_;
};

}  // namespace neumann::search
