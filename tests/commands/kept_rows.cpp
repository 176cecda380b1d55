// Rows of T that are kept in a folder: taken from there to the same bits, wherever the process that traced them died.
#include "apps/output/files/row_files.h"
#include "core/reader/read_scene.h"
#include "operators/fields/matrix/traced_system.h"
#include "tests/commands/render_output.h"

#include <numeric>
#include <random>

namespace neumann::kept_rows_test {

using std::chrono::milliseconds;

class KeptRows : public RenderTest {
protected:
    static inline const std::string box = SCENES "/cornell-box/cornell-box.xml", furnace = SCENES "/furnace/furnace.xml";
    // Four million rays, in 16 parts.
    static std::vector<std::string> large(const std::string& scene = box) {
        return {"spectrum", scene, "--patches", "1000", "--directions", "4096", "--eigenvalues", "1", "--quiet"};
    }
    static std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& options) {
        arguments.insert(arguments.end(), options.begin(), options.end());
        return arguments;
    }
    std::string printed(const std::vector<std::string>& arguments) const {
        const Finished done = run(arguments);
        EXPECT_EQ(done.exit_code, 0) << done.err;
        return done.out;
    }
    // The rays in the files of a folder, by their size; a program may be replacing them.
    std::size_t rays_kept(const std::string& folder) const {
        if (!std::filesystem::exists(path(folder))) return 0;
        std::size_t bytes = 0;
        for (const std::string& name : names(folder)) {
            std::error_code gone;
            const std::uintmax_t size = std::filesystem::file_size(path(folder) / name, gone);
            if (!gone) bytes += size;
        }
        return bytes / 4;
    }
};

TEST_F(KeptRows, AreTakenByEveryCommand) {
    const std::string alone = printed(large());
    EXPECT_EQ(printed(with(large(), {"--keep", "rows"})), alone);
    const auto kept = contents("rows");
    EXPECT_FALSE(kept.empty());
    EXPECT_EQ(printed(with(large(), {"--keep", "rows"})), alone);
    EXPECT_EQ(contents("rows"), kept);  // nothing was traced

    const std::vector<std::string> smaller{"--patches", "200", "--directions", "64", "--quiet"};
    printed(with({"solve", box, "--keep", "rows"}, smaller));
    const auto more = contents("rows");
    EXPECT_EQ(more.size(), kept.size() + 1);
    printed(with({"export", box, "-o", "a"}, smaller));
    printed(with({"export", box, "-o", "b", "--keep", "rows"}, smaller));
    EXPECT_EQ(contents("rows"), more);
    for (const char* file : {"T.mtx", "R_r.mtx", "b.mtx"}) EXPECT_EQ(text_of(path("a") / file), text_of(path("b") / file)) << file;
    // Other seeds are other rays.
    EXPECT_NE(printed(with(with({"solve", box, "--keep", "rows"}, smaller), {"--seed", "1"})), "");
    EXPECT_EQ(names("rows").size(), more.size() + 1);
}

TEST_F(KeptRows, LoseNothingButTheLastSeconds) {
    // Sixteen million rays, so that many deaths fall into the time in which they are traced.
    std::vector<std::string> larger = large();
    *std::ranges::find(larger, "4096") = "16384";
    const std::string alone = printed(larger);
    const std::vector<std::string> keeping = with(larger, {"--keep", "rows", "--checkpoint", "0.01", "-t", "1"});
    std::mt19937 random(1);
    std::uniform_int_distribution<int> wait(0, 200);
    std::size_t went_on = 0, before = 0;
    for (int death = 0; death < 12; ++death) {
        RunningCommand command = start(keeping);
        // Every other death falls behind rows of its own, however slow the machine is.
        for (int i = 0; death % 2 == 0 && i < 1000 && rays_kept("rows") <= before; ++i)
            std::this_thread::sleep_for(milliseconds(10));
        std::this_thread::sleep_for(milliseconds(wait(random)));
        command.signal(SIGKILL);
        if (command.wait().exit_code == 0) break;
        if (!std::filesystem::exists(path("rows"))) continue;
        const std::size_t now = rays_kept("rows");
        went_on += before > 0 && now > before;
        before = now;
    }
    EXPECT_GT(went_on, 2u);
    EXPECT_EQ(printed(keeping), alone);
    // Each ray was kept once. Headers are small.
    EXPECT_EQ(printed(with(larger, {"--keep", "whole", "--checkpoint", "1000"})), alone);
    EXPECT_NEAR(static_cast<double>(rays_kept("rows")), static_cast<double>(rays_kept("whole")), 0.01 * rays_kept("whole"));
}

