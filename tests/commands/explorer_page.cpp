// index.html of a render and of two: what is packed into it, how large it is, and what is refused. That a browser shows it is
// tested in tests/browser.
#include "apps/output/pages/explorer_page.h"
#include "tests/commands/render_output.h"

#include <zlib.h>
#include <random>

namespace neumann::explorer_page_test {

// The bytes of a packed picture, by zlib and a table of digits; green and blue without what they are less than red.
std::vector<std::uint8_t> unpacked(const PackedPicture& picture, std::size_t pixels) {
    std::string digits, compressed;
    for (char c = '!'; c <= '~'; ++c)
        if (c != '<' && c != '&' && c != '\\') digits += c;
    EXPECT_EQ(digits.size(), 91u);
    std::uint32_t bits = 0;
    int count = 0;
    for (std::size_t k = 0; k < picture.bytes.size(); k += 2) {
        const bool alone = k + 1 == picture.bytes.size();
        const std::size_t value = digits.find(picture.bytes[k]) + (alone ? 0 : 91 * digits.find(picture.bytes[k + 1]));
        bits |= static_cast<std::uint32_t>(value) << count;
        for (count += alone ? 6 : 13; count >= 8; count -= 8, bits >>= 8) compressed += static_cast<char>(bits & 255u);
    }
    const std::size_t n = pixels;
    std::size_t size = 6 * n;
    for (const auto& errors : picture.head.at("errors")) size += errors.at("codes").get<std::size_t>();
    std::vector<std::uint8_t> bytes(size + 1);  // one more would be seen
    uLongf length = bytes.size();
    EXPECT_EQ(uncompress(bytes.data(), &length, reinterpret_cast<const Bytef*>(compressed.data()), compressed.size()), Z_OK);
    EXPECT_EQ(length, size);
    for (std::size_t i = 0; i < n; ++i) {
        const auto half = [&](std::size_t at) { return bytes[at] << 8 | bytes[at + 3 * n]; };
        for (const std::size_t c : {1, 2}) {
            const int sum = half(c * n + i) + half(i);
            bytes[c * n + i] = static_cast<std::uint8_t>(sum >> 8);
            bytes[(c + 3) * n + i] = static_cast<std::uint8_t>(sum);
        }
        std::size_t at = 6 * n;
        for (const auto& errors : picture.head.at("errors")) {
            const auto channels = errors.at("channels").get<std::size_t>();
            for (std::size_t c = 1; c < channels; ++c)
                bytes[at + c * n + i] = static_cast<std::uint8_t>(bytes[at + c * n + i] + bytes[at + i]);
            at += errors.at("codes").get<std::size_t>();
        }
    }
    return bytes;
}

double half_value(std::uint32_t bits) {
    const int exponent = (bits >> 10) & 31, fraction = bits & 1023;
    const double size = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
    return bits & 0x8000 ? -size : size;
}

double error_value(const nlohmann::ordered_json& scale, int code) {
    if (code == 0) return 0.0;
    if (code == 255) return std::numeric_limits<double>::infinity();
    return std::exp2(scale.at("low").get<double>() + (code - 1) * scale.at("step").get<double>());
}

// Values over nine decades at 1e-30 of the usual, as deep bounces have: relative to the brightest they keep 11 bits down to 2⁻²⁹ of
// it, or what a 16th of their error is where that is more, and errors 6%, or what 252 steps over their range leave.
TEST(ExplorerPage, PackedPicturesKeepThreeDigits) {
    constexpr int width = 7, height = 5;
    PixelEstimate term = Estimate{Image(width, height), Image(width, height), 15.0}, sum = term, next_sum = term;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> decades(-9.0, 0.0), narrow(0.0, 1.0);
    for (std::size_t i = 0; i < term.mean.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            term.mean.pixels[i][c] = 1e-30 * std::pow(10.0, decades(random)) * (i % 5 == 4 ? -1.0 : 1.0);
            term.standard_error.pixels[i][c] = 1e-31 * std::pow(10.0, decades(random));
            sum.standard_error.pixels[i][c] = 1e-31 * std::pow(10.0, narrow(random));
            next_sum.standard_error.pixels[i][c] = 1e-31 * std::pow(10.0, narrow(random));
        }
    term.mean.pixels[3] = Rgb(0.0);
    term.standard_error.pixels[3] = Rgb(0.0, std::numeric_limits<double>::infinity(), 1e-31);

    PackedSeries packed(width, height, 2);
    packed.add_term(0, term);
    packed.add_sum(0, sum);
    packed.add_term(1, term);
    packed.add_sum(1, next_sum);
    packed.pack();
    EXPECT_EQ(packed.factor(), 1);
    EXPECT_EQ(packed.head().at("width"), width);
    EXPECT_NEAR(packed.head().at("interval_factor").get<double>(), 2.1314, 1e-4);  // Student's t, 15 degrees of freedom, 0.975
    const PackedPicture& picture = packed.pictures().at(0);
    ASSERT_EQ(picture.head.at("errors").size(), 2u);
    const PackedPicture& next = packed.pictures().at(1);
    ASSERT_EQ(next.head.at("errors").size(), 2u);
    const auto &term_scale = picture.head["errors"][0], &sum_scale = picture.head["errors"][1],
               &next_scale = next.head["errors"][1];
    EXPECT_EQ(term_scale.at("kind"), "term");
    EXPECT_EQ(sum_scale.at("kind"), "sum");
    EXPECT_DOUBLE_EQ(sum_scale.at("step").get<double>(), 1.0 / 6.0);
    EXPECT_DOUBLE_EQ(term_scale.at("step").get<double>(), 1.0 / 6.0);

    constexpr std::size_t n = width * height;
    const auto bytes = unpacked(picture, n), next_bytes = unpacked(next, n);
    const int exponent = picture.head.at("exponent");
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t at = c * n + i;
            const double mean = std::ldexp(half_value(bytes[at] << 8 | bytes[at + 3 * n]), exponent);
            const double exact = term.mean.pixels[i][static_cast<int>(c)];
            const double error = term.standard_error.pixels[i][static_cast<int>(c)];
            EXPECT_NEAR(
                mean, exact,
                std::max(0x1p-11 * std::abs(exact), std::ldexp(1.0, exponent - 25)) + (std::isfinite(error) ? error / 16.0 : 0.0))
                << i;
            // However large its error is, it keeps its first bit: what is not 0 is not shown as 0.
            if (std::abs(exact) > std::ldexp(1.0, exponent - 24)) {
                EXPECT_LE(std::abs(std::log2(mean / exact)), 1.0);
            }
            const auto expect_error = [&](const auto& scale, int code, double error) {
                const double decoded = error_value(scale, code);
                if (error == 0.0 || std::isinf(error)) {
                    EXPECT_EQ(decoded, error);
                } else {
                    EXPECT_LE(std::abs(std::log2(decoded / error)), 0.5001 * scale.at("step").template get<double>());
                }
            };
            expect_error(term_scale, bytes[at + 6 * n], term.standard_error.pixels[i][static_cast<int>(c)]);
            expect_error(sum_scale, bytes[at + 9 * n], sum.standard_error.pixels[i][static_cast<int>(c)]);
            // Less the codes of the sum before.
            expect_error(next_scale, static_cast<std::uint8_t>(next_bytes[at + 9 * n] + bytes[at + 9 * n]),
                         next_sum.standard_error.pixels[i][static_cast<int>(c)]);
        }
}

