// `neumann spectrum` on scenes whose spectra are known.
#include "tests/commands/render_output.h"

#include <algorithm>

namespace neumann::spectrum_command_test {

class SpectrumCommand : public CommandTest {
protected:
    static inline const std::string furnace = SCENES "/furnace/furnace.xml", segment = SCENES "/sphere-segment/sphere-segment.xml";

    std::string printed(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "spectrum");
        const Finished done = run(arguments);
        EXPECT_EQ(done.exit_code, 0) << done.err;
        EXPECT_EQ(names(), Names{});
        return done.out;
    }
    nlohmann::json json(std::vector<std::string> arguments) const {
        arguments.push_back("--json");
        return nlohmann::json::parse(printed(arguments));
    }
    std::string refusal(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "spectrum");
        return refused(arguments);
    }
};

// T 1 = 1 and λ₁ = ρ on every mesh; what is left after n bounces is ρ^(n+1).
TEST_F(SpectrumCommand, Furnace) {
    for (const double rho : {0.5, 0.9, 0.99}) {
        const auto j = json({furnace, "--patches", "300", "--directions", "32", "-D", fmt::format("albedo={}", rho)});
        EXPECT_EQ(j["transport"]["row_sums"]["min"], 1.0);
        EXPECT_EQ(j["transport"]["row_sums"]["max"], 1.0);
        EXPECT_EQ(j["transport"]["rays_that_see_nothing"], 0.0);
        ASSERT_EQ(j["channels"].size(), 1u);
        const auto& grey = j["channels"][0];
        EXPECT_EQ(grey["name"], "grey");
        EXPECT_EQ(grey["series"], "converges");
        EXPECT_NEAR(grey["spectral_radius"], rho, 1e-12);
        EXPECT_NEAR(grey["norms"]["inf"], rho, 1e-15);
        EXPECT_GE(grey["norms"]["2"], rho * (1.0 - 1e-12));
        // Of the operator all norms are ρ. Of the matrix ‖K‖₁ is the largest of some 300 sums of rays, each with the noise of its
        // own.
        const double one = grey["norms"]["1"], error = grey["norm_1_standard_error"];
        EXPECT_GE(one, rho * (1.0 - 1e-12));
        EXPECT_LE(one, rho + 4.5 * error);
        EXPECT_LE(error, 0.5 * rho) << "what this test can see";
        EXPECT_EQ(j["norms_of"]["1"], "power: sum of m |L|, m = n^2 * area * projected solid angle of an unknown");
        EXPECT_EQ(grey["largest_albedo"], rho);
        ASSERT_EQ(grey["refinement"].size(), 4u);
        for (const auto& row : grey["refinement"]) EXPECT_NEAR(row["eigenvalues"][0]["real"], rho, 1e-12) << row["what"];
        for (const auto& row : grey["bounces_until"]) {
            const double remaining = row["remaining"];
            EXPECT_EQ(row["bounces"], std::ceil(std::log(remaining) / std::log(rho) - 1.0)) << rho << ", " << remaining;
        }
    }
}

// One channel alone is what it is among all.
TEST_F(SpectrumCommand, OneChannel) {
    const std::vector<std::string> room = {SCENES "/cornell-box/cornell-box.xml", "--patches", "60", "--directions", "8"};
    const auto all = json(room);
    ASSERT_EQ(all["channels"].size(), 3u);
    for (const auto& [letter, number] : {std::pair("r", 0), {"g", 1}, {"b", 2}}) {
        std::vector<std::string> one = room;
        one.insert(one.end(), {"--channel", letter});
        const auto found = json(one);
        ASSERT_EQ(found["channels"].size(), 1u);
        EXPECT_EQ(found["channels"][0]["name"], all["channels"][number]["name"]);
        EXPECT_EQ(found["channels"][0]["eigenvalues"], all["channels"][number]["eigenvalues"]);
        EXPECT_EQ(found["channels"][0]["refinement"], all["channels"][number]["refinement"]);
        EXPECT_EQ(found["channels"][0]["spectral_radius_shift"], all["channels"][number]["spectral_radius_shift"]);
    }
    EXPECT_EQ(refusal({room[0], "--channel", "x"}), "--channel: x not in {r,g,b}\nRun with --help for more information.\n");
}

