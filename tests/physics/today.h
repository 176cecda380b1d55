// Tests that take long go through a part of their cases each day, and in three days through all. Those labelled nightly have
// NEUMANN_TEST_DAY=all, which goes through all at once; a number there is another day.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <string>

namespace neumann::physics {

inline constexpr std::size_t parts_of_long_tests = 3;

inline std::string day_of_tests() {
    if (const char* const given = std::getenv("NEUMANN_TEST_DAY"); given && *given) return given;
    using Days = std::chrono::duration<long, std::ratio<86400>>;
    return std::to_string(std::chrono::duration_cast<Days>(std::chrono::system_clock::now().time_since_epoch()).count());
}

inline bool all_are_of_today() { return day_of_tests() == "all"; }
inline bool is_of_today(std::size_t number) {
    return all_are_of_today() || number % parts_of_long_tests == std::stoul(day_of_tests()) % parts_of_long_tests;
}

}  // namespace neumann::physics