// What patches get wrong is a number for 4 × 4 pixels, that of the worst channel and pixel, to 6%; also at an edge that cuts a
// block.
TEST(ExplorerPage, DiscretisationIsThatOfTheWorstOfABlock) {
    constexpr std::size_t pixels = 5 * 5, first = 6 * pixels;
    PixelEstimate term = Estimate{Image(5, 5), {}};
    term.discretisation = Image(5, 5);
    term.discretisation.at(3, 0) = Rgb(0.25, 3.0, 0.5);
    term.discretisation.at(0, 3) = Rgb(1.0);
    term.discretisation.at(4, 4) = Rgb(0.0, 0.0, 0.125);
    PackedSeries packed(5, 5, 1);
    packed.add_term(0, term);
    packed.pack();
    const PackedPicture& picture = packed.pictures().at(0);
    ASSERT_EQ(picture.head.at("errors").size(), 1u);
    const auto& scale = picture.head["errors"][0];
    EXPECT_EQ(scale.at("kind"), "term_discretisation");
    EXPECT_EQ(scale.at("channels"), 1);
    EXPECT_EQ(scale.at("block"), 4);
    ASSERT_EQ(scale.at("codes"), 4);
    const auto bytes = unpacked(picture, pixels);
    EXPECT_NEAR(error_value(scale, bytes[first]), 3.0, 0.06 * 3.0);
    EXPECT_EQ(bytes[first + 1], 0);
    EXPECT_EQ(bytes[first + 2], 0);
    EXPECT_NEAR(error_value(scale, bytes[first + 3]), 0.125, 0.06 * 0.125);
}

