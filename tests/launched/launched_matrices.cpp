// solve and spectrum on several processes, started by mpirun as users start them, beside one process; PETSc on one process.
#include "tests/launched/launched_test.h"

#include <cmath>

namespace neumann::launched_matrices_test {

using Json = nlohmann::json;

class LaunchedMatrices : public LaunchedTest {
protected:
    // The JSON that a command prints on so many processes; 0: without a launcher.
    Json printed_on(int processes, const std::vector<std::string>& arguments) const {
        const Finished done = run_program(on(processes, neumann(arguments)));
        EXPECT_EQ(done.exit_code, 0) << done.err;
        return done.exit_code == 0 ? Json::parse(done.out) : Json();
    }
    static std::string scene(const std::string& name) { return std::string(SCENES) + "/" + name + "/" + name + ".xml"; }
    static Json row(const Json& solved, const std::string& name) {
        for (const Json& solver : solved.at("solvers"))
            if (solver.at("name") == name) return solver;
        ADD_FAILURE() << "no row " << name;
        return {};
    }
};

TEST_F(LaunchedMatrices, ObeyTheLawsOfOneProcess) {
    const std::pair<const char*, const char*> scenes[] = {
        {"furnace", "300"}, {"cornell-box", "500"}, {"glossy-floor", "40"}, {"glass-ball", "60"}};
    for (const int processes : {1, 2, 3}) {
        for (const auto& [name, patches] : scenes) {
            if (processes == 1 && name != std::string("furnace")) continue;
            SCOPED_TRACE(fmt::format("{} on {}", name, processes));
            const Finished done = run_program(on(processes, {SHARED_LAWS, scene(name), patches, "64"}));
            ASSERT_EQ(done.exit_code, 0) << done.err;
            const Json laws = Json::parse(done.out);
            EXPECT_EQ(laws.at("processes"), processes);
            if (name == std::string("furnace")) {
                EXPECT_LE(laws.at("closure"), 1e-14);
            }
            EXPECT_EQ(laws.at("terms"), 0.0);  // the same bits
            EXPECT_EQ(laws.at("gathered"), 0.0);
            EXPECT_LE(laws.at("adjoint"), 1e-13);
            EXPECT_LE(laws.at("entries"), 1e-13);
            EXPECT_LE(laws.at("sums"), 1e-13);
            EXPECT_LE(laws.at("enclosures"), 1e-13);
            // Nobody has all of T.
            EXPECT_LE(laws.at("most_rays").get<double>(), 1.3 * laws.at("rays").get<double>() / processes);
        }
    }
}

TEST_F(LaunchedMatrices, HaveTheEigenvaluesOfOneProcess) {
    const std::vector<std::string> command{
        "spectrum", scene("sphere-segment"), "--patches", "300", "--eigenvalues", "2", "--time", "1000", "--json", "--quiet"};
    const Json alone = printed_on(0, command);
    for (const int processes : {2, 3}) {
        SCOPED_TRACE(processes);
        const Json shared = printed_on(processes, command);
        for (std::size_t c = 0; c < alone.at("channels").size(); ++c) {
            const Json &a = alone.at("channels")[c], &b = shared.at("channels")[c];
            for (const char* norm : {"inf", "1", "2"}) EXPECT_NEAR(a.at("norms").at(norm), b.at("norms").at(norm), 1e-10) << norm;
            EXPECT_NEAR(a.at("norm_1_standard_error"), b.at("norm_1_standard_error"), 1e-10);
            EXPECT_NEAR(a.at("spectral_radius"), b.at("spectral_radius"), 1e-9);
            for (std::size_t i = 0; i < 2; ++i)
                EXPECT_NEAR(a.at("eigenvalues")[i].at("real"), b.at("eigenvalues")[i].at("real"), 1e-8);
            EXPECT_EQ(a.at("bounces_until"), b.at("bounces_until"));
        }
    }
}

TEST_F(LaunchedMatrices, SolveAsOneProcessDoes) {
    const std::vector<std::string> command{"solve", scene("furnace"), "-D",   "albedo=0.9", "--patches",
                                           "300",   "--error",        "1e-8", "--json"};
    const Json alone = printed_on(0, command);
    const Json shared = printed_on(3, command);
    EXPECT_EQ(shared.at("reference"), "gmres");
    for (const char* name : {"neumann", "ratio-tail", "chebyshev"}) {
        EXPECT_EQ(row(shared, name).at("applications"), row(alone, name).at("applications")) << name;
        EXPECT_LE(row(shared, name).at("error"), 1e-8) << name;
    }
    for (const char* name : {"petsc-gmres-none", "petsc-gmres-jacobi", "petsc-bcgs-bjacobi", "petsc-gmres-gamg"}) {
        EXPECT_EQ(row(shared, name).at("verdict"), "converged") << name;
        EXPECT_LE(row(shared, name).at("error"), 1e-8) << name;
    }
}

// Whose rays they are does not matter: three processes go on with those of two, of which one died.
TEST_F(LaunchedMatrices, KeepTheirRays) {
    const auto command = [&](const std::vector<std::string>& options) {
        std::vector<std::string> all{"solve", scene("cornell-box"), "--patches", "500", "--directions", "4096", "--json"};
        all.insert(all.end(), options.begin(), options.end());
        return all;
    };
    const auto terms = [&](const Json& solved) {
        Json history = row(solved, "neumann").at("history");
        for (Json& step : history) step.erase("seconds");
        return history;
    };
    {
        RunningCommand dying = start_on(2, command({"--keep", "rows", "--checkpoint", "0.01"}));
        ASSERT_TRUE(wait_for("rows/rows_001_00001.kept"));
        kill(process(1, "rows").value(), SIGKILL);
        EXPECT_NE(dying.wait().exit_code, 0);
    }
    const Json shared = printed_on(3, command({"--keep", "rows"}));
    const auto kept = names("rows");
    EXPECT_TRUE(kept.contains("rows_002_00000.kept"));
    // All are there: none is traced again.
    EXPECT_EQ(terms(printed_on(2, command({"--keep", "rows"}))), terms(printed_on(2, command({}))));
    printed_on(0, command({"--keep", "rows"}));
    EXPECT_EQ(names("rows"), kept);
    EXPECT_EQ(terms(shared), terms(printed_on(3, command({}))));
}

TEST_F(LaunchedMatrices, AFolderThatIsInUseIsRefusedByAll) {
    RunningCommand other = start_program(
        neumann({"solve", scene("cornell-box"), "--patches", "4000", "--directions", "65536", "--keep", "rows", "-t", "1"}));
    ASSERT_TRUE(wait_for("rows"));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    const Finished done = run_on(2, {"solve", scene("cornell-box"), "--keep", "rows"});
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_NE(done.err.find("rows: another run is writing there\n"), std::string::npos) << done.err;
    other.signal(SIGKILL);
    other.wait();
}

// Whether the parser tells it, the request, or the command.
TEST_F(LaunchedMatrices, OneSpeaksOfWhatIsWrong) {
    const std::vector<std::vector<std::string>> cases{{"--channel", "x", "--channel: x not in {r,g,b}"},
                                                      {"-D", "res", "-D res: expected name=value"},
                                                      {"-D", "colour=red", "-D colour=red: nothing"}};
    for (const auto& wrong : cases) {
        const Finished done = run_program(on(2, neumann({"solve", scene("furnace"), wrong[0], wrong[1]})));
        EXPECT_EQ(done.exit_code, 2);
        EXPECT_EQ(done.out, "");
        ASSERT_NE(done.err.find(wrong[2]), std::string::npos) << done.err;
        EXPECT_EQ(done.err.find(wrong[2], done.err.find(wrong[2]) + 1), std::string::npos) << done.err;
    }
}

class PetscOfOneProcess : public LaunchedMatrices {};

TEST_F(PetscOfOneProcess, SolvesAsOursDo) {
    const Json solved =
        printed_on(0, {"solve", scene("cornell-box"), "--patches", "600", "--error", "1e-9", "--petsc", "--json", "--quiet"});
    for (const char* name : {"petsc-gmres-none", "petsc-gmres-jacobi", "petsc-bcgs-bjacobi", "petsc-gmres-gamg"}) {
        EXPECT_EQ(row(solved, name).at("verdict"), "converged") << name;
        EXPECT_LE(row(solved, name).at("error"), 1e-9) << name;  // against LU
        EXPECT_FALSE(row(solved, name).at("history").empty());
    }
}

TEST_F(PetscOfOneProcess, TakesOptionsAndTellsOfThoseThatNothingReads) {
    const Finished done = run({"solve", scene("furnace"), "--petsc", "-ksp_type bcgs -pc_type asm -sub_pc_type lu -ksp_typo 3"});
    EXPECT_EQ(done.exit_code, 0);
    EXPECT_NE(done.out.find("PETSc bcgs/asm"), std::string::npos) << done.out;
    EXPECT_EQ(done.err, "warning: PETSc: nothing has asked for the option -ksp_typo 3\n");
    const Finished wrong = run({"solve", scene("furnace"), "--petsc", "-ksp_type gmress"});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_EQ(wrong.err, "--petsc: PETSc: Unable to find requested KSP type gmress\n");
}

TEST_F(PetscOfOneProcess, FindsTheEigenvaluesThatSpectraFinds) {
    const Json found = printed_on(0, {"spectrum", scene("cornell-box"), "--patches", "600", "--petsc", "--json", "--quiet"});
    for (const Json& channel : found.at("channels")) {
        ASSERT_TRUE(channel.at("slepc").at("converged"));
        for (std::size_t i = 0; i < 4; ++i)
            EXPECT_NEAR(channel.at("eigenvalues")[i].at("real"), channel.at("slepc").at("eigenvalues")[i].at("real"), 1e-8);
    }
}

TEST_F(PetscOfOneProcess, IsMissedByNameAndOnlyWhereItIsAskedFor) {
    write("libneumann_petsc.so", "");
    const auto without = [&](std::vector<std::string> arguments) {
        std::vector<std::string> command{"/usr/bin/env", "LD_LIBRARY_PATH=" + folder().string()};
        for (const std::string& word : neumann(arguments)) command.push_back(word);
        return run_program(command);
    };
    const Finished done = without({"solve", scene("furnace"), "--petsc"});
    EXPECT_EQ(done.exit_code, 1);
    EXPECT_EQ(done.out, "");
    EXPECT_NE(done.err.find("PETSc needs neumann with -DNEUMANN_MPI=ON"), std::string::npos) << done.err;
    EXPECT_EQ(without({"solve", scene("furnace")}).exit_code, 0);
}

}  // namespace neumann::launched_matrices_test
