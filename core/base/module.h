// Loads parts of the program when they are first needed, because of the libraries that they bring along.
#pragma once

#include <string>

namespace neumann {

// A function in a module. Throws RunError, which begins with `without` ("pictures cannot be read"), if it is not there.
void* function_in_module(const char* file, const char* name, const std::string& without);

// What the function of this name, `extern "C" const Offer* name()`, offers.
template <class Offer>
const Offer& offer_of_module(const char* file, const char* name, const std::string& without) {
    return *reinterpret_cast<const Offer* (*)()>(function_in_module(file, name, without))();
}

}  // namespace neumann
