#include "operators/paths/corrected/caustic_aim.h"

#include "operators/paths/corrected/caustics.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

constexpr std::uint64_t pilot_stream = 0x6361757374696373ull;
// The first pilot goes on until it finds something.
constexpr std::uint32_t paths_of_pilot = 1u << 14, most_paths_of_pilot = 1u << 17;
constexpr int pilots = 8;
constexpr std::size_t cells = 16;  // of the film, across and down
// Kinds of caustics have their own densities: by the number of delta lobes, and those that one more surface has reflected.
constexpr std::size_t most_lobes = 3, kinds = most_lobes + 1;
// The most of the directions from a diffuse surface that are towards where caustics come from.
constexpr double share_of_caustics = 1.0 / 3.0;
// The directions of a walk from its first diffuse vertex, at least.
constexpr double directions = 4.0;

// What the camera sees of a path of a pilot. `densities` is the sum of the densities of all pilots at the path's numbers, over
// which each path counts as one of all pilots together (the balance heuristic).
struct SeenInPilot {
    NumberTree::Numbers at;
    double value, densities;
    // The density of paths from the lamps, without aim, over that of walks: both per étendue, which delta lobes keep.
    double lamps_over_walks;
    std::size_t bounce, cell;
    bool is_first;

    double amount() const { return value / densities; }
};

// What a path of a pilot brings to a diffuse surface.
struct Arrived {
    NumberTree::Numbers at;
    DirectionTables::Arrival what;
    double densities;
};

struct PilotPaths {
    std::vector<SeenInPilot> seen;
    std::vector<Arrived> arrived;
    std::uint64_t rays = 0;

    void append(const PilotPaths& more) {
        seen.insert(seen.end(), more.seen.begin(), more.seen.end());
        arrived.insert(arrived.end(), more.arrived.begin(), more.arrived.end());
        rays += more.rays;
    }
};

double mean_density(const std::vector<NumberTree>& trees, const NumberTree::Numbers& at) {
    double sum = 0.0;
    for (const NumberTree& tree : trees) sum += tree.density(at);
    return sum / static_cast<double>(trees.size());
}

std::size_t cell_of(const Film& film, const Vec2& position) {
    const auto part = [](double x, int begin, int size) {
        return std::min(static_cast<std::size_t>(std::max((x - begin) * cells / size, 0.0)), cells - 1);
    };
    return part(position.y, film.crop_y, film.crop_height) * cells + part(position.x, film.crop_x, film.crop_width);
}

// Traces paths_of_pilot paths; `first` is the number of the first one.
PilotPaths trace_pilot(const Scene& scene, const Caustics& caustics, const CausticAim& aim, int bounces, std::uint64_t seed,
                       std::uint32_t first) {
    const double pixels = static_cast<double>(scene.film.crop_width) * scene.film.crop_height;
    std::vector<PilotPaths> groups(paths_of_pilot / Caustics::at_once);
    oneapi::tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t g) {
        PilotPaths& group = groups[g];
        std::vector<AimedNumbers> numbers;
        for (std::uint32_t i = 0; i < Caustics::at_once; ++i) {
            Sampler sampler(seed ^ pilot_stream, first + static_cast<std::uint32_t>(g) * Caustics::at_once + i);
            sampler.start(0);
            numbers.emplace_back(sampler, aim, i % aim.densities());
        }
        std::vector<std::uint64_t> rays(static_cast<std::size_t>(bounces) + 1);
        Caustics::Work work;
        caustics.trace(
            numbers, work,
            [&](const CameraEdge& edge, bool is_first, std::size_t bounce) {
                const LightWalker& w = work.walkers.walker[edge.walker];
                const AimedNumbers& drawn = numbers[edge.walker];
                const double of_lamps = Caustics::paths_of_sample * pixels * w.emission.density,
                             of_walks = directions * edge.pixels_per_area * std::abs(glm::dot(w.x.normal, edge.w)) * inv_pi;
                group.seen.push_back({drawn.at(), max_component(edge.value) * drawn.density(), 0.0, of_lamps / of_walks, bounce,
                                      cell_of(scene.film, edge.position), is_first});
            },
            [&](std::uint32_t path, int, const LightWalker& w) {
                group.arrived.push_back({numbers[path].at(), {w.x, w.wi, max_component(w.beta) * numbers[path].density()}, 0.0});
            },
            rays);
        for (const std::uint64_t n : rays) group.rays += n;
    });
    PilotPaths all;
    for (const PilotPaths& group : groups) all.append(group);
    return all;
}

