// Options that are wrong: stderr names the option and what is wrong with it, exit code 2, and nothing is left behind. The words of
// most of these messages are CLI11's and differ between its versions; what is compared whole is the program's own.
#include "tests/commands/render_output.h"

namespace neumann::bad_input_options_test {

class BadInputOptions : public RenderTest {
protected:
    BadInputOptions() { write("scene.xml", plates()); }

    std::string refusal(std::vector<std::string> options) const {
        options.insert(options.begin(), {"render", "scene.xml", "-o", "new/folder"});
        const Names before = names();
        const Finished done = run(options);
        EXPECT_EQ(done.exit_code, 2) << testing::PrintToString(options);
        EXPECT_EQ(done.out, "");
        EXPECT_EQ(names(), before);
        return done.err;
    }
    void expect_refused(const std::string& option, const std::string& value) const {
        const std::string message = refusal({option, value});
        EXPECT_TRUE(message.starts_with(option + ": ")) << message;
        EXPECT_NE(message.find(value), std::string::npos) << message;
        EXPECT_LT(message.size(), 250u) << message;
    }
};

TEST_F(BadInputOptions, Numbers) {
    expect_refused("-n", "-1");
    expect_refused("-n", "1.5");
    expect_refused("-n", "many");
    expect_refused("--spp", "0");
    expect_refused("--spp", "-4");
    expect_refused("--spp", "1e3");
    expect_refused("-t", "0");
}

TEST_F(BadInputOptions, RealNumbers) {
    for (const char* option : {"--time", "--error", "--tail"})
        for (const char* value : {"0", "-1"}) expect_refused(option, value);
    expect_refused("--time", "inf");
    expect_refused("--error", "small");
}

// Misspelt, or another program's.
TEST_F(BadInputOptions, WhatWasMeant) {
    const std::string more = "\nRun with --help for more information.\n";
    EXPECT_EQ(refusal({"--sp", "4"}), "--sp: render has no such option; did you mean '--spp'?" + more);
    EXPECT_EQ(refusal({"--methd=walk"}), "--methd: render has no such option; did you mean '--method'?" + more);
    const Finished help = run({"render", "scene.xml", "--sp", "4", "--help"});
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_NE(help.out.find("--spp N"), std::string::npos);
    EXPECT_EQ(refusal({"--unheard-of"}), "--unheard-of: render has no such option" + more);
    EXPECT_EQ(
        refusal({"--max-depth", "5"}),
        "--max-depth: render has no such option; here it is -n, the last bounce; programs count differently, see counting.md of "
        "the manual" +
            more);
    EXPECT_TRUE(refusal({"--method", "corected"}).ends_with("; did you mean 'corrected'?" + more));
    EXPECT_EQ(refusal({"--method", "bdpt"}), "--method: what other programs call bdpt is bidirectional here" + more);
}

TEST_F(BadInputOptions, Chains) {
    expect_refused("--chain", "0");
    EXPECT_EQ(refusal({"--chain", "10"}), "--chain belongs to metropolis, not to walk\n");
    write("small.xml", R"(<scene version="3.0.0">
<sensor type="perspective"><film type="hdrfilm"><integer name="width" value="8"/><integer name="height" value="8"/></film></sensor>
<shape type="sphere"><emitter type="area"><rgb name="radiance" value="1"/></emitter></shape></scene>)");
    const Finished done = run({"render", "small.xml", "-o", "a", "--method", "metropolis", "--spp", "64", "--chain", "100"});
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_EQ(
        done.err,
        "--chain 100: a replicate of 16 samples for each of 8×8 pixels has 1024 states of a bounce, and its 64 chains may be of "
        "16 at most\n");
    EXPECT_EQ(names(), (Names{"scene.xml", "small.xml"}));
}

TEST_F(BadInputOptions, Adaptive) {
    expect_refused("--adaptive", "everything");
    EXPECT_TRUE(refusal({"--adaptive", "-1"}).starts_with("--adaptive: '-1' is not bounces, sum, all or the number of a bounce\n"));
    for (const std::string method : {"walk", "corrected", "mixed"})
        EXPECT_EQ(refusal({"--method", method, "--adaptive", "5", "-n", "4"}),
                  "--adaptive 5: the last bounce that has a picture is 4\n");
    EXPECT_EQ(refusal({"--method", "light", "--adaptive", "sum"}),
              "--adaptive belongs to auto, walk, guided, corrected, bidirectional and mixed, not to light\n");
}

TEST_F(BadInputOptions, BiasAllowed) {
    EXPECT_EQ(refusal({"--method", "walk", "--bias-allowed"}), "--bias-allowed belongs to auto, not to walk\n");
}

TEST_F(BadInputOptions, Tree) {
    for (const std::string what : {"0", "9", "all", "equal", "equal-1", "equal-17", "equal-2.5"})
        EXPECT_TRUE(refusal({"--tree", what})
                        .starts_with("--tree: '" + what + "' is not sum, place, a bounce from 1 to 8, or equal-2 to equal-16\n"));
    EXPECT_EQ(refusal({"--tree", "sum", "--split", "2,2"}), "--tree chooses what split and roulette say; take it alone\n");
    EXPECT_EQ(refusal({"--tree", "5", "-n", "4"}), "--tree 5: the last bounce that has a picture is 4\n");
    EXPECT_EQ(refusal({"--tree", "equal-2", "-n", "9"}),
              "--tree makes 2 branches at 9 reflections 512 paths, where 256 are the most; take fewer bounces\n");
    for (const std::string other : {"--reuse", "--tree=sum"})
        EXPECT_EQ(refusal({"--indirect", "cosine", other}), "--indirect is for plain walks; take it without tree and reuse\n");
}

TEST_F(BadInputOptions, Reuse) {
    EXPECT_EQ(refusal({"--method", "guided", "--reuse"}), "--reuse belongs to walk, not to guided\n");
    for (const auto& [option, value] : {std::pair{"--tree", "sum"}, {"--adaptive", "sum"}, {"--split", "2,2"}})
        EXPECT_EQ(refusal({"--reuse", option, value}),
                  "--reuse needs one walk of each pixel; take it without tree, adaptive and split\n");
}

TEST_F(BadInputOptions, Photons) {
    for (const std::string radius : {"0", "-1", "nan", "wide"})
        EXPECT_TRUE(refusal({"--method", "photon", "--radius", radius})
                        .starts_with("--radius: '" + radius + "' is not a length above 0\n"));
    expect_refused("--photons", "0");
    EXPECT_EQ(refusal({"--gather"}), "--gather belongs to photon, not to walk\n");
    // A lamp above a floor that shines away from it.
    write("dark.xml", R"(<scene version="3.0.0">
<sensor type="perspective"><film type="hdrfilm"><integer name="width" value="4"/><integer name="height" value="4"/></film></sensor>
<shape type="rectangle"/>
<shape type="rectangle">
  <transform name="to_world"><translate z="1"/></transform><emitter type="area"><rgb name="radiance" value="1"/></emitter>
</shape></scene>)");
    const Finished done = run({"render", "dark.xml", "-o", "a", "--method", "photon", "--spp", "4"});
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_EQ(done.err, "photon: none of 65536 paths from the lights meets a surface; take walk\n");
    EXPECT_EQ(names(), (Names{"scene.xml", "dark.xml"}));
}

TEST_F(BadInputOptions, Caches) {
    for (const std::string accuracy : {"0", "-1", "nan", "fine"})
        EXPECT_TRUE(refusal({"--method", "cache", "--accuracy", accuracy})
                        .starts_with("--accuracy: '" + accuracy + "' is not a number above 0\n"));
    EXPECT_TRUE(
        refusal({"--method", "cache", "--records", "octree"}).starts_with("--records: octree not in {hessian,split-sphere}\n"));
    EXPECT_EQ(refusal({"--accuracy", "0.1"}), "--accuracy belongs to cache, not to walk\n");
    // Nothing but a mirror.
    write("mirror.xml", R"(<scene version="3.0.0">
<sensor type="perspective"><film type="hdrfilm"><integer name="width" value="4"/><integer name="height" value="4"/></film></sensor>
<shape type="rectangle"><transform name="to_world"><translate z="1"/></transform><bsdf type="twosided"><bsdf type="conductor"/></bsdf></shape>
<emitter type="constant"/>
</scene>)");
    const Finished done = run({"render", "mirror.xml", "-o", "a", "--method", "cache", "--spp", "4"});
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_EQ(done.err, "cache keeps records on diffuse surfaces, and paths from the camera meet none; take walk\n");
    EXPECT_EQ(names(), (Names{"scene.xml", "mirror.xml"}));
}

TEST_F(BadInputOptions, Paths) {
    EXPECT_EQ(refusal({"--paths", "3"}), "--paths 3: expected a pixel, as 19,160, or the word named\n");
    EXPECT_EQ(refusal({"--paths", "164,0"}), "--paths 164,0: the picture has x from 0 to 163 and y from 0 to 4\n");
    EXPECT_EQ(refusal({"--paths", "3,4", "--files", "tables"}), "--paths: are for the page; expected page among --files\n");
    EXPECT_EQ(refusal({"--paths", "named", "--method", "gather"}),
              "--paths: gather has no paths to replay: its bounces are read from fields on patches\n");
    EXPECT_EQ(refusal({"--paths", "named", "--method", "pointwise"}),
              "--paths: pointwise has no paths to replay: each of its bounces is asked for anew\n");
    EXPECT_EQ(refusal({"--paths", "named", "--bias-allowed"}),
              "--paths: --bias-allowed may choose fields on patches, which have no paths; take one of the two\n");
}

// A goal that no number reaches would never end.
TEST_F(BadInputOptions, NotANumber) {
    for (const char* option : {"--time", "--error", "--tail"}) {
        std::vector<std::string> options{option, "nan", "--spp", "1"};
        const std::string message = refusal(options);
        EXPECT_NE(message.find(option), std::string::npos) << message;
    }
}

TEST_F(BadInputOptions, ANegativeSeed) {
    const std::string message = refusal({"--seed", "-1", "--spp", "1"});
    EXPECT_NE(message.find("--seed"), std::string::npos) << message;
}

TEST_F(BadInputOptions, Names) {
    EXPECT_NE(refusal({"--method", "guess"}).find("walk"), std::string::npos);
    for (const char* direct : {"all", "1"}) {
        const std::string message = refusal({"--direct", direct, "--spp", "1"});
        for (const char* allowed : {"light", "bsdf", "mis"}) EXPECT_NE(message.find(allowed), std::string::npos) << message;
        EXPECT_EQ(message.find("->"), std::string::npos) << message;
    }
}

TEST_F(BadInputOptions, UnknownOrMissing) {
    EXPECT_NE(refusal({"--bounces", "3"}).find("--bounces"), std::string::npos);
    EXPECT_NE(refusal({"another.xml"}).find("another.xml"), std::string::npos);
    const std::string both = refusal({"-n", "3", "--tail", "0.1"});
    EXPECT_TRUE(both.find("-n") != std::string::npos && both.find("--tail") != std::string::npos) << both;
    const Finished none = run({"render"});
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_NE(none.err.find("SCENE"), std::string::npos) << none.err;
}

// Options stand where one likes.
TEST_F(BadInputOptions, DefinitionsBeforeTheSceneAreFine) {
    const Finished done = run({"render", "-D", "height=2", "scene.xml", "-n", "0", "--spp", "1", "-o", "a", "--quiet"});
    EXPECT_EQ(done.exit_code, 0) << done.err;
}

// Only the scene and its definitions are read before the folder is tried, and nothing is computed.
TEST_F(BadInputOptions, FoldersThatCannotBeWritten) {
    write("file", "mine");
    for (const std::string output : {"file", "file/below", "file/far/below", "/proc/neumann"}) {
        const Finished done = run({"render", "scene.xml", "-n", "0", "--spp", "1", "-o", output});
        EXPECT_EQ(done.exit_code, 2);
        EXPECT_EQ(done.err, output + ": cannot be written: " +
                                (output.starts_with("/proc") ? "No such file or directory" : "Not a directory") + "\n");
        EXPECT_EQ(done.out, "");
    }
    EXPECT_EQ(text_of(path("file")), "mine");
    EXPECT_EQ(names(), (Names{"file", "scene.xml"}));
}

TEST_F(BadInputOptions, ManyPicturesForTheMemory) {
    const Finished done =
        run({"render", "scene.xml", "-n", "100", "--spp", "1", "-o", "new/folder", "-D", "height=600", "--memory", "0.01"});
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_NE(done.err.find("\n100 bounces of 164×600 pixels need about "), std::string::npos) << done.err;
    EXPECT_TRUE(done.err.ends_with(" GiB, and 0.0 may be taken; take fewer bounces or a smaller film\n")) << done.err;
    EXPECT_EQ(names(), Names{"scene.xml"});
}

// Names that no file can have.
TEST_F(BadInputOptions, NamesThatCannotBe) {
    std::filesystem::create_symlink("loop", path("loop"));
    const std::string long_name(300, 'x');
    for (const auto& [name, why] :
         {std::pair(std::string("loop"), "Too many levels of symbolic links"), {long_name, "File name too long"}})
        for (const std::vector<std::string>& arguments :
             {std::vector<std::string>{"render", "scene.xml", "-n", "0", "--spp", "1", "-o", name},
              {"render", "scene.xml", "-n", "0", "--spp", "1", "-o", "a", "--reference", name},
              {"page", name},
              {"replay", name, "1"},
              {"merge", name, name, "-o", "b"},
              {"plan", name}}) {
            const Finished done = run(arguments);
            EXPECT_EQ(done.exit_code, 2) << arguments.front() << ": " << done.err;
            EXPECT_TRUE(done.err.starts_with(name)) << done.err;
            EXPECT_NE(done.err.find(why), std::string::npos) << done.err;
        }
}

// Options stand behind the command, and are told so by their own name.
TEST_F(BadInputOptions, BeforeTheCommand) {
    const Finished done = run({"--spp", "4", "render", "scene.xml"});
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_EQ(
        done.err,
        "--spp stands before the command, expected after it: neumann render … --spp\nRun with --help for more information.\n");
}

TEST_F(BadInputOptions, OfOtherPrograms) {
    const std::string size =
        " has no such option; here it is -D, as in -D res=256 or -D width=256: sizes have the names that the scene "
        "gives them\nRun with --help for more information.\n";
    for (const char* option : {"--res", "--size", "-r", "--width"}) {
        EXPECT_EQ(refusal({option, "64"}), std::string(option) + ": render" + size);
        EXPECT_EQ(run({"plan", "scene.xml", option, "64"}).err, std::string(option) + ": plan" + size);
    }
    EXPECT_EQ(refusal({"--max-depth", "3"}),
              "--max-depth: render has no such option; here it is -n, the last bounce; programs count differently, see counting.md "
              "of the "
              "manual\nRun with --help for more information.\n");
}

// Where the experiments were not built, their help is there, and what is missing is said.
TEST_F(BadInputOptions, ExperimentsThatAreNotThere) {
    std::filesystem::copy(NEUMANN, path("neumann"));
    const std::string alone = path("neumann").string();
    EXPECT_EQ(run_program({alone, "study", "--help"}).exit_code, 0);
    const Finished done = run_program({alone, "study", "scene.xml"});
    EXPECT_EQ(done.exit_code, 1);
    EXPECT_TRUE(done.err.starts_with("neumann: the program neumann-experiments, which runs this command, is not there"))
        << done.err;
    EXPECT_EQ(run_program({alone, "study", "scene.xml", "--spp", "4"}).exit_code, 2);
}

}  // namespace neumann::bad_input_options_test