// Where patches get more wrong than noise, means are as coarse as that, and no coarser.
TEST(ExplorerPage, MeansAreRoundedByAllOfTheirError) {
    constexpr double mean = 1.0 + 0x1p-9, noise = 0x1p-10, wrong = 0x1p-4;
    PixelEstimate term = Estimate{Image(2, 1), Image(2, 1), 15.0};
    term.mean.pixels = {Rgb(mean), Rgb(mean)};
    term.standard_error.pixels = {Rgb(noise), Rgb(noise)};
    term.discretisation = Image(2, 1);
    term.discretisation.pixels = {Rgb(wrong), Rgb(0.0)};
    PackedSeries packed(2, 1, 1);
    packed.add_term(0, term);
    packed.pack();
    const PackedPicture& picture = packed.pictures().at(0);
    const auto bytes = unpacked(picture, 2);
    const auto decoded = [&](std::size_t i) {
        return std::ldexp(half_value(bytes[i] << 8 | bytes[i + 6]), picture.head.at("exponent"));
    };
    EXPECT_EQ(decoded(0), 1.0);  // a multiple of 2⁻⁷
    EXPECT_EQ(decoded(1), mean);
}

nlohmann::ordered_json small_run(std::size_t bounces) {
    nlohmann::ordered_json run;
    run["bounces"] = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < bounces; ++i) run["bounces"].push_back({{"mean", std::pow(0.5, i)}, {"stderr", 0.001}});
    return run;
}

// Noise that is worse than a render's: four samples a pixel, and channels that know nothing of each other.
TEST(ExplorerPage, SeventeenNoisyBouncesStayBelow11Megabytes) {
    constexpr int side = 256;
    PackedSeries packed(side, side, 18);
    std::mt19937 random(1);
    std::exponential_distribution<double> sample;
    const auto noisy = [&] {
        Estimate picture{Image(side, side), Image(side, side), 3.0};
        for (std::size_t i = 0; i < picture.mean.pixels.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                double sum = 0.0, squares = 0.0;
                for (int k = 0; k < 4; ++k) {
                    const double x = sample(random);
                    sum += x;
                    squares += x * x;
                }
                picture.mean.pixels[i][c] = sum / 4;
                picture.standard_error.pixels[i][c] = std::sqrt((squares - sum * sum / 4) / 12);
            }
        return picture;
    };
    for (std::size_t i = 0; i <= 17; ++i) {
        packed.add_term(i, noisy());
        if (i < 17) packed.add_sum(i, noisy());
    }
    packed.pack();
    EXPECT_EQ(packed.factor(), 1);
    const ExploredRun run{small_run(17), "", 1.0, std::move(packed), true};
    const std::string page = explorer_page({&run});
    EXPECT_LT(page.size(), 11e6);
    EXPECT_GT(page.size(), 7e6);  // all of it is there
}

TEST(ExplorerPage, LargeFilmsAreReducedByAWholeFactor) {
    PackedSeries packed(4096, 2304, 9);
    EXPECT_EQ(packed.factor(), 4);
    EXPECT_EQ(packed.width(), 1024);
    EXPECT_EQ(packed.height(), 576);
    EXPECT_EQ(
        packed.reduction(),
        "index.html shows the pictures at 1/4 of their size, 1024×576 in place of 4096×2304: whole ones would make it too large to "
        "open (above about 75 MB)");
    EXPECT_EQ(PackedSeries(1024, 1024, 8).factor(), 1);
    EXPECT_EQ(PackedSeries(1025, 1024, 8).factor(), 2);
    EXPECT_EQ(PackedSeries(2, 1, 1, 100'000'000).factor(), 2);  // one pixel is the least

    PackedSeries two(2048, 1024, 9);
    ASSERT_EQ(two.factor(), 2);
    Estimate picture{Image(2048, 1024), Image(2048, 1024), 1.0};
    picture.mean.at(0, 0) = Rgb(4.0, 0.0, 0.0);
    picture.mean.at(1, 1) = Rgb(2.0, 0.0, 0.0);
    two.add_term(0, picture);
    two.pack();
    const std::size_t n = 1024 * 512;
    const auto bytes = unpacked(two.pictures()[0], n);
    EXPECT_EQ(std::ldexp(half_value(bytes[0] << 8 | bytes[3 * n]), two.pictures()[0].head.at("exponent")), 1.5);
}

