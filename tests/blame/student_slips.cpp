// The names of the slips, and what each spoils first: bounce 1 is the lamp's light on what is seen, and next directions bring
// bounce 2, before which Russian roulette begins.
#include "tests/blame/student_tracer.h"

#include <limits>

namespace neumann::blame_test {

namespace {

struct Entry {
    Slip slip;
    const char* name;
    int first_wrong_bounce;
};
constexpr Entry entries[] = {
    {Slip::none, "none", std::numeric_limits<int>::max()},
    {Slip::next_no_cosine, "next_no_cosine", 2},
    {Slip::next_cosine_squared, "next_cosine_squared", 2},
    {Slip::cosine_as_uniform, "cosine_as_uniform", 2},
    {Slip::uniform_as_cosine, "uniform_as_cosine", 2},
    {Slip::even_theta, "even_theta", 2},
    {Slip::half_hemisphere, "half_hemisphere", 2},
    {Slip::whole_sphere, "whole_sphere", 2},
    {Slip::no_pi_next, "no_pi_next", 2},
    {Slip::albedo_squared_next, "albedo_squared_next", 2},
    {Slip::white_next, "white_next", 2},
    {Slip::roulette_constant, "roulette_constant", 2},
    {Slip::roulette_albedo, "roulette_albedo", 2},
    {Slip::roulette_one_minus, "roulette_one_minus", 2},
    {Slip::roulette_squared, "roulette_squared", 2},
    {Slip::emission_at_bounce_1, "emission_at_bounce_1", 1},
    {Slip::no_samples_at_the_end, "no_samples_at_the_end", 1},
    {Slip::inverse_distance, "inverse_distance", 1},
    {Slip::no_area, "no_area", 1},
    {Slip::over_area, "over_area", 1},
    {Slip::swapped_wall, "swapped_wall", 1},
    {Slip::half_angle, "half_angle", 0},
};
const Entry& entry(Slip slip) { return entries[static_cast<std::size_t>(slip)]; }

}  // namespace

const std::vector<Slip>& all_slips() {
    static const std::vector<Slip> all = [] {
        std::vector<Slip> slips;
        for (const Entry& e : entries)
            if (e.slip != Slip::none) slips.push_back(e.slip);
        return slips;
    }();
    return all;
}
std::string name(Slip slip) { return entry(slip).name; }
int first_wrong_bounce(Slip slip) { return entry(slip).first_wrong_bounce; }

}  // namespace neumann::blame_test