// Two surfaces that exchange light: F_ss = 3/4, F_sd = 1/4, and F_ds = 3/4 / 0.87², for the disk's rim is outside. 13 rings of
// patches, of which the disk's plane is nearly a border: this moves the eigenvalues by up to 0.0003. Over 50 seeds they have
// standard deviations of at most 0.0005, of which the limit is 4.5, and the 0.0003.
TEST_F(SpectrumCommand, SphereSegment) {
    for (const auto& [rho_s, rho_d] : {std::pair(0.5, 0.7), std::pair(0.9, 0.3)}) {
        const auto j = json({segment, "--patches", "300", "--directions", "256", "-D", fmt::format("sphere_albedo={}", rho_s), "-D",
                             fmt::format("disk_albedo={}", rho_d)});
        const double trace = 0.75 * rho_s, root = std::sqrt(trace * trace + rho_s * rho_d * 0.75 / (0.87 * 0.87));
        const auto& grey = j["channels"][0];
        const double limit = 4.5 * 0.0005 + 0.0003;
        EXPECT_NEAR(grey["spectral_radius"], 0.5 * (trace + root), limit);
        EXPECT_NEAR(grey["eigenvalues"][0]["real"], 0.5 * (trace + root), limit);
        // The cavity behind the disk has an eigenvalue of its own, and other modes are noise.
        if (rho_s == 0.5) {
            EXPECT_NEAR(grey["eigenvalues"][1]["real"], 0.5 * (trace - root), limit);
        }
        for (const auto& value : grey["eigenvalues"]) EXPECT_LE(value["residual"], 1e-10);
    }
}

TEST_F(SpectrumCommand, AlbedoOneAndAbove) {
    auto j = json({furnace, "--patches", "100", "-D", "albedo=1"});
    EXPECT_EQ(j["channels"][0]["series"], "does not converge");
    EXPECT_EQ(j["channels"][0]["bounces_until"][0]["bounces"], nullptr);
    EXPECT_EQ(j["channels"][0]["rounding"]["float"]["relative_error"], nullptr);
    j = json({furnace, "--patches", "100", "-D", "albedo=1.05"});
    EXPECT_EQ(j["channels"][0]["series"], "diverges");
    // ‖K‖∞ = 1.2, and yet the series converges.
    j = json({segment, "--patches", "100", "-D", "disk_albedo=1.2"});
    EXPECT_EQ(j["channels"][0]["series"], "converges");
    EXPECT_NEAR(j["channels"][0]["norms"]["inf"], 1.2, 1e-14);
    EXPECT_LT(j["channels"][0]["spectral_radius"], 0.65);
}

TEST_F(SpectrumCommand, NormsWarnAndTheRadiusJudges) {
    const Finished done = run({"spectrum", furnace, "--patches", "100", "-D", "albedo=1"});
    EXPECT_EQ(done.exit_code, 0);
    EXPECT_EQ(
        done.err,
        "warning: grey: ‖K‖∞ = 1 is not below 1 and bounds no tail; whether the series converges is for the spectral radius to "
        "say\n");
    EXPECT_NE(done.out.find("\ngrey: does not converge (albedo 1 in a closed room): the spectral radius is 1, no light is lost.\n"),
              std::string::npos)
        << done.out;
    EXPECT_EQ(run({"spectrum", furnace, "--patches", "100", "-D", "albedo=1", "--quiet"}).err, "");
    const std::string above = printed({furnace, "--patches", "100", "-D", "albedo=1.05"});
    EXPECT_NE(above.find("\ngrey: diverges, the spectral radius is 1.050000: K^i Le grows without end.\n"), std::string::npos)
        << above;
}

TEST_F(SpectrumCommand, TablesAreAtMost100Wide) {
    for (const std::string& scene : {furnace, std::string(SCENES "/cornell-box/cornell-box.xml")}) {
        std::istringstream lines(printed({scene, "--patches", "400"}));
        std::string line;
        std::getline(lines, line);  // the first names the file
        while (std::getline(lines, line)) {
            const auto width = std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; });
            EXPECT_LE(width, 100) << line;
        }
    }
}

