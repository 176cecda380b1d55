#include "core/base/module.h"

#include "core/base/error.h"

#include <dlfcn.h>

namespace neumann {

void* function_in_module(const char* file, const char* name, const std::string& without) {
    void* const library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr)
        throw RunError(
            without +
            ", because part of neumann is missing, which where it was built cmake --build build/release builds: " + dlerror());
    void* const function = dlsym(library, name);
    if (function == nullptr) throw RunError(without + ": " + dlerror());
    return function;
}

}  // namespace neumann
