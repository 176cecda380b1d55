// How a series or a solver ended. "Stopped" is not "converged".
#pragma once

namespace neumann {

enum class Verdict {
    converged,   // the estimated error is below the tolerance
    rounding,    // as close as rounding lets it come, which is not as close as the tolerance
    limit,       // the applications allowed were used up before
    diverging,   // the terms do not get smaller, and the spectral radius is 1 or more: there is no L
    broke_down,  // a division by zero, or numbers that are not finite: the method has no answer here
    refused      // there is an answer, but not one to rely on; `why` says what is wrong with it
};

inline const char* name(Verdict verdict) {
    switch (verdict) {
        case Verdict::converged:
            return "converged";
        case Verdict::rounding:
            return "rounding";
        case Verdict::limit:
            return "limit";
        case Verdict::diverging:
            return "diverging";
        case Verdict::broke_down:
            return "broke down";
        case Verdict::refused:
            return "refused";
    }
    return "";
}

}  // namespace neumann
