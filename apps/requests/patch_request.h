// The requests of `neumann solve`, `spectrum` and `export`: a scene on patches, and what is done with its matrices.
#pragma once

#include "apps/requests/option.h"
#include "apps/requests/scene_file.h"

#include <cstdint>
#include <optional>
#include <string>

namespace neumann {

struct PatchOptions {
    SceneFile scene;
    std::uint64_t patches = 2000;
    std::uint32_t rays = 64;  // per facet, a power of two
    std::uint64_t seed = 0;
    int threads = 0;                  // 0: all
    std::optional<double> memory;     // GiB
    std::optional<std::string> keep;  // folder for the rows of T
    std::optional<double> checkpoint;
    bool quiet = false;
    bool json = false;
    std::string command_line;  // as typed
};

struct SolveRequest {
    PatchOptions patches;
    std::string channel;  // r, g, b; empty: the one with the largest spectral radius
    double tolerance = 1e-6;
    int most = 10000;  // largest number of applications of K
    bool csv = false;
    std::optional<std::string> petsc;  // PETSc's options; empty: a few kinds
};

struct SpectrumRequest {
    PatchOptions patches;
    std::string channel;  // r, g, b; empty: all
    int eigenvalues = 4;
    double seconds = 60.0;
    int most = 10000;  // largest number of applications of K in a search
    bool csv = false;
    std::optional<std::string> petsc;  // SLEPc's options
};

struct ExportRequest {
    PatchOptions patches;
    std::string output;  // a folder; empty: out/NAME-matrices
    bool with_K = false;
};

const Options<SolveRequest>& solve_options();
const Options<SpectrumRequest>& spectrum_options();
const Options<ExportRequest>& export_options();

}  // namespace neumann