// Text from a scene cannot end the script that holds it.
TEST(ExplorerPage, TextCannotEndItsScript) {
    nlohmann::ordered_json json = small_run(1);
    json["command"] = "</script><script>alert(1)</script><!--";
    PackedSeries packed(1, 1, 1);
    packed.add_term(0, Estimate{Image(1, 1), Image(1, 1)});
    packed.pack();
    const ExploredRun run{json, "", 1.0, std::move(packed), false};
    const std::string page = explorer_page({&run});
    EXPECT_EQ(page.find("alert(1)</"), std::string::npos);
    const std::string begin = "id=\"data\">";
    const std::size_t at = page.find(begin) + begin.size();
    const auto read = nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
    EXPECT_EQ(read.at("runs").at(0).at("run").at("command"), json["command"]);
}

class ExplorerCompare : public RenderTest {
protected:
    void SetUp() override {
        write("scene.xml", plates());
        render("scene.xml", "a", {"-n", "1", "--spp", "4", "--quiet"});
        render("scene.xml", "b", {"-n", "2", "--spp", "4", "--seed", "1", "--quiet"});
    }
};

// As the manual says of a render of 256² pixels, and bounces 0 to 16.
TEST_F(ExplorerCompare, ARendersPageHasLessThanEightMegabytes) {
    for (const char* method : {"walk", "matrix", "photon"}) {
        const Finished done = run({"render", scene_file("cornell-box"), "-D", "res=256", "-n", "16", "--spp", "16", "--method",
                                   method, "--files", "page", "-o", method, "--quiet"});
        ASSERT_EQ(done.exit_code, 0) << done.err;
        EXPECT_LT(std::filesystem::file_size(path(method) / "index.html"), 8'000'000u) << method;
    }
}

TEST_F(ExplorerCompare, APageOfTwoRuns) {
    const Finished done = run({"compare", "a", "b", "-o", "both", "--json"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_EQ(names("both"), (Names{"index.html", "compare.json"}));
    EXPECT_EQ(text_of(path("both/compare.json")), done.out);
    EXPECT_TRUE(run({"compare", "a", "b", "-o", "both"}).out.ends_with("\nBoth are on the page both/index.html\n"));
}

TEST_F(ExplorerCompare, MoreThanTwoRuns) {
    const Finished two = run({"compare", "a", "b", "--json"}), three = run({"compare", "a", "b", "a", "-o", "three", "--json"});
    ASSERT_EQ(three.exit_code, 0) << three.err;
    EXPECT_EQ(three.out, two.out);  // the figures are those of A and B
    const std::string page = text_of(path("three/index.html"));
    for (const char* picture : {"picture-0-0", "picture-1-2", "picture-2-0"})
        EXPECT_NE(page.find(picture), std::string::npos) << picture;
    EXPECT_TRUE(run({"compare", "a", "b", "a", "-o", "three"}).out.ends_with("\nAll are on the page three/index.html\n"));
}

TEST_F(ExplorerCompare, RefusalsLoseNothing) {
    const auto before = contents(".");
    EXPECT_EQ(refused({"compare", "a", "b", "a"}), "a: figures are of two, A and B; more folders are for the page of -o\n");
    EXPECT_EQ(refused({"compare", "a", "b", "-o", "a"}).substr(0, 7), "a holds");
    EXPECT_EQ(refused({"compare", "a/sum_000.exr", "b/sum_000.exr", "-o", "c"}),
              "-o: a/sum_000.exr is a picture; a page is made of two folders of render\n");
    EXPECT_EQ(contents("."), before);

    std::filesystem::remove(path("b/run.json"));
    EXPECT_EQ(refused({"compare", "a", "b", "-o", "c"}), "b/run.json: cannot be read; expected a folder that render wrote\n");
    write("b/run.json", "{}");
    EXPECT_TRUE(refused({"compare", "a", "b", "-o", "c"}).starts_with("b/run.json: not a run.json of this version: "));
    render("scene.xml", "wide", {"-n", "1", "--spp", "4", "-D", "height=6", "--quiet"});
    EXPECT_NE(refused({"compare", "a", "wide", "-o", "c"}), "");
    EXPECT_EQ(refused({"compare", "a", "a", "wide", "-o", "c"}).substr(0, 12), "a and wide: ");
    EXPECT_FALSE(std::filesystem::exists(path("c")));
}

}  // namespace neumann::explorer_page_test
