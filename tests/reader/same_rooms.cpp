// One room in five languages (tests/data/rooms): its terms are the same, bounce by bounce.
#include "core/reader/read_scene.h"
#include "operators/render/methods/render.h"
#include "operators/statistics/picture_statistics.h"
#include "tests/physics/seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace neumann::same_rooms_test {

constexpr int width = 32, height = 24, block = 8, bounces = 4;

Image part_of(const Image& image, int x0, int y0) {
    Image part(block, block);
    for (int y = 0; y < block; ++y)
        for (int x = 0; x < block; ++x) part.at(x, y) = image.at(x0 + x, y0 + y);
    return part;
}

Estimate part_of(const Estimate& estimate, int x0, int y0) {
    return {part_of(estimate.mean, x0, y0), part_of(estimate.standard_error, x0, y0), estimate.degrees_of_freedom};
}

BounceSeries terms_of(const std::string& file, std::uint64_t seed) {
    // glTF and COLLADA do not say how large the picture is.
    const std::map<std::string, std::string> film = {{"width", "32"}, {"filter", "box"}};
    const bool has_film = !file.ends_with(".gltf") && !file.ends_with(".dae");
    const Scene scene = read_scene(TEST_DATA "/rooms/" + file, has_film ? std::map<std::string, std::string>() : film);
    for (const auto& [text, count] : scene.warnings.counts()) ADD_FAILURE() << file << ": " << text;
    EXPECT_EQ(scene.film.width, width) << file;
    EXPECT_EQ(scene.film.height, height) << file;
    method::Walk walk;
    walk.sampler = SamplerKind::independent;
    return render(scene, walk, {.bounces = bounces, .samples = 512, .replicates = 64, .seed = seed, .only_pictures = true});
}

// Of each of four files against the Mitsuba file: the mean of the picture in bounces 0 to 4, and of 12 blocks in bounces 1 to 4,
// in 3 channels; 636 comparisons at 4.5 standard errors, in which chance alone fails one of 230 seeds. The standard error of a
// block is 0.6% in bounce 1 and at most 3% in bounce 4, that of the picture 0.3% and 0.7%.
TEST(SameRooms, InFiveLanguages) {
    const BounceSeries xml = terms_of("room.xml", physics::fixed_seed);
    std::uint64_t seed = physics::fixed_seed;
    for (const std::string file : {"room.gltf", "room.pbrt", "room.dae", "room.json"}) {
        const BounceSeries other = terms_of(file, ++seed);
        for (std::size_t i = 0; i <= bounces; ++i) {
            const auto compare = [&](const Estimate& a, const Estimate& b, double largest_error, const std::string& where) {
                const PictureMeans of_a = picture_means(a), of_b = picture_means(b);
                for (int channel = 0; channel < 3; ++channel) {
                    const MeanWithError d = difference(of_a.channel[channel], of_b.channel[channel]);
                    EXPECT_LE(std::abs(d.mean), 4.5 * d.standard_error + 1e-12)
                        << fmt::format("{}, bounce {}, channel {}, {}: {} and {}, z = {}", file, i, channel, where,
                                       of_a.channel[channel].mean, of_b.channel[channel].mean, d.mean / d.standard_error);
                    EXPECT_LE(of_a.channel[channel].standard_error, largest_error * of_a.channel[channel].mean)
                        << i << " " << where;
                }
            };
            const Estimate a = xml.term(i), b = other.term(i);
            compare(a, b, 0.02, "the picture");
            for (int y = 0; i > 0 && y < height; y += block)
                for (int x = 0; x < width; x += block)
                    compare(part_of(a, x, y), part_of(b, x, y), 0.03, fmt::format("block {}, {}", x, y));
        }
    }
}

}  // namespace neumann::same_rooms_test
