// Renders that are put together: parts of one, and others of other seeds.
#include "tests/commands/render_output.h"

namespace neumann::merge_command_test {

class MergeCommand : public RenderTest {
protected:
    MergeCommand() { write("scene.xml", plates()); }

    void part(const std::string& output, std::vector<std::string> options) const {
        options.insert(options.end(), {"-n", "2", "--quiet"});
        EXPECT_EQ(render("scene.xml", output, options).err, "");
    }
    void merge(std::vector<std::string> folders, const std::string& output) const {
        folders.insert(folders.begin(), "merge");
        folders.insert(folders.end(), {"-o", output, "--quiet"});
        const Finished done = run(folders);
        EXPECT_EQ(done.exit_code, 0) << done.err;
    }
};

TEST_F(MergeCommand, PartsAreTheWhole) {
    for (const std::string method : {"walk", "bidirectional", "corrected", "photon", "cache", "metropolis", "mixed"}) {
        SCOPED_TRACE(method);
        part("whole", {"--spp", "512", "--method", method});
        for (const std::string k : {"1", "2", "3"}) part(k, {"--spp", "512", "--method", method, "--part", k + "/3"});
        merge({"3", "1", "2"}, "all");
        std::filesystem::remove(path("all/render.samples"));
        expect_same_pictures("whole", "all");
        for (const char* what : {"bounces", "rest", "sum", "health", "samples", "options"})
            EXPECT_EQ(run_json("all").at(what), run_json("whole").at(what)) << what;
        EXPECT_EQ(Table(path("all/convergence.csv")).last("relative_stderr_sum"),
                  Table(path("whole/convergence.csv")).last("relative_stderr_sum"));
    }
    EXPECT_EQ(run_json("2").at("samples").at("first_replicate"), 5);
    EXPECT_EQ(run_json("2").at("samples").at("replicates"), 5);
}

// Two of three parts are a render, too; that one is missing is told, and so is what a part is not asked for.
TEST_F(MergeCommand, APartIsMissing) {
    for (const std::string k : {"1", "2", "3"}) part(k, {"--spp", "512", "--method", "walk", "--part", k + "/3"});
    merge({"1", "3"}, "two");
    EXPECT_EQ(run_json("two").at("samples").at("per_pixel"), 352);  // 5 and 6 of 16 replicates of 32
    EXPECT_TRUE(warnings("two").contains("160 samples a pixel of the whole are missing: a part is not here, or was cut short"));
    merge({"1", "2", "3"}, "all");
    EXPECT_TRUE(warnings("all").empty());
    EXPECT_EQ(refused({"render", "--resume", "2", "--spp", "1024"}),
              "--resume: --part 2/3 is of the samples that it began with; for more, render them as parts of another seed and merge "
              "these, too\n");
    EXPECT_EQ(refused({"replay", "2", "--pixel", "3,3", "--sample", "7"}),
              "--sample 7: expected 160 to 319, as many as the render has a pixel\n");
    const Finished of_part = run({"replay", "2", "--pixel", "3,3", "--sample", "170", "--json"}),
                   of_all = run({"replay", "all", "--pixel", "3,3", "--sample", "170", "--json"});
    EXPECT_EQ(of_part.exit_code, 0) << of_part.err;
    EXPECT_EQ(of_part.out, of_all.out);
}

// The replicates of all count the same: means and variances are those of the set of all (Chan, Golub and LeVeque 1983).
TEST_F(MergeCommand, SeedsAreOneSetOfReplicates) {
    part("a", {"--spp", "128", "--method", "walk", "--checkpoint", "0.0001"});
    part("b", {"--spp", "384", "--method", "walk", "--checkpoint", "0.0001", "--seed", "7"});
    merge({"b", "a"}, "c");
    const double m = 4.0, n = 12.0;
    for (const char* name : {"bounce_001.exr", "bounce_002.exr", "sum_002.exr", "rest.exr"}) {
        const Estimate a = picture("a", name), b = picture("b", name), c = picture("c", name);
        for (std::size_t p = 0; p < c.mean.pixels.size(); ++p) {
            const double x = a.mean.pixels[p].g, y = b.mean.pixels[p].g;
            const double mean = (m * x + n * y) / (m + n);
            EXPECT_NEAR(c.mean.pixels[p].g, mean, 1e-6 * mean) << name;
        }
    }
    EXPECT_EQ(run_json("c").at("samples").at("per_pixel"), 512);
    EXPECT_EQ(run_json("c").at("samples").at("degrees_of_freedom"), m + n - 1.0);
    EXPECT_EQ(run_json("c").at("samples").at("merged"),
              nlohmann::json::parse(R"([{"seed": 0, "first_replicate": 0, "replicates": 4},
                                        {"seed": 7, "first_replicate": 0, "replicates": 12}])"));
    const auto squares = [&](const std::string& folder, double count) {
        const double error = run_json(folder).at("bounces").at(2).at("stderr");
        return error * error * count * (count - 1.0);
    };
    // Means over the picture of a walk are of independent pixels: their squared errors add up like those of one.
    EXPECT_GT(squares("c", m + n), squares("a", m));
    // A sample that the health names is found again in the render that it is from.
    EXPECT_GT(expect_replayed("c"), 2);
    // Merged again.
    part("d", {"--spp", "128", "--method", "walk", "--checkpoint", "0.0001", "--seed", "8"});
    merge({"c", "d"}, "e");
    EXPECT_EQ(run_json("e").at("samples").at("per_pixel"), 640);
    EXPECT_EQ(refused({"merge", "e", "a", "-o", "f"}),
              "e and a have the same samples, of seed 0; merged, these would count twice\n");
    EXPECT_EQ(refused({"render", "--resume", "e", "--spp", "1280"}),
              "--resume e: was merged of several seeds; render another seed and merge that, too\n");
}

// Where pixels have different numbers of samples: of `corrected`, each seed has others.
TEST_F(MergeCommand, SeedsWithOtherNumbersOfSamplesInEachPixel) {
    for (const char* seed : {"0", "7"})
        part(seed, {"--spp", "128", "--method", "corrected", "--adaptive", "sum", "--checkpoint", "0.0001", "--seed", seed});
    merge({"0", "7"}, "c");
    const Estimate a = picture("0", "sum_002.exr"), b = picture("7", "sum_002.exr"), c = picture("c", "sum_002.exr");
    for (std::size_t p = 0; p < c.mean.pixels.size(); ++p)
        EXPECT_NEAR(c.mean.pixels[p].g, 0.5 * (a.mean.pixels[p].g + b.mean.pixels[p].g), 1e-6 * c.mean.pixels[p].g);
    const nlohmann::json sizes = run_json("c").at("samples").at("of_a_pixel_in_a_replicate");
    EXPECT_LT(sizes.at("fewest"), sizes.at("most"));
    EXPECT_GT(expect_replayed("c"), 2);
    // Once more, with a third seed.
    part("8", {"--spp", "128", "--method", "corrected", "--adaptive", "sum", "--checkpoint", "0.0001", "--seed", "8"});
    merge({"c", "8"}, "d");
    EXPECT_EQ(run_json("d").at("samples").at("per_pixel"), 384);
    EXPECT_GT(expect_replayed("d"), 2);
}

TEST_F(MergeCommand, WhatDoesNotGoTogether) {
    part("a", {"--spp", "128", "--part", "1/2"});
    part("light", {"--spp", "128", "--method", "light", "--checkpoint", "0.0001", "--seed", "1"});
    part("few", {"--spp", "16", "--checkpoint", "0.0001", "--seed", "1"});
    part("low", {"--spp", "128", "--part", "1/2", "--seed", "1", "-D", "height=4"});
    part("none", {"--spp", "16"});
    const auto before = contents("a");
    EXPECT_EQ(refused({"merge", "a", "a", "-o", "b"}),
              "a and a have the same samples, of seed 0; merged, these would count twice\n");
    EXPECT_EQ(refused({"merge", "a", "light", "-o", "b"}),
              "a and light cannot be merged: one is by walk, and the other by light\n");
    EXPECT_EQ(
        refused({"merge", "a", "few", "-o", "b"}),
        "a and few cannot be merged: one has replicates of 32 samples a pixel, and the other of 4, because of its fewer or more "
        "samples\n");
    EXPECT_EQ(refused({"merge", "a", "low", "-o", "b"}), "a and low cannot be merged: one has 164×5 pixels, and the other 164×4\n");
    EXPECT_EQ(
        refused({"merge", "a", "none", "-o", "b"}),
        "none: holds no render.samples; renders that are to be merged keep it with --part, or with a --checkpoint shorter than "
        "they take\n");
    EXPECT_EQ(refused({"merge", "a", "light", "-o", "a"}), "-o a: is one of those that are merged; expected another folder\n");
    EXPECT_EQ(refused({"merge", "a", "nothing", "-o", "b"}), "nothing: is not a folder; expected that of a finished render\n");
    EXPECT_FALSE(std::filesystem::exists(path("b")));
    EXPECT_EQ(contents("a"), before);
    expect_refused({"--part", "1/2"}, "--part needs --spp, the samples of all parts");
    expect_refused({"--part", "1/2", "--spp", "64", "--method", "matrix"},
                   "--part: matrix has no samples that could be put together");
    expect_refused({"--part", "3/8", "--spp", "64"},
                   "--part 3/8: 64 samples a pixel are 4 replicates of 16, which is fewer than one for each part");
    expect_refused({"--part", "17/16", "--spp", "64"},
                   "--part: '17/16' is not K/N with K from 1 to N, such as 3/16\nRun with --help for more information.");
}

// The script for Slurm, with what Slurm tells a job: a job that is sent again does nothing.
TEST_F(MergeCommand, AJobArray) {
    const auto job = [&](const std::string& k) {
        const std::string programs = std::filesystem::path(NEUMANN).parent_path().string();
        const Finished done =
            run_program({"/usr/bin/env", "PATH=" + programs + ":/usr/bin:/bin", "SLURM_ARRAY_TASK_ID=" + k,
                         "SLURM_ARRAY_TASK_COUNT=2", "SLURM_CPUS_PER_TASK=1", "bash", SCENES "/../apps/manual/job_array.slurm",
                         "scene.xml", "out", "--spp", "128", "-n", "2"});
        EXPECT_EQ(done.exit_code, 0) << done.err;
        EXPECT_EQ(done.err, "");
    };
    job("1");
    job("2");
    const auto before = contents("out/part-0001");
    job("1");
    EXPECT_EQ(contents("out/part-0001"), before);
    merge({"out/part-0001", "out/part-0002"}, "all");
    part("whole", {"--spp", "128"});
    std::filesystem::remove(path("all/render.samples"));
    expect_same_pictures("whole", "all");
}

}  // namespace neumann::merge_command_test
