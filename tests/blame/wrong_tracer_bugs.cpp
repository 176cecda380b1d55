// The names of the mistakes, and what each spoils first.
#include "tests/blame/wrong_tracer.h"

#include <limits>

namespace neumann::blame_test {

namespace {

struct Entry {
    Bug bug;
    const char* name;
    int first_wrong_bounce;
};

// Bounce 0 is what the camera sees of lamps: only the camera, the file and emission itself can spoil it. What reflects or asks a
// lamp for light does so from bounce 1 on. The camera sees the panel's back, and a lamp in the mirror, in bounce 1 already. The
// lamp's back lights the walls above it, but the camera does not see it.
constexpr Entry entries[] = {
    {Bug::none, "none", std::numeric_limits<int>::max()},
    {Bug::missing_pi, "missing_pi", 1},
    {Bug::extra_pi, "extra_pi", 1},
    {Bug::no_cosine, "no_cosine", 1},
    {Bug::cosine_squared, "cosine_squared", 1},
    {Bug::no_light_cosine, "no_light_cosine", 1},
    {Bug::albedo_squared, "albedo_squared", 1},
    {Bug::albedo_missing, "albedo_missing", 1},
    {Bug::light_twice, "light_twice", 1},
    {Bug::no_emission, "no_emission", 0},
    {Bug::roulette_unweighted, "roulette_unweighted", 3},
    {Bug::clamped, "clamped", 2},
    {Bug::two_sided_light, "two_sided_light", 1},
    {Bug::one_sided_walls, "one_sided_walls", 1},
    {Bug::half_pixel, "half_pixel", 0},
    {Bug::flipped_x, "flipped_x", 0},
    {Bug::no_shadows, "no_shadows", 1},
    {Bug::half_area, "half_area", 1},
    {Bug::no_light_after_mirror, "no_light_after_mirror", 1},
    {Bug::no_inverse_square, "no_inverse_square", 1},
    {Bug::gamma, "gamma", 0},
};

const Entry& entry(Bug bug) { return entries[static_cast<std::size_t>(bug)]; }

}  // namespace

const std::vector<Bug>& all_bugs() {
    static const std::vector<Bug> all = [] {
        std::vector<Bug> bugs;
        for (const Entry& e : entries)
            if (e.bug != Bug::none) bugs.push_back(e.bug);
        return bugs;
    }();
    return all;
}
std::string name(Bug bug) { return entry(bug).name; }
int first_wrong_bounce(Bug bug) { return entry(bug).first_wrong_bounce; }

}  // namespace neumann::blame_test