TEST_F(SpectrumCommand, Csv) {
    write("spectrum.csv", "");
    const Finished done = run({"spectrum", furnace, "--patches", "200", "--eigenvalues", "3", "--csv"});
    write("spectrum.csv", done.out);
    const Table table(path("spectrum.csv"));
    EXPECT_EQ(table.columns(), (std::vector<std::string>{"channel", "patches", "unknowns", "rays", "index", "real", "imaginary",
                                                         "modulus", "residual"}));
    ASSERT_EQ(table.size(), 4u * 2u + 3u);
    for (std::size_t i = 0; i < table.size(); ++i)
        if (table.number(i, "index") == 1) {
            EXPECT_NEAR(table.number(i, "modulus"), 0.5, 1e-12);
        }
}

TEST_F(SpectrumCommand, TheSameOnAnyNumberOfThreads) {
    const std::vector<std::string> arguments = {furnace, "--patches", "200", "-t"};
    auto one = arguments, two = arguments;
    one.push_back("1");
    two.push_back("2");
    EXPECT_EQ(printed(one), printed(two));
}

// Light that stays in the ball has as many eigenvalues of modulus 1 as there are ways to go round. The radius is known without
// them.
TEST_F(SpectrumCommand, WhatIsNotFoundIsSaid) {
    const std::string ball = SCENES "/glass-ball/glass-ball.xml";
    const Finished done = run({"spectrum", ball, "--patches", "400", "--most", "40"});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    EXPECT_NE(done.err.find("warning: red: eigenvalues were not found within 40 applications of K, largest residual "),
              std::string::npos)
        << done.err;
    EXPECT_NE(done.out.find("\nred: the radius is known without them: some light is kept for good, 1.000000 of it each time.\n"),
              std::string::npos)
        << done.out;
    const auto j = json({ball, "--patches", "400", "--most", "40"});
    const auto& red = j["channels"][0];
    EXPECT_EQ(red["eigenvalues_converged"], false);
    EXPECT_EQ(red["eigenvalues_search"]["applications"], 40.0);
    EXPECT_FALSE(red["eigenvalues_search"]["history"].empty());
    EXPECT_NEAR(red["spectral_radius"], 1.0, 1e-9);
    EXPECT_EQ(red["series"], "undecided");
    // Out of time at once: there is still a report.
    const Finished soon = run({"spectrum", furnace, "--time", "1e-9"});
    EXPECT_EQ(soon.exit_code, 0);
    EXPECT_NE(soon.err.find("warning: the time of 1e-09 s was up: this is what was found until then\n"), std::string::npos)
        << soon.err;
}

TEST_F(SpectrumCommand, Refusals) {
    EXPECT_EQ(refusal({furnace, "--patches", "0"}),
              "--patches: '0' is not a whole number from 1 to 1099511627776\nRun with --help for more information.\n");
    EXPECT_EQ(
        refusal({furnace, "--directions", "48"}),
        "--directions: '48' is not a power of two from 1 to 1048576, such as 32 or 64\nRun with --help for more information.\n");
    EXPECT_EQ(
        refusal({furnace, "--directions", "0"}),
        "--directions: '0' is not a power of two from 1 to 1048576, such as 32 or 64\nRun with --help for more information.\n");
    EXPECT_EQ(refusal({furnace, "--directions", "2097152"}),
              "--directions: '2097152' is not a power of two from 1 to 1048576, such as 32 or 64\nRun with --help for more "
              "information.\n");
    EXPECT_EQ(refusal({"none.xml"}), run({"render", "none.xml"}).err);
    const std::string many = refusal({furnace, "--patches", "1000000000000"});
    EXPECT_TRUE(many.starts_with(furnace + ": 1000000000000 patches of 64 rays need about ")) << many;
    EXPECT_TRUE(many.ends_with(" patches of as many rays fit\n")) << many;
    const std::string head = "<scene version=\"3.0.0\"><sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/></sensor>";
    write("empty.xml", head + "</scene>");
    EXPECT_EQ(refusal({"empty.xml"}), "empty.xml: the scene has no surfaces, so there is nothing to cut into patches\n");
    write("lone.xml", head + "<shape type=\"rectangle\"><bsdf type=\"diffuse\"/></shape></scene>");
    EXPECT_EQ(refusal({"lone.xml"}), "lone.xml: no surface faces another or shines: K is 0 and has no unknowns\n");
}

}  // namespace neumann::spectrum_command_test
