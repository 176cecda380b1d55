// How long a scene of many meshes takes to read, and how much memory at the peak, in each language or in those that the arguments
// name. The goal is 1 s for Mitsuba's and 2 s for the others.
#include "core/base/stopwatch.h"
#include "core/reader/read_scene.h"
#include "tests/bench/wavy_scenes.h"

#include <cstdio>
#include <filesystem>
#include <functional>
#include <ranges>
#include <vector>

#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

rusage usage() {
    rusage result{};
    getrusage(RUSAGE_SELF, &result);
    return result;
}

double peak_bytes() { return 1024.0 * static_cast<double>(usage().ru_maxrss); }

// Of all threads, which a busy machine does not change.
double processor_seconds() {
    const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
    return seconds(usage().ru_utime) + seconds(usage().ru_stime);
}

bool measure(const std::string& name, const std::string& path) {
    const double before = peak_bytes(), processor_before = processor_seconds();
    neumann::Stopwatch all;
    neumann::SceneParts parts = neumann::read_scene_parts(path);
    const double files = all.seconds(), processor_files = processor_seconds(), peak_of_files = peak_bytes();
    const neumann::Scene scene = neumann::make_scene(std::move(parts));
    const double seconds = all.seconds(), peak = peak_bytes();
    const struct mallinfo2 heap = mallinfo2();
    fmt::print(
        "{}: {} meshes, {:.0f} triangles: {:.2f} s, of which {:.2f} s for the files; {:.2f} s of processors, {:.2f} s for the "
        "files\n",
        name, neumann::wavy::meshes, neumann::wavy::triangles, seconds, files, processor_seconds() - processor_before,
        processor_files - processor_before);
    fmt::print(
        "    memory at the peak: {:.0f} MB, {:.0f} bytes a triangle ({:.0f} MB after the files, {:.0f} MB before); in the end on "
        "the heap: {:.0f} MB\n",
        peak / 1e6, peak / neumann::wavy::triangles, peak_of_files / 1e6, before / 1e6,
        static_cast<double>(heap.uordblks + heap.hblkhd) / 1e6);
    return scene.geometry.shapes().size() == neumann::wavy::meshes;
}

// In a process of its own, whose memory is nothing else's.
bool run(const std::function<bool()>& work) {
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        const bool is_right = work();
        std::fflush(nullptr);
        _exit(is_right ? 0 : 1);
    }
    int status = 0;
    return waitpid(child, &status, 0) == child && status == 0;
}

}  // namespace

int main(int argc, char** argv) {
    const auto& writers = neumann::wavy::writers();
    std::vector<std::string> names(argv + 1, argv + argc);
    if (names.empty())
        for (const auto& [name, writer] : writers) names.push_back(name);
    for (const std::string& name : names)
        if (!writers.contains(name)) {
            const auto known = std::views::keys(writers);
            fmt::print(stderr, "unknown language '{}', expected some of: {}\n", name, fmt::join(known.begin(), known.end(), ", "));
            return 2;
        }
    const std::string folder = std::filesystem::temp_directory_path() / fmt::format("neumann_bench_reading_{}", getpid());
    bool is_right = true;
    for (const std::string& name : names) {
        std::filesystem::create_directories(folder);
        const std::string path = writers.at(name)(folder);
        is_right = run([&] { return measure(name, path); }) && is_right;
        std::filesystem::remove_all(folder);
    }
    return is_right ? 0 : 1;
}
