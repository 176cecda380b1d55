#include "tests/agreement/reference.h"

#include "core/reader/read_scene.h"
#include "operators/render/methods/method_options.h"
#include "tests/physics/seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

namespace neumann::agreement {

namespace {

namespace fs = std::filesystem;

struct Maker {
    const char* method;
    std::uint64_t replicates;  // of 16 samples
    bool knows_rest;
    std::uint64_t of_both_ends = 0;  // replicates for the pixels, where they are others
};
const std::map<std::string, Maker> makers = {
    {"cornell-box", {"walk", 256, true}},      {"door-ajar", {"bidirectional", 256, true}},
    {"furnace", {"walk", 64, true}},           {"mitsuba-cornell", {"walk", 256, true}},
    {"sphere-segment", {"walk", 256, true}},   {"facing-mirrors", {"walk", 128, true, 256}},
    {"floating-panels", {"walk", 128, true}},  {"glass-ball", {"bidirectional", 512, false}},
    {"glossy-floor", {"walk", 128, true}},     {"metal-room", {"bidirectional", 256, true}},
    {"outdoor", {"bidirectional", 256, true}},
};

// All numbers of a reference, in the order in which they are kept.
template <class Visit>
void visit_numbers(Reference& reference, const Visit& visit) {
    for (physics::Blocks::Value& value : reference.values) visit(value.mean), visit(value.error);
    for (Estimate& term : reference.pixels)
        for (Image* image : {&term.mean, &term.standard_error})
            for (Rgb& pixel : image->pixels)
                for (int c = 0; c < 3; ++c) visit(pixel[c]);
}

void make(Reference& reference, const Maker& maker) {
    const auto by = [&](const char* method, std::uint64_t replicates, SeriesMoments* pixels) {
        const SamplingSettings settings =
            physics::settings_of(reference.scene, make_method({method, {}}), static_cast<int>(bounces), physics::fixed_seed, 0.5);
        return physics::Blocks(reference.scene, settings, block, replicates, pixels);
    };
    SeriesMoments pixels(resolution, resolution, bounces + 2);  // with the rest
    const physics::Blocks found = by(maker.method, maker.replicates, maker.of_both_ends > 0 ? nullptr : &pixels);
    if (maker.of_both_ends > 0) by("bidirectional", maker.of_both_ends, &pixels);
    reference.values.clear();
    for (std::size_t b = 0; b <= blocks; ++b)
        for (std::size_t q = 0; q < bounces + 2; ++q)
            for (std::size_t channel = 0; channel < 3; ++channel)
                reference.values.push_back(found.at(b, q, channel, maker.replicates));
    for (std::size_t q = 0; q <= bounces; ++q) reference.pixels[q] = pixels.result().term(q);
}

auto time_of(const fs::path& file) { return fs::last_write_time(file).time_since_epoch().count(); }

// The references of this executable; others have others.
fs::path folder() {
    const fs::path executable = fs::read_symlink("/proc/self/exe");
    return fs::path(REFERENCES) / fmt::format("{:x}-{:x}", fs::file_size(executable), time_of(executable));
}
// That of a scene as its files are now, and of a seed.
fs::path file_of(const std::string& scene) {
    auto newest = time_of(fmt::format(SCENES "/{}", scene));
    for (const auto& entry : fs::recursive_directory_iterator(fmt::format(SCENES "/{}", scene)))
        newest = std::max(newest, time_of(entry.path()));
    return folder() / fmt::format("{}-{:x}-{}", scene, newest, physics::fixed_seed);
}

bool read(const fs::path& path, Reference& reference) {
    std::ifstream file(path, std::ios::binary);
    visit_numbers(reference, [&](double& x) { file.read(reinterpret_cast<char*>(&x), sizeof x); });
    return file.good() && file.peek() == std::ifstream::traits_type::eof();
}

void write(const fs::path& path, Reference& reference) {
    std::error_code ignored;  // another process may remove the same
    fs::create_directories(path.parent_path());
    for (const auto& entry : fs::directory_iterator(REFERENCES))
        if (entry.path() != path.parent_path()) fs::remove_all(entry.path(), ignored);
    const fs::path part = fmt::format("{}.{}.part", path.string(), getpid());
    std::ofstream file(part, std::ios::binary);
    visit_numbers(reference, [&](double& x) { file.write(reinterpret_cast<const char*>(&x), sizeof x); });
    file.close();
    ASSERT_TRUE(file) << part;
    fs::rename(part, path);
}

Reference read_or_make(const std::string& name) {
    const Maker& maker = makers.at(name);
    const Image empty(resolution, resolution);
    Reference reference{read_scene(fmt::format(SCENES "/{}/{}.xml", name, name), {{"res", std::to_string(resolution)}}),
                        maker.knows_rest, std::vector<physics::Blocks::Value>((blocks + 1) * (bounces + 2) * 3),
                        std::vector<Estimate>(bounces + 1, Estimate{empty, empty})};
    const fs::path path = file_of(name);
    if (!read(path, reference)) {
        make(reference, maker);
        write(path, reference);
    }
    return reference;
}

}  // namespace

const Reference& reference(const std::string& scene) {
    static std::map<std::string, Reference> made;
    const auto there = made.find(scene);
    return there != made.end() ? there->second : made.emplace(scene, read_or_make(scene)).first->second;
}

std::vector<std::string> scenes_with_reference() {
    std::vector<std::string> scenes;
    for (const auto& [scene, maker] : makers) scenes.push_back(scene);
    return scenes;
}

}  // namespace neumann::agreement