// Densities in proportion to how much a path adds to the places of the picture where it arrives, relative to what there is: bright
// places and dim ones are to have equally many paths.
std::vector<NumberTree> learn(const std::vector<SeenInPilot>& seen, std::size_t bounces) {
    constexpr double part_of_mean = 0.1;
    std::vector<NumberTree> trees(1);
    for (std::size_t kind = 0; kind < kinds; ++kind) {
        const auto is_of_kind = [&](const SeenInPilot& s) {
            return s.is_first ? std::min(s.bounce - 2, most_lobes - 1) == kind : kind == most_lobes;
        };
        std::vector<double> light((bounces + 1) * cells * cells), mean(bounces + 1);
        for (const SeenInPilot& s : seen) {
            if (!is_of_kind(s)) continue;
            light[s.bounce * cells * cells + s.cell] += s.amount();
            mean[s.bounce] += s.amount() / (cells * cells);
        }
        std::vector<NumberTree::Found> found;
        for (const SeenInPilot& s : seen) {
            if (!is_of_kind(s)) continue;
            const double there = light[s.bounce * cells * cells + s.cell] + part_of_mean * mean[s.bounce];
            found.push_back({s.at, s.value / there, s.amount() / there});
        }
        if (!found.empty()) trees.emplace_back(std::move(found));
    }
    return trees;
}

// The part of the caustics seen that paths from the lamps would make by the balance heuristic.
double part_of_lamps(const std::vector<SeenInPilot>& seen, const std::vector<NumberTree>& trees) {
    double part = 0.0, all = 0.0;
    for (const SeenInPilot& s : seen) {
        if (!s.is_first) continue;
        const double lamps = s.lamps_over_walks * mean_density(trees, s.at);
        part += s.amount() * lamps / (lamps + 1.0);
        all += s.amount();
    }
    return all > 0.0 ? part / all : 0.0;
}

}  // namespace

double CausticAim::density(const Numbers& at) const { return mean_density(trees_, at); }

CausticAim::CausticAim(const Scene& scene, int bounces, std::uint64_t seed, const DirectionTables* tables, const Watch& watch) {
    if (bounces < 2 || !has_specular(scene.materials) || scene.hide_emitters || !scene.camera.can_be_joined()) return;
    const Caustics caustics(scene, bounces, nullptr, 0.0);
    PilotPaths all;
    std::vector<std::vector<NumberTree>> earlier;
    std::uint32_t paths = 0;
    for (int pilot = 0; pilot < pilots; ++pilot) {
        const std::size_t seen = all.seen.size(), arrived = all.arrived.size();
        do {
            all.append(trace_pilot(scene, caustics, *this, bounces, seed, paths));
            paths += paths_of_pilot;
            if (watch.stop()) throw Stopped();
        } while (all.seen.empty() && paths < most_paths_of_pilot);
        rays_ = all.rays;
        if (all.seen.empty()) return;
        earlier.push_back(trees_);
        const auto add_densities = [&](auto& of, std::size_t old) {
            for (std::size_t i = 0; i < old; ++i) of[i].densities += mean_density(trees_, of[i].at);
            for (std::size_t i = old; i < of.size(); ++i)
                for (const std::vector<NumberTree>& trees : earlier) of[i].densities += mean_density(trees, of[i].at);
        };
        add_densities(all.seen, seen);
        add_densities(all.arrived, arrived);
        trees_ = learn(all.seen, static_cast<std::size_t>(bounces));
    }
    pays_ = part_of_lamps(all.seen, trees_) > 0.5;
    if (!pays_ || !tables) return;
    std::vector<DirectionTables::Arrival> arrivals;
    for (const Arrived& arrived : all.arrived) {
        arrivals.push_back(arrived.what);
        arrivals.back().power /= arrived.densities;
    }
    tables_ = tables->with(arrivals, share_of_caustics);
}

}  // namespace neumann
