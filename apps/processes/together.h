// Work in which all processes that were started together take part.
#pragma once

#include "core/base/error.h"
#include "core/base/processes/processes.h"

#include <exception>

namespace neumann {

// Reports an error of this process and ends it; the launcher ends the others.
[[noreturn]] void end_all(const Processes& processes, const std::exception& error);

// Returns the result of work(), which all processes do together. All of them find the same errors of the input; another
// error of one ends them all, because others may be waiting for it.
template <class Work>
auto together(Processes& processes, const Work& work) -> decltype(work()) {
    try {
        return work();
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& e) {
        end_all(processes, e);
    }
}

}  // namespace neumann
