// `neumann plan`, and --plan of `render`.
#include "apps/output/files/rendered_picture.h"
#include "tests/commands/render_output.h"

namespace neumann::plan_command_test {

class PlanCommand : public CommandTest {
protected:
    nlohmann::json json(const std::string& folder) const { return nlohmann::json::parse(text_of(path(folder) / "run.json")); }
    std::string rendered(const std::string& scene, const std::vector<std::string>& more, const std::string& folder) const {
        std::vector<std::string> arguments{"render", scene, "-D", "res=8", "-n", "3", "--spp", "16", "--quiet", "-o", folder};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Finished done = run(arguments);
        EXPECT_EQ(done.exit_code, 0) << done.err;
        return folder;
    }
    static const nlohmann::json& part(const nlohmann::json& plan, const std::string& begin) {
        for (const auto& p : plan)
            if (p.at("part").get<std::string>().starts_with(begin)) return p;
        throw std::out_of_range("the plan has no part " + begin);
    }
    const std::string furnace_ = SCENES "/furnace/furnace.xml", cornell_ = SCENES "/cornell-box/cornell-box.xml";
};

TEST_F(PlanCommand, SaysWhatIsKeptAndWhatIsLeftOut) {
    const Finished done = run({"plan", furnace_});
    EXPECT_EQ(done.exit_code, 0);
    EXPECT_EQ(done.err, "");
    const std::size_t left_out = done.out.find("\nLeft out:\n");
    ASSERT_NE(left_out, std::string::npos) << done.out;
    EXPECT_EQ(done.out.substr(0, 6), "Kept:\n");
    const std::size_t furnace = done.out.find("a furnace: all that can be seen gives off the same radiance");
    ASSERT_NE(furnace, std::string::npos) << done.out;
    EXPECT_GT(furnace, left_out);

    const auto plan = nlohmann::json::parse(run({"plan", cornell_, "--json"}).out);
    EXPECT_TRUE(part(plan, "three colour channels").at("kept").get<bool>());
    EXPECT_TRUE(part(plan, "shadow rays").at("kept").get<bool>());
    const nlohmann::json specular = part(plan, "mirrors");
    EXPECT_FALSE(specular.at("kept").get<bool>());
    EXPECT_FALSE(specular.at("reason").get<std::string>().empty());
    EXPECT_FALSE(specular.at("saves").get<std::string>().empty());
    EXPECT_FALSE(part(plan, "late bounces").at("kept").get<bool>());
}

TEST_F(PlanCommand, TakesDefinitionsAndRefusesWhatIsNoScene) {
    EXPECT_EQ(run({"plan", furnace_, "-D", "albedo=0.2", "--json"}).exit_code, 0);
    EXPECT_NE(refused({"plan", furnace_, "-D", "nobody=1"}).find("nobody"), std::string::npos);
    EXPECT_NE(refused({"plan", "nothing.xml"}).find("nothing.xml"), std::string::npos);
}

TEST_F(PlanCommand, FullLeavesNothingOutAndShowsTheSame) {
    rendered(cornell_, {}, "auto");
    rendered(cornell_, {"--plan", "full"}, "full");
    EXPECT_EQ(json("full").at("plan"), "full");
    EXPECT_TRUE(json("auto").at("plan").is_array());
    for (const char* file : {"bounce_000.exr", "bounce_001.exr", "bounce_003.exr", "sum_003.exr", "rest.exr"}) {
        const RenderedPicture a = read_rendered_picture((path("auto") / file).string()),
                              b = read_rendered_picture((path("full") / file).string());
        EXPECT_EQ(a.picture.mean.pixels, b.picture.mean.pixels) << file;
        EXPECT_EQ(a.picture.standard_error.pixels, b.picture.standard_error.pixels) << file;
    }
    rendered(furnace_, {}, "furnace");
    rendered(furnace_, {"--plan", "full"}, "furnace_full");
    EXPECT_LT(json("furnace").at("bounces").at(2).at("rays"), json("furnace_full").at("bounces").at(2).at("rays"));
}

// Of the plan, run.json has what the method took.
TEST_F(PlanCommand, OfMethods) {
    const auto has_light_samples = [&](const std::vector<std::string>& options, const std::string& folder) {
        rendered(furnace_, options, folder);
        const nlohmann::json of_run = json(folder);
        for (const auto& p : of_run.at("plan"))
            if (p.at("part").get<std::string>().starts_with("asking lights")) return true;
        return false;
    };
    EXPECT_TRUE(has_light_samples({}, "walk"));
    EXPECT_TRUE(has_light_samples({"--direct", "mis-balance"}, "balance"));
    EXPECT_FALSE(has_light_samples({"--direct", "light"}, "light"));
    EXPECT_FALSE(part(json("walk").at("plan"), "roulette").at("kept").get<bool>());
    rendered(furnace_, {"--roulette", "albedo"}, "roulette");
    EXPECT_TRUE(part(json("roulette").at("plan"), "roulette").at("kept").get<bool>());
    rendered(furnace_, {"--method", "bidirectional"}, "both");
    EXPECT_EQ(json("both").at("plan"), "full");
    EXPECT_NE(refused({"render", furnace_, "--method", "matrix", "--plan", "full"}).find("--plan belongs to auto, walk, "),
              std::string::npos);
    EXPECT_NE(refused({"render", furnace_, "--plan", "half"}).find("half"), std::string::npos);
}

}  // namespace neumann::plan_command_test
