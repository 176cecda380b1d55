#include "core/base/memory.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

namespace neumann {

namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

// "max", and a file that does not exist, are no limit.
double limit_in(const std::filesystem::path& file) {
    double bytes = no_limit;
    return std::ifstream(file) >> bytes ? bytes : no_limit;
}

// A group may use no more than the groups around it. In a container its path is often the host's, and the visible part
// of the tree begins with the container.
double limit_of_group(const std::filesystem::path& tree, const std::string& group, const char* file) {
    double least = no_limit;
    for (std::filesystem::path at = group;; at = at.parent_path()) {
        least = std::min(least, limit_in(tree / at.relative_path() / file));
        if (!at.has_relative_path()) return least;
    }
}

// Reads the groups of cgroups(7), versions 1 and 2: lines such as "4:memory:/a/b", "0::/a/b".
double limit_of_groups() {
    double least = no_limit;
    std::ifstream groups("/proc/self/cgroup");
    for (std::string line; std::getline(groups, line);) {
        const auto first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos) continue;
        std::string controllers = ",";
        controllers.append(line, first + 1, second - first - 1).append(",");
        const std::string group = line.substr(second + 1);
        if (controllers == ",,") least = std::min(least, limit_of_group("/sys/fs/cgroup", group, "memory.max"));
        if (controllers.find(",memory,") != std::string::npos)
            least = std::min(least, limit_of_group("/sys/fs/cgroup/memory", group, "memory.limit_in_bytes"));
    }
    return least;
}

}  // namespace

double usable_memory() {
    static const double bytes = std::min(physical_memory(), limit_of_groups());
    return bytes;
}

}  // namespace neumann
