#include "core/base/peak_memory.h"

#include <malloc.h>

#include <fstream>
#include <string>

namespace neumann {

bool restart_peak_memory() {
    malloc_trim(0);  // memory freed by earlier work does not count for this one
    std::ofstream file("/proc/self/clear_refs");
    return static_cast<bool>(file << "5" << std::flush);
}

double peak_memory() {
    std::ifstream file("/proc/self/status");
    for (std::string name; file >> name;) {
        if (name != "VmHWM:") continue;
        double kibibytes = 0.0;
        file >> kibibytes;
        return kibibytes * 1024.0;
    }
    return 0.0;
}

}  // namespace neumann
