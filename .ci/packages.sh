# shellcheck shell=bash disable=SC2034,SC2154
# What neumann needs, and the functions that install it and build. Sourced by ../run and ../test, which set $root and $build.
#
# One line each: Debian package | what it is | a command, file or headers by which it is recognised where there is no apt (any of them is enough)

packages_to_run='
g++                 | a C++20 compiler                        | c++ g++ clang++
cmake               | CMake 3.25 or later                     | cmake
ninja-build         | Ninja                                   | ninja
libembree-dev       | Embree 3.13 or 4                        | embree4/rtcore.h embree3/rtcore.h
libopenimageio-dev  | OpenImageIO 2.4 or later                | OpenImageIO/imageio.h
libopenexr-dev      | OpenEXR 3.1 or later                    | OpenEXR/ImfOutputFile.h
libpng-dev          | libpng                                  | png.h
libgif-dev          | giflib 5                                | gif_lib.h
libhpdf-dev         | libharu 2.3 or later, PDF files         | hpdf.h
libfreetype-dev     | FreeType                                | freetype2/ft2build.h
libdeflate-dev      | libdeflate                              | libdeflate.h
libglm-dev          | GLM                                     | glm/glm.hpp
libtbb-dev          | oneTBB 2021 or later                    | tbb/parallel_for.h
libpugixml-dev      | pugixml                                 | pugixml.hpp
libimath-dev        | Imath 3.1 or later, half floats         | Imath/half.h
zlib1g-dev          | zlib                                    | zlib.h
libcli11-dev        | CLI11                                   | CLI/CLI.hpp
nlohmann-json3-dev  | JSON for Modern C++ 3.11 or later       | nlohmann/json.hpp
libfmt-dev          | {fmt}                                   | fmt/format.h
libboost-dev        | Boost 1.74 or later, headers only       | boost/version.hpp
libeigen3-dev       | Eigen 3.4 or later                      | eigen3/Eigen/src/Core/Matrix.h Eigen/src/Core/Matrix.h
libspectra-dev      | Spectra                                 | Spectra/Util/Version.h
librandom123-dev    | Random123                               | Random123/philox.h
libxxhash-dev       | xxHash                                  | xxhash.h
libnanoflann-dev    | nanoflann 1.4 or later                  | nanoflann.hpp
libjs-chart.js      | Chart.js 3 or 4, for plots of pages     | /usr/share/javascript/chart.js/chart.min.js
fonts-dejavu-core   | the DejaVu fonts, for labels (optional) |
'

packages_to_python='
python3             | Python 3                                | python3
python3-dev         | its headers                             |
pybind11-dev        | pybind11 2.10 or later                  |
python3-numpy       | NumPy                                   |
python3-scipy       | SciPy: T, R and K are its matrices      |
python3-matplotlib  | matplotlib, with which the lessons draw |
'

packages_to_mpi='
libopenmpi-dev      | Open MPI 4.1 or later                   | mpi.h mpicxx
openmpi-bin         | its launcher                            | mpirun
libpetsc-real-dev   | PETSc 3.18 or later, for real numbers   | petsc.h
libslepc-real-dev   | SLEPc 3.18 or later, likewise           | slepc.h
'

packages_to_site='
python3-markdown    | Python-Markdown, which makes pages      |
libjs-katex         | KaTeX, formulas of lessons (optional)   |
python3-nbclient    | nbclient, which runs lessons            |
python3-nbformat    | nbformat, which reads them              |
python3-ipykernel   | the kernel for Python of Jupyter        |
'

packages_to_test='
libgtest-dev        | GoogleTest                              | gtest/gtest.h
libbenchmark-dev    | Google Benchmark                        | benchmark/benchmark.h
dpkg-dev            | what cpack finds dependencies with      | dpkg-shlibdeps
file                | file, which cpack asks of each file     | file
python3-openimageio | the Python module of OpenImageIO        |
python3-ipywidgets  | ipywidgets, sliders of lessons          |
mypy                | mypy, a type checker, for keywords      | mypy
chromium            | Chromium, in which pages are tested     | chromium chromium-browser google-chrome
firefox-esr         | Firefox, in which pages are tested      | firefox firefox-esr
nodejs              | Node.js 18 or later, which drives it    | node nodejs
npm                 | npm, which fetches playwright-core      | npm
'

say() { printf '%s\n' "$*" >&2; }