TEST_F(KeptRows, AreWrittenWhenAskedToEnd) {
    for (const int signal : {SIGTERM, SIGINT}) {
        RunningCommand command = start({"solve", box, "--patches", "4000", "--directions", "65536", "--keep", "rows", "-t", "1"});
        for (int i = 0; i < 1000 && !std::filesystem::exists(path("rows")); ++i) std::this_thread::sleep_for(milliseconds(10));
        std::this_thread::sleep_for(milliseconds(500));
        command.signal(signal);
        const Finished done = command.wait();
        EXPECT_EQ(done.exit_code, 1);
        EXPECT_EQ(done.err,
                  "neumann: interrupted; the rays that were traced are in rows, and the same command goes on from there\n");
    }
    EXPECT_EQ(names("rows"), (Names{"rows_000_00000.kept", "rows_000_00001.kept"}));
}

TEST_F(KeptRows, OnAFullDisk) {
    printed({"solve", box, "--patches", "200", "--keep", "rows", "--quiet"});
    const auto before = contents("rows");
    const Finished done = run(with(large(), {"--keep", "rows", "--checkpoint", "0.001", "-t", "1"}), 900'000);
    EXPECT_EQ(done.exit_code, 1);
    EXPECT_EQ(
        done.err,
        "neumann: rows/rows_000_00001.kept: cannot be written: File too large\nWhat was kept before is whole: the same command "
        "goes on from there\n");
    EXPECT_EQ(contents("rows"), before);
}

TEST_F(KeptRows, WhatIsDamagedOrOfAnotherSceneIsRefused) {
    const std::vector<std::string> small{"solve", furnace, "--patches", "100", "--keep", "rows", "--quiet"};
    printed(small);
    const std::string whole = text_of(path("rows/rows_000_00000.kept"));
    const auto refusal = [&](const std::string& text) {
        write("rows/rows_000_00000.kept", text);
        const auto before = contents("rows");
        const std::string message = refused(small);
        EXPECT_EQ(contents("rows"), before);
        return message;
    };
    EXPECT_EQ(refusal(whole.substr(0, whole.size() / 2)),
              "rows/rows_000_00000.kept: damaged: it ends too early; without that file its rays are traced again\n");
    std::mt19937 random(2);
    for (int i = 0; i < 20; ++i) {
        std::string other = whole;
        const std::size_t at = std::uniform_int_distribution<std::size_t>(0, whole.size() - 1)(random);
        other[at] = static_cast<char>(other[at] ^ (1 << (i % 8)));
        EXPECT_NE(refusal(other).find("rows/rows_000_00000.kept: damaged: "), std::string::npos) << at;
    }
    write("rows/rows_000_00000.kept", whole);
    const auto before = contents("rows");
    EXPECT_EQ(
        refused(with(small, {"-D", "albedo=0.25"})),
        "--keep rows: holds rays of another scene: its definitions is {} there, and {\"albedo\":\"0.25\"} here; expected another "
        "folder\n");
    EXPECT_TRUE(refused({"solve", box, "--keep", "rows"}).starts_with("--keep rows: holds rays of another scene: its hash is "));
    EXPECT_EQ(contents("rows"), before);
    render(furnace, "a", {"-n", "1", "--spp", "1", "--quiet"});
    EXPECT_NE(refused({"solve", furnace, "--keep", "a"}).find("of render, which would be lost; expected another folder"),
              std::string::npos);
    EXPECT_NE(refused({"render", furnace, "-o", "rows"}).find("of --keep, which would be lost"), std::string::npos);
    EXPECT_EQ(refused({"solve", furnace, "--keep", ""}), "the output folder has no name\n");
    // Rows of a program that traces other rays.
    std::filesystem::remove_all(path("rows"));
    {
        const Scene scene = read_scene(furnace);
        RowFiles files(path("rows"), {{"hash", scene.hash}, {"definitions", nlohmann::ordered_json::object()}, {"lenient", false}},
                       0, 60.0);
        const TracedSettings settings{.patches = 100};
        const PatchSpace space = traced_space(scene, settings);
        const RayTable table(space, settings.rays, 1);  // by another seed
        std::vector<std::uint32_t> facets(space.facets().size());
        std::iota(facets.begin(), facets.end(), 0u);
        files.rows_of(settings)->keep(facets, {table.seen()});
    }
    EXPECT_EQ(refused(small), "the rays that are kept are not those that this program traces here; expected another folder\n");
    EXPECT_NE(refused({"solve", furnace, "--checkpoint", "3"}).find("--checkpoint requires --keep"), std::string::npos);
}

TEST_F(KeptRows, TwoAtOnceAreRefused) {
    RunningCommand command = start({"solve", box, "--patches", "4000", "--directions", "65536", "--keep", "rows", "-t", "1"});
    for (int i = 0; i < 1000 && !std::filesystem::exists(path("rows")); ++i) std::this_thread::sleep_for(milliseconds(10));
    std::this_thread::sleep_for(milliseconds(200));
    EXPECT_EQ(refused({"solve", box, "--keep", "rows"}), "rows: another run is writing there\n");
    command.signal(SIGKILL);
    command.wait();
    EXPECT_EQ(run({"solve", box, "--patches", "100", "--keep", "rows", "--quiet"}).exit_code, 0);
}

}  // namespace neumann::kept_rows_test
