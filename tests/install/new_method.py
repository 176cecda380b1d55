"""Adds a method by CONTRIBUTING's recipe to a copy of the sources, builds the program and compares its pictures with the walk's.

    new_method.py SOURCE FOLDER CXX [LAUNCHER]
"""

import json
import shutil
import subprocess
import sys
from pathlib import Path

SOURCE, FOLDER = Path(sys.argv[1]), Path(sys.argv[2])
CXX, LAUNCHER = sys.argv[3], sys.argv[4] if len(sys.argv) > 4 else ""

OPTIONS = """// Walks that leave nothing out.
struct Straight : PathOptions {
    static constexpr const char* name = "straight";
    static constexpr const char* help = "walks that leave nothing out";

    std::shared_ptr<const PathMethod> prepare(const Preparing& preparing) const;
    bool operator==(const Straight&) const = default;
};

"""
METHOD = """#include "operators/render/from_paths/path_method.h"
#include "operators/render/from_paths/term_estimators.h"
#include "operators/render/methods/method.h"

namespace neumann {

namespace {

class StraightPaths : public PathMethod {
public:
    std::shared_ptr<const PathSampler> sampler(const Scene& scene, const SamplingSettings& settings) const override {
        return walk_sampler(scene, settings, MaterialContinuation());
    }
    double walks_worth(int, std::span<const double>) const override { return 1.0; }
    bool is_bounded(const SamplingSettings& settings) const override { return settings.weighs_directions(); }
};

}  // namespace

std::shared_ptr<const PathMethod> method::Straight::prepare(const Preparing&) const { return std::make_shared<const StraightPaths>(); }

}  // namespace neumann
"""


def put_before(path, mark, text):
    said = path.read_text()
    assert said.count(mark) == 1, f"{path}: '{mark}' is not there once"
    path.write_text(said.replace(mark, text + mark))


def run(*command):
    subprocess.run([str(word) for word in command], check=True)


def output(*command):
    return subprocess.run([str(word) for word in command], check=True, stdout=subprocess.PIPE, text=True).stdout


copy, build = FOLDER / "source", FOLDER / "build"
shutil.rmtree(copy, ignore_errors=True)
shutil.copytree(SOURCE, copy, ignore=lambda folder, names: {"build", "out", ".git"} & set(names) if Path(folder) == SOURCE else set())
methods = copy / "operators/render/methods"
put_before(methods / "method.h", "// Options of all methods with fields on patches.", OPTIONS)
put_before(methods / "method.h", "method::Matrix, method::Gather, method::Patches>;", "method::Straight, ")
(methods / "straight_method.cpp").write_text(METHOD)

run("cmake", "-S", copy, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DNEUMANN_TESTS=OFF", "-DNEUMANN_BENCHMARKS=OFF",
    "-DNEUMANN_PYTHON=OFF", f"-DCMAKE_CXX_COMPILER={CXX}", f"-DCMAKE_CXX_COMPILER_LAUNCHER={LAUNCHER}")
run("cmake", "--build", build, "--target", "neumann")
neumann = build / "apps/neumann"
assert "straight: walks that leave nothing out" in " ".join(output(neumann, "render", "--help").split())
for name, options in (("straight", ()), ("walk", ("--plan", "full"))):
    run(neumann, "render", copy / "scenes/cornell-box/cornell-box.xml", "-D", "res=16", "--spp", 4, "-n", 3, "--method", name, *options,
        "-o", FOLDER / name, "--quiet")
for picture in ("bounce_000.exr", "bounce_001.exr", "bounce_002.exr", "bounce_003.exr"):
    found = json.loads(output(neumann, "compare", "--json", FOLDER / "straight" / picture, FOLDER / "walk" / picture))
    [figures] = found["pictures"]
    assert figures["rmse"] == 0.0 and figures["mean"] > 0.0, figures
run(neumann, "replay", FOLDER / "straight", "--pixel", "8,8", "--sample", 0)