# The packages of the given table that dpkg does not know as installed.
missing_packages() {
    local names name installed
    names=$(sed -n 's/^\([^ |]\{1,\}\).*/\1/p' <<<"$1")
    # shellcheck disable=SC2086
    installed=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' $names 2>/dev/null || true)
    for name in $names; do
        grep -qxF "installed $name" <<<"$installed" && continue
        # Node.js from elsewhere brings an npm of its own, and excludes Debian's.
        [[ $name == npm ]] && command -v npm >/dev/null && continue
        printf '%s ' "$name"
    done
}

# Where there is no apt: the descriptions of what neither the PATH nor the compiler's include path has.
missing_by_name() {
    local description probes probe found
    grep '|' <<<"$1" | while IFS='|' read -r _ description probes; do
        found=
        for probe in $probes; do
            case $probe in
            /*) [[ -e $probe ]] && found=1 ;;
            *.h | *.hpp) "${CXX:-c++}" -E -x c++ -include "$probe" /dev/null >/dev/null 2>&1 && found=1 ;;
            *) command -v "$probe" >/dev/null && found=1 ;;
            esac
        done
        [[ -n $found || -z ${probes// /} ]] || sed 's/^ */    /; s/ *$//' <<<"$description"
    done
}

# install_missing TABLE LOG: afterwards the packages are there, or it has been said which are not. Never fails: CMake has the last word.
install_missing() {
    local missing as_root=() log=$2
    if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
        # Asked only before the first build: it takes a second.
        configured && return 0
        missing=$(missing_by_name "$1")
        [[ -z $missing ]] || say "This system has no apt, and these were not found:" "$(printf '\n%s' "$missing")"
        return 0
    fi
    missing=$(missing_packages "$1")
    [[ -n $missing ]] || return 0
    if [[ -e $build/build.ninja && -e $log.failed && $missing == "$(<"$log.failed")" ]]; then
        say "Still missing, and not tried again (remove ${log#"$root/"}.failed for that): $missing"
        return 0
    fi
    say "Missing packages: $missing"
    if ((EUID != 0)); then
        if ! command -v sudo >/dev/null; then
            say "Not root, and no sudo: an administrator has to install them. Going on with what is there."
            return 0
        fi
        as_root=(sudo)
    fi
    say "Installing them; this takes a minute or two. Details: ${log#"$root/"}"
    mkdir -p "$(dirname "$log")"
    as_root+=(env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300)
    # shellcheck disable=SC2024
    "${as_root[@]}" update >"$log" 2>&1 || say "apt-get update failed; going on with the lists of before."
    # shellcheck disable=SC2024,SC2086
    if ! "${as_root[@]}" install -y --no-install-recommends $missing >>"$log" 2>&1; then
        tail -n 5 "$log" >&2
        say "Not everything could be installed. Going on with what is there."
        printf '%s' "$missing" >"$log.failed"
    fi
}

# What drives Chromium in tests/browser, as its lock file pins it, into build/browser. Never fails: CMake says what is missing.
install_browser_driver() {
    local from=$root/tests/browser to=$root/build/browser
    [[ -d $to/node_modules/playwright-core ]] && cmp -s "$from/package-lock.json" "$to/package-lock.json" && return 0
    command -v npm >/dev/null || return 0
    say "Fetching playwright-core with npm. Details: ${to#"$root/"}/npm.log"
    mkdir -p "$to"
    cp "$from/package.json" "$from/package-lock.json" "$to"
    if ! (cd "$to" && npm ci --no-audit --no-fund >npm.log 2>&1); then
        rm -f "$to/package-lock.json"
        say "npm could not fetch it."
    fi
}

# Whether $build was configured, and here: a folder that was moved has to be configured afresh.
configured() {
    [[ -e $build/build.ninja && $(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$build/CMakeCache.txt") -ef $root ]]
}

# build_in PRESET "TARGET..." [CMake option...]: configures where needed or where options are given, and builds. What is up to date is not mentioned.
build_in() {
    local preset=$1 targets fresh=()
    read -ra targets <<<"$2"
    shift 2
    configured || fresh=(--fresh)
    if (($# > 0 || ${#fresh[@]} > 0)); then
        # Errors and warnings remain, on stderr.
        (cd "$root" && cmake --preset "$preset" "${fresh[@]}" "$@" >/dev/null) || return 1
    fi
    cmake --build "$build" --target "${targets[@]}" -j "$(nproc)" | sed -u '/no work to do/d; /Re-checking globbed/d' >&2
}
