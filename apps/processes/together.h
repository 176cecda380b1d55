// Work in which all processes that were started together take part.
#pragma once

#include "core/base/error.h"
#include "core/base/processes/processes.h"

#include <exception>

namespace neumann {

// Says what is wrong with this process, and ends it; the launcher ends the others.
[[noreturn]] void end_all(const Processes& processes, const std::exception& error);

// What work() returns, which all processes do together. What is wrong with the input all find; another error of one of them ends
// them all, for others may be waiting for it.
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
