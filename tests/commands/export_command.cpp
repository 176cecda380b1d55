// `neumann export`: what is read back are the matrices of the library.
#include "core/reader/read_scene.h"
#include "operators/fields/matrix/traced_system.h"
#include "tests/commands/render_output.h"

namespace neumann::export_command_test {

using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;

class ExportCommand : public CommandTest {
protected:
    static inline const std::string furnace = SCENES "/furnace/furnace.xml", box = SCENES "/cornell-box/cornell-box.xml";
    static inline const std::vector<std::string> small{"--patches", "150", "--directions", "16", "-o", "a"};

    Finished exported(const std::string& scene, std::vector<std::string> more = {}) const {
        more.insert(more.begin(), small.begin(), small.end());
        more.insert(more.begin(), {"export", scene});
        return run(more);
    }
    // Past the line of the format and the comment.
    std::istringstream numbers(const std::string& name, const std::string& format) const {
        std::istringstream text(text_of(path("a/" + name)));
        std::string line;
        std::getline(text, line);
        EXPECT_EQ(line, "%%MatrixMarket matrix " + format + " real general") << name;
        std::getline(text, line);
        EXPECT_TRUE(line.starts_with("% ")) << name;
        return text;
    }
    Sparse sparse(const std::string& name) const {
        auto text = numbers(name, "coordinate");
        Eigen::Index rows = 0, columns = 0, entries = 0;
        text >> rows >> columns >> entries;
        std::vector<Eigen::Triplet<double>> triplets;
        int row = 0, column = 0;
        for (double value = 0.0; text >> row >> column >> value;) triplets.emplace_back(row - 1, column - 1, value);
        EXPECT_EQ(static_cast<Eigen::Index>(triplets.size()), entries) << name;
        Sparse matrix(rows, columns);
        matrix.setFromTriplets(triplets.begin(), triplets.end());
        return matrix;
    }
    Eigen::MatrixXd dense(const std::string& name) const {
        auto text = numbers(name, "array");
        Eigen::Index rows = 0, columns = 0;
        text >> rows >> columns;
        Eigen::MatrixXd matrix(rows, columns);
        for (Eigen::Index c = 0; c < columns; ++c)
            for (Eigen::Index r = 0; r < rows; ++r) text >> matrix(r, c);
        EXPECT_FALSE(text.fail()) << name;
        return matrix;
    }
    std::string refusal(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "export");
        return refused(arguments);
    }
};

TEST_F(ExportCommand, RoundTrip) {
    const Finished done = exported(box, {"--with-K"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_EQ(names("a"), (Names{"T.mtx", "R_r.mtx", "R_g.mtx", "R_b.mtx", "K_r.mtx", "K_g.mtx", "K_b.mtx", "Le.mtx", "b.mtx",
                                 "measure.mtx", "ray_measure.mtx", "patches.csv", "run.json"}));
    const Scene scene = read_scene(box);
    const TracedSystem system(scene, {150, 16, 0});
    const Eigen::MatrixXd Le = dense("Le.mtx"), b = dense("b.mtx");
    const Vector measure = dense("measure.mtx"), ray_measure = dense("ray_measure.mtx");
    const Sparse T = sparse("T.mtx");
    for (int c = 0; c < 3; ++c) {
        const std::string suffix = std::string("_") + "rgb"[c] + ".mtx";
        const Sparse R = sparse("R" + suffix), K = sparse("K" + suffix), RT = R * T;
        EXPECT_LE((RT - K).norm(), 1e-15 * K.norm());
        EXPECT_EQ(Le.col(c), system.emitted(c));
        EXPECT_EQ(b.col(c), system.direct(c));
        const TracedChannel channel = system.channel(c);
        Vector expected(channel.size());
        for (const Vector& x : {Vector(Le.col(c)), Vector(b.col(c)), Vector(Vector::Ones(channel.size()))}) {
            channel.apply(x, expected);
            EXPECT_LE((K * x - expected).lpNorm<Eigen::Infinity>(), 1e-15 * x.lpNorm<Eigen::Infinity>());
        }
        EXPECT_EQ(measure, channel.measure());
    }
    EXPECT_NEAR(ray_measure.sum() / measure.sum(), 1.0, 1e-13);
    const Table patches(path("a/patches.csv"));
    ASSERT_EQ(patches.size(), static_cast<std::size_t>(measure.size()));
    for (std::size_t u = 0; u < patches.size(); ++u) {
        EXPECT_EQ(patches.number(u, "unknown"), static_cast<double>(u));
        EXPECT_EQ(patches.number(u, "area") * pi, measure[static_cast<Eigen::Index>(u)]);
        const Vec3 n(patches.number(u, "nx"), patches.number(u, "ny"), patches.number(u, "nz"));
        EXPECT_NEAR(glm::length(n), 1.0, 1e-12);
    }
    const auto j = nlohmann::json::parse(text_of(path("a/run.json")));
    EXPECT_EQ(j["channels"], (std::vector<std::string>{"red", "green", "blue"}));
    EXPECT_EQ(j["b"], "K Le, sampled on the lights");
    EXPECT_EQ(j["unknowns"], measure.size());
    EXPECT_EQ(j["files"].size(), 12u);
}

// Rows of T sum to 1, those of R to the albedo: K 1 = ρ, and with Le = 1 so does b.
TEST_F(ExportCommand, Furnace) {
    const Finished done = exported(furnace);
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_EQ(names("a"),
              (Names{"T.mtx", "R.mtx", "Le.mtx", "b.mtx", "measure.mtx", "ray_measure.mtx", "patches.csv", "run.json"}));
    const Sparse T = sparse("T.mtx"), R = sparse("R.mtx");
    const Vector ones = Vector::Ones(T.cols());
    EXPECT_EQ(Vector(T * ones), Vector(Vector::Ones(T.rows())));
    EXPECT_EQ(Vector(R * (T * ones)), Vector(0.5 * ones));
    EXPECT_EQ(Vector(dense("b.mtx")), Vector(0.5 * ones));
    EXPECT_NEAR(dense("measure.mtx").sum(), 24.0 * pi, 1e-11);
    EXPECT_NE(done.out.find("\n    R = scipy.io.mmread(\"R.mtx\").tocsr()\n"), std::string::npos) << done.out;
}

// With the lines that are printed.
TEST_F(ExportCommand, SciPyReadsIt) {
    const Finished done = exported(box, {"--with-K"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    std::istringstream lines(done.out);
    std::string line, program;
    while (std::getline(lines, line))
        if (line.starts_with("    ")) program += line.substr(4) + "\n";
    program += "assert abs(R @ T - K).max() <= 1e-15\nassert Le.shape == (K.shape[0], 3)\nprint('read')\n";
    write("a/read.py", "import os\nos.chdir('a')\n" + program);
    const Finished read = run_program({PYTHON, "a/read.py"});
    EXPECT_EQ(read.exit_code, 0) << read.err;
    EXPECT_EQ(read.out, "read\n");
}

TEST_F(ExportCommand, TheSameAgainAndOnAnyNumberOfThreads) {
    ASSERT_EQ(exported(box, {"-t", "1", "--quiet"}).out, "");
    const auto first = contents("a");
    ASSERT_EQ(exported(box, {"-t", "2", "--quiet"}).exit_code, 0);
    for (const auto& [name, text] : contents("a")) {
        if (name != "run.json") {
            EXPECT_EQ(text, first.at(name)) << name;
        }
    }
}

TEST_F(ExportCommand, WithoutKTheOneOfAnEarlierRunGoes) {
    ASSERT_EQ(exported(furnace, {"--with-K"}).exit_code, 0);
    EXPECT_TRUE(names("a").contains("K.mtx"));
    write("a/notes.txt", "mine");
    ASSERT_EQ(exported(furnace).exit_code, 0);
    EXPECT_FALSE(names("a").contains("K.mtx"));
    EXPECT_TRUE(names("a").contains("notes.txt"));
}

TEST_F(ExportCommand, PicturesOfARenderStay) {
    write("a/bounce_000.exr", "picture");
    EXPECT_EQ(refusal({furnace, "-o", "a"}),
              "a: holds the pictures of a render, which the matrices would replace; name another folder with -o\n");
    EXPECT_EQ(names(), (Names{"a", "a/bounce_000.exr"}));
}

TEST_F(ExportCommand, NothingHalfWritten) {
    // A disk that is full.
    std::vector<std::string> arguments{"export", furnace};
    arguments.insert(arguments.end(), small.begin(), small.end());
    const Finished full = run(arguments, 2000);
    EXPECT_EQ(full.exit_code, 1);
    EXPECT_EQ(full.err, "neumann: a/T.mtx: cannot be written: File too large\n");
    EXPECT_EQ(names(), Names{});
    // Ctrl-C, while the first of some 60 MB are written.
    RunningCommand command =
        start({"export", furnace, "--patches", "8000", "--directions", "64", "--with-K", "-o", "a", "-t", "1"});
    for (int i = 0; i < 3000 && !std::filesystem::exists(path("a/.T.mtx.partial")); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    command.signal(SIGINT);
    const Finished done = command.wait();
    EXPECT_EQ(done.exit_code, 1);
    EXPECT_EQ(done.err, "neumann: interrupted; nothing was written\n");
    EXPECT_EQ(done.out, "");
    EXPECT_EQ(names(), Names{});
}

TEST_F(ExportCommand, Refusals) {
    EXPECT_EQ(refusal({furnace, "--patches", "0"}),
              "--patches: '0' is not a whole number from 1 to 1099511627776\nRun with --help for more information.\n");
    EXPECT_EQ(
        refusal({furnace, "--directions", "3"}),
        "--directions: '3' is not a power of two from 1 to 1048576, such as 32 or 64\nRun with --help for more information.\n");
    write("file", "");
    EXPECT_EQ(refusal({furnace, "--patches", "6", "-o", "file"}), "file: cannot be written: Not a directory\n");
    const std::string many = refusal({furnace, "--patches", "9000000", "--directions", "1048576"});
    EXPECT_TRUE(many.ends_with(" patches of as many rays fit\n")) << many;
    EXPECT_EQ(names(), Names{"file"});
}

}  // namespace neumann::export_command_test
